"""A measure of one's own beside ACC: how often the suspension's travel crosses 30 mm, by Rice's formula."""

import numpy as np

import suspension_ctrl as sc


def strikes(frequency: np.ndarray, psd: dict[str, np.ndarray]) -> float:
    """Return up-crossings of 30 mm per kilometre at 20 m/s."""
    travel = psd["suspension_travel"]
    variance = np.trapezoid(travel, frequency)
    rate = np.sqrt(np.trapezoid((2 * np.pi * frequency) ** 2 * travel, frequency) / variance) / (2 * np.pi)
    return float(rate * np.exp(-(0.03**2) / (2 * variance)) * 1000 / 20)


car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
problem = sc.RideProblem(
    car,
    sc.Iso8608Road("D"),
    speed=20.0,
    bounds={"spring": (10e3, 40e3), "damper": (800.0, 5e3)},
    measures=["ACC", sc.Measure("strikes", "1/km", strikes)],
)
run = sc.minimise(problem, sc.Nsga2(population=40), iterations=15, seed=1)
print(run.front().sort_values("ACC [m/s^2]").iloc[[0, -1]].round(3).to_string(index=False))

"""
A measure of your own beside ACC
================================

How often the travel crosses 30 mm in compression, by Rice's formula: for a Gaussian response of variance m0
and rate variance m2 the level a is crossed upwards (m2/m0)^0.5/(2 pi) exp(-a^2/(2 m0)) times a second.
"""

import matplotlib.pyplot as plt
import numpy as np

import suspension_ctrl as sc


def strikes(frequency: np.ndarray, psd: dict[str, np.ndarray]) -> float:
    """Return crossings of 30 mm per kilometre at 20 m/s."""
    travel = psd["suspension_travel"]
    m0 = np.trapezoid(travel, frequency)
    m2 = np.trapezoid((2 * np.pi * frequency) ** 2 * travel, frequency)
    return float(np.sqrt(m2 / m0) / (2 * np.pi) * np.exp(-(0.03**2) / (2 * m0)) * 1000 / 20)


car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
problem = sc.RideProblem(
    car,
    sc.Iso8608Road("D"),
    speed=20.0,
    bounds={"spring": (10e3, 40e3), "damper": (800.0, 5e3)},
    measures=["ACC", sc.Measure("strikes", "1/km", strikes)],
)
run = sc.minimise(problem, sc.Nsga2(population=40), iterations=15, seed=1)
front = run.front().sort_values("ACC [m/s^2]")
print(front.iloc[[0, -1]].round(3).to_string(index=False))

# %%
# The front of comfort against strikes; firmer dampers stand on the right.
front.plot.scatter("ACC [m/s^2]", "strikes [1/km]", c="damper [N s/m]", colormap="viridis")
plt.show()

"""A quarter car on one strut of any parts, with derivatives beside complex steps."""

import numpy as np

import complex_step
import suspension_ctrl as sc

ROAD = sc.Iso8608Road("C")


def check(parts: tuple, tolerance: float) -> None:
    """Compare relative changes of each column by relative changes of all coefficients."""
    strut = sc.parallel(sc.Spring(), sc.Damper("base", 300.0), *parts, installation_ratio=0.95)
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    design = np.array(list(car.coefficients({"spring": 22e3}).values()))
    bounds = {one.name: (0.9 * x, 1.2 * x) for one, x in zip(car.strut_coefficients, design, strict=True)}
    problem = sc.RideProblem(car, ROAD, speed=20.0, bounds=bounds, band=(0.1, 20.0), constraints=["SWS <= 0.02"])
    values, found = problem.with_jacobian(design[None])
    np.testing.assert_allclose(values, problem.evaluate(design[None]), rtol=1e-12)
    expected = complex_step.jacobian(problem, design)
    scale = np.abs(expected * design).max(axis=1, keepdims=True) / design
    np.testing.assert_array_less(np.abs(found[0] - expected), tolerance * scale)

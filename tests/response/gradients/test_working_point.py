"""Slopes that move with the working point: the implicit function theorem by numpy, and as differences."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.gradients.working_point import point_of, settle_slopes
from suspension_ctrl.response.strut_data import networks_of

LAWS = [sc.BilinearDamper(f"law_{i}", bump=1000.0, rebound=1000.0) for i in range(3)]


def test_slopes_move_by_the_linear_equations_of_the_point():
    """With S = exp(A c + B x) and c = C z + E x, z = ln(S)/2 is linear: (2 - A C) z = (A E + B) x."""
    strut = sc.parallel(sc.Spring(), *LAWS)
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    setting = car.coefficients({"spring": 22e3})
    point = point_of(networks_of(car, setting, ["spring"], np.array([1.0]), np.eye(1, dtype=bool)))
    rng, c = np.random.default_rng(0), len(setting)
    a, b, by_z, by_x = (0.3 * rng.normal(size=shape) for shape in ((3, 3), (3, c), (3, 3), (3, c)))
    point.square[:] = rng.uniform(0.5, 2.0, 3)
    point.by_slope[:], point.by_value[:] = point.square[:, None] * a, point.square[:, None] * b
    point.rise[:] = np.hstack([by_x, by_z])
    settle_slopes(point)
    expected = by_x + by_z @ np.linalg.solve(2 * np.eye(3) - a @ by_z, a @ by_x + b)
    np.testing.assert_allclose(point.total, expected, rtol=1e-12)


def test_white_road_velocity_keeps_the_power_of_a_damper():
    """Of s^2 c in all slopes together: what a law gains in slope it loses in deviation.

    On a quarter car under white road velocity, kt S/2 whatever the spring and the damper, over one wide band: of
    0.1 to 100 Hz 1e-3 is missing, which changes by some of that.
    """
    strut = sc.parallel(sc.Spring(), sc.PowerDamper(force=5e3, exponent=1.6))
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    bounds = {"damper.force": (3e3, 8e3), "spring": (18e3, 25e3)}
    problem = sc.RideProblem(
        car, sc.Iso8608Road("C"), speed=20.0, bounds=bounds, struts={"damper.exponent": 1.6}, band=(0.1, 100.0),
        measures=["damper_power", "ACC"],
    )  # fmt: skip
    design = np.array([5e3, 22e3])
    values, found = problem.with_jacobian(design[None])
    assert np.abs(found[0, 0] * design / values[0, 0]).max() < 5e-3
    assert np.abs(found[0, 1] * design / values[0, 1]).max() > 0.1

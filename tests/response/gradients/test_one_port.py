"""Derivatives around one strut of any kind beside complex steps through the working point."""

import numpy as np
import pytest

import complex_step
import suspension_ctrl as sc

ROAD = sc.Iso8608Road("C")
DIGRESSIVE = sc.DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1, rebound_over_bump=1.7)
STOP = sc.BumpStop(gap=0.02, stiffness=60e3)
MOUNT = sc.Spring("mount", 200e3)
MEASURED = sc.MeasuredStiffness("bush", frequency=[0.1, 5.0, 30.0], storage=[1e5, 2e5, 3e5], loss=[1e4, 3e4, 3e4])
NETWORKS = {
    "a damper on a mount": sc.series(sc.Damper("own", 1500.0), MOUNT),
    "a damper on rubber": sc.series(sc.Damper("own", 1500.0), sc.Rubber("mount", storage=250e3, loss=25e3)),
    "a nested network": sc.series(
        sc.Damper("own", 1500.0),
        sc.parallel(MOUNT, sc.Inerter("mass", 50.0), sc.series(sc.Damper("inner", 400.0), sc.Spring("last", 1e5))),
        installation_ratio=0.8,
    ),
    "measured": sc.series(sc.Damper("own", 1500.0), sc.parallel(MEASURED, sc.Damper("beside", 100.0))),
}
LAWS = {
    "a digressive damper": (DIGRESSIVE,),
    "friction and a power": (sc.PowerDamper(force=5e3, exponent=1.6), sc.Friction(force=40.0)),
    "a stop": (sc.Damper("own", 1500.0), STOP),
    "a damper that pulls the car down on a stop": (sc.BilinearDamper(bump=750.0, rebound=2250.0), STOP),
    "a law on a mount": (sc.series(DIGRESSIVE, MOUNT, installation_ratio=0.9), STOP),
    "a stop on a spring": (
        DIGRESSIVE,
        sc.series(sc.Spring("top", 1.5e5), sc.parallel(sc.Spring("aux", 3e4), STOP)),
    ),
}


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


@pytest.mark.parametrize("name", NETWORKS)
def test_networks_to_rounding(name):
    check((NETWORKS[name],), 1e-10)


@pytest.mark.parametrize("name", LAWS)
def test_laws_as_near_as_the_working_point(name):
    """The iteration ends where deviations change by less than 1e-8; a further step is taken from there."""
    check(LAWS[name], 1e-7)

"""Derivatives of several struts of any kind beside complex steps through the working point."""

import numpy as np
import pytest

import complex_step
import suspension_ctrl as sc

FILE = sc.load_vehicle("jian_2022_full")
FULL = {n: getattr(FILE.vehicle, n) for n in FILE.vehicle.__dataclass_fields__ if "strut" not in n}
FRONT = sc.parallel(
    sc.Spring(),
    sc.DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1, rebound_over_bump=1.7),
    sc.BumpStop(gap=0.02, stiffness=60e3),
)
REAR = sc.parallel(
    sc.Spring(),
    sc.series(
        sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0]),
        sc.Spring("mount", 2e5),
    ),
)
MOUNTED = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount", 2e5)))
SETTING = {"front.spring": 1e4, "rear.spring": 1.3e4, "front_antiroll": 2e4}
CASES = {
    "networks": (MOUNTED, MOUNTED, {"front.damper": 1500.0, "rear.damper": 1700.0, "rear.mount": 2e5}, 1e-10),
    "laws": (FRONT, REAR, {"front.damper.knee": 0.1, "front.bump_stop.gap": 0.02, "rear.mount": 2e5}, 1e-7),
}


@pytest.mark.parametrize("laden", [False, True])
@pytest.mark.parametrize("name", CASES)
def test_derivatives_are_those_of_complex_steps(name, laden):
    """With payload on one side each port has laws of its own; a column's changes by shares of the variables."""
    front, rear, more, tolerance = CASES[name]
    car = sc.FullCar(**FULL, front_strut=front, rear_strut=rear)
    vehicle = sc.Payload(mass=250.0, position=(-0.4, 0.5)).on(car) if laden else car
    setting = {**SETTING, **more}
    bounds = {name: (0.95 * x, 1.1 * x) for name, x in setting.items()}
    problem = sc.RideProblem(
        vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=bounds, band=(0.3, 20.0), nodes=256,
        measures=["ACC", "SWS front", "DTL rear"], constraints=["SWS <= 0.02"],
    )  # fmt: skip
    design = np.array(list(setting.values()))
    values, found = problem.with_jacobian(design[None])
    np.testing.assert_allclose(values, problem.evaluate(design[None]), rtol=1e-12)
    v = slice(0, None) if name == "networks" else slice(3, 5)
    expected = complex_step.jacobian(problem, design, v)
    scale = np.abs(expected * design[v]).max(axis=1, keepdims=True) / design[v]
    np.testing.assert_array_less(np.abs(found[0][:, v] - expected), tolerance * scale)


def test_the_payload_varies():
    """Its weight moves the mean positions, its mass the loop."""
    car = sc.FullCar(**FULL, front_strut=FRONT, rear_strut=FRONT)
    vehicle = sc.Payload(mass=250.0, position=(-0.4, 0.0)).on(car)
    bounds = {"payload.mass": (200.0, 300.0), "front.spring": (9e3, 12e3)}
    problem = sc.RideProblem(
        vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=bounds,
        struts={"rear.spring": 1.3e4}, band=(0.3, 20.0), nodes=256,
    )  # fmt: skip
    design = np.array([260.0, 1e4])
    expected = complex_step.jacobian(problem, design)
    scale = np.abs(expected * design).max(axis=1, keepdims=True) / design
    np.testing.assert_array_less(np.abs(problem.jacobian(design[None])[0] - expected), 1e-7 * scale)

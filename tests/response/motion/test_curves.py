"""Curves in time beside their closed forms, jumps as ramps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import suspension_ctrl as sc
from suspension_ctrl.response.motion.crossings import locate
from suspension_ctrl.response.motion.curves import CREEP
from suspension_ctrl.response.motion.drivable import motion_of
from suspension_ctrl.response.motion.passes import force_of
from suspension_ctrl.response.motion.system import work_of
from suspension_ctrl.response.motion.trees import numbers_of

TABLE = ([-1.0, -0.3, -0.02, 0.0, 0.1, 0.4], [-900.0, -700.0, -300.0, 0.0, 0.0, 1200.0])
LAWS = {
    "table": (sc.TableDamper(velocity=TABLE[0], force=TABLE[1]), lambda v: prolonged(v, *TABLE)),
    "scaled table": (
        sc.TableSpring(deflection=TABLE[0], force=TABLE[1]),
        lambda d: 0.5 * prolonged(d, *TABLE),
    ),
    "bilinear": (sc.BilinearDamper(bump=600.0, rebound=1500.0), lambda v: np.where(v > 0, 1500.0, 600.0) * v),
    "bump stop": (sc.BumpStop(gap=0.02, stiffness=1e5), lambda d: 1e5 * np.minimum(d + 0.02, 0.0)),
    "rebound stop": (
        sc.ReboundStop(gap=0.1, compression=[0.0, 0.1, 0.2], force=[0.0, 300.0, 900.0]),
        lambda d: prolonged(np.maximum(d - 0.1, 0.0), [0.0, 0.1, 0.2], [0.0, 300.0, 900.0]),
    ),
    "friction": (sc.Friction(force=40.0), lambda v: 40.0 * np.clip(v / CREEP, -1, 1)),
    "quadratic": (sc.PowerDamper(force=2e3, exponent=2.0), lambda v: 2e3 * v * np.maximum(np.abs(v), CREEP)),
    "root": (sc.PowerDamper(force=2e3, exponent=0.5), lambda v: 2e3 * v / np.sqrt(np.maximum(np.abs(v), CREEP))),
    "digressive": (
        sc.DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1, rebound_over_bump=2.0),
        lambda v: np.where(v > 0, 2.0, 1.0) * (4e3 * np.clip(v, -0.1, 0.1) + 800.0 * (v - np.clip(v, -0.1, 0.1))),
    ),
}


def prolonged(x, knots, forces):
    """The table, its first and last piece going on."""
    knots, forces = np.array(knots), np.array(forces)
    slopes = np.diff(forces) / np.diff(knots)
    inside = np.interp(x, knots, forces)
    return inside + slopes[0] * np.minimum(x - knots[0], 0) + slopes[-1] * np.maximum(x - knots[-1], 0)


def force_at(law: sc.TableDamper, own: float) -> float:
    """The force of a law beside a spring in a quarter car."""
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=sc.parallel(sc.Spring("main", 2e4), law)
    )
    scale = {f"{law.name}.scale": 0.5} if isinstance(law, sc.TableSpring) else {}
    values = car.coefficients(scale)
    motion = motion_of(car, values)
    numbers, work = numbers_of(motion.program, motion.tree, motion.values), work_of(motion.equations, motion.tree)
    work.own[0, 0] = own
    locate(numbers, work, 0)
    return force_of(numbers, 0, work.segment[0], own)[0]


@pytest.mark.parametrize("name", LAWS)
@given(own=st.floats(-2.0, 2.0))
def test_forces_are_those_of_the_law(name, own):
    law, expected = LAWS[name]
    assert force_at(law, own) == pytest.approx(float(expected(own)), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("name", LAWS)
def test_curves_pass_through_the_origin(name):
    assert force_at(LAWS[name][0], 0.0) == 0.0

"""Passes over trees beside the rules of series and parallel connection."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import suspension_ctrl as sc
from garage import QUARTER
from suspension_ctrl.response.motion.drivable import Drivable
from suspension_ctrl.response.motion.passes import (
    BY_RATE,
    DEFLECTION,
    FORCE,
    RATE,
    assemble,
    deflect,
    gather,
    spread,
)
from suspension_ctrl.response.motion.system import work_of
from suspension_ctrl.response.motion.trees import numbers_of

values = st.floats(-2.0, 2.0)


def force_and_rates(strut, deflection: float, rate: float, states: list[float]) -> tuple[float, list[float]]:
    """Tension of a linear strut and the derivatives of its states."""
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=strut)
    motion = Drivable.of(car).motion(np.array(list(car.coefficients({}).values())))
    tree, work = motion.tree, work_of(motion.equations, motion.tree)
    numbers, own = numbers_of(motion.program, tree, motion.values), slice(4, 4 + tree.states)
    work.slots[DEFLECTION, 0], work.slots[RATE, 0], work.x[0, own] = deflection, rate, states
    deflect(tree, work, 0)
    assemble(tree, numbers, work)
    gather(tree, work, 0)
    spread(tree, numbers, work, 0)
    return float(work.slots[BY_RATE, 0] * rate + work.slots[FORCE, 0]), work.x[1, own].tolist()


@given(d=values, v=values, s=values, r=st.floats(0.5, 2.0))
def test_both_parts_of_a_series_have_its_force(d, v, s, r):
    strut = sc.series(sc.Damper(value=1500.0, installation_ratio=r), sc.Spring(value=2e4), installation_ratio=0.7)
    force, (w,) = force_and_rates(strut, d, v, [s])
    assert force == pytest.approx(0.7 * 2e4 * (0.7 * d - s), abs=1e-6)
    assert force == pytest.approx(0.7 * 1500.0 * r**2 * w, abs=1e-6)


@given(d=values, v=values, s=values)
def test_springs_in_series_share_a_deflection(d, v, s):
    strut = sc.series(sc.Spring(value=2e4), sc.Spring("other", 6e4))
    force, _ = force_and_rates(strut, d, v, [s])
    assert force == pytest.approx(15e3 * d, abs=1e-6)
    _, (w,) = force_and_rates(strut, d, v, [0.75 * d])
    assert w == pytest.approx(0.75 * v, abs=1e-9)


@given(d=values, v=values, s=values, w=values)
def test_an_inerter_in_series_takes_the_force_of_the_other_part(d, v, s, w):
    other = sc.parallel(sc.Damper(value=1500.0), sc.Spring(value=2e4))
    force, (rate, acceleration) = force_and_rates(sc.series(other, sc.Inerter(value=40.0)), d, v, [s, w])
    assert force == pytest.approx(1500.0 * (v - w) + 2e4 * (d - s), abs=1e-6)
    assert rate == w
    assert acceleration == pytest.approx(force / 40.0, abs=1e-9)


def test_dry_friction_on_a_spring_slides_with_it():
    """Prandtl's element: below its limit the spring takes the travel, at the limit friction does."""
    strut = sc.parallel(sc.Spring("main", 2e4), sc.series(sc.Friction(force=50.0), sc.Spring("bush", 1e5)))
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=strut)
    wave = sc.RigSine(motion="heave", amplitude=0.01, frequency=1.2)
    names = ["suspension_travel", "strut_force"]
    history = sc.simulate(car, {}, wave, responses=names)
    travel, force = (history.iloc[:, i].to_numpy() for i in (1, 2))
    friction = force - 2e4 * travel
    assert np.abs(friction).max() == pytest.approx(50.0, rel=2e-3)
    assert QUARTER.struts == car.struts

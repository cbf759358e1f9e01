"""Crossings beside roots of polynomials, and segments by value."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import suspension_ctrl as sc
from garage import QUARTER
from suspension_ctrl.response.motion.crossings import exit_of, locate, switch
from suspension_ctrl.response.motion.drivable import Drivable
from suspension_ctrl.response.motion.system import Work, work_of
from suspension_ctrl.response.motion.trees import Numbers, numbers_of

MARGIN = 1e-9
terms = st.lists(st.floats(-3.0, 3.0).map(lambda x: round(x, 3)), min_size=2, max_size=9)


def first_root(series: np.ndarray, level: float) -> float:
    """First time in (0, 1] at which a polynomial passes a level."""
    roots = np.polynomial.Polynomial(series - np.append(level, np.zeros(len(series) - 1))).roots()
    real = roots[(np.abs(roots.imag) < 1e-9) & (roots.real > 0) & (roots.real <= 1.0)].real
    return real.min(initial=1.0)


def exit_in_1_s(own: np.ndarray, low: float, high: float) -> float:
    """Compiled, a distance that is never reached is divided by zero; Python warns."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return exit_of(own, len(own) - 1, 1.0, low, high, MARGIN, 1e-3)


@given(terms)
def test_a_series_leaves_its_bounds_at_the_first_root(coefficients):
    """The level is passed with a slope: a root that only touches it has no digits."""
    own = np.array([0.0, *coefficients])
    low, high = -0.7, 0.4
    expected = min(first_root(own, level) for level in (low, high))
    slope = abs(np.polynomial.Polynomial(own).deriv()(expected))
    near = np.polynomial.Polynomial(own)(np.linspace(0.0, expected, 500)[:-1])
    assume(slope > 0.05 and near.min() > low and near.max() < high)
    assert exit_in_1_s(own, low, high) == pytest.approx(expected, abs=1e-6)


BEYOND = 0.4 + 2e-9


@pytest.mark.parametrize(("own", "found"), [([BEYOND, 1.0], 0.0), ([BEYOND, -0.1], 1.0), ([0.5, -0.1], 0.0)])
def test_a_series_that_begins_outside_leaves_outwards_or_from_far(own, found):
    assert exit_in_1_s(np.array(own), -0.7, 0.4) == found


def a_law() -> tuple[Numbers, Work]:
    """A table with knots at -0.1, 0 and 0.1 m/s."""
    table = sc.TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -300.0, 0.0, 400.0, 900.0])
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=sc.parallel(sc.Spring(value=2e4), table)
    )
    motion = Drivable.of(car).motion(np.array(list(car.coefficients({}).values())))
    return numbers_of(motion.program, motion.tree, motion.values), work_of(motion.equations, motion.tree)


@pytest.mark.parametrize("own", [-0.5, -0.05, 0.05, 0.5])
def test_a_law_is_on_the_segment_of_its_value(own):
    numbers, work = a_law()
    work.own[0, 0] = own
    locate(numbers, work, 0)
    low, high = work.bounds[:, 0]
    assert low < own <= high
    assert not locate(numbers, work, 0)


def test_a_law_goes_on_with_the_next_segment_outwards_alone():
    numbers, work = a_law()
    equations = Drivable.of(QUARTER).motion(np.array([2e4, 1e3])).equations
    work.own[0, 0] = 0.05
    locate(numbers, work, 0)
    work.own[:2, 0] = 0.1 + 0.5 * MARGIN, -1.0
    switch(equations, numbers, work, 1, 0.0, -1)
    assert work.bounds[1, 0] == 0.1
    work.own[1, 0] = 1.0
    switch(equations, numbers, work, 1, 0.0, -1)
    assert work.bounds[0, 0] == 0.1

"""Derivatives around one strut of springs, dampers and inerters beside complex steps."""

import numpy as np
import pytest

import suspension_ctrl as sc
from one_strut_car import check
from suspension_ctrl.response.gradients import one_fraction
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.measures.terms import Term
from suspension_ctrl.response.one_fraction import OneFraction

MOUNTED = sc.series(sc.Damper("own", 1500.0), sc.Spring("mount", 200e3))
BUSH = sc.series(
    sc.Damper("own", 1500.0), sc.parallel(sc.Spring("mount", 2e5), sc.Spring("more", 1e5)), installation_ratio=0.8
)


@pytest.mark.parametrize("part", [MOUNTED, BUSH])
def test_derivatives_to_rounding(part):
    """Of four and of five variables: one and two groups of rows are summed after that of the design."""
    check((part,), 1e-10)


@pytest.mark.parametrize("tyre_damping", [0.0, 120.0])
def test_mean_squares_have_the_bits_of_values(tyre_damping):
    """Six rows of the denominator, or twelve."""
    car = sc.QuarterCar(
        body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, tyre_damping=tyre_damping,
        strut=sc.parallel(sc.Spring(), MOUNTED),
    )  # fmt: skip
    case = sc.LoadCase(vehicle=car, road=sc.Iso8608Road("C"), speed=20.0)
    terms = [Term("body_acceleration"), Term("tyre_load")]
    setting = car.coefficients({"spring": 22e3})
    squares = case_of(case, terms, setting, ["spring", "own"], (0.1, 20.0), 72)
    assert isinstance(squares, OneFraction)
    designs = np.random.default_rng(0).uniform([1e4, 1e3], [3e4, 5e3], (7, 2))
    wanted = Wanted(np.array([[1.0, 0.0], [2.0, 3.0], [1.0, 2e-6]]), np.array([False, False, True]))
    found, slopes = one_fraction.with_slopes(squares, wanted, designs)
    np.testing.assert_array_equal(found, squares(designs))
    alone = [one_fraction.with_slopes(squares, wanted, design[None])[1][0] for design in designs]
    np.testing.assert_array_equal(slopes, alone)

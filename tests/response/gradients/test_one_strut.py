"""Derivatives of ratios of polynomials beside those of complex steps."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from complex_step import Apart
from garage import DAMPED_QUARTER
from suspension_ctrl.response.gradients.one_strut import with_slopes
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.one_strut import OneStrut
from suspension_ctrl.response.ports import Ports

F = np.linspace(0.3, 20.0, 41)
DENSITIES = np.random.default_rng(0).uniform(0.5, 1.5, (3, F.size))
PORTS = Ports.of(DAMPED_QUARTER, F, DAMPED_QUARTER.responses)
STRUT = OneStrut.around(PORTS, 2 * np.pi * F, DENSITIES)
EACH = Wanted(np.eye(3), np.zeros(3, dtype=bool))
DESIGNS = np.random.default_rng(1).uniform([1e3, 1e3], [1e5, 1e4], (20, 2))


def closed(design: np.ndarray) -> np.ndarray:
    """Mean squares (3,) at a complex design, real and imaginary parts apart."""
    h = Apart.of(np.moveaxis(PORTS.h, 0, 2))
    d = Apart(design[0], 2 * np.pi * F * design[1])
    found = h[:3, 0] + h[:3, 1] * (d / (Apart(1.0) - h[3, 1] * d)) * h[3, 0]
    return (DENSITIES * found.square()).sum(axis=1)


@given(st.floats(1e3, 1e5), st.floats(100.0, 1e4))
def test_derivatives_are_those_of_complex_steps(spring, damper):
    """Near a resonance of a light damper three digits cancel out of the polynomials, as in the mean squares."""
    design = np.array([spring, damper])
    squares, slopes = with_slopes(STRUT, EACH, design[None])
    np.testing.assert_allclose(squares[0], closed(design).real, rtol=1e-9)
    expected = np.array(
        [closed(design + 1e-30j * x * np.eye(2)[v]).imag / (1e-30 * x) for v, x in enumerate(design)]
    )
    scale = np.abs(expected.T * design).max(axis=1, keepdims=True) / design
    np.testing.assert_array_less(np.abs(slopes[0] - expected.T), 1e-9 * scale)


def test_mean_squares_are_those_of_the_case_and_designs_are_worked_out_each_for_itself():
    squares, slopes = with_slopes(STRUT, EACH, DESIGNS)
    np.testing.assert_array_equal(squares, STRUT(DESIGNS))
    alone = np.concatenate([with_slopes(STRUT, EACH, design[None])[1] for design in DESIGNS])
    np.testing.assert_array_equal(slopes, alone)


def part(first: int, stop: int) -> OneStrut:
    """Numerators from the first to before the stop, of one term."""
    numerators, power = STRUT.numerators[first:stop], STRUT.power[first:stop]
    return STRUT._replace(numerators=numerators, term=np.zeros(power.size, dtype=int), power=power)


def test_every_numerator_counts_once():
    """They are summed four at a time: the last are one to four."""
    each = [with_slopes(part(q, q + 1), EACH, DESIGNS)[1][:, 0] for q in range(STRUT.power.size)]
    for count in range(1, len(each) + 1):
        slopes = with_slopes(part(0, count), EACH, DESIGNS)[1][:, 0]
        np.testing.assert_allclose(slopes, sum(each[:count]), rtol=1e-10)


def test_the_largest_is_chosen_for_each_design():
    squares, slopes = with_slopes(STRUT, EACH, DESIGNS)
    factor = 1.0 / squares[[1]] * [[1.0, 1.01, 1.02]]  # by which they are nearly alike at one of the designs
    best = (squares * factor).argmax(axis=1)
    assert len(set(best)) > 1
    found = with_slopes(STRUT, Wanted(factor, np.array([True])), DESIGNS)[1][:, 0]
    rows = np.arange(len(DESIGNS))
    np.testing.assert_allclose(found, factor[0, best, None] * slopes[rows, best], rtol=1e-14)


def test_no_size_of_coefficients_overflows_before_its_square():
    for design in np.array([[1e145, 1e3], [1e3, 1e145], [1e145, 1e145]]):
        squares, slopes = with_slopes(STRUT, EACH, design[None])
        assert np.isfinite(squares).all()
        assert np.isfinite(slopes).all()

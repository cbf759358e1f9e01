"""Derivatives of blocks of two struts in registers, of one load case and of two, beside numpy."""

import numpy as np
import pytest

import struts_by_numpy
from suspension_ctrl.response.gradients import two_struts
from suspension_ctrl.response.gradients.wanted import Wanted

FACTOR = np.array([[1.0, 2.0, 0.0, 3.0], [1.0, 2.0, 0.5, 0.0]])
LARGEST = np.array([False, True])
DESIGNS = np.random.default_rng(1).normal(size=(5, 4))
SIZES = [(2, 4, 3), (2, 2, 2)]


@pytest.mark.parametrize("cases", [1, 2])
def test_derivatives_are_those_of_linear_equations(cases):
    """Numbers of the order of one are rounded some hundred times."""
    struts = struts_by_numpy.random_struts(SIZES, [False, False], cases)
    squares, slopes = map(np.array, zip(*(struts_by_numpy.with_slopes(struts, x) for x in DESIGNS), strict=True))
    wanted = Wanted(np.kron(np.eye(cases), FACTOR), np.tile(LARGEST, cases))
    counted = np.random.default_rng(2).random((len(DESIGNS), len(wanted.largest))) < 0.7
    products = squares[:, None] * wanted.factor
    best = products == products.max(axis=2, keepdims=True)
    weight = wanted.factor * np.where(wanted.largest[:, None], best, 1.0) * counted[:, :, None]
    found = two_struts.differentiated(struts, wanted, DESIGNS, squares, counted)
    np.testing.assert_allclose(found, weight @ slopes, rtol=1e-11, atol=1e-12 * np.abs(slopes).max())
    alone = two_struts.differentiated(struts, wanted, DESIGNS[3:4], squares[3:4], counted[3:4])
    np.testing.assert_array_equal(alone, found[3:4])


def test_blocks_of_other_sizes_and_coupled_struts_do_not_fit():
    assert two_struts.fits(struts_by_numpy.random_struts(SIZES, [False, False]))
    assert not two_struts.fits(struts_by_numpy.random_struts([(2, 1, 3), (3, 2, 2)], [False, False]))
    coupled = struts_by_numpy.random_struts(SIZES, [False, False])
    coupled.gain[2, 5] = 1.0
    assert not two_struts.fits(coupled)

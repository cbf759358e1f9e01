"""Derivatives of blocks of any number of struts, of one load case and of two, beside numpy."""

import numpy as np
import pytest

import struts_by_numpy
from suspension_ctrl.response.gradients.struts_in_lanes import differentiated
from suspension_ctrl.response.gradients.wanted import Wanted

FACTOR = np.array([[1.0, 2.0, 0.0, 3.0], [1.0, 2.0, 0.5, 0.0], [0.0, 0.0, 1.0, 0.0]])
LARGEST = np.array([False, True, False])
DESIGNS = np.random.default_rng(1).normal(size=(9, 4))
SIZES, CROSSED = [(3, 2, 3), (1, 4, 2), (2, 2, 4)], [False, False, True]


@pytest.mark.parametrize("cases", [1, 2])
def test_derivatives_are_those_of_linear_equations(cases):
    """Numbers of the order of one are rounded some hundred times."""
    struts = struts_by_numpy.random_struts(SIZES, CROSSED, cases)
    squares, slopes = map(np.array, zip(*(struts_by_numpy.with_slopes(struts, x) for x in DESIGNS), strict=True))
    np.testing.assert_allclose(struts(DESIGNS), squares, rtol=1e-11)
    wanted = Wanted(np.kron(np.eye(cases), FACTOR), np.tile(LARGEST, cases))
    counted = np.random.default_rng(2).random((len(DESIGNS), len(wanted.largest))) < 0.7
    products = squares[:, None] * wanted.factor
    best = products == products.max(axis=2, keepdims=True)
    weight = wanted.factor * np.where(wanted.largest[:, None], best, 1.0) * counted[:, :, None]
    found = differentiated(struts, wanted, DESIGNS, squares, counted)
    np.testing.assert_allclose(found, weight @ slopes, rtol=1e-11, atol=1e-12 * np.abs(slopes).max())
    alone = differentiated(struts, wanted, DESIGNS[3:4], squares[3:4], counted[3:4])
    np.testing.assert_array_equal(alone, found[3:4])


def test_no_blocks_give_nothing():
    """As of roll on a road shaped like a cylinder."""
    struts = struts_by_numpy.random_struts(SIZES, CROSSED)
    none = struts._replace(
        rows=struts.rows[:0], sizes=struts.sizes[:0], response=struts.response[:0], gain=struts.gain[:, :0]
    )
    counted = np.ones((9, 3), dtype=bool)
    found = differentiated(none, Wanted(FACTOR, LARGEST), DESIGNS, none(DESIGNS), counted)
    np.testing.assert_array_equal(found, np.zeros((9, 3, 4)))

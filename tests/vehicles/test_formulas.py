"""Formulas as data of loops, against numpy."""

import numpy as np

from suspension_ctrl.vehicles.formulas import Sheet


def test_sums_of_products_are_those_of_numpy():
    """To rounding: three products of numbers of size 1."""
    x = np.random.default_rng(1).uniform(0.5, 2.0, (5, 3))
    sheet = Sheet(3)
    two = sheet.constant(2.0)
    square = sheet.sum((3.0, {0: 2.0}), (-0.1, {1: 1.0, 2: -0.5}), constant=1.0)
    root = sheet.sum((1.0, {square: 0.5, two: 1.0}))
    found = sheet.formulas([1, square, root]).of(x)
    a, b, c = x.T
    np.testing.assert_array_equal(found[:, 0], b)
    np.testing.assert_allclose(found[:, 1], 1.0 + 3.0 * a**2 - 0.1 * b / np.sqrt(c), rtol=1e-14)
    np.testing.assert_allclose(found[:, 2], 2.0 * np.sqrt(found[:, 1]), rtol=1e-14)


def test_a_root_below_zero_has_no_value():
    sheet = Sheet(1)
    assert np.isnan(sheet.formulas([sheet.sum((1.0, {0: 0.5}))]).of(np.array([[-1.0]]))).all()

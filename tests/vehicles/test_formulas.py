"""Formulas as data of loops, against numpy."""

import numpy as np

from suspension_ctrl.vehicles.formulas import Sheet, fill, fill_slopes


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


def test_derivatives_are_those_of_products_and_roots():
    """By hand, to rounding; a factor may be 0, and a sum may depend on one before it."""
    sheet = Sheet(3)
    square = sheet.sum((3.0, {0: 2.0}), (-0.1, {1: 1.0, 2: -0.5}), constant=1.0)
    root = sheet.sum((2.0, {square: 0.5, 2: 1.0}))
    formulas, design = sheet.formulas([1, square, root]), np.array([[0.0, 0.7, 1.3]])
    slots, slopes = np.empty(formulas.start.size), np.empty((1, 3, 3))
    fill(formulas, design, 0, slots, np.empty((1, 3)))
    fill_slopes(formulas, slots, 0, np.empty((slots.size, 3)), slopes)
    a, b, c = design[0]
    inner = np.array([6.0 * a, -0.1 / np.sqrt(c), 0.05 * b * c**-1.5])
    value = 1.0 + 3.0 * a**2 - 0.1 * b / np.sqrt(c)
    outer = c / np.sqrt(value) * inner + [0.0, 0.0, 2.0 * np.sqrt(value)]
    np.testing.assert_allclose(slopes[0], [[0.0, 1.0, 0.0], inner, outer], rtol=1e-14)

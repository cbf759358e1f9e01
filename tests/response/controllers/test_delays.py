"""Pade delays against exp(-T s), the polynomials of python-control and their stated error."""

import control
import numpy as np
import pytest

from suspension_ctrl.response.controllers.delays import ERROR, delay, delay_error, delay_order

F = np.array([0.5, 2.0, 5.0, 10.0, 20.0])


@pytest.mark.parametrize(("time", "order"), [(0.05, 1), (0.144, 4), (0.144, 7), (0.3, 10)])
def test_a_delay_is_that_of_python_control(time, order):
    numerator, denominator = control.pade(time, order)
    s = 2j * np.pi * F
    expected = np.polyval(numerator, s) / np.polyval(denominator, s)
    np.testing.assert_allclose(delay(time, order).response(s), expected, rtol=1e-9)
    np.testing.assert_allclose(delay_error(time, order, F), abs(expected - np.exp(-time * s)), atol=1e-9)


def test_a_delay_passes_all_frequencies():
    np.testing.assert_allclose(abs(delay(0.144, 9).response(2j * np.pi * F)), 1.0, rtol=1e-12)


@pytest.mark.parametrize(("time", "highest"), [(0.05, 10.0), (0.144, 10.0), (0.3, 15.0)])
def test_the_order_is_the_least_with_the_error(time, highest):
    order = delay_order(time, highest)
    f = np.linspace(0.0, highest, 50)[1:]
    error = delay_error(time, order, f)
    assert error.max() <= ERROR
    assert (np.diff(error) >= -1e-12).all()  # so that the error at the end is the largest, but for rounding
    assert delay_error(time, order - 1, f).max() > ERROR

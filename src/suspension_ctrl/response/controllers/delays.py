"""Rational delays: Pade's all-pass approximation of exp(-T s), numerator and denominator of one order."""

import numpy as np

from ...quantities import Real
from .filters import Filter

ERROR = 0.01
"""Largest error of a delay within a band, unless that takes too high an order."""
_HIGHEST = 24  # order; its poles are accurate to 1e-9


def delay(time: float, order: int) -> Filter:
    """Return Pade's approximation of a delay [s]: its denominator is the Bessel polynomial of T s/2."""
    from scipy.signal import besselap

    poles = 2 / time * besselap(order, norm="delay")[1]
    return Filter.of(-poles, poles, (-1.0) ** order)


def delay_error(time: float, order: int, f: Real) -> Real:
    """Return the distance (n,) of the approximation from ``exp(-2j pi f T)`` at f (n,) [Hz]: up to 2."""
    s = np.asarray(2j * np.pi * f, dtype=np.complex128)
    return np.asarray(np.abs(delay(time, order).response(s) - np.exp(-time * s)))


def delay_order(time: float, highest: float) -> int:
    """Return the least order with an error of at most `ERROR` up to the `highest` frequency [Hz]."""
    at = np.array([highest])  # the error rises with frequency
    return next((n for n in range(1, _HIGHEST) if delay_error(time, n, at)[0] <= ERROR), _HIGHEST)

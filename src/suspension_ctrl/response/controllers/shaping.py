"""Shaping filters: white noise through a stable filter of minimum phase has the spectrum of a road."""

from typing import NamedTuple

import numpy as np

from ...quantities import Real
from .filters import Filter

NEAR = 0.005
"""Root mean square of the relative error of a spectrum with which a fit ends."""
_MOST = 4  # sections of second order
_POINTS = 100


class Shaping(NamedTuple):
    """A filter, and the relative error of its spectrum over the band: root mean square and largest."""

    filter: Filter
    rms: float
    largest: float


def shaping(f: Real, density: Real, falloff: float | None = None) -> Shaping:
    """Return a filter of the squared magnitude `density` (n,) at ascending f (n,) [Hz].

    A product of up to four quotients of second order, by least squares in the logarithm; a constant density is
    met by a constant. A `falloff` [Hz] is the corner of a low pass of first order behind it.
    """
    omega, wanted = 2 * np.pi * f, np.log(density)
    for sections in range(_MOST + 1):
        found = _fitted(omega, wanted, sections)
        off = np.expm1(_logarithm(found, omega) - wanted)
        if (rms := float(np.sqrt((off**2).mean()))) <= NEAR:
            break
    quotients = np.exp(found[1:]).reshape(-1, 2, 2)
    zeros, poles = (_roots(quotients[:, side]) for side in (0, 1))
    fitted = Shaping(Filter.of(zeros, poles, float(np.exp(found[0] / 2))), rms, float(np.abs(off).max()))
    return fitted if falloff is None else _falling(fitted, f, off, falloff)


def _falling(fitted: Shaping, f: Real, off: Real, falloff: float) -> Shaping:
    """Return a filter that is `off` (n,) at f (n,) with a first-order low pass behind it."""
    edge = 2 * np.pi * falloff
    off = (1 + off) / (1 + (f / falloff) ** 2) - 1
    low_pass = Filter.of(np.empty(0), np.array([-edge]), edge)
    return Shaping(fitted.filter.before(low_pass), float(np.sqrt((off**2).mean())), float(np.abs(off).max()))


def _fitted(omega: Real, wanted: Real, sections: int) -> Real:
    """Return logarithms (1 + 4 k,): of the gain, and of frequency and damping ratio of zeros and poles."""
    from scipy.optimize import least_squares

    level = wanted.mean()
    if not sections:
        return np.array([level])
    ends = np.log(omega[[0, -1]])
    middle = ends[0] + np.ptp(ends) * (np.arange(sections) + 0.5) / sections
    slope = np.polyfit(np.log(omega), wanted, 1)[0]
    apart = slope / 4 * np.ptp(ends) / sections / 2  # between zeros and poles of a constant slope
    damping = np.full(sections, np.log(1.5))
    start = np.column_stack([middle - apart, damping, middle + apart, damping]).ravel()
    begin = np.append(level, start)
    begin[0] -= (_logarithm(begin, omega) - wanted).mean()
    reach = np.column_stack([np.full(sections, ends[0] - 3), np.full(sections, -4.0)])
    lower = np.append(-np.inf, np.tile(reach, 2).ravel())
    upper = np.append(np.inf, np.tile([ends[1] + 3, 4.0], 2 * sections))

    def off(x: Real) -> Real:
        return _logarithm(x, omega) - wanted

    found = least_squares(off, begin, bounds=(lower, upper), max_nfev=200)
    return np.asarray(found.x)


def _logarithm(x: Real, omega: Real) -> Real:
    """Return the logarithm (n,) of the squared magnitude."""
    total = np.full(omega.size, x[0])
    for zero, zero_damping, pole, pole_damping in x[1:].reshape(-1, 4):
        total += _quadratic(omega, zero, zero_damping) - _quadratic(omega, pole, pole_damping)
    return total


def _quadratic(omega: Real, frequency: float, damping: float) -> Real:
    """Return the logarithm (n,) of ``|s^2 + 2 zeta w s + w^2|^2``."""
    w, zeta = np.exp(frequency), np.exp(damping)
    return np.asarray(np.log((w**2 - omega**2) ** 2 + (2 * zeta * w * omega) ** 2))


def _roots(pairs: Real) -> np.ndarray:
    """Return the roots (2 k,) of quadratics (k, 2) by frequency and damping ratio."""
    w, zeta = pairs.T
    root = np.sqrt((zeta**2 - 1).astype(complex))
    return np.concatenate([-w * (zeta + root), -w * w / (w * (zeta + root))])


def frequencies(band: tuple[float, float]) -> Real:
    """Return frequencies (n,) [Hz] at which a spectrum is fitted: from 0 Hz on, the band's last 3.3 decades."""
    low, high = band
    return np.geomspace(max(low, high / 2000), high, _POINTS)

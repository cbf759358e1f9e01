"""Statistical linearisation: a force law whose deflection or rate is Gaussian.

The law is replaced by its mean force E[F] and its mean slope E[F'], which is E[(x - m) F]/s^2 of a standard
deviation s about a mean m.
"""

from math import erfc, gamma, pi, sqrt

import numpy as np

from ..compiled import compilable
from ..quantities import Real

_POINTS = 64  # of the table per unit
_LAST = 9  # of the table: less than 1e-18 lies above
_ORDER = 7  # of Taylor's series about a point: the next terms are below 5e-18


def _table() -> Real:
    """Return the coefficients (points, orders) of the share above z, whose derivatives are Hermite's polynomials.

    The k-th derivative is (-1)^k He_(k-1)(z) times the density at z.
    """
    z = np.arange(_POINTS * _LAST + 1) / _POINTS
    before, here, factor = np.zeros(z.size), np.exp(-(z**2) / 2) / sqrt(2 * pi), 1.0
    columns = [np.array([0.5 * erfc(x / sqrt(2)) for x in z])]
    for k in range(_ORDER):
        factor /= -(k + 1)
        columns.append(factor * here)
        before, here = here, z * here - k * before
    return np.ascontiguousarray(np.transpose(columns))


_ABOVE = _table()


@compilable(fastmath={"contract"}, error_model="numpy")
def normal(z: float) -> tuple[float, float]:
    """Return the share above z and the density at z of the standard normal distribution."""
    size = abs(z)
    if not size < _LAST:
        return 0.5 - 0.5 * np.sign(z), 0.0
    point = int(size * _POINTS + 0.5)
    x, above, density = size - point / _POINTS, 0.0, 0.0
    for k in range(_ORDER, -1, -1):  # Horner's scheme, of the polynomial and of its derivative
        density = density * x - above
        above = above * x + _ABOVE[point, k]
    return (above if z >= 0 else 1.0 - above), density


@compilable(error_model="numpy")
def of_lines(curves: Real, law: int, count: int, mean: float, s: float) -> tuple[float, float, float]:
    """Return mean force [N], mean slope, and its change with ln s, of one of the curves (l, 3, k + 1)."""
    force, slope, change = curves[law, 1, 0] * mean, curves[law, 1, 0], 0.0
    for i in range(count):
        knot, step, jump = curves[law, 0, i], curves[law, 1, i + 1] - curves[law, 1, i], curves[law, 2, i]
        z = (knot - mean) / s
        above, density = normal(z)
        force += step * (s * (density - z * above) - max(-knot, 0.0))
        slope += step * above
        change += step * z * density
        if jump > 0.0:
            force += jump * (above - 0.5 + 0.5 * np.sign(knot))  # the force at 0 is 0
            slope += jump * density / s
            change += jump * density * (z * z - 1) / s
    return force, slope, change


@compilable(error_model="numpy")
def of_power(force: float, exponent: float, s: float) -> tuple[float, float]:
    """Return mean slope, and its change with ln s, of ``force |v|^exponent sign(v)`` about a mean of 0."""
    slope = force * exponent * (sqrt(2.0) * s) ** (exponent - 1) * gamma(exponent / 2) / sqrt(pi)
    return slope, (exponent - 1) * slope

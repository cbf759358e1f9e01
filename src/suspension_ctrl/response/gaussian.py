"""Statistical linearisation: a force law whose deflection or rate is Gaussian.

The law is replaced by its mean force E[F] and its mean slope E[F'], which is E[(x - m) F]/s^2 of a standard
deviation s about a mean m.
"""

from math import erf, exp, gamma, pi, sqrt

import numpy as np

from ..compiled import compilable
from ..quantities import Real

_ROOT_HALF, _DENSITY = sqrt(0.5), 1 / sqrt(2 * pi)


@compilable(error_model="numpy")
def of_lines(curve: Real, count: int, mean: float, s: float) -> tuple[float, float, float]:
    """Return mean force [N], mean slope, and its change with ln s, of knots, slopes and jumps (3, k + 1)."""
    knots, slopes, jumps = curve[0], curve[1], curve[2]
    force, slope, change = slopes[0] * mean, slopes[0], 0.0
    for i in range(count):
        z = (knots[i] - mean) / s
        above, density = 0.5 - 0.5 * erf(z * _ROOT_HALF), exp(-0.5 * z * z) * _DENSITY
        step = slopes[i + 1] - slopes[i]
        force += step * (s * (density - z * above) - max(-knots[i], 0.0))
        slope += step * above
        change += step * z * density
        if jumps[i] > 0.0:
            force += jumps[i] * (above - 0.5 + 0.5 * np.sign(knots[i]))  # the force at 0 is 0
            slope += jumps[i] * density / s
            change += jumps[i] * density * (z * z - 1) / s
    return force, slope, change


@compilable(error_model="numpy")
def of_power(force: float, exponent: float, s: float) -> tuple[float, float]:
    """Return mean slope, and its change with ln s, of ``force |v|^exponent sign(v)`` about a mean of 0."""
    slope = force * exponent * (sqrt(2.0) * s) ** (exponent - 1) * gamma(exponent / 2) / sqrt(pi)
    return slope, (exponent - 1) * slope

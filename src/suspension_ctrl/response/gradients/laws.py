"""Derivatives of the mean force and mean slope of force laws, by deviation, mean and the coefficients of curves.

Of a knot k at z = (k - m)/s, Q above it and density p there, a step of the slope by 1 adds s (p - z Q) to the
force and Q to the slope, a jump by 1 adds Q and p/s, see `gaussian`; p' = -z p and Q' = -p.
"""

from math import log
from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Real
from ...vehicles.networks import Laws
from ..gaussian import normal, of_power
from ..network_rows import DEVIATION, MEAN, POWER, Networks

KNOTS, SLOPES, JUMPS = range(3)
"""Parts of a curve."""
_HALF_LOG_2 = 0.5 * log(2.0)


class LawSlopes(NamedTuple):
    """Derivatives of the mean force and mean slope of l laws."""

    force_by_deviation: Real  # (l,), by the logarithm of the standard deviation
    force_by_mean: Real  # (l,)
    slope_by_deviation: Real  # (l,), by the logarithm
    slope_by_mean: Real  # (l,)
    force_by_value: Real  # (l, c), by coefficients
    slope_by_value: Real  # (l, c)


@compilable()
def law_slopes_of(networks: Networks) -> LawSlopes:
    """Return arrays to be filled in."""
    laws, values = networks.law.shape[0], networks.setting.size
    by_state, by_value = np.empty((4, laws)), np.empty((2, laws, values))
    return LawSlopes(by_state[0], by_state[1], by_state[2], by_state[3], by_value[0], by_value[1])


@uncounted(error_model="numpy")
def fill_law_slopes(networks: Networks, curve: Real, values: Real, state: Real, slopes: LawSlopes) -> None:
    """Fill in the derivatives of every law at its deviation and mean."""
    for law in range(state.shape[0]):
        for c in range(values.size):
            slopes.force_by_value[law, c] = slopes.slope_by_value[law, c] = 0.0
        add_of_lines(networks.laws, law, curve, values, state[law, MEAN], state[law, DEVIATION], slopes)
        if networks.law[law, POWER] >= 0:
            factor, exponent = networks.law[law, POWER], networks.law[law, POWER + 1]
            s, a = state[law, DEVIATION], values[exponent]
            slope, change = of_power(values[factor], a, s)
            slopes.slope_by_deviation[law] += change
            slopes.slope_by_value[law, factor] += slope / values[factor]
            by_exponent = 1 / a + _HALF_LOG_2 + log(s) + 0.5 * digamma(0.5 * a)
            slopes.slope_by_value[law, exponent] += slope * by_exponent


@uncounted(error_model="numpy")
def add_of_lines(
    laws: Laws, law: int, curve: Real, values: Real, mean: float, s: float, slopes: LawSlopes
) -> None:
    """Fill in the derivatives by deviation and mean of a curve of lines, and add those by its coefficients."""
    force_by_s, slope_by_s, slope_by_mean, slope = 0.0, 0.0, 0.0, curve[law, SLOPES, 0]
    add_number(laws, law, SLOPES, 0, mean, 1.0, values, slopes)
    for i in range(laws.most[law]):
        knot, jump = curve[law, KNOTS, i], curve[law, JUMPS, i]
        step, z = curve[law, SLOPES, i + 1] - curve[law, SLOPES, i], (knot - mean) / s
        above, density = normal(z)
        line, below = s * (density - z * above) - max(-knot, 0.0), 1.0 if knot < 0.0 else 0.0
        slope += step * above + jump * density / s
        force_by_s += step * s * density + jump * z * density
        slope_by_s += step * z * density + jump * density * (z * z - 1.0) / s
        rise = step * density / s + jump * z * density / s**2
        slope_by_mean += rise
        add_number(laws, law, SLOPES, i, -line, -above, values, slopes)
        add_number(laws, law, SLOPES, i + 1, line, above, values, slopes)
        force_by_knot = step * (below - above) - jump * density / s
        add_number(laws, law, KNOTS, i, force_by_knot, -rise, values, slopes)
        force_by_jump = above - 0.5 + 0.5 * np.sign(knot)
        add_number(laws, law, JUMPS, i, force_by_jump, density / s, values, slopes)
    slopes.force_by_deviation[law], slopes.force_by_mean[law] = force_by_s, slope
    slopes.slope_by_deviation[law], slopes.slope_by_mean[law] = slope_by_s, slope_by_mean


@uncounted()
def add_number(
    laws: Laws, law: int, part: int, i: int, of_force: float, of_slope: float, values: Real, slopes: LawSlopes
) -> None:
    """Add derivatives by a number of a curve, a constant plus a factor times up to two coefficients."""
    for j in range(2):
        own, other = laws.by[law, part, i, j], laws.by[law, part, i, 1 - j]
        if own >= 0:
            factor = laws.number[law, part, i, 1] * (values[other] if other >= 0 else 1.0)
            slopes.force_by_value[law, own] += of_force * factor
            slopes.slope_by_value[law, own] += of_slope * factor


@compilable()
def digamma(x: float) -> float:
    """Return the logarithmic derivative of the gamma function at x > 0, by Stirling's series above 10.

    Its next term is below 1e-13 there.
    """
    total = 0.0
    while x < 10.0:
        total -= 1.0 / x
        x += 1.0
    y = 1.0 / (x * x)
    return total + log(x) - 0.5 / x - y * (1 / 12 - y * (1 / 120 - y * (1 / 252 - y * (1 / 240 - y / 132))))

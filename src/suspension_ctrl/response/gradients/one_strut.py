"""Derivatives of mean squares by one spring and one damper: those of ratios of polynomials in both."""

from typing import Any

import numpy as np

from ...compiled import compiled, uncounted
from ...quantities import Real
from ..lanes import WIDTH, Lanes, empty, fused, load, spread, store, total
from ..one_strut import OneStrut, fill_powers, gains_at
from .wanted import Wanted, combine, fill_weights, searched

_TOGETHER = 4
"""Numerators that are summed at once."""


@compiled(nogil=True, error_model="numpy")
def with_slopes(strut: OneStrut, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, 2), and the derivatives (p, s, 2) of what is wanted.

    Of an integral of N/D over the frequency, D = |1 + c D|^2, the derivative is that of N'/D - N D'/D^2. The mean
    squares have the bits of `OneStrut`.
    """
    count, terms = designs.shape[0], strut.terms
    squares, result = np.zeros((count, terms)), np.empty((count, wanted.largest.size, 2))
    weight, slopes = np.empty((wanted.largest.size, terms)), np.empty((2, terms))
    gain, power = empty((3, strut.denominator.shape[1])), np.empty((3, 5))
    by_design = searched(wanted)
    for p in range(count):
        fill_changes(strut.denominator, designs[p, 0], designs[p, 1], gain, power)
        fill_slopes(strut, gain, power, p, squares, slopes)
        if p == 0 or by_design:
            fill_weights(wanted, squares, p, weight)
        combine(weight, slopes, p, result)
    return squares, result


@uncounted(error_model="numpy")
def fill_changes(denominator: Real, k: float, c: float, gain: Real, power: Real) -> None:
    """Fill in gains of a design as of `fill_gains`, powers, and their changes by K and by C, (3, n) and (3, 5).

    Those of gains are without the sign and without one of their two factors of scale.
    """
    half, factors = gain.shape[1] // 2, fill_powers(k, c, 0, power)
    for i in range(5):
        power[1, i] = power[2, i] = 0.0
    power[1, 1], power[1, 3] = power[0, 0], 2.0 * power[0, 1]
    power[2, 2], power[2, 4] = power[0, 0], 2.0 * power[0, 2]
    for i in range(0, half, WIDTH):
        one, other = gains_at(denominator, factors, i, half + i)
        store_changes(denominator, k, c, one, gain, i)
        store_changes(denominator, k, c, other, gain, half + i)


@uncounted(forceinline=True)
def store_changes(denominator: Real, k: float, c: float, own: Lanes, gain: Real, i: int) -> None:
    """Fill in eight gains g from frequency i, and g^2 times the derivatives of |1 + c D|^2 by K and by C."""
    by_k = fused(spread(2.0 * k), load(denominator, (2, i)), load(denominator, (0, i)))
    by_c = fused(spread(2.0 * c), load(denominator, (3, i)), load(denominator, (1, i)))
    store(own, gain, (0, i))
    store(own * own * by_k, gain, (1, i))
    store(own * own * by_c, gain, (2, i))


@uncounted(forceinline=True)
def fill_slopes(strut: OneStrut, gain: Real, power: Real, p: int, squares: Real, slopes: Real) -> None:
    """Add the mean squares of a design (p, k), and fill in their derivatives by K and C (2, k)."""
    last = strut.power.size - 1
    for term in range(strut.terms):
        slopes[0, term] = slopes[1, term] = 0.0
    for q in range(0, last + 1, _TOGETHER):
        rows = q, min(q + 1, last), min(q + 2, last), min(q + 3, last)
        own, less_k, less_c = sums_of_changes(gain, strut.numerators, *rows)
        for j in range(min(_TOGETHER, last + 1 - q)):
            term, i = strut.term[q + j], strut.power[q + j]
            scaled = power[0, 0] * power[0, i]
            squares[p, term] += own[j] * power[0, i]
            slopes[0, term] += own[j] * power[1, i] - less_k[j] * scaled
            slopes[1, term] += own[j] * power[2, i] - less_c[j] * scaled


@uncounted()
def sums_of_changes(gain: Real, numerators: Real, a: int, b: int, c: int, d: int) -> tuple[Any, Any, Any]:
    """Return the sums of the products of each of the gains and changes (3, n) with four numerators.

    The fourth is left out where it is the third again.
    """
    s = t = u = v = spread(0.0)
    e = f = g = h = spread(0.0)
    k = m = n = o = spread(0.0)
    for i in range(0, gain.shape[1], WIDTH):
        x, y, z = load(gain, (0, i)), load(gain, (1, i)), load(gain, (2, i))
        one, two, three = load(numerators, (a, i)), load(numerators, (b, i)), load(numerators, (c, i))
        s, t, u = fused(one, x, s), fused(two, x, t), fused(three, x, u)
        e, f, g = fused(one, y, e), fused(two, y, f), fused(three, y, g)
        k, m, n = fused(one, z, k), fused(two, z, m), fused(three, z, n)
        if d > c:
            four = load(numerators, (d, i))
            v, h, o = fused(four, x, v), fused(four, y, h), fused(four, z, o)
    return _totals(s, t, u, v), _totals(e, f, g, h), _totals(k, m, n, o)


@uncounted(forceinline=True)
def _totals(a: Lanes, b: Lanes, c: Lanes, d: Lanes) -> Any:
    """Return the sums of four times eight numbers."""
    return total(a), total(b), total(c), total(d)

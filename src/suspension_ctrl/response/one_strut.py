"""Mean squares over designs of one spring and one damper: integrands are ratios of polynomials in both."""

from typing import Any, NamedTuple

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Complex, Integer, Real
from .lanes import WIDTH, Lanes, empty, fused, in_lines, load, spread, store, total
from .ports import Ports

TOGETHER = 4
"""Designs that are summed at once: a sum has the same order whether they are four or one."""


class OneStrut(NamedTuple):
    """Mean squares over designs (K, C) of one strut, from one frequency response of the plant.

    Around the strut D = K + jwC a response is ``P11 + P12 D (1 - P22 D)^-1 P21 = (a + b D) / (1 + c D)``, where
    a = P11, b = P12 P21 - P11 P22, c = -P22: |a + b D|^2 and |1 + c D|^2 are linear in 1, K, C, K^2, C^2.
    """

    denominator: Real  # (4, n), coefficients of |1 + c D|^2 - 1: of K, C, K^2, C^2; n is a multiple of 16
    numerators: Real  # (q, n), of |a + b D|^2 times a density, those that are not zero throughout
    term: Integer  # (q,), the term of each numerator
    power: Integer  # (q,), its power of a design
    terms: int

    @compiled(nogil=True, error_model="numpy")
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, 2), K [N/m] and C [N s/m], each as if alone."""
        last, n = designs.shape[0] - 1, self.denominator.shape[1]
        result = empty((designs.shape[0], self.terms))
        clear(result)
        gain, power = empty((TOGETHER, n)), empty((TOGETHER, 5))
        for first in range(0, designs.shape[0], TOGETHER):
            for p in range(TOGETHER):
                each = min(first + p, last)
                fill_gains(self.denominator, designs[each, 0], designs[each, 1], p, gain, power)
            count = min(TOGETHER, last + 1 - first)
            add_sums(self.numerators, self.term, self.power, gain, power, first, count, result)
        return result

    @classmethod
    def around(cls, ports: Ports, omega: Real, densities: Real) -> "OneStrut":
        """Take ports at `omega` (f,) [rad/s] and densities (k, f): road, squared weighting, quadrature weight.

        Columns after those of the f frequencies fill up a multiple of two times `WIDTH` and add nothing.
        """
        p21, p22 = ports.h[:, -1, 0], ports.h[:, -1, 1]
        numerators = np.array(
            [
                density * _square_of_line(by_road, by_strut * p21 - by_road * p22, omega)
                for density, by_road, by_strut in zip(densities, *ports.h.T[:, : ports.m], strict=True)
            ]
        ).reshape(ports.m, 5, omega.size)
        term, power = map(np.ascontiguousarray, np.nonzero(numerators.any(axis=2)))  # as pickles hold them
        denominator = _square_of_line(np.ones_like(p22), -p22, omega)
        filled = (0, 0), (0, -omega.size % (2 * WIDTH))
        numerators = np.pad(numerators[term, power], filled)
        denominator = np.pad(denominator[1:], filled, mode="edge")
        return cls(in_lines(denominator), in_lines(numerators), term, power, ports.m)


class OneDesign(NamedTuple):
    """`OneStrut` in compiled loops that have one design after the other: the same bits by another loop."""

    strut: OneStrut

    @compiled(nogil=True, error_model="numpy")
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, 2)."""
        numerators, terms, exponents = self.strut.numerators, self.strut.term, self.strut.power
        result = empty((designs.shape[0], self.strut.terms))
        clear(result)
        gain, power, last = empty((1, numerators.shape[1])), empty((1, 5)), numerators.shape[0] - 1
        for first in range(designs.shape[0]):
            fill_gains(self.strut.denominator, designs[first, 0], designs[first, 1], 0, gain, power)
            for q in range(0, last + 1, 8):
                found = sums_of_eight(numerators, q, last, gain)
                for j in range(8 if q + 7 < last else last + 1 - q):
                    result[first, terms[q + j]] += found[j] * power[0, exponents[q + j]]
        return result


@uncounted()
def clear(values: Real) -> None:
    """Fill in zeros (p, k): `np.zeros` takes long to compile."""
    for p in range(values.shape[0]):
        for k in range(values.shape[1]):
            values[p, k] = 0.0


@uncounted(error_model="numpy")
def fill_gains(denominator: Real, k: float, c: float, p: int, gain: Real, power: Real) -> None:
    """Fill in row p of the scaled gains 1 / |1 + c D|^2 (4, n) and of the powers of a design (4, 5)."""
    half, factors = gain.shape[1] // 2, fill_powers(k, c, p, power)
    for i in range(0, half, WIDTH):
        one, other = gains_at(denominator, factors, i, half + i)
        store(one, gain, (p, i))
        store(other, gain, (p, half + i))


@uncounted(error_model="numpy", forceinline=True)
def fill_powers(k: float, c: float, p: int, power: Real) -> tuple[Lanes, ...]:
    """Fill in row p of the scaled powers 1, K, C, K^2, C^2 of a design (4, 5), and return each eight times."""
    scale = 1.0 / (1.0 + k * k + c * c)  # keeps the products of two denominators in range
    by_k, by_c, by_kk, by_cc = scale * k, scale * c, scale * k * k, scale * c * c
    power[p, 0], power[p, 1], power[p, 2], power[p, 3], power[p, 4] = scale, by_k, by_c, by_kk, by_cc
    return spread(scale), spread(by_k), spread(by_c), spread(by_kk), spread(by_cc)


@uncounted(error_model="numpy", forceinline=True)
def gains_at(denominator: Real, factors: tuple[Lanes, ...], i: int, j: int) -> tuple[Lanes, Lanes]:
    """Return scaled gains at eight frequencies from i and at eight from j, by the powers of a design.

    One division serves both: it takes as long as ten multiplications.
    """
    one, other = loops_at(denominator, factors, i), loops_at(denominator, factors, j)
    inverse = spread(1.0) / (one * other)
    return inverse * other, inverse * one


@uncounted(forceinline=True)
def loops_at(denominator: Real, factors: tuple[Lanes, ...], i: int) -> Lanes:
    """Return |1 + c D|^2 times the scale at eight frequencies, by the powers of a design."""
    found = fused(load(denominator, (0, i)), factors[1], factors[0])
    for j in range(1, 4):
        found = fused(load(denominator, (j, i)), factors[j + 1], found)
    return found


@uncounted(forceinline=True)
def add_sums(
    numerators: Real, term: Integer, exponent: Integer, gain: Real, power: Real, p: int, count: int, result: Real
) -> None:
    """Add to the mean squares of up to four designs from the p-th (p, k), by gains (4, n) and powers."""
    pairs = exponent.size // 2
    for q in range(0, 2 * pairs, 2):
        ones, others = sums_of_two(numerators, q, q + 1, gain)
        for j in range(count):
            result[p + j, term[q]] += ones[j] * power[j, exponent[q]]
            result[p + j, term[q + 1]] += others[j] * power[j, exponent[q + 1]]
    for q in range(2 * pairs, exponent.size):
        ones = sums(numerators, q, gain)
        for j in range(count):
            result[p + j, term[q]] += ones[j] * power[j, exponent[q]]


@uncounted()
def sums(left: Real, q: int, right: Real) -> tuple[float, float, float, float]:
    """Return the sums of the products of row q of `left` (i, n) with the four rows of `right` (4, n).

    A design has the same bits as one of four and alone.
    """
    s = t = u = v = spread(0.0)
    for i in range(0, left.shape[1], WIDTH):
        x = load(left, (q, i))
        s, t = fused(load(right, (0, i)), x, s), fused(load(right, (1, i)), x, t)
        u, v = fused(load(right, (2, i)), x, u), fused(load(right, (3, i)), x, v)
    return total(s), total(t), total(u), total(v)


@uncounted()
def sums_of_two(left: Real, q: int, r: int, right: Real) -> tuple[Any, Any]:
    """Return `sums` of rows q and r of `left` (i, n), each with the four rows of `right`, loaded once for both."""
    s = t = u = v = spread(0.0)
    e = f = g = h = spread(0.0)
    for i in range(0, left.shape[1], WIDTH):
        x, y = load(left, (q, i)), load(left, (r, i))
        one, two, three, four = load(right, (0, i)), load(right, (1, i)), load(right, (2, i)), load(right, (3, i))
        s, t, u, v = fused(one, x, s), fused(two, x, t), fused(three, x, u), fused(four, x, v)
        e, f, g, h = fused(one, y, e), fused(two, y, f), fused(three, y, g), fused(four, y, h)
    return (total(s), total(t), total(u), total(v)), (total(e), total(f), total(g), total(h))


@uncounted()
def sums_of_eight(left: Real, q: int, last: int, right: Real) -> tuple[float, ...]:
    """Return the sums of eight rows of `left` (i, n) from row q, the last again where there are no more.

    Of products with the one row of `right` (1, n), loaded once for all.
    """
    s = t = u = v = spread(0.0)
    e = f = g = h = spread(0.0)
    j = q + (q < last)
    k = j + (j < last)
    m = k + (k < last)
    a = m + (m < last)
    b = a + (a < last)
    c = b + (b < last)
    d = c + (c < last)
    for i in range(0, left.shape[1], WIDTH):
        x = load(right, (0, i))
        s, t = fused(load(left, (q, i)), x, s), fused(load(left, (j, i)), x, t)
        u, v = fused(load(left, (k, i)), x, u), fused(load(left, (m, i)), x, v)
        e, f = fused(load(left, (a, i)), x, e), fused(load(left, (b, i)), x, f)
        g, h = fused(load(left, (c, i)), x, g), fused(load(left, (d, i)), x, h)
    return total(s), total(t), total(u), total(v), total(e), total(f), total(g), total(h)


def _square_of_line(a: Complex, b: Complex, omega: Real) -> Real:
    """Coefficients (5, n) of |a + b (K + jwC)|^2; the product K C has none, as K and jwC are at right angles."""
    return np.stack(
        [
            np.abs(a) ** 2,
            2 * (a.conj() * b).real,
            2 * (a.conj() * b * 1j * omega).real,
            np.abs(b) ** 2,
            omega**2 * np.abs(b) ** 2,
        ]
    )

"""Derivatives of mean squares by one spring and one damper: those of ratios of polynomials in both."""

import numpy as np

from ...compiled import compiled
from ...quantities import Real
from ..one_strut import OneStrut, polynomial
from .wanted import Wanted, combine, fill_weights


# Floating-point options as of `OneStrut`.
@compiled(nogil=True, fastmath={"reassoc", "contract", "nsz"}, error_model="numpy")
def with_slopes(strut: OneStrut, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, 2), and the derivatives (p, s, 2) of what is wanted.

    Of an integral of N/D over the frequency, D = |1 + c D|^2, the derivative is that of N'/D - N D'/D^2.
    """
    count, terms = designs.shape[0], strut.terms
    squares, result = np.empty((count, terms)), np.empty((count, wanted.largest.size, 2))
    weight, slopes = np.empty((wanted.largest.size, terms)), np.empty((2, terms))
    n = strut.denominator.shape[1]
    gain, by_k, by_c = np.empty(n), np.empty(n), np.empty(n)
    for p in range(count):
        k, c = designs[p, 0], designs[p, 1]
        scale = 1.0 / (1.0 + k * k + c * c)
        powers = (scale, scale * k, scale * c, scale * k * k, scale * c * c)
        rise_k, rise_c = (0.0, scale, 0.0, 2 * scale * k, 0.0), (0.0, 0.0, scale, 0.0, 2 * scale * c)
        for i in range(gain.size):
            one = 1.0 / polynomial(strut.denominator, powers, i)
            gain[i] = one
            by_k[i] = one * one * polynomial(strut.denominator, rise_k, i)
            by_c[i] = one * one * polynomial(strut.denominator, rise_c, i)
        for term in range(terms):
            squares[p, term] = slopes[0, term] = slopes[1, term] = 0.0
        for q in range(strut.power.size):
            integral, less_k, less_c = 0.0, 0.0, 0.0
            for i in range(gain.size):
                integral += gain[i] * strut.numerators[q, i]
                less_k += by_k[i] * strut.numerators[q, i]
                less_c += by_c[i] * strut.numerators[q, i]
            term, power = strut.term[q], strut.power[q]
            squares[p, term] += integral * powers[power]
            slopes[0, term] += integral * rise_k[power] - less_k * powers[power]
            slopes[1, term] += integral * rise_c[power] - less_c * powers[power]
        fill_weights(wanted, squares, p, weight)
        combine(weight, slopes, p, result)
    return squares, result

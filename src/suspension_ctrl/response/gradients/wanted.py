"""Which combinations of mean squares derivatives are wanted of."""

from typing import NamedTuple

from ...compiled import uncounted
from ...quantities import Bool, Integer, Real

TIED = 1e-9
"""Share by which a mean square must be larger than one before it: of equal ones the first is the largest."""


class Wanted(NamedTuple):
    """Sums of mean squares times factors, or the largest of these products."""

    factor: Real  # (s, k)
    largest: Bool  # (s,), whether the largest product counts, or their sum


@uncounted()
def fill_weights(wanted: Wanted, squares: Real, p: int, weight: Real) -> None:
    """Fill in the derivatives (s, k) of the combinations by the mean squares of one of the designs (p, k)."""
    for s in range(wanted.largest.size):
        best, most = 0, -1.0
        for k in range(squares.shape[1]):
            weight[s, k] = 0.0 if wanted.largest[s] else wanted.factor[s, k]
        for k in range(squares.shape[1] if wanted.largest[s] else 0):
            product = wanted.factor[s, k] * squares[p, k]
            if product > most * (1.0 + TIED):
                best, most = k, product
        if wanted.largest[s]:
            weight[s, best] = wanted.factor[s, best]


@uncounted()
def searched(wanted: Wanted) -> bool:
    """Whether weights depend on mean squares: where the largest of several products counts."""
    found = False
    for s in range(wanted.largest.size):
        found = found or wanted.largest[s]
    return found


@uncounted()
def leave_out(counted: Bool, p: int, weight: Real) -> None:
    """Set the derivatives (s, k) of combinations to 0 that are not `counted` (p, s) for a design."""
    for s in range(weight.shape[0]):
        for k in range(0 if counted[p, s] else weight.shape[1]):
            weight[s, k] = 0.0


@uncounted()
def combine(weight: Real, slopes: Real, p: int, result: Real) -> None:
    """Fill in the derivatives of the combinations of a design (p, s, v) by those of its mean squares (v, k)."""
    for s in range(weight.shape[0]):
        for v in range(slopes.shape[0]):
            result[p, s, v] = 0.0
        for k in range(weight.shape[1]):
            for v in range(slopes.shape[0] if weight[s, k] != 0.0 else 0):
                result[p, s, v] += weight[s, k] * slopes[v, k]


@uncounted()
def fold(channel: Integer, weight: Real, folded: Real) -> None:
    """Fill in the weights (m,) of the distinct mean squares of each load case by those of its terms (k,)."""
    cases = weight.size // max(channel.size, 1)
    for m in range(folded.size):
        folded[m] = 0.0
    for term in range(weight.size):
        case = term // channel.size
        folded[case * (folded.size // cases) + channel[term - case * channel.size]] += weight[term]

"""Mean squares of a block of two struts that act each on its own deflection, as of a half of most vehicles.

All that lies between the rows of the plant and the squares stays in registers, see `lanes`.
"""

from ..compiled import uncounted
from ..quantities import Integer, Real
from .lanes import Lanes, Pair, fused, less, load, plus, product, reciprocal, row_at, spread, store

Element = tuple[float, float, float]
"""Stiffness [N/m], damping [N s/m] and inertance [kg] of a strut."""


@uncounted(error_model="numpy", forceinline=True)
def add_two_struts(
    first: Pair, second: Pair, rows: Real, sources: int, response: Integer, cases: int, sums: Real
) -> None:
    """Add the squares of a block's terms at eight frequencies by its rows (16 l,) to sums (m, 8).

    The deflections are e = (1 - P D)^-1 S by Cramer's rule, and a term is its row by the source plus T D e; D has
    two dynamic stiffnesses.
    """
    a, b, c, d = loop_of_two(first, second, rows)
    inverse = reciprocal(less(product(a, d), b, c))
    first, second = product(first, inverse), product(second, inverse)
    for source in range(sources):
        x, y = row_at(rows, 4 + source), row_at(rows, 4 + sources + source)
        tension = product(plus(product(d, x), b, y), first), product(plus(product(a, y), c, x), second)
        start = source * cases // sources * (sums.shape[0] // cases)
        add_squares(rows, 4 + 2 * sources, source, sources, tension, response, start, sums)


@uncounted(forceinline=True)
def loop_of_two(first: Pair, second: Pair, rows: Real) -> tuple[Pair, Pair, Pair, Pair]:
    """Return 1 - P D of two dynamic stiffnesses row by row, off the diagonal with the sign changed."""
    unit = spread(1.0), spread(0.0)
    a, d = less(unit, row_at(rows, 0), first), less(unit, row_at(rows, 3), second)
    return a, product(row_at(rows, 1), second), product(row_at(rows, 2), first), d


@uncounted(error_model="numpy", forceinline=True)
def squared_deflections(first: Pair, second: Pair, rows: Real, sources: int) -> tuple[Lanes, Lanes]:
    """Return the squared deflections of two struts by all sources of a block with rows (16 l,)."""
    a, b, c, d = loop_of_two(first, second, rows)
    x, y = less(product(a, d), b, c)
    one = other = spread(0.0)
    for source in range(sources):
        x_1, x_2 = row_at(rows, 4 + source), row_at(rows, 4 + sources + source)
        (p, q), (u, v) = plus(product(d, x_1), b, x_2), plus(product(a, x_2), c, x_1)
        one, other = fused(p, p, fused(q, q, one)), fused(u, u, fused(v, v, other))
    inverse = spread(1.0) / fused(x, x, y * y)
    return one * inverse, other * inverse


@uncounted(forceinline=True)
def stiffness_at(element: Element, w: Lanes) -> Pair:
    """Return the dynamic stiffness of a strut at angular frequencies."""
    k, c, b = element
    return fused(spread(-b), w * w, spread(k)), spread(c) * w


@uncounted(forceinline=True)
def add_squares(
    rows: Real,
    row: int,
    source: int,
    sources: int,
    tension: tuple[Pair, Pair],
    response: Integer,
    start: int,
    sums: Real,
) -> None:
    """Add the squares of all terms of a block, whose rows begin at `row`, by a source and two tensions.

    The sums of its load case begin at `start`.
    """
    by_strut = row + response.size * sources
    for i in range(response.size):
        value = plus(row_at(rows, row + i * sources + source), row_at(rows, by_strut + 2 * i), tension[0])
        re, im = plus(value, row_at(rows, by_strut + 2 * i + 1), tension[1])
        place = start + response[i], 0
        store(fused(re, re, fused(im, im, load(sums, place))), sums, place)

"""Mean squares of a block of two struts that act each on its own deflection, as of a half of most vehicles.

All that lies between the rows of the plant and the squares stays in registers, see `lanes`.
"""

from ..compiled import uncounted
from ..quantities import Integer, Real
from .lanes import WIDTH, Lanes, Pair, at, fused, less, load, plus, product, reciprocal, spread, store

Element = tuple[float, float, float]
"""Stiffness [N/m], damping [N s/m] and inertance [kg] of a strut."""


@uncounted(error_model="numpy")
def add_two_struts(
    omega: Real, rows: Real, one: Element, other: Element, sources: int, response: Integer, sums: Real
) -> None:
    """Add the squares of a block's terms by its rows (l, 2, n) to the sums (m, 8), for a multiple of 8 nodes.

    The deflections are e = (1 - P D)^-1 S by Cramer's rule, and a term is its row by the source plus T D e.
    """
    for t in range(0, omega.size, WIDTH):
        w = load(omega, (t,))
        first, second = stiffness_at(one, w), stiffness_at(other, w)
        unit = spread(1.0), spread(0.0)
        a, d = less(unit, at(rows, 0, t), first), less(unit, at(rows, 3, t), second)
        b, c = product(at(rows, 1, t), second), product(at(rows, 2, t), first)  # both with the sign changed
        inverse = reciprocal(less(product(a, d), b, c))
        first, second = product(first, inverse), product(second, inverse)
        for source in range(sources):
            x, y = at(rows, 4 + source, t), at(rows, 4 + sources + source, t)
            tension = product(plus(product(d, x), b, y), first), product(plus(product(a, y), c, x), second)
            add_squares(rows, 4 + 2 * sources, source, sources, t, tension, response, sums)


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
    t: int,
    tension: tuple[Pair, Pair],
    response: Integer,
    sums: Real,
) -> None:
    """Add the squares of all terms of a block, whose rows begin at `row`, by a source and two tensions."""
    by_strut = row + response.size * sources
    for i in range(response.size):
        value = plus(at(rows, row + i * sources + source, t), at(rows, by_strut + 2 * i, t), tension[0])
        re, im = plus(value, at(rows, by_strut + 2 * i + 1, t), tension[1])
        place = response[i], 0
        store(fused(re, re, fused(im, im, load(sums, place))), sums, place)

"""Mean squares of a block of any number of struts, at eight frequencies at a time, see `lanes`.

All numbers of a block lie in the nearest cache then, in rows of eight real and eight imaginary parts, and the rows
of the plant stay there from design to design. Two designs are closed at once: neither waits for the other.
"""

from ..compiled import uncounted
from ..quantities import Integer, Real
from .lanes import Lanes, Pair, fused, less, load, plus, product, put, reciprocal, row_at, spread, store
from .two_struts import stiffness_at


@uncounted(forceinline=True)
def rows_for(q: int) -> int:
    """Return the rows of a design with q struts: its D (q q), loop (q q), deflections (q) and tensions (q).

    The loop is L and U of 1 - P D, with the reciprocals of the diagonal of U.
    """
    return 2 * q * (q + 1)


@uncounted()
def add_struts(
    w: Lanes,
    plant: Real,
    elements: Real,
    crossed: bool,
    sizes: Integer,
    response: Integer,
    cases: int,
    room: Real,
    sums: Real,
) -> None:
    """Add the squares of a block's terms by its rows (16 l,) to the sums (p, m, 8) of one design or two.

    They have elements (p, q q, 3) of D, off its diagonal only if the block is `crossed`; its sizes are q, s and k.
    """
    q, last = sizes[0], elements.shape[0] - 1
    for i in range(0, q * q, 1 if crossed else q + 1):
        put(stiffness_at((elements[0, i, 0], elements[0, i, 1], elements[0, i, 2]), w), room, i)
        other = elements[last, i, 0], elements[last, i, 1], elements[last, i, 2]
        put(stiffness_at(other, w), room, rows_for(q) + i)
    add_closed(plant, crossed, sizes, response, cases, room, sums)


@uncounted(forceinline=True)
def add_closed(
    plant: Real, crossed: bool, sizes: Integer, response: Integer, cases: int, room: Real, sums: Real
) -> None:
    """Add the squares of a block's terms to the sums (p, m, 8) of one design or two, whose D is in the room."""
    (q, s, k), last = sizes, sums.shape[0] - 1
    factor(q, plant, crossed, room)
    for source in range(s):
        solve(q, s, plant, source, crossed, room)
        one, two, own = rows_for(q) - q, 2 * rows_for(q) - q, source * cases // s * (sums.shape[1] // cases)
        for i in range(k):
            first = second = row_at(plant, q * (q + s) + source + i * s)
            for j in range(q):
                row = row_at(plant, q * (q + s) + k * s + i * q + j)
                first = plus(first, row, row_at(room, one + j))
                second = plus(second, row, row_at(room, two + j))
            add_square(first, sums, 0, own + response[i])
            if last:
                add_square(second, sums, 1, own + response[i])


@uncounted(forceinline=True)
def add_square(value: Pair, sums: Real, p: int, channel: int) -> None:
    """Add squared magnitudes to a sum of a design."""
    (re, im), place = value, (p, channel, 0)
    store(fused(re, re, fused(im, im, load(sums, place))), sums, place)


@uncounted(error_model="numpy", forceinline=True)
def factor(q: int, plant: Real, crossed: bool, room: Real) -> None:
    """Fill in L U = 1 - P D, column by column.

    Elimination closes one strut after the other and needs no pivoting.
    """
    loop, two = q * q, rows_for(q)
    for j in range(q):
        first, end = (0, q) if crossed else (j, j + 1)
        for i in range(q):
            value = other = spread(1.0 if i == j else 0.0), spread(0.0)
            for c in range(first, end):
                row = row_at(plant, i * q + c)
                value = less(value, row, row_at(room, c * q + j))
                other = less(other, row, row_at(room, two + c * q + j))
            for c in range(min(i, j)):
                left, right = loop + i * q + c, loop + c * q + j
                value = less(value, row_at(room, left), row_at(room, right))
                other = less(other, row_at(room, two + left), row_at(room, two + right))
            if i == j:
                value, other = reciprocal(value), reciprocal(other)
            elif i > j:
                pivot = loop + j * q + j
                value, other = product(value, row_at(room, pivot)), product(other, row_at(room, two + pivot))
            put(value, room, loop + i * q + j)
            put(other, room, two + loop + i * q + j)


@uncounted(forceinline=True)
def solve(q: int, s: int, plant: Real, source: int, crossed: bool, room: Real) -> None:
    """Fill in the deflections e of L U e = S for one of s sources, and the tensions D e."""
    loop, e, two = q * q, 2 * q * q, rows_for(q)
    for i in range(q):
        value = other = row_at(plant, q * q + i * s + source)
        for c in range(i):
            value = less(value, row_at(room, loop + i * q + c), row_at(room, e + c))
            other = less(other, row_at(room, two + loop + i * q + c), row_at(room, two + e + c))
        put(value, room, e + i)
        put(other, room, two + e + i)
    for i in range(q - 1, -1, -1):
        value, other = row_at(room, e + i), row_at(room, two + e + i)
        for c in range(i + 1, q):
            value = less(value, row_at(room, loop + i * q + c), row_at(room, e + c))
            other = less(other, row_at(room, two + loop + i * q + c), row_at(room, two + e + c))
        pivot = loop + i * q + i
        put(product(value, row_at(room, pivot)), room, e + i)
        put(product(other, row_at(room, two + pivot)), room, two + e + i)
    for i in range(q):
        first, end = (0, q) if crossed else (i, i + 1)
        value = other = spread(0.0), spread(0.0)
        for c in range(first, end):
            value = plus(value, row_at(room, i * q + c), row_at(room, e + c))
            other = plus(other, row_at(room, two + i * q + c), row_at(room, two + e + c))
        put(value, room, e + q + i)
        put(other, room, two + e + q + i)

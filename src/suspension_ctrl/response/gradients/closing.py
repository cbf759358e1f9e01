"""Struts of a block closed one after another, at eight frequencies at a time, see `lanes`.

A plant gives deflections by tensions P and by sources S, and responses by tensions T and by sources R. A strut j
of stiffness d turns the matrix A = [P S; T R] into A + a w b, with its column a and its row b, and
w = d / (1 - d P_jj). Once all are closed, S has become the deflections e, R the responses y, and T the responses h
to further tensions: a change dD of the stiffness changes y by h dD e. P is left half done where nothing needs it.
"""

from ...compiled import uncounted
from ...quantities import Integer, Real
from ..lanes import Lanes, Pair, at, less, plus, product, put, reciprocal, row_at, spread
from ..two_struts import stiffness_at


@uncounted()
def fill_plant(rows: Real, t: int, sizes: Integer, plant: Real) -> None:
    """Fill in a block's A at eight frequencies by its rows (l, 2, n), which are of P, S, R and then T."""
    q, s, k = sizes
    for i in range(q + k):
        response = i - q
        by_strut = i * q if response < 0 else q * (q + s) + k * s + response * q
        by_source = q * q + i * s if response < 0 else q * (q + s) + response * s
        for c in range(q):
            put(at(rows, by_strut + c, t), plant, i * (q + s) + c)
        for c in range(s):
            put(at(rows, by_source + c, t), plant, i * (q + s) + q + c)


@uncounted(error_model="numpy")
def close(
    w: Lanes,
    plant: Real,
    elements: Real,
    crossed: bool,
    q: int,
    columns: int,
    own: Integer,
    line: Integer,
    closed: Real,
) -> None:
    """Fill in A of a design with elements (q q, 3) of D and rows `own` (l,), from rows `line` of the plant's.

    Two struts are closed at a time. With D off its diagonal, struts of stiffness 1 act on [P D S; T D R].
    """
    given, lines = plant, line
    if crossed:
        fill_crossed(w, plant, elements, q, columns, own.size, line, closed)
        given, lines = closed, own
    for j in range(0, q - 1, 2):
        one, two = lines[j] * columns, (j + 1) * columns
        first = tension_at(w, elements, crossed, j * (q + 1), row_at(given, one + j))
        change(given, lines[j + 1] * columns, j, first, given, one, 0, columns, closed, two)
        second = tension_at(w, elements, crossed, (j + 1) * (q + 1), row_at(closed, two + j + 1))
        for m in range(2, own.size + 1):  # row j, by which the others change, is the last
            i = j + m if j + m < own.size else j + m - own.size
            row, start = lines[i] * columns, j + 2 if i <= j else 0
            f = product(row_at(given, row + j), first)
            g = product(plus(row_at(given, row + j + 1), f, row_at(given, one + j + 1)), second)
            for c in range(start, columns):
                value = plus(row_at(given, row + c), f, row_at(given, one + c))
                put(plus(value, g, row_at(closed, two + c)), closed, i * columns + c)
        change(closed, two, j + 1, second, closed, two, j + 2, columns, closed, two)
        given, lines = closed, own
    if q % 2:
        one = lines[q - 1] * columns
        first = tension_at(w, elements, crossed, q * q - 1, row_at(given, one + q - 1))
        for m in range(own.size):
            i = m + q if m + q < own.size else m + q - own.size
            start = q if i < q else 0
            change(given, lines[i] * columns, q - 1, first, given, one, start, columns, closed, i * columns)
    if crossed:
        fill_uncrossed(plant, q, columns, own.size, line, closed)


@uncounted(error_model="numpy", forceinline=True)
def tension_at(w: Lanes, elements: Real, crossed: bool, i: int, own: Pair) -> Pair:
    """Return the tension of a strut by its deflection without it, which changes by its own tension."""
    unit = spread(1.0), spread(0.0)
    stiffness = stiffness_at((elements[i, 0], elements[i, 1], elements[i, 2]), w)
    if crossed:
        stiffness = unit
    return product(stiffness, reciprocal(less(unit, stiffness, own)))


@uncounted(forceinline=True)
def change(
    given: Real,
    row: int,
    j: int,
    tension: Pair,
    by: Real,
    one: int,
    start: int,
    columns: int,
    closed: Real,
    own: int,
) -> None:
    """Fill in a row of A with strut j closed, from a given row and the one of the strut."""
    factor = product(row_at(given, row + j), tension)
    for c in range(start, columns):
        put(plus(row_at(given, row + c), factor, row_at(by, one + c)), closed, own + c)


@uncounted()
def fill_crossed(
    w: Lanes, plant: Real, elements: Real, q: int, columns: int, rows: int, line: Integer, closed: Real
) -> None:
    """Fill in [P D S; T D R] from rows `line` of the plant's A."""
    for i in range(rows):
        given, own = line[i] * columns, i * columns
        for c in range(q, columns):
            put(row_at(plant, given + c), closed, own + c)
        for j in range(q):
            value = spread(0.0), spread(0.0)
            for c in range(q):
                element = elements[c * q + j, 0], elements[c * q + j, 1], elements[c * q + j, 2]
                value = plus(value, row_at(plant, given + c), stiffness_at(element, w))
            put(value, closed, own + j)


@uncounted()
def fill_uncrossed(plant: Real, q: int, columns: int, rows: int, line: Integer, closed: Real) -> None:
    """Put h = T + (h D) P in the place of h D, the tensions of closed struts by further ones."""
    for i in range(q, rows):
        own = i * columns
        for j in range(q):
            value = row_at(plant, line[i] * columns + j)
            for c in range(q):
                value = plus(value, row_at(closed, own + c), row_at(plant, c * columns + j))
            put(value, closed, rows * columns + j)
        for j in range(q):
            put(row_at(closed, rows * columns + j), closed, own + j)

"""Mean squares over designs of any number of struts: a compiled solve of the strut loop at every frequency."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Bool, Integer, Real
from .lanes import WIDTH, load, spread, store, total
from .two_struts import add_two_struts


class ManyStruts(NamedTuple):
    """Blocks of coupled struts in rows (2, n): real and imaginary parts of a value at n frequencies.

    A block has deflections by q tensions (q, q) and by s uncorrelated sources of unit density in place of the
    roads (q, s), then k terms by sources (k, s) and by tensions (k, q), times the root of their densities. Blocks
    follow one another; the last dimension of each part varies fastest.
    """

    omega: Real  # (n,) angular frequencies [rad/s]
    rows: Real  # (l, 2, n)
    sizes: Integer  # (b, 3), q, s and k of each block
    response: Integer  # (sum of k,), the distinct mean square to which a row of terms contributes
    channel: Integer  # (m,), the distinct mean square of each term
    gain: Real  # (v, sum of q q), tensions of each variable at 1 by deflections or their derivatives of its order
    order: Integer  # (v,), 0 of springs, 1 of dampers, 2 of inerters and masses
    origin: Real  # (v,), values of the variables around which the plant is closed already

    @compiled(nogil=True)
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, v), each as if alone, by (1 - P D) e = S."""
        room, found, sums = room_for(self), np.empty(self.channel.size), np.empty((self.channel.size, WIDTH))
        result, added = np.empty((designs.shape[0], self.channel.size)), np.empty(designs.shape[1])
        for p in range(designs.shape[0]):
            for v in range(added.size):
                added[v] = designs[p, v] - self.origin[v]
            fill_squares(self, added, room, found, sums)
            for term in range(self.channel.size):
                channel = self.channel[term]
                result[p, term] = found[channel] + total(load(sums, (channel, 0)))
        return result


class Room(NamedTuple):
    """Work arrays for the largest block, of rows (2, n)."""

    present: Bool  # (q q), whether an entry of D is not zero
    stiffness: Real  # D (q q)
    loop: Real  # (q (q + s))
    tension: Real  # D e (q)
    value: Real


@compilable()
def room_for(struts: ManyStruts) -> Room:
    """Return work arrays."""
    q, s, n = 0, 0, struts.omega.size
    for b in range(struts.sizes.shape[0]):
        q, s = max(q, struts.sizes[b, 0]), max(s, struts.sizes[b, 1])
    square, loop = np.empty((q * q, 2, n)), np.empty((q * (q + s), 2, n))
    return Room(np.empty(q * q, np.bool_), square, loop, np.empty((q, 2, n)), np.empty((2, n)))


@uncounted()
def fill_squares(struts: ManyStruts, added: Real, room: Room, found: Real, sums: Real) -> None:
    """Fill in the distinct mean squares: each that of an array (m,) and the lanes of another (m, 8)."""
    row, entry, output = 0, 0, 0
    for channel in range(found.size):
        found[channel] = 0.0
        store(spread(0.0), sums, (channel, 0))
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        rows, response = struts.rows[row : row + (q + k) * (q + s)], struts.response[output : output + k]
        if q == 2 and struts.omega.size % WIDTH == 0 and not across(struts, entry):
            one, other = element_at(struts, added, entry), element_at(struts, added, entry + 3)
            add_two_struts(struts.omega, rows, one, other, s, response, sums)
        else:
            add_block(struts, added, entry, q, s, rows, response, room, found)
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k


@uncounted()
def across(struts: ManyStruts, entry: int) -> bool:
    """Whether a variable couples the two struts of a block with this first entry."""
    found = 0
    for v in range(struts.gain.shape[0]):
        found += struts.gain[v, entry + 1] != 0.0 or struts.gain[v, entry + 2] != 0.0
    return found > 0


@uncounted()
def element_at(struts: ManyStruts, added: Real, entry: int) -> tuple[float, float, float]:
    """Return stiffness, damping and inertance at an entry of D for variables with values `added` (v,)."""
    k, c, b = 0.0, 0.0, 0.0
    for v in range(added.size):
        value = struts.gain[v, entry] * added[v]
        if struts.order[v] == 0:
            k += value
        elif struts.order[v] == 1:
            c += value
        else:
            b += value
    return k, c, b


@uncounted()
def add_block(
    struts: ManyStruts,
    added: Real,
    entry: int,
    q: int,
    s: int,
    rows: Real,
    response: Integer,
    room: Room,
    found: Real,
) -> None:
    """Add the integrals of a block of any size with its rows (l, 2, n) to the distinct mean squares."""
    present, stiffness, loop = room.present, room.stiffness, room.loop
    by_source, by_strut = rows[q * (q + s) :], rows[q * (q + s) + response.size * s :]
    fill_stiffness(added, struts, entry, present, stiffness[: q * q])
    fill_loop(q, s, present, stiffness, rows, rows[q * q :], loop)
    eliminate(q, q + s, loop)
    add_terms(q, s, present, stiffness, loop, by_source, by_strut, response, room.tension, room.value, found)


@uncounted()
def fill_stiffness(added: Real, struts: ManyStruts, entry: int, present: Bool, stiffness: Real) -> None:
    """Fill in D (q q, 2, n), sum of gain (jw)^order, and which entries (q q,) are not zero."""
    for i in range(stiffness.shape[0]):
        k, c, b = element_at(struts, added, entry + i)
        present[i] = k != 0.0 or c != 0.0 or b != 0.0
        for t in range(struts.omega.size):
            w = struts.omega[t]
            stiffness[i, 0, t] = k - b * (w * w)
            stiffness[i, 1, t] = c * w


@uncounted()
def fill_loop(q: int, s: int, present: Bool, stiffness: Real, feedback: Real, sources: Real, loop: Real) -> None:
    """Put 1 - P D beside the sources into the loop (q (q + s), 2, n)."""
    for i in range(q):
        for j in range(q):
            row = loop[i * (q + s) + j]
            row[:] = 0.0
            for other in range(q):
                if present[other * q + j]:
                    add_product(-1.0, feedback[i * q + other], stiffness[other * q + j], row)
            for t in range(row.shape[1] if i == j else 0):
                row[0, t] += 1.0
        for source in range(s):
            copy(sources[i * s + source], loop[i * (q + s) + q + source])


@uncounted()
def eliminate(q: int, columns: int, loop: Real) -> None:
    """Solve the linear equations (q columns, 2, n) in place: solutions replace the right-hand sides.

    Elimination closes one strut after the other and needs no pivoting.
    """
    for c in range(q):
        invert(loop[c * columns + c])
        for j in range(c + 1, columns):
            multiply(loop[c * columns + c], loop[c * columns + j])
        for i in range(c + 1, q):
            for j in range(c + 1, columns):
                add_product(-1.0, loop[i * columns + c], loop[c * columns + j], loop[i * columns + j])
    for c in range(q - 1, 0, -1):
        for i in range(c):
            for j in range(q, columns):
                add_product(-1.0, loop[i * columns + c], loop[c * columns + j], loop[i * columns + j])


@uncounted()
def add_terms(
    q: int,
    s: int,
    present: Bool,
    stiffness: Real,
    loop: Real,
    by_source: Real,
    by_strut: Real,
    response: Integer,
    tension: Real,
    value: Real,
    found: Real,
) -> None:
    """Add the integrals of the terms of a block to the distinct mean squares, by its solved loop."""
    for source in range(s):
        for i in range(q):
            tension[i] = 0.0
            for j in range(q):
                if present[i * q + j]:
                    add_product(1.0, stiffness[i * q + j], loop[j * (q + s) + q + source], tension[i])
        for i in range(response.size):
            copy(by_source[i * s + source], value)
            for j in range(q):
                add_product(1.0, by_strut[i * q + j], tension[j], value)
            found[response[i]] += sum_of_squares(value)


# Rows of frequencies: products may be fused and sums taken in whatever order suits the processor, the same for
# every design; numpy's error model leaves out a check for division by zero that would keep a loop from being
# vectorised.
@compilable()
def copy(given: Real, row: Real) -> None:
    """Fill in a complex row (2, n) by another."""
    for part in range(2):
        for t in range(row.shape[1]):
            row[part, t] = given[part, t]


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def invert(value: Real) -> None:
    """Replace a complex row (2, n) by its reciprocal."""
    a, b = value[0], value[1]
    for t in range(a.size):
        size = a[t] * a[t] + b[t] * b[t]
        a[t] /= size
        b[t] /= -size


@compilable(fastmath={"contract", "nsz"})
def multiply(factor: Real, value: Real) -> None:
    """Multiply a complex row (2, n) by another in place."""
    a, b, x, y = factor[0], factor[1], value[0], value[1]
    for t in range(a.size):
        real = a[t] * x[t] - b[t] * y[t]
        y[t] = a[t] * y[t] + b[t] * x[t]
        x[t] = real


@compilable(fastmath={"contract", "nsz"})
def add_product(sign: float, left: Real, right: Real, total: Real) -> None:
    """Add the product of two complex rows (2, n), times `sign`, to a third."""
    a, b, x, y, re, im = left[0], left[1], right[0], right[1], total[0], total[1]
    for t in range(a.size):
        re[t] += sign * (a[t] * x[t] - b[t] * y[t])
        im[t] += sign * (a[t] * y[t] + b[t] * x[t])


@compilable(fastmath={"reassoc", "contract", "nsz"})
def sum_of_squares(value: Real) -> float:
    """Return the sum of the squared magnitudes of a complex row (2, n)."""
    total = 0.0
    x, y = value[0], value[1]
    for t in range(x.size):
        total += x[t] * x[t] + y[t] * y[t]
    return total

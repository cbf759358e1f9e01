"""Mean squares over designs of any number of struts: a compiled solve of the strut loop at every frequency."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Bool, Integer, Real
from .lanes import WIDTH, at, load, put, spread, store, total
from .struts_in_lanes import add_struts, rows_for
from .two_struts import add_two_struts

_TILE = 16
"""Designs for which eight columns of the rows stay in the nearest cache."""


class ManyStruts(NamedTuple):
    """Blocks of coupled struts in rows (2, n): real and imaginary parts of a value at n frequencies.

    A block has deflections by q tensions (q, q) and by s uncorrelated sources of unit density in place of the
    roads (q, s), then k terms by sources (k, s) and by tensions (k, q), times the root of their densities. Blocks
    follow one another; the last dimension of each part varies fastest. Of load cases that share a plant the
    sources in each block are those of one case after another, as many of each.
    """

    omega: Real  # (n,) angular frequencies [rad/s], a multiple of eight
    rows: Real  # (l, 2, n)
    sizes: Integer  # (b, 3), q, s and k of each block
    response: Integer  # (sum of k,), the distinct mean square to which a row of terms contributes
    channel: Integer  # (m,), the distinct mean square of each term
    gain: Real  # (v, sum of q q), tensions of each variable at 1 by deflections or their derivatives of its order
    order: Integer  # (v,), 0 of springs, 1 of dampers, 2 of inerters and masses
    origin: Real  # (v,), values of the variables around which the plant is closed already
    cases: int = 1  # load cases that share the plant

    @compiled(nogil=True)
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, cases k) of designs (p, v), each as if alone, by (1 - P D) e = S."""
        terms, tile, most, rows = self.channel.size, min(_TILE, designs.shape[0]), 0, 0
        for b in range(self.sizes.shape[0]):
            q, s, k = self.sizes[b]
            most, rows = max(most, q), max(rows, (q + k) * (q + s))
        room, plant = np.empty(2 * rows_for(most) * 2 * WIDTH), np.empty(rows * 2 * WIDTH)
        sums = np.empty((tile, self.cases * terms, WIDTH))
        elements = np.empty((tile, self.gain.shape[1], 3))
        result = np.empty((designs.shape[0], self.cases * terms))
        for first in range(0, designs.shape[0], _TILE):
            count = min(_TILE, designs.shape[0] - first)
            for p in range(count):
                fill_elements(self, designs, first + p, elements[p])
            fill_squares(self, elements[:count], plant, room, sums)
            for p in range(count):
                for term in range(self.cases * terms):
                    channel = self.channel[term % terms] + term - term % terms
                    result[first + p, term] = total(load(sums, (p, channel, 0)))
        return result


@uncounted()
def fill_elements(struts: ManyStruts, designs: Real, p: int, elements: Real) -> None:
    """Fill in stiffness, damping and inertance (e, 3) at each entry of D for one of the designs (p, v)."""
    for entry in range(elements.shape[0]):
        for order in range(3):
            elements[entry, order] = 0.0
    for v in range(struts.origin.size):
        added, order = designs[p, v] - struts.origin[v], struts.order[v]
        for entry in range(elements.shape[0]):
            elements[entry, order] += struts.gain[v, entry] * added


@uncounted()
def fill_squares(struts: ManyStruts, elements: Real, plant: Real, room: Real, sums: Real) -> None:
    """Fill in the lanes (p, m, 8) of the distinct mean squares of designs by their elements (p, e, 3)."""
    row, entry, output = 0, 0, 0
    for p in range(elements.shape[0]):
        for channel in range(sums.shape[1]):
            store(spread(0.0), sums, (p, channel, 0))
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        rows, response = struts.rows[row : row + (q + k) * (q + s)], struts.response[output : output + k]
        crossed = across(struts, entry, q)
        for t in range(0, struts.omega.size, WIDTH):
            for i in range(rows.shape[0]):  # side by side they lie in few pages of memory
                put(at(rows, i, t), plant, i)
            w = load(struts.omega, (t,))
            if q == 2 and not crossed:
                for p in range(elements.shape[0]):
                    add_two_struts(w, plant, elements[p, entry : entry + 4], s, response, struts.cases, sums[p])
            else:
                for p in range(0, elements.shape[0], 2):
                    own = elements[p : p + 2, entry : entry + q * q]
                    two = sums[p : p + 2]
                    add_struts(w, plant, own, crossed, struts.sizes[b], response, struts.cases, room, two)
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k


@uncounted()
def across(struts: ManyStruts, entry: int, q: int) -> bool:
    """Whether a variable couples two of the q struts of a block with this first entry."""
    found = 0
    for v in range(struts.gain.shape[0]):
        for i in range(q * q):
            found += i % (q + 1) != 0 and struts.gain[v, entry + i] != 0.0
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

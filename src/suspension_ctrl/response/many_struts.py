"""Mean squares over designs of any number of struts: a compiled solve of the strut loop at every frequency."""

from typing import NamedTuple

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Integer, Real
from .lanes import WIDTH, at, load, put, spread, store, total
from .struts_in_lanes import add_struts, rows_for
from .two_struts import Element, add_two_struts, stiffness_at

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
                    first = stiffness_at(elements_of(elements, p, entry), w)
                    second = stiffness_at(elements_of(elements, p, entry + 3), w)
                    add_two_struts(first, second, plant, s, response, struts.cases, sums[p])
            else:
                for p in range(0, elements.shape[0], 2):
                    own = elements[p : p + 2, entry : entry + q * q]
                    two = sums[p : p + 2]
                    add_struts(w, plant, own, crossed, struts.sizes[b], response, struts.cases, room, two)
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k


@uncounted(forceinline=True)
def elements_of(elements: Real, p: int, entry: int) -> Element:
    """Return those of one of the designs (p, e, 3) at an entry of D."""
    return elements[p, entry, 0], elements[p, entry, 1], elements[p, entry, 2]


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

"""Derivatives of mean squares of blocks of any number of struts, at eight frequencies at a time, see `lanes`.

A block is closed for the responses that have a weight alone, see `closing`. Of load cases that share a plant each
has its own mean squares and combinations of them, side by side.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Bool, Integer, Real
from ..lanes import WIDTH, Lanes, empty, fused, load, plus, product, put, row_at, spread, store, total
from ..many_struts import ManyStruts, across, fill_elements
from .closing import close, fill_plant
from .wanted import Wanted, fill_weights, fold, leave_out

_TILE = 8
"""Designs for which eight columns of the rows are put side by side."""


COMBINATION, ROW, SOURCES, BEGINS, ENDS = range(5)
"""Columns of the responses heard: combination, row of A, first source, whether first and whether last of a sum."""


class Room(NamedTuple):
    """Work arrays of a tile of designs; a matrix A of `closing` has eight complex numbers for each of its own."""

    plant: Real  # (16 l,), A of a block
    closed: Real  # (16 l,), A of a design with its struts and the responses heard, then room for D
    elements: Real  # (p, e, 3), stiffness, damping and inertance at each entry of D
    weight: Real  # (p, s, m), of the distinct mean squares in combinations
    heard: Integer  # (p, h, 5), the responses that have a weight
    share: Real  # (p, h), weights of the responses heard
    number: Integer  # (p, 2), of rows of A, and of responses heard
    line: Integer  # (1 + p, l), 0, 1, 2 ... and the rows of the plant's A that a design has
    entries: Integer  # (y, 2), row and column of the entries of a block's D that depend on variables
    moments: Real  # (p, s, y, 24), halves of the changes of combinations by K, C and b there


@compiled(nogil=True)
def differentiated(struts: ManyStruts, wanted: Wanted, designs: Real, squares: Real, counted: Bool) -> Real:
    """Return the derivatives (p, s, v) of what is wanted, of designs (p, v) with mean squares (p, k).

    Those of combinations that are not `counted` (p, s) are 0.
    """
    room, weight = room_for(struts, wanted), np.empty(wanted.factor.shape)
    result = np.zeros((designs.shape[0], wanted.largest.size, designs.shape[1]))
    for first in range(0, designs.shape[0], _TILE):
        count = min(_TILE, designs.shape[0] - first)
        for p in range(count):
            fill_elements(struts, designs, first + p, room.elements[p])
            fill_weights(wanted, squares, first + p, weight)
            leave_out(counted, first + p, weight)
            for s in range(wanted.largest.size):
                fold(struts.channel, weight[s], room.weight[p, s])
        add_slopes(struts, room, result[first : first + count])
    return result


@compilable()
def room_for(struts: ManyStruts, wanted: Wanted) -> Room:
    """Return work arrays."""
    rows, spare, lines, most, terms, channels = 0, 0, 0, 0, 0, 0
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        rows, spare = max(rows, (q + k) * (q + s)), max(spare, q * q)
        most, lines, terms = max(most, q), max(lines, q + k), max(terms, k)
    for term in range(struts.channel.size):
        channels = max(channels, struts.channel[term] + 1)
    combinations = wanted.largest.size
    heard = combinations * terms * struts.cases
    return Room(
        empty((rows * 2 * WIDTH,)),
        empty(((rows + spare) * 2 * WIDTH,)),
        np.empty((_TILE, struts.gain.shape[1], 3)),
        np.empty((_TILE, combinations, channels * struts.cases)),
        np.empty((_TILE, heard, 5), np.int64),
        np.empty((_TILE, heard)),
        np.empty((_TILE, 2), np.int64),
        np.empty((1 + _TILE, lines), np.int64),
        np.empty((most * most, 2), np.int64),
        empty((_TILE, combinations, most * most, 3 * WIDTH)),
    )


@uncounted()
def add_slopes(struts: ManyStruts, room: Room, slopes: Real) -> None:
    """Add the derivatives (p, s, v) of combinations with a weight."""
    row, entry, output = 0, 0, 0
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        rows, response = struts.rows[row : row + (q + k) * (q + s)], struts.response[output : output + k]
        entries = room.entries[: fill_entries(struts, entry, q, room.entries)]
        for p in range(slopes.shape[0]):
            choose(struts.sizes[b], response, struts.cases, p, room)
        fill_moments(struts, rows, entry, struts.sizes[b], entries, slopes.shape[0], room)
        for p in range(slopes.shape[0]):
            for h in range(room.number[p, 1]):
                x = room.heard[p, h, COMBINATION]
                if h == 0 or x != room.heard[p, h - 1, COMBINATION]:
                    add_changes(struts, entry, q, entries, room.moments[p, x], slopes[p, x])
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k


@uncounted()
def add_changes(struts: ManyStruts, entry: int, q: int, entries: Integer, moments: Real, slopes: Real) -> None:
    """Add the derivatives (v,) of a combination by its moments (y, 24) in a block."""
    for y in range(entries.shape[0]):
        i = entry + entries[y, 0] * q + entries[y, 1]
        for v in range(slopes.size):
            if struts.gain[v, i] != 0.0:
                slopes[v] += 2.0 * struts.gain[v, i] * total(load(moments, (y, struts.order[v] * WIDTH)))


@uncounted()
def fill_entries(struts: ManyStruts, entry: int, q: int, entries: Integer) -> int:
    """Fill in and count the entries (y, 2) of D that depend on a variable in a block of q struts, by columns."""
    number = 0
    for j in range(q):
        for i in range(q):
            reached = 0
            for v in range(struts.origin.size):
                reached += struts.gain[v, entry + i * q + j] != 0.0
            if reached > 0:
                entries[number, 0], entries[number, 1] = i, j
                number += 1
    return number


@uncounted()
def choose(sizes: Integer, response: Integer, cases: int, p: int, room: Room) -> None:
    """Fill in which responses (k,) of a block of these sizes are heard, and the rows of A that a design has."""
    weight, line, heard, (q, s, _) = room.weight[p], room.line[1 + p], room.heard[p], sizes
    rows, number, channels = q, 0, weight.shape[1] // cases
    for i in range(line.size):
        line[i] = room.line[0, i] = i
    for x in range(weight.shape[0]):
        for case in range(cases):
            before = number
            for i in range(response.size):
                share = weight[x, case * channels + response[i]]
                if share != 0.0:
                    row = q
                    while row < rows and line[row] != q + i:
                        row += 1
                    line[row], rows = q + i, max(rows, row + 1)
                    heard[number, COMBINATION], heard[number, ROW] = x, row
                    heard[number, SOURCES] = q + case * (s // cases)
                    heard[number, BEGINS], heard[number, ENDS] = number == before, 0
                    room.share[p, number] = share
                    number += 1
            if number > before:
                heard[number - 1, ENDS] = 1
    room.number[p, 0], room.number[p, 1] = rows, number


@uncounted()
def fill_moments(
    struts: ManyStruts, rows: Real, entry: int, sizes: Integer, entries: Integer, designs: int, room: Room
) -> None:
    """Fill in the moments of a block by its rows (l, 2, n)."""
    q, s, _ = sizes
    crossed, inertial = across(struts, entry, q), 2 in struts.order
    for p in range(designs):
        for h in range(room.number[p, 1]):
            for y in range(entries.shape[0]):
                for order in range(3):
                    store(spread(0.0), room.moments, (p, room.heard[p, h, COMBINATION], y, order * WIDTH))
    for t in range(0, struts.omega.size, WIDTH):
        fill_plant(rows, t, sizes, room.plant)
        w = load(struts.omega, (t,))
        for p in range(designs):
            if room.number[p, 1] > 0:
                elements, own = room.elements[p, entry : entry + q * q], room.line[0, : room.number[p, 0]]
                close(w, room.plant, elements, crossed, q, q + s, own, room.line[1 + p], room.closed)
                add_moments(w, s // struts.cases, q + s, inertial, entries, p, room)


@uncounted()
def add_moments(w: Lanes, own: int, columns: int, inertial: bool, entries: Integer, p: int, room: Room) -> None:
    """Add h e times the conjugates of the responses heard and (jw)^order, by `own` sources of a load case.

    Sums over the responses of a combination lie behind A until all are added.
    """
    closed, moments, rows = room.closed, room.moments[p], room.number[p, 0]
    for h in range(room.number[p, 1]):
        x, row, first, begins, ends = room.heard[p, h]
        share, strut, summed = spread(room.share[p, h]), -1, (spread(0.0), spread(0.0))
        for y in range(entries.shape[0]):
            if entries[y, 1] != strut:
                strut = entries[y, 1]
                summed = spread(0.0), spread(0.0)
                for source in range(first, first + own):
                    re, im = row_at(closed, row * columns + source)
                    summed = plus(summed, (re, -im), row_at(closed, strut * columns + source))
                summed = share * summed[0], share * summed[1]
            re, im = product(row_at(closed, row * columns + entries[y, 0]), summed)
            if not begins:
                before = row_at(closed, rows * columns + y)
                re, im = before[0] + re, before[1] + im
            if not ends:
                put((re, im), closed, rows * columns + y)
                continue
            store(load(moments, (x, y, 0)) + re, moments, (x, y, 0))
            store(fused(-w, im, load(moments, (x, y, WIDTH))), moments, (x, y, WIDTH))
            if inertial:
                store(fused(-(w * w), re, load(moments, (x, y, 2 * WIDTH))), moments, (x, y, 2 * WIDTH))

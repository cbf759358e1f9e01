"""Derivatives of mean squares around one strut of springs, dampers and inerters, of ratios of polynomials.

An integral of N/D changes by that of N'/D - N D'/D^2. Numerators and denominators are linear in the coefficients
of the products of N and S, and these change with the variables.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Bool, Integer, Real
from ..lanes import WIDTH, Lanes, empty, fused, load, spread, store, total
from ..network_fractions import PARTS, ZERO, put, row_at
from ..network_rows import DIRECT, Networks, fill_direct
from ..one_fraction import (
    POWERS,
    SIX,
    OneFraction,
    Room,
    fill_fraction,
    fill_gains,
    fill_powers,
    loop_at,
    room_for,
    six,
)
from ..one_port import add_beside
from ..one_strut import clear
from .network_fractions import change_of_mirrored, fill_changes, whole_change
from .wanted import Wanted, combine, fill_weights, searched

_TOGETHER = 3
"""Rows of gains that are summed at once with four numerators."""


class Slopes(NamedTuple):
    """Work arrays of derivatives of a design by v variables."""

    change: Real  # (v, m, 4), of direct elements
    inside: Bool  # (v,), whether a variable changes a part of the network, or elements beside it alone
    changes: Real  # (1 + x, 6), of fractions of parts in series by a variable
    power: Real  # (v, 15), of products of N and S
    gain: Real  # (r, n), of a design, then of its changes, without their sign; r is a multiple of three
    sums: Real  # (r, q, 8), of numerators times gains
    by_variable: Real  # (v, k), of mean squares


@compilable(error_model="numpy")
def slopes_for(case: OneFraction, room: Room, variables: int) -> Slopes:
    """Return work arrays, with the changes of direct elements, which are linear in coefficients."""
    networks, one = case.port.networks, np.zeros(room.values.size)
    change, inside = np.empty((variables, networks.row.size, DIRECT)), np.empty(variables, dtype=np.bool_)
    for v in range(variables):
        one[networks.variable[v]] = 1.0
        fill_direct(networks, one, room.state, change[v])
        inside[v] = changes_part(change[v])
        add_beside(networks, one, change[v])
        one[networks.variable[v]] = 0.0
    gain = empty((variables // _TOGETHER * _TOGETHER + _TOGETHER, case.denominator.shape[1]))
    for r in range(1 + variables, gain.shape[0]):
        for i in range(gain.shape[1]):
            gain[r, i] = 0.0
    changes, power = np.empty((room.rows.shape[0] - 1, PARTS)), np.empty((variables, POWERS))
    sums = empty((gain.shape[0], case.term.size, WIDTH))
    return Slopes(change, inside, changes, power, gain, sums, np.zeros((variables, case.port.terms)))


@uncounted()
def changes_part(change: Real) -> bool:
    """Whether any direct elements (m, 4) change."""
    found = False
    for i in range(change.shape[0]):
        for j in range(DIRECT):
            found = found or change[i, j] != 0.0
    return found


@compiled(nogil=True, error_model="numpy")
def with_slopes(case: OneFraction, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted.

    The mean squares have the bits of `OneFraction`.
    """
    count, variables = designs.shape
    networks, room = case.port.networks, room_for(case.port.networks)
    slopes, weight = slopes_for(case, room, variables), np.empty(wanted.factor.shape)
    squares, result = np.empty((count, case.port.terms)), np.empty((count, wanted.largest.size, variables))
    power, by_design = np.empty((1, POWERS)), searched(wanted)
    clear(squares)
    for p in range(count):
        fill_fraction(networks, designs, p, room)
        scale = fill_powers(room.rows, 0, power)
        fill_gains(case.denominator, case.below, 0, power, slopes.gain)
        for v in range(variables):
            fill_power(networks, room, v, scale, slopes)
            fill_change(case.denominator, case.below, v, slopes)
        fill_sums(case, slopes)
        add_slopes(case, power, p, squares, slopes)
        if p == 0 or by_design:
            fill_weights(wanted, squares, p, weight)
        combine(weight, slopes.by_variable, p, result)
    return squares, result


@uncounted(forceinline=True)
def fill_power(networks: Networks, room: Room, v: int, scale: float, slopes: Slopes) -> None:
    """Fill in the derivatives of the products of N and S by a variable."""
    change, root = slopes.change[v], networks.root[0]
    if slopes.inside[v]:
        fill_changes(networks, room.direct, room.rows, change, slopes.changes)
    else:
        put(ZERO, ZERO, slopes.changes, networks.row[root])
    n, d = row_at(room.rows, room.rows.shape[0] - 1)
    d_n, d_d = whole_change(room.direct, root, room.rows, networks.row[root], change, slopes.changes)
    lower, both = change_of_mirrored(d, d, d_d, d_d), change_of_mirrored(d, n, d_d, d_n)
    upper = change_of_mirrored(n, n, d_n, d_n)
    for m in range(len(lower)):
        slopes.power[v, m], slopes.power[v, 5 + m] = scale * lower[m], scale * both[m]
        slopes.power[v, 10 + m] = scale * upper[m]


@uncounted()
def fill_change(denominator: Real, below: Integer, v: int, slopes: Slopes) -> None:
    """Fill in squared gains times the derivatives of the denominator by a variable."""
    factors, more = six(slopes.power, v, below, 0), below.size > SIX
    others = six(slopes.power, v, below, below.size - SIX)
    for i in range(0, denominator.shape[1], WIDTH):
        own, found = load(slopes.gain, (0, i)), loop_at(denominator, factors, 0, i)
        if more:
            found = found + loop_at(denominator, others, SIX, i)
        store(own * own * found, slopes.gain, (1 + v, i))


@uncounted(forceinline=True)
def fill_sums(case: OneFraction, slopes: Slopes) -> None:
    """Fill in the lanes of the sums of all numerators times gains and changes."""
    last = case.term.size - 1
    for r in range(0, slopes.gain.shape[0], 3):
        for q in range(0, last + 1, 4):
            rows = q, min(q + 1, last), min(q + 2, last), min(q + 3, last)
            add_lanes(slopes.gain, r, case.numerators, rows, slopes.sums)


@uncounted()
def add_lanes(gain: Real, r: int, numerators: Real, rows: tuple[int, int, int, int], sums: Real) -> None:
    """Fill in the sums (r, q, 8) of products of three of the gains (r, n) from the r-th with four numerators."""
    s = t = u = v = spread(0.0)
    e = f = g = h = spread(0.0)
    k = m = n = o = spread(0.0)
    a, b, c, d = rows
    for i in range(0, gain.shape[1], WIDTH):
        x, y, z = load(gain, (r, i)), load(gain, (r + 1, i)), load(gain, (r + 2, i))
        one, two = load(numerators, (a, i)), load(numerators, (b, i))
        s, e, k = fused(one, x, s), fused(one, y, e), fused(one, z, k)
        t, f, m = fused(two, x, t), fused(two, y, f), fused(two, z, m)
        if d > b:
            three, four = load(numerators, (c, i)), load(numerators, (d, i))
            u, g, n = fused(three, x, u), fused(three, y, g), fused(three, z, n)
            v, h, o = fused(four, x, v), fused(four, y, h), fused(four, z, o)
    put_three(s, e, k, r, a, sums)
    put_three(t, f, m, r, b, sums)
    if d > b:
        put_three(u, g, n, r, c, sums)
        put_three(v, h, o, r, d, sums)


@uncounted(forceinline=True)
def put_three(one: Lanes, two: Lanes, three: Lanes, r: int, q: int, sums: Real) -> None:
    """Fill in the lanes of a numerator times three gains from the r-th."""
    store(one, sums, (r, q, 0))
    store(two, sums, (r + 1, q, 0))
    store(three, sums, (r + 2, q, 0))


@uncounted(forceinline=True)
def add_slopes(case: OneFraction, power: Real, p: int, squares: Real, slopes: Slopes) -> None:
    """Add the mean squares of a design (p, k), and fill in their derivatives by all variables.

    Numerators follow one another term by term.
    """
    term, exponent, last = case.term, case.power, case.term.size - 1
    for q in range(last + 1):
        squares[p, term[q]] += total(load(slopes.sums, (0, q, 0))) * power[0, exponent[q]]
    for v in range(slopes.power.shape[0]):
        found = spread(0.0)
        for q in range(last + 1):
            found = fused(load(slopes.sums, (0, q, 0)), spread(slopes.power[v, exponent[q]]), found)
            found = fused(load(slopes.sums, (1 + v, q, 0)), spread(-power[0, exponent[q]]), found)
            if q == last or term[q + 1] != term[q]:
                slopes.by_variable[v, term[q]] = total(found)
                found = spread(0.0)

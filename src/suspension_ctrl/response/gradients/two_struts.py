"""Derivatives of mean squares of blocks of two struts that act each on its own deflection.

With e = (1 - P D)^-1 S a response y = R + T D e changes by T (1 - D P)^-1 dD e: as D is diagonal, its changes with
the dynamic stiffness of both struts take four products, and those of its square stay in registers, see `lanes`.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Bool, Integer, Real
from ..lanes import (
    WIDTH,
    Lanes,
    Pair,
    at,
    fused,
    less,
    load,
    plus,
    product,
    reciprocal,
    row_at,
    spread,
    store,
    total,
)
from ..many_struts import ManyStruts, element_at
from ..two_struts import Element, stiffness_at
from .wanted import Wanted, combine, fill_weights, fold, leave_out


class Directions(NamedTuple):
    """Changes of the dynamic stiffness of a block's two struts, beside those of springs."""

    damping: bool  # whether there are variables of dampers,
    inertance: bool  # of inerters or masses
    tangents: Real  # (16 y,), of networks at eight frequencies, by variables
    row: Integer  # (2, y), tangents of each strut
    number: tuple[int, int]  # number of these


@compilable()
def plain_directions(struts: ManyStruts) -> Directions:
    """Return those of struts without networks."""
    return Directions(has(struts, 1), has(struts, 2), np.empty(0), np.empty((2, 0), np.int64), (0, 0))


@uncounted()
def has(struts: ManyStruts, order: int) -> bool:
    """Whether a variable of an order has gains."""
    found = 0
    for v in range(struts.origin.size):
        for entry in range(struts.gain.shape[1] if struts.order[v] == order else 0):
            found += struts.gain[v, entry] != 0.0
    return found > 0


def fits(struts: ManyStruts) -> bool:
    """Whether all blocks have two struts that no variable couples."""
    two = (struts.sizes[:, 0] == 2).all()
    return bool(two and not struts.gain.reshape(len(struts.gain), -1, 4)[:, :, 1:3].any())


@compiled(nogil=True)
def differentiated(struts: ManyStruts, wanted: Wanted, designs: Real, squares: Real, counted: Bool) -> Real:
    """Return the derivatives (p, s, v) of what is wanted, of designs (p, v) with mean squares (p, k).

    Those of combinations that are not `counted` (p, s) are 0.
    """
    (count, variables), combinations, channels, most = designs.shape, wanted.largest.size, 0, 0
    for term in range(struts.channel.size):
        channels = max(channels, struts.channel[term] + 1)
    for b in range(struts.sizes.shape[0]):
        most = max(most, struts.sizes[b, 2])
    channels, most = channels * struts.cases, most * struts.cases
    added, weight, folded = np.empty(variables), np.empty(wanted.factor.shape), np.empty((combinations, channels))
    heard, moments = np.empty((most, 2), np.int64), np.empty((most, 6, WIDTH))
    slopes, result = np.empty((variables, channels)), np.empty((count, combinations, variables))
    directions = plain_directions(struts)
    for p in range(count):
        for v in range(variables):
            added[v] = designs[p, v] - struts.origin[v]
        fill_weights(wanted, squares, p, weight)
        leave_out(counted, p, weight)
        for s in range(combinations):
            fold(struts.channel, weight[s], folded[s])
        fill_slopes(struts, added, folded, heard, directions, moments, slopes)
        combine(folded, slopes, p, result)
    return result


@uncounted()
def fill_slopes(
    struts: ManyStruts,
    added: Real,
    weight: Real,
    heard: Integer,
    directions: Directions,
    moments: Real,
    slopes: Real,
) -> None:
    """Fill in the derivatives (v, m) of the distinct mean squares that have a weight (s, m)."""
    row, entry, output = 0, 0, 0
    for v in range(slopes.shape[0]):
        for channel in range(slopes.shape[1]):
            slopes[v, channel] = 0.0
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        rows, response = struts.rows[row : row + (q + k) * (q + s)], struts.response[output : output + k]
        number = choose(weight, response, struts.cases, heard)
        one, other = element_at(struts, added, entry), element_at(struts, added, entry + 3)
        fill_moments(struts.omega, rows, one, other, s, k, s // struts.cases, heard[:number], directions, moments)
        for h in range(number):
            channel = heard[h, 1] * (slopes.shape[1] // struts.cases) + response[heard[h, 0]]
            for v in range(slopes.shape[0]):
                for j in range(2):
                    gain = struts.gain[v, entry + 3 * j]
                    if gain != 0.0:
                        change = total(load(moments, (h, 3 * j + struts.order[v], 0)))
                        slopes[v, channel] += 2.0 * gain * change
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k


@uncounted()
def choose(weight: Real, response: Integer, cases: int, heard: Integer) -> int:
    """Fill in and count the responses of a block (k,) and load cases (h, 2) that have a weight (s, m)."""
    number, channels = 0, weight.shape[1] // cases
    for case in range(cases):
        for i in range(response.size):
            for s in range(weight.shape[0]):
                if weight[s, case * channels + response[i]] != 0.0:
                    heard[number, 0], heard[number, 1] = i, case
                    number += 1
                    break
    return number


@uncounted(error_model="numpy")
def fill_moments(
    omega: Real,
    rows: Real,
    one: Element,
    other: Element,
    sources: int,
    k: int,
    own: int,
    heard: Integer,
    directions: Directions,
    moments: Real,
) -> None:
    """Fill in half of the changes of squares of the responses heard (h, 6, 8), by K, C and b of both struts.

    The rows (l, 2, n) and the solution of a block of k responses are as of `add_two_struts`; of the sources each
    load case has its own, as many as all others.
    """
    clear(moments, heard.shape[0])
    for t in range(0, omega.size, WIDTH):
        w = load(omega, (t,))
        add_changes(
            w, stiffness_at(one, w), stiffness_at(other, w), rows, t, sources, k, own, heard, directions, moments
        )


@uncounted(forceinline=True)
def clear(moments: Real, number: int) -> None:
    """Begin with so many responses."""
    for i in range(number):
        for j in range(moments.shape[1]):
            store(spread(0.0), moments, (i, j, 0))


@uncounted(error_model="numpy", forceinline=True)
def add_changes(
    w: Lanes,
    first: Pair,
    second: Pair,
    rows: Real,
    t: int,
    sources: int,
    k: int,
    own: int,
    heard: Integer,
    directions: Directions,
    moments: Real,
) -> None:
    """Add changes of squares at eight frequencies from the t-th, by the dynamic stiffnesses of both struts."""
    unit, half = (spread(1.0), spread(0.0)), moments.shape[1] // 2
    p12, p21 = at(rows, 1, t), at(rows, 2, t)
    a, d = less(unit, at(rows, 0, t), first), less(unit, at(rows, 3, t), second)
    b, c = product(p12, second), product(p21, first)
    inverse = reciprocal(less(product(a, d), b, c))
    across, back = product(p12, first), product(p21, second)
    begin, end, case = 0, 0, -1
    for source in range(sources):
        if source == (case + 1) * own:
            begin, case = end, case + 1
            while end < heard.shape[0] and heard[end, 1] == case:
                end += 1
        x, y = at(rows, 4 + source, t), at(rows, 4 + sources + source, t)
        e, f = product(plus(product(d, x), b, y), inverse), product(plus(product(a, y), c, x), inverse)
        tension, u, v = (product(e, first), product(f, second)), product(e, inverse), product(f, inverse)
        by_first, by_second = (product(d, u), product(back, u)), (product(across, v), product(a, v))
        for i in range(begin, end):
            part = 4 + 2 * sources + heard[i, 0] * sources + source
            strut = 4 + 2 * sources + k * sources + 2 * heard[i, 0]
            left, right = at(rows, strut, t), at(rows, strut + 1, t)
            value = plus(plus(at(rows, part, t), left, tension[0]), right, tension[1])
            change = plus(product(left, by_first[0]), right, by_first[1])
            add_moments(w, value, change, i, 0, directions, 0, moments)
            change = plus(product(left, by_second[0]), right, by_second[1])
            add_moments(w, value, change, i, half, directions, 1, moments)


@uncounted(forceinline=True)
def add_moments(
    w: Lanes, value: Pair, change: Pair, i: int, j: int, directions: Directions, strut: int, moments: Real
) -> None:
    """Add the real part of a change times the conjugate of a value, times 1, jw and (jw)^2, and times tangents.

    Those that no variable has are left out.
    """
    (x, y), (u, v) = value, change
    re, im = fused(x, u, y * v), fused(y, u, -(x * v))
    store(load(moments, (i, j, 0)) + re, moments, (i, j, 0))
    if directions.damping:
        store(load(moments, (i, j + 1, 0)) + w * im, moments, (i, j + 1, 0))
    if directions.inertance:
        store(fused(-(w * w), re, load(moments, (i, j + 2, 0))), moments, (i, j + 2, 0))
    for g in range(directions.number[strut]):
        (a, b), place = row_at(directions.tangents, directions.row[strut, g]), (i, j + 3 + g, 0)
        store(fused(re, a, fused(im, b, load(moments, place))), moments, place)

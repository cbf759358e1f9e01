"""Derivatives of mean squares of any number of struts: the adjoint of the strut loop at every frequency.

With e = (1 - P D)^-1 S and a response y = R + T D e, a change of the dynamic stiffness D changes the response by
dy = h dD e with h = T (1 - D P)^-1 = T (1 + D C), C = (1 - P D)^-1 P, and a sum of squares |y|^2 times weights by
2 Re (m dD e) with m = sum of weight y* h.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Bool, Integer, Real
from ..loop_rows import add_product, copy, eliminate, fill_loop, sum_of_squares
from ..many_struts import ManyStruts

ENTRY = 5
"""Column of a block's first entry of D."""


class Loops(NamedTuple):
    """Work arrays of the closed blocks of a design, block after block, in rows (2, n)."""

    block: Integer  # (b, 8), of each block q, s and k, and where its parts begin
    inputs: Real  # right-hand sides (q (s + q)), S and P of each block
    present: Bool  # (q q), whether an entry of D is not zero
    reached: Bool  # (q q), whether an entry of D depends on a variable or a network
    stiffness: Real  # D (q q)
    loop: Real  # (q (q + s + q)), with e and C as solutions
    passed: Real  # 1 + D C (q q)
    value: Real  # y (k s)
    tension: Real  # D e (q) of a source
    force: Real  # (2 q) of a source: sum of weight y* T, then m
    found: Real  # (m,), distinct mean squares
    weight: Real  # (m,), of them in a combination


@compilable()
def loops_of(struts: ManyStruts) -> Loops:
    """Return work arrays, with the right-hand sides of all blocks filled in."""
    n, most, channels, blocks = struts.omega.size, 0, 0, struts.sizes.shape[0]
    block, ends = np.empty((blocks, 8), dtype=np.int64), np.zeros(5, dtype=np.int64)
    for b in range(blocks):
        q, s, k = struts.sizes[b]
        most = max(most, q)
        lengths = ((q + k) * (q + s), q * (s + q), q * q, k, k * s)
        for i in range(8):
            block[b, i] = struts.sizes[b, i] if i < 3 else ends[i - 3]
        for i in range(5):
            ends[i] += lengths[i]
    for term in range(struts.channel.size):
        channels = max(channels, struts.channel[term] + 1)
    _, right, square, _, values = ends
    bits, rows, found = np.empty((2, square), dtype=np.bool_), np.empty((square, 2, n)), np.empty((2, channels))
    loop, tension, force = np.empty((square + right, 2, n)), np.empty((most, 2, n)), np.empty((2 * most, 2, n))
    inputs, passed, value = np.empty((right, 2, n)), np.empty((square, 2, n)), np.empty((values, 2, n))
    loops = Loops(block, inputs, bits[0], bits[1], rows, loop, passed, value, tension, force, found[0], found[1])
    fill_inputs(struts, loops)
    return loops


@uncounted()
def fill_inputs(struts: ManyStruts, loops: Loops) -> None:
    """Fill in the right-hand sides, and the entries of D that a variable or a network reaches."""
    for b in range(loops.block.shape[0]):
        q, s, _, row, right, _, _, _ = loops.block[b]
        for i in range(q):
            for j in range(s):
                copy(struts.rows[row + q * q + i * s + j], loops.inputs[right + i * (s + q) + j])
            for j in range(q):
                copy(struts.rows[row + i * q + j], loops.inputs[right + i * (s + q) + s + j])
    for entry in range(loops.reached.size):
        loops.reached[entry] = False
        for v in range(struts.gain.shape[0]):
            loops.reached[entry] |= struts.gain[v, entry] != 0.0


@uncounted()
def close(struts: ManyStruts, loops: Loops, b: int) -> None:
    """Solve the loop of a block of filled stiffness, and fill in 1 + D C."""
    q, s, _, row, right, entry, _, _ = loops.block[b]
    columns = q + s + q
    present, stiffness = loops.present[entry : entry + q * q], loops.stiffness[entry : entry + q * q]
    feedback, inputs = struts.rows[row : row + q * q], loops.inputs[right : right + q * (s + q)]
    loop = loops.loop[entry + right : entry + right + q * columns]
    fill_loop(q, s + q, present, stiffness, feedback, inputs, loop)
    eliminate(q, columns, loop)
    for i in range(q):
        for j in range(q):
            passed = loops.passed[entry + i * q + j]
            set_to(1.0 if i == j else 0.0, passed)
            for other in range(q):
                if present[i * q + other]:
                    add_product(1.0, stiffness[i * q + other], loop[other * columns + q + s + j], passed)


@uncounted()
def fill_values(struts: ManyStruts, loops: Loops, b: int) -> None:
    """Fill in the responses of a closed block, and add their squares to the distinct mean squares."""
    q, s, k, row, right, entry, output, first = loops.block[b]
    by_source = struts.rows[row + q * (q + s) : row + q * (q + s) + k * s]
    by_strut = struts.rows[row + q * (q + s) + k * s : row + (q + k) * (q + s)]
    for source in range(s):
        for i in range(q):
            tension = loops.tension[i]
            set_to(0.0, tension)
            for j in range(q):
                if loops.present[entry + i * q + j]:
                    solved = loops.loop[entry + right + j * (q + s + q) + q + source]
                    add_product(1.0, loops.stiffness[entry + i * q + j], solved, tension)
        for i in range(k):
            value = loops.value[first + i * s + source]
            copy(by_source[i * s + source], value)
            for j in range(q):
                add_product(1.0, by_strut[i * q + j], loops.tension[j], value)
            loops.found[struts.response[output + i]] += sum_of_squares(value)


@uncounted()
def fill_force(struts: ManyStruts, loops: Loops, b: int, source: int) -> bool:
    """Fill in m of a combination in a block for a source; return whether a response has a weight."""
    q, s, k, row, _, entry, output, first = loops.block[b]
    by_strut = struts.rows[row + q * (q + s) + k * s : row + (q + k) * (q + s)]
    heard = False
    for i in range(k):
        weight = loops.weight[struts.response[output + i]]
        for j in range(q if weight != 0.0 else 0):
            if not heard:
                set_to(0.0, loops.force[j])
            add_conjugate_product(weight, loops.value[first + i * s + source], by_strut[i * q + j], loops.force[j])
        heard |= weight != 0.0
    for j in range(q if heard else 0):
        set_to(0.0, loops.force[q + j])
        for i in range(q):
            add_product(1.0, loops.force[i], loops.passed[entry + i * q + j], loops.force[q + j])
    return heard


@compilable()
def set_to(value: float, row: Real) -> None:
    """Fill in a real value throughout a complex row (2, n)."""
    for t in range(row.shape[1]):
        row[0, t], row[1, t] = value, 0.0


@compilable(fastmath={"contract", "nsz"})
def add_conjugate_product(weight: float, left: Real, right: Real, total: Real) -> None:
    """Add the conjugate of a complex row (2, n) times another, times a weight, to a third."""
    a, b, x, y, re, im = left[0], left[1], right[0], right[1], total[0], total[1]
    for t in range(a.size):
        re[t] += weight * (a[t] * x[t] + b[t] * y[t])
        im[t] += weight * (a[t] * y[t] - b[t] * x[t])


@compilable(fastmath={"reassoc", "contract", "nsz"})
def moments(left: Real, right: Real, omega: Real) -> tuple[float, float, float]:
    """Return the real parts of the sums of a product of complex rows (2, n), times 1, jw and (jw)^2."""
    a, b, x, y = left[0], left[1], right[0], right[1]
    stiffness, damping, inertance = 0.0, 0.0, 0.0
    for t in range(a.size):
        re, im, w = a[t] * x[t] - b[t] * y[t], a[t] * y[t] + b[t] * x[t], omega[t]
        stiffness += re
        damping -= w * im
        inertance -= w * w * re
    return stiffness, damping, inertance

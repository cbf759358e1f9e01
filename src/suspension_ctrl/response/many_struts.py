"""Mean-square responses of any number of struts: a compiled solve of the small loop at every frequency."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from ..quantities import Real


class StrutBlock(NamedTuple):
    """Struts that feel one another: their loop, and the rows of the responses that they have a part in.

    Real and imaginary parts of each value at all frequencies stand in rows (2, n), which a processor works on at
    once.

    Parameters
    ----------
    omega : (n,) ndarray
        Angular frequencies [rad/s].
    feedback : (q, q, 2, n) ndarray
        Deflections by tensions.
    deflections : (q, s, 2, n) ndarray
        Deflections by s uncorrelated sources of unit density that stand for the roads.
    rows : (k, s, 2, n) ndarray
        Responses by these sources, each times the root of the density it is to be integrated with.
    from_struts : (k, q, 2, n) ndarray
        Responses by tensions, likewise.
    response : (k,) ndarray
        Number of the response that a row adds to.
    stiffness, damping : (v, q, q) ndarray
        Tensions by deflections and by their rates, of each variable coefficient.
    origin : (v,) ndarray
        Coefficients of the struts that are in place already.
    """

    omega: Real
    feedback: Real
    deflections: Real
    rows: Real
    from_struts: Real
    response: NDArray[np.int64]
    stiffness: Real
    damping: Real
    origin: Real


@njit(cache=True)
def mean_squares(design: Real, blocks: tuple[StrutBlock, ...], channels: int) -> Real:
    """Return the mean squares (channels,) of one design (v,)."""
    result = np.zeros(channels)
    for block in blocks:
        add_mean_squares(design, block, result)
    return result


@njit(cache=True)
def mean_squares_of_all(designs: Real, blocks: tuple[StrutBlock, ...], channels: int) -> Real:
    """Return the mean squares (p, channels) of designs (p, v), to the last bit those of each one alone."""
    results = np.empty((designs.shape[0], channels))
    for i in range(designs.shape[0]):
        results[i] = mean_squares(designs[i], blocks, channels)
    return results


@njit(cache=True)
def add_mean_squares(design: Real, block: StrutBlock, result: Real) -> None:
    """Add what a block gives of the mean squares (m,) of a design (v,) to `result`.

    Struts with tensions D e by deflections e = S + P D e, where S are the sources: (1 - P D) e = S is solved by
    elimination, which is to close one strut after the other and so needs no exchange of rows.
    """
    q, sources = block.deflections.shape[0], block.deflections.shape[1]
    added = design - block.origin
    k, c = weighted_sum(added, block.stiffness), weighted_sum(added, block.damping)
    loop = open_loop(k, c, block)
    eliminate(loop)
    tension = np.empty((q, 2, block.omega.size))
    value = np.empty((2, block.omega.size))
    for s in range(sources):
        tension[:] = 0.0
        for i in range(q):
            for j in range(q):
                add_impedance(k[i, j], c[i, j], block.omega, loop[j, q + s], tension[i])
        for row in range(block.response.size):
            value[:] = block.rows[row, s]
            for j in range(q):
                add_product(1.0, block.from_struts[row, j], tension[j], value)
            result[block.response[row]] += sum_of_squares(value)


@njit(cache=True)
def weighted_sum(weights: Real, matrices: Real) -> Real:
    """Return the sum (q, q) of `matrices` (v, q, q), each times its weight (v,)."""
    total = np.zeros(matrices.shape[1:])
    for v in range(weights.size):
        total += weights[v] * matrices[v]
    return total


@njit(cache=True)
def open_loop(k: Real, c: Real, block: StrutBlock) -> Real:
    """Return 1 - P D beside the sources, (q, q + s, 2, n)."""
    q, n = k.shape[0], block.omega.size
    loop = np.zeros((q, q + block.deflections.shape[1], 2, n))
    for i in range(q):
        for j in range(q):
            for l in range(q):  # noqa: E741
                add_impedance(-k[l, j], -c[l, j], block.omega, block.feedback[i, l], loop[i, j])
        loop[i, i, 0] += 1.0
        for s in range(block.deflections.shape[1]):
            loop[i, q + s] = block.deflections[i, s]
    return loop


@njit(cache=True)
def eliminate(loop: Real) -> None:
    """Solve the linear equations (q, q + s, 2, n) in place: solutions stand where the right-hand sides were."""
    q, columns = loop.shape[0], loop.shape[1]
    for c in range(q):
        invert(loop[c, c])
        for j in range(c + 1, columns):
            multiply(loop[c, c], loop[c, j])
        for i in range(c + 1, q):
            for j in range(c + 1, columns):
                add_product(-1.0, loop[i, c], loop[c, j], loop[i, j])
    for c in range(q - 1, 0, -1):
        for i in range(c):
            for j in range(q, columns):
                add_product(-1.0, loop[i, c], loop[c, j], loop[i, j])


# Rows of frequencies: products may be fused and sums taken in whatever order suits the processor, the same for
# every design; numpy's error model leaves out a check for division by zero that would keep a loop from being
# vectorised.
@njit(cache=True, fastmath={"contract", "nsz"}, error_model="numpy")
def invert(value: Real) -> None:
    """Replace a complex row (2, n) by its reciprocal."""
    a, b = value[0], value[1]
    for t in range(a.size):
        size = a[t] * a[t] + b[t] * b[t]
        a[t] /= size
        b[t] /= -size


@njit(cache=True, fastmath={"contract", "nsz"})
def multiply(factor: Real, value: Real) -> None:
    """Multiply a complex row (2, n) by another in place."""
    a, b, x, y = factor[0], factor[1], value[0], value[1]
    for t in range(a.size):
        real = a[t] * x[t] - b[t] * y[t]
        y[t] = a[t] * y[t] + b[t] * x[t]
        x[t] = real


@njit(cache=True, fastmath={"contract", "nsz"})
def add_product(sign: float, left: Real, right: Real, total: Real) -> None:
    """Add the product of two complex rows (2, n), times `sign`, to a third."""
    a, b, x, y, re, im = left[0], left[1], right[0], right[1], total[0], total[1]
    for t in range(a.size):
        re[t] += sign * (a[t] * x[t] - b[t] * y[t])
        im[t] += sign * (a[t] * y[t] + b[t] * x[t])


@njit(cache=True, fastmath={"contract", "nsz"})
def add_impedance(k: float, c: float, omega: Real, values: Real, total: Real) -> None:
    """Add k + jwc times a complex row (2, n) to another."""
    if k == 0.0 and c == 0.0:
        return
    x, y, re, im = values[0], values[1], total[0], total[1]
    for t in range(omega.size):
        w = c * omega[t]
        re[t] += k * x[t] - w * y[t]
        im[t] += k * y[t] + w * x[t]


@njit(cache=True, fastmath={"reassoc", "contract", "nsz"})
def sum_of_squares(value: Real) -> float:
    """Return the sum of the squared magnitudes of a complex row (2, n)."""
    total = 0.0
    x, y = value[0], value[1]
    for t in range(x.size):
        total += x[t] * x[t] + y[t] * y[t]
    return total

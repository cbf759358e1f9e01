"""Mean-square responses of any number of struts: a compiled solve of the small loop at every frequency."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from .ports import Real


class StrutBlock(NamedTuple):
    """Struts that feel one another: their loop, and the rows of the responses that they have a part in.

    Real and imaginary parts stand apart, so that all frequencies are worked on at once.

    Parameters
    ----------
    omega : (n,) ndarray
        Angular frequencies [rad/s].
    feedback : (2, q, q, n) ndarray
        Deflections by tensions.
    deflections : (2, q, s, n) ndarray
        Deflections by s uncorrelated sources of unit density that stand for the roads.
    rows : (2, k, s, n) ndarray
        Responses by these sources, each times the root of the density it is to be integrated with.
    from_struts : (2, k, q, n) ndarray
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


# As in `strut_loop`: sums over frequencies in whatever order suits the processor, no check for division by zero.
@njit(cache=True, fastmath={"reassoc", "contract", "nsz"}, error_model="numpy")
def add_mean_squares(design: Real, block: StrutBlock, result: Real) -> None:
    """Add what a block gives of the mean squares (m,) of a design (v,) to `result`.

    Struts with tensions D e by deflections e = S + P D e, where S are the sources: (1 - P D) e = S is solved by
    elimination, which is to close one strut after the other and so needs no exchange of rows.
    """
    sources = block.deflections.shape[2]
    added = design - block.origin
    k, c = weighted_sum(added, block.stiffness), weighted_sum(added, block.damping)
    loop = open_loop(k, c, block)
    eliminate(loop, k.shape[0])
    deflections = loop[:, :, k.shape[0] :]
    tension = np.empty((2, k.shape[0], block.omega.size))
    value = np.empty((2, block.omega.size))
    for s in range(sources):
        tension[:] = 0.0
        for i in range(k.shape[0]):
            for j in range(k.shape[0]):
                add_impedance(k[i, j], c[i, j], block.omega, deflections[:, j, s], tension[:, i])
        for row in range(block.response.size):
            value[:] = block.rows[:, row, s]
            for j in range(k.shape[0]):
                add_product(1.0, block.from_struts[:, row, j], tension[:, j], value)
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
    """Return 1 - P D beside the sources, (2, q, q + s, n)."""
    q, n = k.shape[0], block.omega.size
    loop = np.zeros((2, q, q + block.deflections.shape[2], n))
    loop[:, :, q:] = block.deflections
    product = np.empty((2, n))
    for i in range(q):
        for j in range(q):
            product[:] = 0.0
            for l in range(q):  # noqa: E741
                add_impedance(k[l, j], c[l, j], block.omega, block.feedback[:, i, l], product)
            loop[0, i, j] = -product[0]
            loop[1, i, j] = -product[1]
        loop[0, i, i] += 1.0
    return loop


@njit(cache=True)
def eliminate(loop: Real, q: int) -> None:
    """Solve the linear equations (2, q, q + s, n) in place: solutions stand where the right-hand sides were."""
    for c in range(q):
        divide(loop[:, c, c], loop[:, c, c + 1 :])
        for i in range(q):
            if i != c:
                for j in range(c + 1, loop.shape[2]):
                    add_product(-1.0, loop[:, i, c], loop[:, c, j], loop[:, i, j])


@njit(cache=True, fastmath={"contract", "nsz"}, error_model="numpy")
def divide(divisor: Real, values: Real) -> None:
    """Divide `values` (2, k, n) by the `divisor` (2, n) in place."""
    a, b = divisor[0], divisor[1]
    for j in range(values.shape[1]):
        x, y = values[0, j], values[1, j]
        for t in range(a.size):
            size = a[t] * a[t] + b[t] * b[t]
            real = (x[t] * a[t] + y[t] * b[t]) / size
            y[t] = (y[t] * a[t] - x[t] * b[t]) / size
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

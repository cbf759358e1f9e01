"""The limits of this machine in this run, and the operations that an evaluation needs."""

from functools import cache
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from suspension_ctrl.compiled import compiled
from suspension_ctrl.response.any_struts import AnyStruts
from suspension_ctrl.response.lanes import WIDTH, fused, spread, total
from suspension_ctrl.response.linearisation import working_points
from suspension_ctrl.response.many_struts import ManyStruts
from suspension_ctrl.response.one_fraction import OneFraction
from suspension_ctrl.response.one_port import OnePort
from suspension_ctrl.response.one_strut import OneStrut

_CHAINS = 10  # independent, more than the cycles from one multiply-add to the next of its chain
_STREAM = 1 << 23  # numbers of an array of the triad: 64 MB, beyond any cache
_SECONDS = 0.02
STEP = _CHAINS * WIDTH
"""Multiply-adds of all chains in a step."""


class Limits(NamedTuple):
    """Operations in a second on one thread."""

    multiply_adds: float
    divisions: float
    bytes: float


class Work(NamedTuple):
    """Operations that follow from a formula: an addition or a multiplication counts as a multiply-add."""

    multiply_adds: float
    divisions: float
    bytes: float

    def seconds(self, limits: Limits) -> float:
        """Return the time [s] of the slowest kind of operation, as if it hid the others."""
        return max(count / rate for count, rate in zip(self, limits, strict=True))


@compiled(nogil=True, error_model="numpy")
def multiply_adds(repeats: int, x: float) -> float:
    """Return the sum of ten chains of multiply-adds."""
    f, y = spread(x), spread(1.0 - x)
    a = b = c = d = e = spread(0.1)
    g = h = i = j = k = spread(0.2)
    for _ in range(repeats):
        a, b, c, d, e = fused(a, f, y), fused(b, f, y), fused(c, f, y), fused(d, f, y), fused(e, f, y)
        g, h, i, j, k = fused(g, f, y), fused(h, f, y), fused(i, f, y), fused(j, f, y), fused(k, f, y)
    return total(a + b + c + d + e + g + h + i + j + k)


@compiled(error_model="numpy")
def divisions(repeats: int, x: float) -> float:
    """Return the sum of ten chains of divisions."""
    f = spread(x)
    a = b = c = d = e = spread(0.1)
    g = h = i = j = k = spread(0.2)
    for _ in range(repeats):
        a, b, c, d, e = f / a, f / b, f / c, f / d, f / e
        g, h, i, j, k = f / g, f / h, f / i, f / j, f / k
    return total(a + b + c + d + e + g + h + i + j + k)


@compiled()
def triad(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64], factor: float) -> None:
    """Fill in a = b + factor c."""
    for i in range(a.size):
        a[i] = b[i] + factor * c[i]


@cache
def limits() -> Limits:
    """Return the limits of this machine, the best of several tries each."""
    each, repeats = STEP, 200_000
    arrays = np.ones((3, _STREAM))
    return Limits(
        each * repeats / _least(multiply_adds, repeats, 0.5),
        each * repeats / _least(divisions, repeats, 1.5),
        arrays.nbytes / _least(triad, *arrays, 3.0),
    )


def _least(function: Any, *arguments: Any) -> float:
    """Return the least time [s] of calls for a while after a first one."""
    function(*arguments)
    times: list[float] = []
    while sum(times) < 10 * _SECONDS or len(times) < 5:
        start = perf_counter()
        function(*arguments)
        times.append(perf_counter() - start)
    return min(times)


def work_of(case: Any, designs: NDArray[np.float64]) -> Work:
    """Return the mean operations for a design of a kernel."""
    if isinstance(case, OneStrut):
        return _of_one_strut(case)
    if isinstance(case, OneFraction):
        return _of_one_fraction(case)
    if isinstance(case, OnePort):
        return _of_one_port(case, float(working_points(case, designs).iterations.mean()))
    if isinstance(case, AnyStruts):
        points = working_points(case, designs) if len(case.networks.law) else None
        return _of_any_struts(case, float(points.iterations.mean()) if points else 0.0)
    return _of_many_struts(case)


def _of_one_strut(case: OneStrut) -> Work:
    """Return 4 multiply-adds by denominator, of which two share a division and 3 products, 1 by numerator."""
    q, n = case.numerators.shape
    return Work(n * (4 + 1.5 + q), n / 2, 8 * (2 + case.terms))


def _of_one_fraction(case: OneFraction) -> Work:
    """Return a multiply-add by row of the denominator and by numerator, and what shares a division as above."""
    (q, n), rows = case.numerators.shape, int(case.denominator.any(axis=1).sum())
    return Work(n * (rows + 1.5 + q), n / 2, 8 * (len(case.networks.variable) + case.port.terms))


def _of_one_port(case: OnePort, iterations: float) -> Work:
    """Return operations by node of a network in series, and by iteration of force laws.

    Two elements in series are 24 multiply-adds and a division: two stiffnesses of 5, a product, a sum, a quotient.
    The gain is a stiffness of 5, a denominator of 5, a division and 3 products, and each numerator is 1 more. An
    iteration without series is a stiffness of 3 and a denominator of 5, of which two share a division, and two
    integrals, 3.5; a last one has the gain in place of that, and 2 by each law.
    """
    (r, n), laws = case.numerators.shape, len(case.networks.law)
    series = int((case.networks.row > 0).sum())
    gains = iterations if series else 1.0
    others = iterations - gains
    each = gains * (24 * series + 13 + 2 * laws) + r + others * 11.5
    return Work(n * each, n * (gains * (1 + series) + others / 2), 8 * (2 + case.terms))


def _of_any_struts(case: AnyStruts, iterations: float) -> Work:
    """Return operations by node of networks, of blocks as of `_of_many_struts`, and by iteration of force laws.

    Two elements in series are 24 multiply-adds and a division as above, and their sum with what stands beside them
    2 at each strut of each block. An iteration of a block closes the loop, of two struts by 5, 16, 8 and 2
    multiply-adds and a division; a squared deflection by source is 10 of two struts and 2 of others, and 1 more by
    network; a law is 2.
    """
    n, blocks, laws = case.struts.omega.size, _of_many_struts(case.struts), len(case.networks.law)
    series = int((case.networks.row > 0).sum())
    struts = sum(q for q, _, _ in case.struts.sizes.tolist())
    multiply_adds, divisions = 24.0 * series + (2 * struts if series else 0), float(series)
    if laws:
        closed = sum(_closed(q, s) for q, s, _ in case.struts.sizes.tolist())
        multiply_adds += iterations * (multiply_adds + closed + 2 * laws)
        divisions += iterations * (divisions + blocks.divisions / n)
    return Work(blocks.multiply_adds + n * multiply_adds, blocks.divisions + n * divisions, blocks.bytes)


def _of_many_struts(case: ManyStruts) -> Work:
    """Return operations by node of each block of q struts, s sources and k responses.

    A complex product is 4 multiply-adds. Two struts: stiffnesses 5, the loop 16, its determinant 8, the reciprocal
    4 and a division, two products 8; by source two deflections and tensions, 24, and by source and response two
    products and a square, 10. Of q others: stiffnesses 3 q, the loop q q products, elimination q reciprocals and
    the products of a triangular solve.
    """
    multiply_adds, divisions, n = 0.0, 0.0, case.omega.size
    for q, s, k in case.sizes.tolist():
        deflections = 16 * s if q == 2 else 0
        multiply_adds += n * (_loop(q, s) + deflections + s * (4 * q + k * (4 * q + 2)))
        divisions += n * (1 if q == 2 else q)
    return Work(multiply_adds, divisions, 8 * (len(case.origin) + case.channel.size))


def _loop(q: int, s: int) -> int:
    """Return the multiply-adds of the loop of q struts, with the deflections by s sources if they are not two."""
    inner = sum((q + s - c - 1) * (1 + q - c - 1) for c in range(q)) + s * q * (q - 1) // 2
    return 41 if q == 2 else 3 * q + 4 * q * q + 4 * q + 4 * inner


def _closed(q: int, s: int) -> int:
    """Return the multiply-adds from the loop of q struts to squared deflections of networks by s sources."""
    return 31 + 2 * (10 * s + 1) if q == 2 else _loop(q, s) + q * (2 * s + 1)

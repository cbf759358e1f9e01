"""Derivatives of mean squares around one strut of any kind, by the adjoint of its dynamic stiffness."""

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Integer, Real
from ..network_rows import DIRECT, IN_SERIES, OF_RATE, STATES, fill, fill_rows, fill_share
from ..one_port import OnePort, add_terms, fill_gain, solve
from ..working_point import Points
from .network_rows import Adjoint, add_moments, adjoint_of, clear, pull, pull_share
from .wanted import Wanted, fill_weights
from .working_point import (
    Point,
    Settled,
    fill_rise,
    fill_slopes,
    keep_law,
    point_of,
    settle,
    settle_slopes,
    settled_of,
)


@compiled(error_model="numpy")
def with_slopes(port: OnePort, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted.

    NaN without a working point.
    """
    networks, n, count, laws = port.networks, port.omega.size, designs.shape[0], port.networks.law.shape[0]
    points = Points(np.empty((count, laws, STATES)), np.empty((count, 1)), np.empty(count, dtype=np.int64))
    squares = solve(port, designs, points) if laws > 0 else np.zeros((count, port.terms))
    settled, adjoint, point = settled_of(networks, n), adjoint_of(networks, n), point_of(networks)
    gain, numerator, beside = np.empty((4, n)), np.empty((4, n)), np.empty(DIRECT)
    slopes, weight = np.empty((count, wanted.largest.size, designs.shape[1])), np.empty(wanted.factor.shape)
    for p in range(count):
        settle(networks, designs, p, points.state, settled)
        close(port, settled, gain)
        if laws == 0:
            add_terms(port.numerators, port.term, port.power, gain, p, squares)
        else:
            fill_rise(networks, settled, point)
            for law in range(laws):
                differentiate_law(port, settled, gain, law, numerator, beside, adjoint, point)
            settle_slopes(point)
        fill_weights(wanted, squares, p, weight)
        for s in range(wanted.largest.size):
            clear(adjoint)
            fill_numerator(port.numerators, port.term, port.power, weight[s], numerator)
            differentiate(port, settled, gain, numerator, beside, adjoint)
            fill_slopes(networks, adjoint, point, slopes[p, s])
    return squares, slopes


@uncounted(error_model="numpy")
def close(port: OnePort, settled: Settled, gain: Real) -> None:
    """Fill in the rows of the network, and the gains (4, n) of the loop with it and with what stands beside it."""
    networks, direct = port.networks, settled.direct
    last = networks.root[0]
    for c in range(networks.order.size):
        direct[last, networks.order[c]] += networks.gain[c, 0, 0] * settled.values[c]
    fill_rows(networks, port.omega, settled.values, direct, settled.rows)
    fill_gain(port.denominator, port.omega, direct, last, settled.rows, networks.row[last], gain)


@uncounted(error_model="numpy")
def differentiate_law(
    port: OnePort,
    settled: Settled,
    gain: Real,
    law: int,
    numerator: Real,
    beside: Real,
    adjoint: Adjoint,
    point: Point,
) -> None:
    """Fill in the mean square of a law's own deflection or rate, and its derivatives."""
    networks, share, direct, rows = port.networks, settled.share[0], settled.direct, settled.rows
    clear(adjoint)
    fill(share, networks.square[law])
    if networks.law[law, IN_SERIES]:
        fill_share(networks, port.omega, law, direct, rows, share)
    fill_product(port.excitation[networks.law[law, OF_RATE]], share, numerator[0])
    for power in range(1, 4):
        fill(numerator[power], 0.0)
    fill_product(numerator[0], gain[0], share)
    point.square[law] = total_of(share)
    if networks.law[law, IN_SERIES]:
        pull_share(networks, port.omega, law, direct, rows, share, adjoint)
    differentiate(port, settled, gain, numerator, beside, adjoint)
    keep_law(law, adjoint, point)


@uncounted(error_model="numpy")
def differentiate(
    port: OnePort, settled: Settled, gain: Real, numerator: Real, beside: Real, adjoint: Adjoint
) -> None:
    """Add up the derivatives of an output by coefficients and slopes, by its numerator (4, n).

    Works in those by the direct elements beside the network (4,).
    """
    networks = port.networks
    row = adjoint.rows[adjoint.place[networks.root[0]]]
    add_adjoint(port.denominator, numerator, gain, row)
    fill(beside, 0.0)
    add_moments(1.0, row, port.omega, beside)
    pull(networks, port.omega, settled.direct, settled.rows, adjoint)
    for c in range(adjoint.by_value.size):
        adjoint.by_value[c] += networks.gain[c, 0, 0] * beside[networks.order[c]]


@compilable(fastmath={"contract", "nsz"})
def add_adjoint(denominator: Real, numerator: Real, gain: Real, row: Real) -> None:
    """Add the adjoint of D (2, n) in the sum of N/|1 + c D|^2 with N of 1, Re D, Im D and |D|^2 (4, n)."""
    for t in range(row.shape[1]):
        one, re, im = gain[0, t], gain[1, t], gain[2, t]
        value = numerator[0, t] * one + numerator[1, t] * re + numerator[2, t] * im + numerator[3, t] * gain[3, t]
        row[0, t] += numerator[1, t] * one + 2.0 * numerator[3, t] * re
        row[0, t] -= value * (denominator[1, t] * one + 2.0 * denominator[3, t] * re)
        row[1, t] -= numerator[2, t] * one + 2.0 * numerator[3, t] * im
        row[1, t] += value * (denominator[2, t] * one + 2.0 * denominator[3, t] * im)


@compilable(fastmath={"contract", "nsz"})
def fill_numerator(numerators: Real, term: Integer, power: Integer, weight: Real, numerator: Real) -> None:
    """Fill in the numerator (4, n) of a combination of terms with weights (k,)."""
    for i in range(numerator.shape[0]):
        for t in range(numerator.shape[1]):
            numerator[i, t] = 0.0
    for q in range(power.size):
        factor = weight[term[q]]
        if factor != 0.0:
            for t in range(numerator.shape[1]):
                numerator[power[q], t] += factor * numerators[q, t]


@compilable()
def fill_product(left: Real, right: Real, result: Real) -> None:
    """Fill in the product (n,) of two rows."""
    for t in range(result.size):
        result[t] = left[t] * right[t]


@compilable(fastmath={"reassoc", "contract", "nsz"})
def total_of(row: Real) -> float:
    """Return the sum of a row (n,)."""
    total = 0.0
    for t in range(row.size):
        total += row[t]
    return total

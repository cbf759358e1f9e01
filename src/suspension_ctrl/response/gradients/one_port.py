"""Derivatives of mean squares around one strut with force laws, by the adjoint of its dynamic stiffness."""

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Real
from ..network_rows import (
    DAMPING,
    DIRECT,
    IN_SERIES,
    INERTANCE,
    LOSS,
    OF_RATE,
    STIFFNESS,
    fill,
    fill_share,
)
from ..one_port import OnePort, add_beside, fill_gain, solve
from ..working_point import room_for_points
from .joints import Joints, fill_rows_and_joints
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


def with_slopes(port: OnePort, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted.

    NaN without a working point.
    """
    points = room_for_points(port.networks, len(designs))
    squares = solve(port, designs, points)
    return squares, differentiated(port, wanted, designs, points.state, squares)


@compiled(nogil=True, error_model="numpy")
def differentiated(port: OnePort, wanted: Wanted, designs: Real, state: Real, squares: Real) -> Real:
    """Return the derivatives (p, s, v) of what is wanted, at states (p, l, 8) of laws with mean squares (p, k).

    Outputs are the mean squares of laws, then what is wanted.
    """
    networks, n, count, laws = port.networks, port.omega.size, designs.shape[0], port.networks.law.shape[0]
    settled, adjoint, point = settled_of(networks, n), adjoint_of(networks, n, False), point_of(networks)
    gain, beside, numerators = np.empty((4, n)), np.empty(DIRECT), numerators_of(port, wanted)
    slopes, weight = np.empty((count, wanted.largest.size, designs.shape[1])), np.empty(wanted.factor.shape)
    for p in range(count):
        settle(networks, designs, p, state, settled)
        close(port, settled, adjoint.joints, gain)
        fill_rise(networks, settled, point)
        fill_weights(wanted, squares, p, weight)
        for output in range(laws + wanted.largest.size):
            clear(adjoint)
            s = output - laws
            which = numerators.shape[0] - 1 if s < 0 else row_of(wanted, weight, s)
            if s < 0:
                fill_law(port, settled, gain, output, numerators[which, 0], adjoint, point)
            elif s == 0:
                settle_slopes(point)
            differentiate(port, gain, numerators[which], settled.share[1], beside, adjoint)
            if s < 0:
                keep_law(output, adjoint, point)
            else:
                fill_slopes(networks, adjoint, point, slopes[p, s])
    return slopes


@compilable()
def numerators_of(port: OnePort, wanted: Wanted) -> Real:
    """Return numerators (s k + 1, 4, n) of what is wanted: of sums, or of each term; the last are zeros."""
    terms, found = port.terms, np.zeros((wanted.factor.size + 1, 4, port.omega.size))
    for s in range(wanted.largest.size):
        for q in range(port.power.size):
            which = s * terms + (port.term[q] if wanted.largest[s] else 0)
            for t in range(port.omega.size):
                found[which, port.power[q], t] += wanted.factor[s, port.term[q]] * port.numerators[q, t]
    return found


@compilable()
def row_of(wanted: Wanted, weight: Real, s: int) -> int:
    """Return which of the numerators is that of a combination with weights (s, k)."""
    terms, best = weight.shape[1], 0
    for k in range(terms if wanted.largest[s] else 0):
        best = k if weight[s, k] != 0.0 else best
    return s * terms + best


@uncounted(error_model="numpy", forceinline=True)
def close(port: OnePort, settled: Settled, joints: Joints, gain: Real) -> None:
    """Fill in the rows and joints of the network, and the gains (4, n) of the loop with what stands beside it."""
    networks, direct, last = port.networks, settled.direct, port.networks.root[0]
    add_beside(networks, settled.values, direct)
    fill_rows_and_joints(networks, port.omega, settled.values, direct, settled.rows, joints)
    fill_gain(port.denominator, port.omega, direct, last, settled.rows, networks.row[last], gain)


@uncounted(error_model="numpy", forceinline=True)
def fill_law(
    port: OnePort, settled: Settled, gain: Real, law: int, numerator: Real, adjoint: Adjoint, point: Point
) -> None:
    """Fill in the mean square of a law's own deflection or rate, its numerator (n,), and adjoints by its share."""
    networks, share, direct, rows = port.networks, settled.share[0], settled.direct, settled.rows
    fill(share, networks.square[law])
    if networks.law[law, IN_SERIES]:
        fill_share(networks, port.omega, law, direct, rows, share)
    fill_product(port.excitation[networks.law[law, OF_RATE]], share, numerator)
    fill_product(numerator, gain[0], share)
    point.square[law] = total_of(share)
    if networks.law[law, IN_SERIES]:
        pull_share(networks, port.omega, law, direct, rows, share, adjoint)


@uncounted(error_model="numpy", forceinline=True)
def differentiate(port: OnePort, gain: Real, numerator: Real, value: Real, beside: Real, adjoint: Adjoint) -> None:
    """Add up the derivatives of an output by coefficients and slopes, by its numerator (4, n).

    Works in its summands (n,), and in the derivatives by direct elements beside the network (4,).
    """
    networks = port.networks
    last = networks.root[0]
    fill(beside, 0.0)
    if adjoint.place[last] > 0:
        row = adjoint.rows[adjoint.place[last]]
        fill_adjoint(port.denominator, numerator, gain, value, row)
        add_moments(row, port.omega, beside)
    else:
        add_port_moments(port.denominator, numerator, gain, port.omega, beside)
        for i in range(DIRECT):
            adjoint.moment[last, i] += beside[i]
    pull(networks, port.omega, adjoint)
    for c in range(adjoint.by_value.size):
        adjoint.by_value[c] += networks.gain[c, 0, 0] * beside[networks.order[c]]


@compilable(fastmath={"reassoc", "contract", "nsz"})
def add_port_moments(denominator: Real, numerator: Real, gain: Real, omega: Real, moment: Real) -> None:
    """Add the derivatives (4,) by direct elements, as `fill_adjoint` and `add_moments` in one."""
    stiffness, damping, inertance, loss = 0.0, 0.0, 0.0, 0.0
    for t in range(omega.size):
        one, re, im, w = gain[0, t], gain[1, t], gain[2, t], omega[t]
        value = numerator[0, t] * one + numerator[1, t] * re + numerator[2, t] * im + numerator[3, t] * gain[3, t]
        twice = 2.0 * (numerator[3, t] - value * denominator[3, t])
        by_re = (numerator[1, t] - value * denominator[1, t]) * one + twice * re
        by_im = (numerator[2, t] - value * denominator[2, t]) * one + twice * im
        stiffness += by_re
        damping += w * by_im
        inertance -= w * w * by_re
        loss += by_im
    moment[STIFFNESS] += stiffness
    moment[DAMPING] += damping
    moment[INERTANCE] += inertance
    moment[LOSS] += loss


# Rows few enough in a loop for the compiler to tell them apart: more are not vectorised.
@compilable(fastmath={"contract", "nsz"})
def fill_adjoint(denominator: Real, numerator: Real, gain: Real, value: Real, row: Real) -> None:
    """Fill in the adjoint of D (2, n) in the sum of N/|1 + c D|^2 with N of 1, Re D, Im D and |D|^2 (4, n).

    Works in the summands (n,).
    """
    n_0, n_re, n_im, n_d = numerator[0], numerator[1], numerator[2], numerator[3]
    one, by_re, by_im, square = gain[0], gain[1], gain[2], gain[3]
    for t in range(value.size):
        value[t] = n_0[t] * one[t] + n_re[t] * by_re[t] + n_im[t] * by_im[t] + n_d[t] * square[t]
    fill_slope(1.0, n_re, n_d, denominator[1], denominator[3], one, by_re, value, row[0])
    fill_slope(-1.0, n_im, n_d, denominator[2], denominator[3], one, by_im, value, row[1])


@compilable(fastmath={"contract", "nsz"})
def fill_slope(
    sign: float,
    linear: Real,
    quadratic: Real,
    below: Real,
    below_quadratic: Real,
    one: Real,
    by: Real,
    value: Real,
    row: Real,
) -> None:
    """Fill in the derivatives (n,) of ratios by a part of D, times a sign."""
    for t in range(row.size):
        own = linear[t] * one[t] + 2.0 * quadratic[t] * by[t]
        row[t] = sign * (own - value[t] * (below[t] * one[t] + 2.0 * below_quadratic[t] * by[t]))


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

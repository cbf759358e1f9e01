"""Networks of struts at the quadrature nodes: dynamic stiffness, and the share of a force law in the deflection.

A row (2, n) holds real and imaginary parts at n frequencies.
"""

from typing import NamedTuple

from ..compiled import compilable
from ..quantities import Bool, Integer, Real
from ..vehicles.networks import DAMPER, INERTER, LAW, MEASURED, PARALLEL, RUBBER, SPRING, Laws

KIND, PART, COEFFICIENT, LAW_OF = 0, 1, 3, 5
"""Columns of a node; a second part and coefficient follow the first."""
OF_RATE, IN_SERIES, NETWORK, POWER = range(4)
"""Columns of a law; the exponent of a power follows its factor."""
STATES = 8
DEVIATION, MEAN, FORCE, SLOPE, CHANGE, BEFORE, STEP, NEXT = range(STATES)
"""Columns of a law's state: standard deviation s and mean of its own deflection or rate; mean force, slope and its
change with ln s; ln s and its step in the last iteration; the deviation that results."""


class Networks(NamedTuple):
    """Networks at n frequencies, with m nodes, q ports, c coefficients, t networks and l force laws.

    Where left and right are alike a network stands for both: its laws have one working point.
    """

    node: Integer  # (m, 6), KIND, two PARTS, two COEFFICIENTS and the law of each node, see `Program`
    ratio: Real  # (m,), installation ratio of each node
    total: Real  # (m,), product of the squared installation ratios of a node and all above
    plain: bool  # whether all nodes are springs, dampers, inerters and laws in parallel
    root: Integer  # (t,), last node of each network
    measured: Real  # (x, 2, n), storage and loss stiffness of measured elements
    laws: Laws
    law: Integer  # (l, 5), OF_RATE, IN_SERIES, NETWORK and two POWERS of each law
    square: Real  # (l,), product of the squared installation ratios above a law, its own too
    setting: Real  # (c,), coefficients of the vehicle
    variable: Integer  # (v,), coefficient of each variable
    gain: Real  # (c, q, q), tensions of each coefficient at 1 by derivatives of its order
    order: Integer  # (c,)
    ports: Bool  # (t, q), where each network stands
    port: Integer  # (t,), the first of these
    compliance: Real  # (q, q), deflections by tensions at 0 Hz around nominal struts [m/N]
    nominal: Real  # (q, q), stiffness of nominal struts [N/m]
    sag: Real  # (q,), deflections by payload on nominal struts [m]


@compilable(error_model="numpy")
def fill_rows(
    node: Integer, ratio: Real, law: Integer, measured: Real, omega: Real, values: Real, state: Real, rows: Real
) -> None:
    """Fill in the dynamic stiffness (m, 2, n) of every node, as its deflection is at the node above it."""
    for i in range(ratio.size):
        kind, square, first, second = node[i, KIND], ratio[i] ** 2, node[i, COEFFICIENT], node[i, COEFFICIENT + 1]
        if kind >= PARALLEL:
            join(kind == PARALLEL, rows[node[i, PART]], rows[node[i, PART + 1]], square, rows[i])
        elif kind == MEASURED:
            scale(square * values[first], measured[second], rows[i])
        elif kind == LAW:
            value, of_rate = square * state[node[i, LAW_OF], SLOPE], law[node[i, LAW_OF], OF_RATE] > 0
            fill_element(0.0 if of_rate else value, value if of_rate else 0.0, 0.0, 0.0, omega, rows[i])
        else:
            value, loss = square * values[first], square * values[second] if kind == RUBBER else 0.0
            stiffness = value if kind in (SPRING, RUBBER) else 0.0
            inertance = value if kind == INERTER else 0.0
            fill_element(stiffness, value if kind == DAMPER else 0.0, inertance, loss, omega, rows[i])


@compilable(fastmath={"contract", "nsz"})
def fill_element(stiffness: float, damping: float, inertance: float, loss: float, omega: Real, row: Real) -> None:
    """Fill in a row (2, n) of one element."""
    re, im = row[0], row[1]
    for i in range(omega.size):
        re[i] = stiffness - inertance * (omega[i] * omega[i])
        im[i] = loss + damping * omega[i]


@compilable(fastmath={"contract", "nsz"})
def scale(factor: float, given: Real, row: Real) -> None:
    """Fill in a row (2, n) times a factor."""
    re, im, real, imaginary = row[0], row[1], given[0], given[1]
    for i in range(re.size):
        re[i], im[i] = factor * real[i], factor * imaginary[i]


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def join(parallel: bool, one: Real, other: Real, square: float, row: Real) -> None:
    """Fill in the sum of two rows (2, n), or in series a b/(a + b), times the square of an installation ratio."""
    a, b, c, d, re, im = one[0], one[1], other[0], other[1], row[0], row[1]
    if parallel:
        for i in range(re.size):
            re[i] = square * (a[i] + c[i])
            im[i] = square * (b[i] + d[i])
        return
    for i in range(re.size):
        real, imaginary = a[i] + c[i], b[i] + d[i]
        scale = square / (real * real + imaginary * imaginary)
        upper, across = a[i] * c[i] - b[i] * d[i], a[i] * d[i] + b[i] * c[i]
        re[i] = scale * (upper * real + across * imaginary)
        im[i] = scale * (across * real - upper * imaginary)


@compilable(error_model="numpy")
def fill_share(node: Integer, ratio: Real, law: int, rows: Real, share: Real) -> None:
    """Fill in |own deflection over deflection of the port|^2 (n,) of a law, by the rows of all nodes."""
    own = -1
    for i in range(ratio.size):
        one, other, square = node[i, PART], node[i, PART + 1], ratio[i] ** 2
        if node[i, LAW_OF] == law:
            own = i
            share[:] = square
        elif own >= 0 and own in (one, other):
            if node[i, KIND] == PARALLEL:
                for j in range(share.size):
                    share[j] *= square
            else:
                split(rows[own], rows[other if own == one else one], square, share)
            own = i


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def split(own: Real, other: Real, square: float, share: Real) -> None:
    """Multiply a share (n,) by that of one of two parts in series, of dynamic stiffness `own` and `other`."""
    a, b, c, d = own[0], own[1], other[0], other[1]
    for i in range(share.size):
        real, imaginary = a[i] + c[i], b[i] + d[i]
        share[i] *= square * (c[i] * c[i] + d[i] * d[i]) / (real * real + imaginary * imaginary)

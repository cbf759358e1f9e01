"""Networks of struts at the quadrature nodes: dynamic stiffness, and the share of a force law in the deflection.

The dynamic stiffness of a node is that of its direct elements, which are in parallel with one another, plus a row
(2, n) of real and imaginary parts at n frequencies: of its elements in series, and of those known by a table.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable
from ..quantities import Bool, Integer, Real
from ..vehicles.networks import INERTER, LAW, MEASURED, PARALLEL, RUBBER, Laws

KIND, PART, COEFFICIENT, LAW_OF = 0, 1, 3, 5
"""Columns of a node; a second part and coefficient follow the first."""
DIRECT = 4
STIFFNESS, DAMPING, INERTANCE, LOSS = range(DIRECT)
"""Columns of the direct elements of a node; the first three are SPRING, DAMPER and INERTER of `Program`."""
OF_RATE, IN_SERIES, NETWORK, POWER = range(4)
"""Columns of a law; the exponent of a power follows its factor."""
STATES = 8
DEVIATION, MEAN, FORCE, SLOPE, CHANGE, TAKEN, STEP, NEXT = range(STATES)
"""Columns of a law's state: standard deviation s and mean of its own deflection or rate; mean force, slope and its
change with ln s; the change of ln s and its step in the last iteration; the deviation that results."""


class Networks(NamedTuple):
    """Networks at n frequencies, with m nodes, q ports, c coefficients, t networks and l force laws.

    Where left and right are alike a network stands for both: its laws have one working point.
    """

    node: Integer  # (m, 6), KIND, two PARTS, two COEFFICIENTS and the law of each node, see `Program`
    ratio: Real  # (m,), installation ratio of each node
    row: Integer  # (m,), row of each node, 0 of a node with direct elements alone
    root: Integer  # (t,), last node of each network
    measured: Real  # (x, 2, n), storage and loss stiffness of measured elements
    laws: Laws
    law: Integer  # (l, 5), OF_RATE, IN_SERIES, NETWORK and two POWERS of each law
    square: Real  # (l,), product of the squared installation ratios above a law, its own too
    setting: Real  # (c,), coefficients of the vehicle
    variable: Integer  # (v,), coefficient of each variable
    gain: Real  # (c, q, q), tensions of each coefficient at 1 by derivatives of its order
    order: Integer  # (c,)
    weight: Real  # (c,), mean tension by a coefficient at 1 at its ports, of masses of payload [N]
    ports: Bool  # (t, q), where each network stands
    port: Integer  # (t,), the first of these
    compliance: Real  # (q, q), deflections by tensions at 0 Hz around nominal struts [m/N]
    nominal: Real  # (q, q), stiffness of nominal struts [N/m]
    sag: Real  # (q,), deflections by payload on nominal struts [m]
    same_damping: bool  # whether no variable changes a curve, a damper or a part of a network


# Loops in place of reductions and copies of numpy, which take long to compile.
@compilable()
def setting_of(networks: Networks) -> Real:
    """Return a copy of the coefficients (c,) of the vehicle."""
    values = np.empty(networks.setting.size)
    for i in range(values.size):
        values[i] = networks.setting[i]
    return values


@compilable()
def rows_of(networks: Networks, n: int) -> Real:
    """Return rows (1 + x, 2, n) of zeros for all nodes."""
    most = 0
    for i in range(networks.row.size):
        most = max(most, networks.row[i])
    return np.zeros((1 + most, 2, n))


@compilable()
def moves(networks: Networks) -> bool:
    """Whether a law depends on the mean deflection."""
    found = 0
    for i in range(networks.law.shape[0]):
        found += networks.law[i, OF_RATE] == 0
    return found > 0


@compilable(error_model="numpy", forceinline=True)
def fill_direct(networks: Networks, values: Real, state: Real, direct: Real) -> None:
    """Fill in the direct elements (m, 4) of every node, as its deflection is at the node above it."""
    node, ratio, law = networks.node, networks.ratio, networks.law
    for i in range(ratio.size):
        kind, square = node[i, KIND], ratio[i] * ratio[i]
        for j in range(DIRECT):
            direct[i, j] = 0.0
            if kind == PARALLEL:
                direct[i, j] = square * (direct[node[i, PART], j] + direct[node[i, PART + 1], j])
        if kind == LAW:
            which = node[i, LAW_OF]
            direct[i, DAMPING if law[which, OF_RATE] else STIFFNESS] = square * state[which, SLOPE]
        elif kind == RUBBER:
            direct[i, STIFFNESS] = square * values[node[i, COEFFICIENT]]
            direct[i, LOSS] = square * values[node[i, COEFFICIENT + 1]]
        elif kind <= INERTER:
            direct[i, kind] = square * values[node[i, COEFFICIENT]]


@compilable(error_model="numpy", forceinline=True)
def fill_rows(networks: Networks, omega: Real, values: Real, direct: Real, rows: Real) -> None:
    """Fill in the rows (1 + x, 2, n) of all nodes by their direct elements; the first is 0."""
    for i in range(networks.row.size):
        fill_row(networks, omega, values, direct, i, rows)


@compilable(error_model="numpy", forceinline=True)
def fill_row(networks: Networks, omega: Real, values: Real, direct: Real, i: int, rows: Real) -> None:
    """Fill in the row of a node, if it has one, by those of its parts."""
    node, ratio, row, measured = networks.node, networks.ratio, networks.row, networks.measured
    kind, square, one, other = node[i, KIND], ratio[i] * ratio[i], node[i, PART], node[i, PART + 1]
    if row[i] > 0 and kind == MEASURED:
        scale(square * values[node[i, COEFFICIENT]], measured[node[i, COEFFICIENT + 1]], rows[row[i]])
    elif row[i] > 0 and kind == PARALLEL:
        add(square, rows[row[one]], rows[row[other]], rows[row[i]])
    elif row[i] > 0:
        join(square, omega, direct, one, other, rows[row[one]], rows[row[other]], rows[row[i]])


@compilable(fastmath={"contract", "nsz"})
def scale(factor: float, given: Real, row: Real) -> None:
    """Fill in a row (2, n) times a factor."""
    for i in range(row.shape[1]):
        row[0, i], row[1, i] = factor * given[0, i], factor * given[1, i]


@compilable(fastmath={"contract", "nsz"})
def add(factor: float, one: Real, other: Real, row: Real) -> None:
    """Fill in the sum of two rows (2, n) times a factor."""
    for i in range(row.shape[1]):
        row[0, i], row[1, i] = factor * (one[0, i] + other[0, i]), factor * (one[1, i] + other[1, i])


@compilable(inline="always")
def elements(direct: Real, node: int) -> tuple[float, float, float, float]:
    """Return the direct elements of a node."""
    return direct[node, STIFFNESS], direct[node, DAMPING], direct[node, INERTANCE], direct[node, LOSS]


@compilable(inline="always")
def stiffness_at(elements: tuple[float, float, float, float], w: float, row: Real, i: int) -> tuple[float, float]:
    """Return real and imaginary part of a dynamic stiffness at a frequency w, the i-th."""
    k, c, b, h = elements
    return k - b * (w * w) + row[0, i], h + c * w + row[1, i]


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def join(
    square: float, omega: Real, direct: Real, one: int, other: int, upper: Real, lower: Real, row: Real
) -> None:
    """Fill in a b/(a + b) of two nodes in series with rows (2, n), times the square of an installation ratio."""
    first, second = elements(direct, one), elements(direct, other)
    for i in range(omega.size):
        a, b = stiffness_at(first, omega[i], upper, i)
        c, d = stiffness_at(second, omega[i], lower, i)
        real, imaginary, re, im = a + c, b + d, a * c - b * d, a * d + b * c
        factor = square / (real * real + imaginary * imaginary)
        row[0, i], row[1, i] = factor * (re * real + im * imaginary), factor * (im * real - re * imaginary)


@compilable()
def fill(row: Real, value: float) -> None:
    """Fill in a value throughout (n,)."""
    for i in range(row.size):
        row[i] = value


@compilable(error_model="numpy")
def fill_share(networks: Networks, omega: Real, law: int, direct: Real, rows: Real, share: Real) -> None:
    """Fill in |own deflection over deflection of the port|^2 (n,) of a law in series."""
    node, ratio, row, own = networks.node, networks.ratio, networks.row, -1
    fill(share, networks.square[law])
    for i in range(ratio.size):
        one, other = node[i, PART], node[i, PART + 1]
        if node[i, LAW_OF] == law:
            own = i
        elif own >= 0 and own in (one, other):
            if node[i, KIND] != PARALLEL:
                beside = other if own == one else one
                split(omega, direct, own, beside, rows[row[own]], rows[row[beside]], share)
            own = i


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def split(omega: Real, direct: Real, own: int, other: int, upper: Real, lower: Real, share: Real) -> None:
    """Multiply a share (n,) by that of one of two nodes in series with rows (2, n)."""
    first, second = elements(direct, own), elements(direct, other)
    for i in range(omega.size):
        a, b = stiffness_at(first, omega[i], upper, i)
        c, d = stiffness_at(second, omega[i], lower, i)
        real, imaginary = a + c, b + d
        share[i] *= (c * c + d * d) / (real * real + imaginary * imaginary)

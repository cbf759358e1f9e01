"""Adjoint of networks: from a change of a network's dynamic stiffness to changes of its coefficients and laws.

A real output changes by Re(m dD) with the stiffness D of a node, summed over frequencies: m is the node's
adjoint, a row (2, n). Below a node of installation ratio r it is r^2 m for parts in parallel, and r^2 (b/(a +
b))^2 m for a part a in series with b. What direct elements need of it are four moments.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Integer, Real
from ...vehicles.networks import INERTER, LAW, MEASURED, PARALLEL, RUBBER, SERIES
from ..loop_rows import add_product
from ..network_rows import (
    COEFFICIENT,
    DAMPING,
    DIRECT,
    INERTANCE,
    KIND,
    LAW_OF,
    LOSS,
    OF_RATE,
    PART,
    STIFFNESS,
    Networks,
    elements,
    stiffness_at,
)
from .joints import Joints, joints_of


class Adjoint(NamedTuple):
    """Work arrays of one output at a time, over m nodes, c coefficients and l laws."""

    joints: Joints  # of a design
    place: Integer  # (m,), row of the adjoint of a node, 0 of a node below direct elements alone
    rows: Real  # (1 + x, 2, n), the first for any use
    moment: Real  # (m, 4), derivatives by the direct elements of a node
    by_value: Real  # (c,), derivatives by coefficients
    by_slope: Real  # (l,), and by the slopes of laws


@compilable()
def adjoint_of(networks: Networks, n: int, roots: bool) -> Adjoint:
    """Return work arrays at n frequencies, with a row for every root or for those with parts in series alone."""
    nodes, last = networks.row.size, 0
    place = np.empty(nodes, dtype=np.int64)
    for i in range(nodes):
        place[i] = networks.row[i]
        last = max(last, place[i])
    for t in range(networks.root.size if roots else 0):
        if place[networks.root[t]] == 0:
            last += 1
            place[networks.root[t]] = last
    rows, moment = np.empty((1 + last, 2, n)), np.empty((nodes, DIRECT))
    by_value, by_slope = np.empty(networks.setting.size), np.empty(networks.law.shape[0])
    return Adjoint(joints_of(networks, n), place, rows, moment, by_value, by_slope)


@uncounted(forceinline=True)
def clear(adjoint: Adjoint) -> None:
    """Begin with another output."""
    for i in range(adjoint.rows.shape[0]):
        for t in range(adjoint.rows.shape[2]):
            adjoint.rows[i, 0, t] = adjoint.rows[i, 1, t] = 0.0
    for i in range(adjoint.moment.shape[0]):
        for j in range(DIRECT):
            adjoint.moment[i, j] = 0.0
    for i in range(adjoint.by_value.size):
        adjoint.by_value[i] = 0.0
    for i in range(adjoint.by_slope.size):
        adjoint.by_slope[i] = 0.0


@uncounted(error_model="numpy", forceinline=True)
def pull(networks: Networks, omega: Real, adjoint: Adjoint) -> None:
    """Carry the adjoints of the roots down to all nodes, and add up derivatives by coefficients and slopes."""
    node, ratio, place = networks.node, networks.ratio, adjoint.place
    for i in range(ratio.size - 1, -1, -1):
        kind, square, one, other = node[i, KIND], ratio[i] * ratio[i], node[i, PART], node[i, PART + 1]
        if kind == SERIES:
            for j in range(2):
                if adjoint.joints.needed[node[i, PART + j]]:
                    pull_part(omega, i, node[i, PART + j], adjoint)
        elif kind == MEASURED:
            own = networks.measured[node[i, COEFFICIENT + 1]]
            adjoint.by_value[node[i, COEFFICIENT]] += square * real_product(adjoint.rows[place[i]], own)
        else:
            if place[i] > 0:
                add_moments(adjoint.rows[place[i]], omega, adjoint.moment[i])
            if kind == PARALLEL:
                pull_beside(square, i, one, adjoint)
                pull_beside(square, i, other, adjoint)
            else:
                pull_leaf(networks, square, i, adjoint)


@uncounted()
def pull_leaf(networks: Networks, square: float, i: int, adjoint: Adjoint) -> None:
    """Add derivatives by the coefficients or the slope of a direct element."""
    node, moment = networks.node[i], adjoint.moment[i]
    if node[KIND] == LAW:
        of_rate = networks.law[node[LAW_OF], OF_RATE]
        adjoint.by_slope[node[LAW_OF]] += square * moment[DAMPING if of_rate else STIFFNESS]
    elif node[KIND] == RUBBER:
        adjoint.by_value[node[COEFFICIENT]] += square * moment[STIFFNESS]
        adjoint.by_value[node[COEFFICIENT + 1]] += square * moment[LOSS]
    elif node[KIND] <= INERTER:
        adjoint.by_value[node[COEFFICIENT]] += square * moment[node[KIND]]


@uncounted()
def pull_beside(square: float, i: int, part: int, adjoint: Adjoint) -> None:
    """Hand the adjoint of a node on to one of its parts in parallel."""
    if adjoint.place[part] > 0:
        own, above = adjoint.rows[adjoint.place[part]], adjoint.rows[adjoint.place[i]]
        for t in range(own.shape[1]):
            own[0, t] += square * above[0, t]
            own[1, t] += square * above[1, t]
    else:
        for j in range(DIRECT):
            adjoint.moment[part, j] += square * adjoint.moment[i, j]


@uncounted()
def pull_part(omega: Real, i: int, part: int, adjoint: Adjoint) -> None:
    """Hand the adjoint of a node on to one of its parts in series."""
    joints = adjoint.joints
    above, joint = adjoint.rows[adjoint.place[i]], joints.rows[joints.row[part]]
    if adjoint.place[part] > 0:
        add_product(1.0, above, joint, adjoint.rows[adjoint.place[part]])
    else:
        add_product_moments(above, joint, omega, adjoint.moment[part])


@compilable(fastmath={"reassoc", "contract", "nsz"})
def add_moments(row: Real, omega: Real, moment: Real) -> None:
    """Add derivatives (4,) by stiffness, damping, inertance and loss of a node with an adjoint (2, n)."""
    re, im = row[0], row[1]
    stiffness, damping, inertance, loss = 0.0, 0.0, 0.0, 0.0
    for t in range(omega.size):
        w = omega[t]
        stiffness += re[t]
        damping -= w * im[t]
        inertance -= w * w * re[t]
        loss -= im[t]
    moment[STIFFNESS] += stiffness
    moment[DAMPING] += damping
    moment[INERTANCE] += inertance
    moment[LOSS] += loss


@compilable(fastmath={"reassoc", "contract", "nsz"})
def add_product_moments(left: Real, right: Real, omega: Real, moment: Real) -> None:
    """Add the derivatives (4,) of a node whose adjoint is the product of two rows (2, n)."""
    a, b, x, y = left[0], left[1], right[0], right[1]
    stiffness, damping, inertance, loss = 0.0, 0.0, 0.0, 0.0
    for t in range(omega.size):
        w, re, im = omega[t], a[t] * x[t] - b[t] * y[t], a[t] * y[t] + b[t] * x[t]
        stiffness += re
        damping -= w * im
        inertance -= w * w * re
        loss -= im
    moment[STIFFNESS] += stiffness
    moment[DAMPING] += damping
    moment[INERTANCE] += inertance
    moment[LOSS] += loss


@compilable(fastmath={"reassoc", "contract", "nsz"})
def real_product(left: Real, right: Real) -> float:
    """Return the real part of the sum of the product of two complex rows (2, n)."""
    total = 0.0
    for t in range(left.shape[1]):
        total += left[0, t] * right[0, t] - left[1, t] * right[1, t]
    return total


@uncounted(error_model="numpy")
def pull_share(
    networks: Networks, omega: Real, law: int, direct: Real, rows: Real, density: Real, adjoint: Adjoint
) -> None:
    """Add the adjoints of nodes in the mean square of a law, of density (n,), by its share of the deflection."""
    node, row, own = networks.node, networks.row, -1
    for i in range(networks.ratio.size):
        one, other = node[i, PART], node[i, PART + 1]
        if node[i, LAW_OF] == law:
            own = i
        elif own >= 0 and own in (one, other):
            if node[i, KIND] != PARALLEL:
                beside = other if own == one else one
                for part in (own, beside):
                    target = adjoint.rows[adjoint.place[part]]
                    if adjoint.place[part] == 0:
                        for t in range(omega.size):
                            target[0, t] = target[1, t] = 0.0
                    upper, lower = rows[row[own]], rows[row[beside]]
                    add_of_share(omega, direct, own, beside, upper, lower, density, part == own, target)
                    if adjoint.place[part] == 0:
                        add_moments(target, omega, adjoint.moment[part])
            own = i


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def add_of_share(
    omega: Real,
    direct: Real,
    own: int,
    other: int,
    upper: Real,
    lower: Real,
    density: Real,
    of_own: bool,
    target: Real,
) -> None:
    """Add the adjoint of a in |b/(a + b)|^2 times a density (n,), -2/(a + b), or that of b, 2 a/(b (a + b))."""
    first, second = elements(direct, own), elements(direct, other)
    for t in range(omega.size):
        a, b = stiffness_at(first, omega[t], upper, t)
        c, d = stiffness_at(second, omega[t], lower, t)
        x, y = a + c, b + d
        size, both = x * x + y * y, c * c + d * d
        re, im = x / size, -y / size
        if of_own:
            factor = -2.0 * density[t]
        else:
            factor = 2.0 * density[t] / both if both > 0.0 else 0.0
            p, q = a * c + b * d, b * c - a * d  # a times the conjugate of b
            re, im = re * p - im * q, re * q + im * p
        target[0, t] += factor * re
        target[1, t] += factor * im

"""Derivatives of the mean deflections of laws: the static equilibrium of `mean_position`, differentiated.

A coefficient, or the logarithm of a law's deviation, changes the tension of elements at their deflections.
Parts in series yield to a change by their compliances; then the ports yield, and the laws take part in that.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Real
from ...vehicles.networks import LAW, MEASURED, PARALLEL, RUBBER, SPRING
from ..mean_position import POSITION, STIFFNESS, fill_stiffening
from ..network_rows import COEFFICIENT, KIND, LAW_OF, OF_RATE, PART, Networks
from .laws import LawSlopes


class Yielding(NamedTuple):
    """Work arrays of q ports and m nodes, in r directions: by a coefficient or the logarithm of a deviation."""

    stiffening: Real  # (q, q)
    loop: Real  # (q, q)
    deflection: Real  # (q, r)
    tension: Real  # (r, m), changes at the deflections of nodes
    given: Real  # (m,), changes of deflections
    force: Real  # (q,)


@compilable()
def yielding_of(networks: Networks) -> Yielding:
    """Return work arrays."""
    q, m, r = networks.sag.size, networks.row.size, networks.setting.size + networks.law.shape[0]
    return Yielding(
        np.empty((q, q)), np.empty((q, q)), np.empty((q, r)), np.empty((r, m)), np.empty(m), np.empty(q)
    )


@uncounted(error_model="numpy")
def fill_mean_slopes(
    networks: Networks,
    values: Real,
    nodes: Real,
    position: Real,
    slopes: LawSlopes,
    yielding: Yielding,
    means: Real,
) -> None:
    """Fill in derivatives (l, r) of the means of laws."""
    stiffening, loop, deflection, tension, given, force = yielding
    fill_stiffening(networks, values, nodes, stiffening)
    for i in range(force.size):
        for j in range(force.size):
            loop[i, j] = 1.0 if i == j else 0.0
            for k in range(force.size):
                loop[i, j] -= networks.compliance[i, k] * stiffening[k, j]
    for direction in range(means.shape[1]):
        fill_tensions(networks, nodes, slopes, direction, tension[direction])
        fill_forces(networks, position, direction, tension[direction], force)
        for i in range(force.size):
            deflection[i, direction] = 0.0
            for j in range(force.size):
                deflection[i, direction] += networks.compliance[i, j] * force[j]
    solve(loop, deflection)
    for direction in range(means.shape[1]):
        for t in range(networks.root.size):
            given[networks.root[t]] = deflection[networks.port[t], direction]
        hand_down(networks, nodes, tension[direction], given, means[:, direction])


@uncounted(error_model="numpy")
def fill_tensions(networks: Networks, nodes: Real, slopes: LawSlopes, direction: int, tension: Real) -> None:
    """Fill in the changes of tension (m,) of every node at its deflection, as seen by the node above."""
    node, coefficients = networks.node, slopes.force_by_value.shape[1]
    for i in range(networks.ratio.size):
        kind, ratio, one, other = node[i, KIND], networks.ratio[i], node[i, PART], node[i, PART + 1]
        own, which = 0.0, node[i, LAW_OF]
        if kind == PARALLEL:
            own = tension[one] + tension[other]
        elif kind > PARALLEL:
            upper, lower = nodes[one, STIFFNESS], nodes[other, STIFFNESS]
            if upper + lower > 0.0:
                own = (tension[one] * lower + tension[other] * upper) / (upper + lower)
        elif kind == LAW and direction < coefficients:
            own = slopes.force_by_value[which, direction]
        elif kind == LAW and direction - coefficients == which:
            own = slopes.force_by_deviation[which]
        elif kind in (SPRING, RUBBER, MEASURED) and direction == node[i, COEFFICIENT]:
            own = ratio * nodes[i, POSITION]
            own *= networks.measured[node[i, COEFFICIENT + 1], 0, 0] if kind == MEASURED else 1.0
        tension[i] = ratio * own


@uncounted()
def fill_forces(networks: Networks, position: Real, direction: int, tension: Real, force: Real) -> None:
    """Fill in the changes of tension (q,) of the struts at their mean deflections."""
    for j in range(force.size):
        force[j] = 0.0
    if direction < networks.order.size:
        straight = networks.order[direction] == 0
        for j in range(force.size):
            force[j] += 0.0 if straight else networks.weight[direction] * networks.gain[direction, j, j]
            for k in range(force.size if straight else 0):
                force[j] += networks.gain[direction, j, k] * position[k]
    for t in range(networks.root.size):
        for j in range(force.size):
            if networks.ports[t, j]:
                force[j] += tension[networks.root[t]]


@uncounted(error_model="numpy")
def hand_down(networks: Networks, nodes: Real, tension: Real, given: Real, means: Real) -> None:
    """Fill in what the means of laws (l,) take of the changes given to the roots; works in those of nodes (m,)."""
    node, ratio = networks.node, networks.ratio
    for i in range(ratio.size - 1, -1, -1):
        kind, own, which = node[i, KIND], ratio[i] * given[i], node[i, LAW_OF]
        one, other = node[i, PART], node[i, PART + 1]
        if kind == PARALLEL:
            given[one] = given[other] = own
        elif kind > PARALLEL:
            stiff, soft = (one, other) if nodes[one, STIFFNESS] > nodes[other, STIFFNESS] else (other, one)
            given[stiff] = given[soft] = own
            if nodes[stiff, STIFFNESS] > 0.0:
                force = tension[i] / ratio[i] + nodes[i, STIFFNESS] / ratio[i] ** 2 * own
                given[stiff] = (force - tension[stiff]) / nodes[stiff, STIFFNESS]
                given[soft] = own - given[stiff]
        elif kind == LAW:
            means[which] = 0.0 if networks.law[which, OF_RATE] else own


@uncounted(error_model="numpy")
def solve(matrix: Real, right: Real) -> None:
    """Replace right-hand sides (n, r) by the solutions of linear equations (n, n), by pivots in columns."""
    n = matrix.shape[0]
    for c in range(n):
        best = c
        for i in range(c + 1, n):
            best = i if abs(matrix[i, c]) > abs(matrix[best, c]) else best
        for j in range(n):
            matrix[c, j], matrix[best, j] = matrix[best, j], matrix[c, j]
        for j in range(right.shape[1]):
            right[c, j], right[best, j] = right[best, j], right[c, j]
        for i in range(n):
            factor = matrix[i, c] / matrix[c, c] if i != c else 0.0
            for j in range(c, n):
                matrix[i, j] -= factor * matrix[c, j]
            for j in range(right.shape[1]):
                right[i, j] -= factor * right[c, j]
    for c in range(n):
        for j in range(right.shape[1]):
            right[c, j] /= matrix[c, c]

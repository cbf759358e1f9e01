"""Mean positions of struts: static equilibrium with the mean forces of force laws, and with payload."""

import numpy as np

from ..compiled import compilable
from ..quantities import Real
from ..vehicles.networks import INERTER, LAW, MEASURED, PARALLEL, RUBBER, SPRING
from .network_rows import COEFFICIENT, DEVIATION, FORCE, KIND, LAW_OF, MEAN, OF_RATE, PART, SLOPE, Networks
from .working_point import linearise

AT_ZERO, STIFFNESS, POSITION = range(3)
"""Columns of a node at 0 Hz: force at deflection 0, stiffness, mean deflection."""


_MOST, _QUICK, _NEAR = 100, 10, 1e-10  # steps, steps before shorter ones, change of a mean by the deviation
_ODD = 1e-6  # N, mean force up to which a law is odd


@compilable(error_model="numpy")
def balance(
    networks: Networks, curve: Real, values: Real, state: Real, nodes: Real, position: Real, work: Real
) -> None:
    """Linearise the laws at the means of static equilibrium, by Newton's steps at these deviations.

    Works in the state (m, 3) of nodes at 0 Hz and in equations (3, q, q).
    """
    for step in range(_MOST):
        linearise(networks.law, networks.laws.most, curve, values, state)
        error = place(networks, values, state, nodes, position, work, 1.0 if step < _QUICK else 0.3)
        if not error >= _NEAR:  # or NaN
            break


@compilable(error_model="numpy")
def place(
    networks: Networks, values: Real, state: Real, nodes: Real, position: Real, work: Real, share: float
) -> float:
    """Fill in mean deflections of ports (q,); return the largest change of a law's by its deviation.

    A law takes a share of its change.
    """
    fill_static(networks, values, state, nodes)
    fill_positions(networks, values, nodes, position, work)
    node, ratio, law, error = networks.node, networks.ratio, networks.law, 0.0
    for t in range(networks.root.size):
        nodes[networks.root[t], POSITION] = position[networks.port[t]]
    for i in range(ratio.size - 1, -1, -1):
        own = ratio[i] * nodes[i, POSITION]
        if node[i, KIND] >= PARALLEL:
            one, other = node[i, PART], node[i, PART + 1]
            nodes[one, POSITION] = nodes[other, POSITION] = own
            if node[i, KIND] != PARALLEL:
                divide_in_series(nodes, ratio[i], i, one, other)
        elif node[i, KIND] == LAW and not law[node[i, LAW_OF], OF_RATE]:
            which = node[i, LAW_OF]
            error = max(error, abs(own - state[which, MEAN]) / state[which, DEVIATION])
            state[which, MEAN] += share * (own - state[which, MEAN])
    return error


@compilable(error_model="numpy")
def divide_in_series(nodes: Real, ratio: float, whole: int, one: int, other: int) -> None:
    """Divide the mean deflection of two parts in series, by the force in the stiffer one."""
    own = ratio * nodes[whole, POSITION]
    stiff, soft = (one, other) if nodes[one, STIFFNESS] > nodes[other, STIFFNESS] else (other, one)
    if nodes[stiff, STIFFNESS] > 0.0:
        force = nodes[whole, AT_ZERO] / ratio + nodes[whole, STIFFNESS] / ratio**2 * own
        nodes[stiff, POSITION] = (force - nodes[stiff, AT_ZERO]) / nodes[stiff, STIFFNESS]
        nodes[soft, POSITION] = own - nodes[stiff, POSITION]


@compilable(error_model="numpy")
def fill_static(networks: Networks, values: Real, state: Real, nodes: Real) -> None:
    """Fill in force at deflection 0 and stiffness of every node at 0 Hz, as seen by the node above."""
    node, law = networks.node, networks.law
    for i in range(networks.ratio.size):
        kind, ratio, force, stiffness = node[i, KIND], networks.ratio[i], 0.0, 0.0
        if kind >= PARALLEL:
            one, other = node[i, PART], node[i, PART + 1]
            upper, lower = nodes[one, STIFFNESS], nodes[other, STIFFNESS]
            force, stiffness = nodes[one, AT_ZERO] + nodes[other, AT_ZERO], upper + lower
            if kind != PARALLEL and stiffness > 0.0:
                force = (nodes[one, AT_ZERO] * lower + nodes[other, AT_ZERO] * upper) / stiffness
                stiffness = upper * lower / stiffness
            elif kind != PARALLEL:  # nothing holds the end between: beside an inerter the mean force is 0
                inert = node[one, KIND] == INERTER or node[other, KIND] == INERTER
                force = 0.0 if inert or abs(force) < _ODD else np.nan
        elif kind == LAW:
            which = node[i, LAW_OF]
            force = state[which, FORCE]
            if not law[which, OF_RATE]:
                stiffness = state[which, SLOPE]
                force -= stiffness * state[which, MEAN]
        elif kind in (SPRING, RUBBER, MEASURED):
            stiffness = values[node[i, COEFFICIENT]]
            stiffness *= networks.measured[node[i, COEFFICIENT + 1], 0, 0] if kind == MEASURED else 1.0
        nodes[i, AT_ZERO], nodes[i, STIFFNESS] = ratio * force, ratio * ratio * stiffness


@compilable(error_model="numpy")
def fill_positions(networks: Networks, values: Real, nodes: Real, d: Real, work: Real) -> None:
    """Fill in the mean deflections: d = sag + C (F(d) - K0 d), with forces straight about the last point.

    The equations (1 - C (K - K0)) d = sag + C F(0) are near the identity and need no pivoting.
    """
    q, c = networks.sag.size, networks.compliance
    change, matrix, force = work[0], work[1], work[2, 0]
    fill_stiffening(networks, values, nodes, change)
    for i in range(q):
        force[i] = 0.0
        for j in range(q):
            matrix[i, j] = 1.0 if i == j else 0.0
    for i in range(values.size):
        if networks.order[i] != 0 and networks.weight[i] != 0.0:
            for j in range(q):
                force[j] += networks.weight[i] * values[i] * networks.gain[i, j, j]
    for t in range(networks.ports.shape[0]):
        for j in range(q):
            if networks.ports[t, j]:
                force[j] += nodes[networks.root[t], AT_ZERO]
    for i in range(q):
        d[i] = networks.sag[i]
        for j in range(q):
            d[i] += c[i, j] * force[j]
            for k in range(q):
                matrix[i, k] -= c[i, j] * change[j, k]
    for p in range(q):
        for i in range(q):
            if i != p:
                factor = matrix[i, p] / matrix[p, p]
                d[i] -= factor * d[p]
                for j in range(p, q):
                    matrix[i, j] -= factor * matrix[p, j]
    for p in range(q):
        d[p] /= matrix[p, p]


@compilable()
def fill_stiffening(networks: Networks, values: Real, nodes: Real, change: Real) -> None:
    """Fill in K - K0 (q, q), the stiffness of the struts about the last point less that of nominal ones."""
    q = networks.sag.size
    for i in range(q):
        for j in range(q):
            change[i, j] = -networks.nominal[i, j]
    for i in range(values.size):
        if networks.order[i] == 0:
            for j in range(q):
                for k in range(q):
                    change[j, k] += values[i] * networks.gain[i, j, k]
    for t in range(networks.ports.shape[0]):
        for j in range(q):
            if networks.ports[t, j]:
                change[j, j] += nodes[networks.root[t], STIFFNESS]

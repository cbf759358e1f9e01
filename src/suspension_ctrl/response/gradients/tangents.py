"""Derivatives of the dynamic stiffness of one network by each variable, at all frequencies."""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Integer, Real
from ...vehicles.networks import INERTER, LAW, MEASURED, PARALLEL, RUBBER, SERIES
from ..loop_rows import multiply
from ..network_rows import (
    COEFFICIENT,
    DAMPING,
    INERTANCE,
    KIND,
    LOSS,
    PART,
    STIFFNESS,
    Networks,
    add,
    scale,
)
from .joints import Joints


class Tangents(NamedTuple):
    """Work arrays of a network with m nodes and v variables at n frequencies."""

    above: Integer  # (m,), node of which each is a part, -1 of the last
    rows: Real  # (v, 2, n), derivatives of the dynamic stiffness by the variables
    own: Real  # (2, n), by one coefficient of one element


@compilable()
def tangents_of(networks: Networks, n: int) -> Tangents:
    """Return work arrays at n frequencies."""
    above = np.empty(networks.row.size, dtype=np.int64)
    for i in range(above.size):
        above[i] = -1
        for j in range(2 if networks.node[i, KIND] >= PARALLEL else 0):
            above[networks.node[i, PART + j]] = i
    return Tangents(above, np.empty((networks.variable.size, 2, n)), np.empty((2, n)))


@uncounted(error_model="numpy", forceinline=True)
def fill_tangents(networks: Networks, omega: Real, joints: Joints, tangents: Tangents) -> None:
    """Fill in the derivatives by all variables, with filled joints and without force laws."""
    node = networks.node
    for v in range(networks.variable.size):
        c, row, found = networks.variable[v], tangents.rows[v], False
        if networks.gain[c, 0, 0] != 0.0:
            fill_element(networks.gain[c, 0, 0], networks.order[c], omega, row)  # beside the network
            found = True
        for i in range(networks.ratio.size):
            for j in range(2 if node[i, KIND] == RUBBER else 1 if node[i, KIND] < LAW else 0):
                if node[i, COEFFICIENT + j] == c:
                    own = tangents.own if found else row
                    climb(networks, omega, joints, tangents.above, i, j, own)
                    if found:
                        add(1.0, row, own, row)
                    found = True
        if not found:  # of a payload
            fill_element(0.0, STIFFNESS, omega, row)


@uncounted(error_model="numpy", forceinline=True)
def climb(
    networks: Networks, omega: Real, joints: Joints, above: Integer, leaf: int, part: int, own: Real
) -> None:
    """Fill in the derivative (2, n) of the last node by the first or second coefficient of an element."""
    node, ratio, kind, i = networks.node, networks.ratio, networks.node[leaf, KIND], leaf
    square, filled = ratio[leaf] * ratio[leaf], kind == MEASURED
    order = kind if kind <= INERTER else LOSS if part == 1 else STIFFNESS
    if filled:
        scale(1.0, networks.measured[node[leaf, COEFFICIENT + 1]], own)
    while above[i] >= 0:
        i, below = above[i], i
        if node[i, KIND] != SERIES:
            square *= ratio[i] * ratio[i]
        elif filled:
            multiply(joints.rows[joints.row[below]], own)
        else:
            fill_joined(order, omega, joints.rows[joints.row[below]], own)
            filled = True
    if not filled:
        fill_element(square, order, omega, own)
    elif square != 1.0:
        scale(square, own, own)


@compilable(inline="always")
def element_of(order: int) -> tuple[float, float, float, float]:
    """Return direct elements of which one is 1."""
    return (
        1.0 if order == STIFFNESS else 0.0,
        1.0 if order == DAMPING else 0.0,
        1.0 if order == INERTANCE else 0.0,
        1.0 if order == LOSS else 0.0,
    )


@compilable(fastmath={"contract", "nsz"})
def fill_element(value: float, order: int, omega: Real, row: Real) -> None:
    """Fill in the dynamic stiffness (2, n) of a direct element of some order and value."""
    k, c, b, h = element_of(order)
    for t in range(omega.size):
        w = omega[t]
        row[0, t], row[1, t] = value * (k - b * (w * w)), value * (h + c * w)


@compilable(fastmath={"contract", "nsz"})
def fill_joined(order: int, omega: Real, joint: Real, row: Real) -> None:
    """Fill in the dynamic stiffness (2, n) of a direct element of 1 times a joint."""
    k, c, b, h = element_of(order)
    for t in range(omega.size):
        w = omega[t]
        re, im = k - b * (w * w), h + c * w
        row[0, t], row[1, t] = re * joint[0, t] - im * joint[1, t], re * joint[1, t] + im * joint[0, t]

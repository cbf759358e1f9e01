"""Parts of networks in series: how a change of a part changes the dynamic stiffness of the whole.

A part a in series with b changes a b/(a + b) by (b/(a + b))^2 times its own change, times the square of the
installation ratio of the node.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Bool, Integer, Real
from ...vehicles.networks import LAW, PARALLEL, SERIES
from ..network_rows import COEFFICIENT, KIND, PART, Networks, elements, fill_row, stiffness_at

Elements = tuple[float, float, float, float]
"""Direct elements of a node."""


class Joints(NamedTuple):
    """Factors of the changes of parts in series, of networks with m nodes at n frequencies."""

    row: Integer  # (m,), row of a part
    rows: Real  # (y, 2, n)
    needed: Bool  # (m,), whether a variable or a law stands below a node


@compilable()
def joints_of(networks: Networks, n: int) -> Joints:
    """Return work arrays at n frequencies."""
    row, needed, parts = (
        np.zeros(networks.row.size, dtype=np.int64),
        np.zeros(networks.row.size, dtype=np.bool_),
        0,
    )
    for i in range(row.size):
        for j in range(2 if networks.node[i, KIND] == SERIES else 0):
            row[networks.node[i, PART + j]] = parts
            parts += 1
    fill_needed(networks, needed)
    return Joints(row, np.empty((parts, 2, n)), needed)


@uncounted()
def fill_needed(networks: Networks, needed: Bool) -> None:
    """Fill in below which nodes a variable or a law stands."""
    node = networks.node
    for i in range(needed.size):
        needed[i] = node[i, KIND] == LAW
        if node[i, KIND] >= PARALLEL:
            needed[i] = needed[node[i, PART]] or needed[node[i, PART + 1]]
        for v in range(networks.variable.size):
            for j in range(2):
                needed[i] |= node[i, COEFFICIENT + j] == networks.variable[v]


@uncounted(error_model="numpy", forceinline=True)
def fill_rows_and_joints(
    networks: Networks, omega: Real, values: Real, direct: Real, rows: Real, joints: Joints
) -> None:
    """Fill in the rows of all nodes, and by what changes of parts in series are multiplied, of those needed."""
    node, row, needed = networks.node, networks.row, joints.needed
    for i in range(row.size):
        one, other, series = node[i, PART], node[i, PART + 1], node[i, KIND] == SERIES
        if series and row[one] == 0 and row[other] == 0 and needed[one] != needed[other]:
            part, beside = (one, other) if needed[one] else (other, one)
            ends, square = (
                (elements(direct, part), elements(direct, beside)),
                networks.ratio[i] * networks.ratio[i],
            )
            join_directly(square, omega, ends[0], ends[1], rows[row[i]], joints.rows[joints.row[part]])
            continue
        fill_row(networks, omega, values, direct, i, rows)
        for j in range(2 if series else 0):
            if needed[node[i, PART + j]]:
                fill_joint_of(networks, omega, direct, rows, i, j, joints)


@uncounted(error_model="numpy")
def fill_joint_of(
    networks: Networks, omega: Real, direct: Real, rows: Real, i: int, j: int, joints: Joints
) -> None:
    """Fill in the joint of the first or second part of a node in series."""
    row, part, other = networks.row, networks.node[i, PART + j], networks.node[i, PART + 1 - j]
    joint, square = joints.rows[joints.row[part]], networks.ratio[i] * networks.ratio[i]
    if row[part] == 0 and row[other] == 0:
        fill_direct_joint(square, omega, elements(direct, part), elements(direct, other), joint)
    else:
        fill_joint(square, omega, direct, part, other, rows[row[part]], rows[row[other]], joint)


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def join_directly(square: float, omega: Real, part: Elements, other: Elements, row: Real, joint: Real) -> None:
    """Fill in a b/(a + b) and (b/(a + b))^2 (2, n) times a squared ratio, of direct elements a and b."""
    (k, c, b, h), (k_2, c_2, b_2, h_2) = part, other
    for t in range(omega.size):
        w = omega[t]
        re_1, im_1 = k - b * (w * w), h + c * w
        re_2, im_2 = k_2 - b_2 * (w * w), h_2 + c_2 * w
        x, y = re_1 + re_2, im_1 + im_2
        inverse = 1.0 / (x * x + y * y)
        re, im = (re_2 * x + im_2 * y) * inverse, (im_2 * x - re_2 * y) * inverse
        row[0, t], row[1, t] = square * (re_1 * re - im_1 * im), square * (re_1 * im + im_1 * re)
        joint[0, t], joint[1, t] = square * (re * re - im * im), 2.0 * square * re * im


# Fewer rows in a loop than in `fill_joint`: the compiler can tell them apart, and vectorises it.
@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def fill_direct_joint(square: float, omega: Real, part: Elements, other: Elements, joint: Real) -> None:
    """Fill in (b/(a + b))^2 times a squared ratio (2, n), of direct elements a in series with others b."""
    (k, c, b, h), (k_2, c_2, b_2, h_2) = part, other
    for t in range(omega.size):
        w = omega[t]
        re_2, im_2 = k_2 - b_2 * (w * w), h_2 + c_2 * w
        x, y = k - b * (w * w) + re_2, h + c * w + im_2
        inverse = 1.0 / (x * x + y * y)
        re, im = (re_2 * x + im_2 * y) * inverse, (im_2 * x - re_2 * y) * inverse
        joint[0, t], joint[1, t] = square * (re * re - im * im), 2.0 * square * re * im


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def fill_joint(
    square: float, omega: Real, direct: Real, part: int, other: int, upper: Real, lower: Real, joint: Real
) -> None:
    """Fill in (b/(a + b))^2 times a squared ratio (2, n), of a part a in series with b."""
    first, second = elements(direct, part), elements(direct, other)
    for t in range(omega.size):
        a, b = stiffness_at(first, omega[t], upper, t)
        c, d = stiffness_at(second, omega[t], lower, t)
        x, y = a + c, b + d
        inverse = 1.0 / (x * x + y * y)
        re, im = (c * x + d * y) * inverse, (d * x - c * y) * inverse
        joint[0, t], joint[1, t] = square * (re * re - im * im), 2.0 * square * re * im

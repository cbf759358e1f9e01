"""Derivatives at the working point of force laws, by the implicit function theorem.

The deviation s of each law is that which the slopes c of all laws cause, s^2 = S(c, x). With z = ln s, and
slopes and means that follow from z and the variables x, (1 - S_c c_z/(2 S)) dz = (S_x + S_c c_x)/(2 S) dx. The
iteration to the point is not differentiated.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, uncounted
from ...quantities import Real
from ..mean_position import balance
from ..network_rows import DEVIATION, DIRECT, MEAN, STATES, Networks, fill_direct, moves, rows_of, setting_of
from ..working_point import begin, fill_values, linearise
from .laws import LawSlopes, fill_law_slopes, law_slopes_of
from .mean_position import Yielding, fill_mean_slopes, solve, yielding_of
from .network_rows import Adjoint


class Settled(NamedTuple):
    """Networks of a design at its working point: c coefficients, l laws, m nodes, n frequencies, q ports."""

    values: Real  # (c,)
    curve: Real  # (l, 3, k + 1)
    state: Real  # (l, 8)
    nodes: Real  # (m, 3), at 0 Hz
    position: Real  # (q,)
    work: Real  # (3, q, q)
    direct: Real  # (m, 4)
    rows: Real  # (1 + x, 2, n)
    share: Real  # (2, n), for any use


class Point(NamedTuple):
    """Derivatives at the working point of a design, of l laws and c coefficients."""

    slopes: LawSlopes
    yielding: Yielding
    means: Real  # (l, c + l), of means by coefficients and by ln s
    rise: Real  # (l, c + l), of slopes
    square: Real  # (l,), S
    by_value: Real  # (l, c), of S by coefficients
    by_slope: Real  # (l, l), and by the slopes of laws
    equations: Real  # (l, l)
    deviation: Real  # (l, c), of ln s
    total: Real  # (l, c), of slopes by coefficients, in the end


@compilable()
def settled_of(networks: Networks, n: int) -> Settled:
    """Return work arrays at n frequencies."""
    laws, q, m = networks.law.shape[0], networks.sag.size, networks.row.size
    curve, state, nodes = np.empty(networks.laws.number.shape[:3]), np.empty((laws, STATES)), np.empty((m, 3))
    position, work, direct, share = np.zeros(q), np.empty((3, q, q)), np.empty((m, DIRECT)), np.empty((2, n))
    values, rows = setting_of(networks), rows_of(networks, n)
    return Settled(values, curve, state, nodes, position, work, direct, rows, share)


@compilable()
def point_of(networks: Networks) -> Point:
    """Return work arrays."""
    laws, c = networks.law.shape[0], networks.setting.size
    means, rise = np.zeros((laws, c + laws)), np.empty((laws, c + laws))
    by_value, deviation, total = np.empty((laws, c)), np.empty((laws, c)), np.empty((laws, c))
    square, by_slope, equations = np.empty(laws), np.empty((laws, laws)), np.empty((laws, laws))
    slopes, yielding = law_slopes_of(networks), yielding_of(networks)
    return Point(slopes, yielding, means, rise, square, by_value, by_slope, equations, deviation, total)


@uncounted(error_model="numpy", forceinline=True)
def settle(networks: Networks, designs: Real, p: int, states: Real, settled: Settled) -> None:
    """Linearise one of the designs (p, v) at the deviations and means of its working point, of states (p, l, 8).

    A step was taken from where the iteration ended: this is nearer to the point than the mean squares are.
    """
    values, curve, state = settled.values, settled.curve, settled.state
    fill_values(networks.variable, designs, p, values)
    if p == 0 or not networks.same_damping:
        begin(networks.law, networks.laws, values, curve, state)
    for law in range(state.shape[0]):
        state[law, DEVIATION], state[law, MEAN] = states[p, law, DEVIATION], states[p, law, MEAN]
    if moves(networks):
        balance(networks, curve, values, state, settled.nodes, settled.position, settled.work)
    else:
        linearise(networks.law, networks.laws.most, curve, values, state)
    fill_direct(networks, values, state, settled.direct)


@uncounted(error_model="numpy")
def fill_rise(networks: Networks, settled: Settled, point: Point) -> None:
    """Fill in the derivatives of slopes by coefficients and by the logarithms of deviations."""
    values, nodes, position = settled.values, settled.nodes, settled.position
    fill_law_slopes(networks, settled.curve, values, settled.state, point.slopes)
    if moves(networks):
        fill_mean_slopes(networks, values, nodes, position, point.slopes, point.yielding, point.means)
    for law in range(point.square.size):
        for direction in range(point.rise.shape[1]):
            point.rise[law, direction] = point.slopes.slope_by_mean[law] * point.means[law, direction]
        for c in range(values.size):
            point.rise[law, c] += point.slopes.slope_by_value[law, c]
        point.rise[law, values.size + law] += point.slopes.slope_by_deviation[law]


@uncounted()
def keep_law(law: int, adjoint: Adjoint, point: Point) -> None:
    """Keep the derivatives of a law's mean square."""
    for c in range(adjoint.by_value.size):
        point.by_value[law, c] = adjoint.by_value[c]
    for other in range(adjoint.by_slope.size):
        point.by_slope[law, other] = adjoint.by_slope[other]


@uncounted(error_model="numpy")
def settle_slopes(point: Point) -> None:
    """Fill in the derivatives of slopes by coefficients at working points, which move with them."""
    laws, c = point.by_value.shape
    for i in range(laws):
        factor = 0.5 / point.square[i]
        for k in range(laws):
            point.equations[i, k] = 1.0 if i == k else 0.0
            for j in range(laws):
                point.equations[i, k] -= factor * point.by_slope[i, j] * point.rise[j, c + k]
        for v in range(c):
            point.deviation[i, v] = factor * point.by_value[i, v]
            for j in range(laws):
                point.deviation[i, v] += factor * point.by_slope[i, j] * point.rise[j, v]
    solve(point.equations, point.deviation)
    for i in range(laws):
        for v in range(c):
            point.total[i, v] = point.rise[i, v]
            for k in range(laws):
                point.total[i, v] += point.rise[i, c + k] * point.deviation[k, v]


@uncounted(forceinline=True)
def fill_slopes(networks: Networks, adjoint: Adjoint, point: Point, slopes: Real) -> None:
    """Fill in the derivatives (v,) of an output by the variables, with the working point that moves with them."""
    for v in range(slopes.size):
        c = networks.variable[v]
        slopes[v] = adjoint.by_value[c]
        for law in range(adjoint.by_slope.size):
            slopes[v] += adjoint.by_slope[law] * point.total[law, c]

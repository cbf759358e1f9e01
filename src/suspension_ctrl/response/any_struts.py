"""Mean squares over designs of any number of struts of any kind: the loop of `ManyStruts` with networks."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Bool, Real
from .loop_rows import add_terms, eliminate, fill_loop, fill_stiffness
from .many_struts import ManyStruts
from .mean_position import balance
from .network_rows import (
    DAMPING,
    DIRECT,
    IN_SERIES,
    NETWORK,
    NEXT,
    OF_RATE,
    STATES,
    STIFFNESS,
    Networks,
    elements,
    fill,
    fill_direct,
    fill_rows,
    fill_share,
    moves,
    rows_of,
    setting_of,
    stiffness_at,
)
from .working_point import MOST, NEAR, Points, begin, fill_damping, fill_values, improve, keep, linearise


class AnyStruts(NamedTuple):
    """Blocks of coupled struts around nominal ones, with v variables of gains and t networks after them."""

    struts: ManyStruts
    networks: Networks
    nominal: Real  # (t, 2), stiffness and damping in place of each network
    density: Real  # (2, n), quadrature weights of deflections and of rates
    wheels: Real  # (t,), number of ports of each network

    @compilable()
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, v), each as if alone; NaN without a working point."""
        laws, ports = self.networks.law.shape[0], self.networks.sag.size
        nothing = Points(np.empty((0, laws, STATES)), np.empty((0, ports)), np.empty(0, dtype=np.int64))
        return solve(self, designs, nothing)


@compiled(nogil=True, error_model="numpy")
def solve(any_struts: AnyStruts, designs: Real, points: Points) -> Real:
    """Return the mean squares (p, k) of designs (p, v), and fill in their working points if there is room."""
    struts, networks = any_struts.struts, any_struts.networks
    law, square, count, number = networks.law, networks.square, networks.laws.most, networks.laws.number
    omega, n, m, q = struts.omega, struts.omega.size, networks.row.size, networks.sag.size
    values, rows, (loops, squares, ports) = setting_of(networks), rows_of(networks, n), sizes_of(struts)
    direct, share = np.empty((m, DIRECT)), np.empty(n)
    curve, state, nodes = np.empty(number.shape[:3]), np.empty((count.size, STATES)), np.empty((m, 3))
    position, work, damping = np.zeros(q), np.empty((3, q, q)), np.empty(networks.root.size)
    room, present = np.empty((loops, 2, n)), np.empty(squares, dtype=np.bool_)
    tension, value = np.empty((ports, 2, n)), np.empty((2, n))
    added, found = np.empty(designs.shape[1]), np.empty(struts.channel.size)
    anywhere = points.iterations.size > 0 or moves(networks)
    result = np.empty((designs.shape[0], struts.channel.size))
    for p in range(designs.shape[0]):
        fill_values(networks.variable, designs, p, values)
        for v in range(added.size):
            added[v] = designs[p, v] - struts.origin[v]
        fill_damping(networks, values, damping)
        begin(law, networks.laws, values, curve, state)
        reached, iteration = False, 0
        while not reached and iteration < MOST:
            if anywhere:
                balance(networks, curve, values, state, nodes, position, work)
            else:
                linearise(law, count, curve, values, state)
            fill_direct(networks, values, state, direct)
            fill_rows(networks, omega, values, direct, rows)
            close_blocks(any_struts, added, direct, rows, present, room)
            fill_next(any_struts, state, direct, rows, share, room)
            reached = improve(law, square, damping, state, iteration) < NEAR
            iteration += 1
        keep(points, p, state, position, iteration if reached else -1)
        fill_terms(any_struts, present, room, tension, value, found)
        for term in range(struts.channel.size):
            result[p, term] = found[struts.channel[term]] if reached else np.nan
    return result


@compilable()
def sizes_of(struts: ManyStruts) -> tuple[int, int, int]:
    """Return the rows of all loops and of all stiffness matrices, and the most struts of a block."""
    loops, squares, most = 0, 0, 0  # reductions of numpy take long to compile
    for b in range(struts.sizes.shape[0]):
        q, s = struts.sizes[b, 0], struts.sizes[b, 1]
        loops, squares, most = loops + q * (2 * q + s), squares + q * q, max(most, q)
    return loops, squares, most


@uncounted()
def close_blocks(any_struts: AnyStruts, added: Real, direct: Real, rows: Real, present: Bool, room: Real) -> None:
    """Solve the strut loops of all blocks: stiffness (q q), then loop (q (q + s)) of each block after another.

    The variables have values `added` (v,) to those of the origin.
    """
    struts, root, nominal = any_struts.struts, any_struts.networks.root, any_struts.nominal
    own = any_struts.networks.row
    row, entry, start = 0, 0, 0
    for t in range(root.size):
        direct[root[t], STIFFNESS] -= nominal[t, 0]
        direct[root[t], DAMPING] -= nominal[t, 1]
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        stiffness, loop = room[start : start + q * q], room[start + q * q : start + q * (2 * q + s)]
        filled = present[entry : entry + q * q]
        fill_stiffness(added, struts, entry, filled, stiffness)
        for t in range(root.size):
            gain = struts.gain[added.size + t, entry : entry + q * q]
            add_network(gain, struts.omega, direct, root[t], rows[own[root[t]]], filled, stiffness)
        feedback, sources = struts.rows[row : row + q * q], struts.rows[row + q * q : row + q * (q + s)]
        fill_loop(q, s, filled, stiffness, feedback, sources, loop)
        eliminate(q, q + s, loop)
        row, entry, start = row + (q + k) * (q + s), entry + q * q, start + q * (2 * q + s)


@compilable(fastmath={"contract", "nsz"})
def add_network(
    gain: Real, omega: Real, direct: Real, node: int, row: Real, present: Bool, stiffness: Real
) -> None:
    """Add the dynamic stiffness of a node with its row (2, n) to the stiffness (q q, 2, n) by its gains (q q,)."""
    own = elements(direct, node)
    for i in range(gain.size):
        factor = gain[i]
        if factor != 0.0:
            present[i] = True
            for t in range(omega.size):
                re, im = stiffness_at(own, omega[t], row, t)
                stiffness[i, 0, t] += factor * re
                stiffness[i, 1, t] += factor * im


@uncounted(error_model="numpy")
def fill_next(any_struts: AnyStruts, state: Real, direct: Real, rows: Real, share: Real, room: Real) -> None:
    """Fill in the deviations that result for every law."""
    networks, omega, law = any_struts.networks, any_struts.struts.omega, any_struts.networks.law
    for i in range(state.shape[0]):
        fill(share, networks.square[i])
        if law[i, IN_SERIES]:
            fill_share(networks, omega, i, direct, rows, share)
        seen = any_struts.density[law[i, OF_RATE]]
        state[i, NEXT] = np.sqrt(deflection(any_struts, law[i, NETWORK], seen, share, room))


@uncounted()
def deflection(any_struts: AnyStruts, network: int, density: Real, share: Real, room: Real) -> float:
    """Return the mean square of the deflection of a network's port, times a share (n,), with density (n,)."""
    struts, total, entry, start = any_struts.struts, 0.0, 0, 0
    v = struts.origin.size + network
    for b in range(struts.sizes.shape[0]):
        q, s = struts.sizes[b, 0], struts.sizes[b, 1]
        loop = room[start + q * q : start + q * (2 * q + s)]
        for i in range(q):
            member = struts.gain[v, entry + i * q + i]
            if member != 0.0:
                for source in range(s):
                    total += member * weighted_square(loop[i * (q + s) + q + source], density, share)
        entry, start = entry + q * q, start + q * (2 * q + s)
    return total / any_struts.wheels[network]


@compilable(fastmath={"reassoc", "contract", "nsz"})
def weighted_square(value: Real, density: Real, share: Real) -> float:
    """Return the sum of the squared magnitudes of a row (2, n) times density and share (n,)."""
    total = 0.0
    x, y = value[0], value[1]
    for t in range(x.size):
        total += (x[t] * x[t] + y[t] * y[t]) * density[t] * share[t]
    return total


@uncounted()
def fill_terms(any_struts: AnyStruts, present: Bool, room: Real, tension: Real, value: Real, found: Real) -> None:
    """Fill in the distinct mean squares of the responses."""
    struts, row, entry, start, output = any_struts.struts, 0, 0, 0, 0
    fill(found, 0.0)
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        stiffness, loop = room[start : start + q * q], room[start + q * q : start + q * (2 * q + s)]
        by_source = struts.rows[row + q * (q + s) : row + q * (q + s) + k * s]
        by_strut = struts.rows[row + q * (q + s) + k * s : row + (q + k) * (q + s)]
        response, own = struts.response[output : output + k], present[entry : entry + q * q]
        add_terms(q, s, own, stiffness, loop, by_source, by_strut, response, tension, value, found)
        row, entry, start, output = row + (q + k) * (q + s), entry + q * q, start + q * (2 * q + s), output + k

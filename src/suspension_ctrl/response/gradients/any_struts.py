"""Derivatives of mean squares of any number of struts of any kind: the adjoint of the loop and of its networks."""

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Bool, Real
from ..any_struts import AnyStruts, solve
from ..loop_rows import add_product, fill_stiffness
from ..network_rows import (
    DAMPING,
    IN_SERIES,
    NETWORK,
    OF_RATE,
    STIFFNESS,
    elements,
    fill,
    fill_share,
    stiffness_at,
)
from ..working_point import room_for_points
from .joints import fill_rows_and_joints
from .many_struts import ENTRY, Loops, close, fill_force, fill_values, loops_of, moments, set_to
from .network_rows import Adjoint, adjoint_of, clear, pull, pull_share
from .one_port import total_of
from .wanted import Wanted, fill_weights, fold
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


def with_slopes(any_struts: AnyStruts, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted.

    NaN without a working point.
    """
    networks, squares = any_struts.networks, np.zeros((len(designs), any_struts.struts.channel.size))
    points = room_for_points(networks, len(designs))
    if len(networks.law) > 0:
        squares = solve(any_struts, designs, points)
    return squares, differentiated(any_struts, wanted, designs, points.state, squares)


@compiled(nogil=True, error_model="numpy")
def differentiated(any_struts: AnyStruts, wanted: Wanted, designs: Real, state: Real, squares: Real) -> Real:
    """Return the derivatives (p, s, v) of what is wanted, at states (p, l, 8) of laws with mean squares (p, k).

    Without laws the mean squares are filled in.
    """
    struts, networks, count = any_struts.struts, any_struts.networks, designs.shape[0]
    laws, n = networks.law.shape[0], struts.omega.size
    settled, loops, added = settled_of(networks, n), loops_of(struts), np.empty(designs.shape[1])
    adjoint, point = adjoint_of(networks, n, True), point_of(networks)
    slopes, weight = np.empty((count, wanted.largest.size, designs.shape[1])), np.empty(wanted.factor.shape)
    for p in range(count):
        for v in range(added.size):
            added[v] = designs[p, v] - struts.origin[v]
        settle(networks, designs, p, state, settled)
        close_networks(any_struts, loops, added, settled, adjoint)
        for term in range(struts.channel.size if laws == 0 else 0):
            squares[p, term] = loops.found[struts.channel[term]]
        if laws > 0:
            fill_rise(networks, settled, point)
            for law in range(laws):
                differentiate_law(any_struts, loops, law, settled, adjoint, point)
            settle_slopes(point)
        fill_weights(wanted, squares, p, weight)
        for s in range(wanted.largest.size):
            clear(adjoint)
            fold(struts.channel, weight[s], loops.weight)
            differentiate(any_struts, loops, adjoint)
            fill_slopes(networks, adjoint, point, slopes[p, s])
    return slopes


@uncounted()
def close_networks(any_struts: AnyStruts, loops: Loops, added: Real, settled: Settled, adjoint: Adjoint) -> None:
    """Solve the loops of all blocks for variables with values `added` (v,), and fill in responses."""
    struts, networks, direct = any_struts.struts, any_struts.networks, settled.direct
    fill_rows_and_joints(networks, struts.omega, settled.values, direct, settled.rows, adjoint.joints)
    fill(loops.found, 0.0)
    for t in range(networks.root.size):
        direct[networks.root[t], STIFFNESS] -= any_struts.nominal[t, 0]
        direct[networks.root[t], DAMPING] -= any_struts.nominal[t, 1]
    for b in range(loops.block.shape[0]):
        q, entry = loops.block[b, 0], loops.block[b, ENTRY]
        square = slice(entry, entry + q * q)
        present, stiffness = loops.present[square], loops.stiffness[square]
        fill_stiffness(added, struts, entry, present, stiffness)
        for t in range(networks.root.size):
            gain, root = struts.gain[added.size + t, square], networks.root[t]
            row = settled.rows[networks.row[root]]
            add_network(gain, struts.omega, direct, root, row, present, stiffness)
        close(struts, loops, b)
        fill_values(struts, loops, b)


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
def differentiate_law(
    any_struts: AnyStruts,
    loops: Loops,
    law: int,
    settled: Settled,
    adjoint: Adjoint,
    point: Point,
) -> None:
    """Fill in the mean square of a law's own deflection or rate, and its derivatives."""
    struts, networks, share = any_struts.struts, any_struts.networks, settled.share
    network, density = networks.law[law, NETWORK], any_struts.density[networks.law[law, OF_RATE]]
    fill(share[0], networks.square[law])
    if networks.law[law, IN_SERIES]:
        fill_share(networks, struts.omega, law, settled.direct, settled.rows, share[0])
    for t in range(density.size):
        share[0, t] *= density[t] / any_struts.wheels[network]
        share[1, t] = 0.0
    clear(adjoint)
    for b in range(loops.block.shape[0]):
        for source in range(loops.block[b, 1]):
            if fill_deflection(any_struts, loops, b, source, network, share):
                add_entries(any_struts, loops, b, source, adjoint)
    point.square[law] = total_of(share[1])
    if networks.law[law, IN_SERIES]:
        pull_share(networks, struts.omega, law, settled.direct, settled.rows, share[1], adjoint)
    pull(networks, struts.omega, adjoint)
    keep_law(law, adjoint, point)


@uncounted()
def fill_deflection(any_struts: AnyStruts, loops: Loops, b: int, source: int, network: int, share: Real) -> bool:
    """Fill in m of a network's deflection in a block for a source, e in place of y; return whether it is there.

    Adds |e|^2 times the first of the shares (2, n) to the second.
    """
    q, s, _, _, right, entry, _, _ = loops.block[b]
    v, columns, found = any_struts.struts.origin.size + network, q + s + q, False
    for i in range(q):
        set_to(0.0, loops.force[q + i])
    for i in range(q):
        member = any_struts.struts.gain[v, entry + i * q + i]
        if member != 0.0:
            own = entry + right + i * columns
            weigh(member, share, loops.loop[own + q + source], loops.force[0])
            for j in range(q):
                add_product(1.0, loops.force[0], loops.loop[own + q + s + j], loops.force[q + j])
            found = True
    return found


@compilable(fastmath={"contract", "nsz"})
def weigh(member: float, share: Real, value: Real, weighed: Real) -> None:
    """Fill in the conjugate of a row (2, n) times a member and the first share; add its square times that."""
    for t in range(share.shape[1]):
        factor = member * share[0, t]
        weighed[0, t], weighed[1, t] = factor * value[0, t], -factor * value[1, t]
        share[1, t] += factor * (value[0, t] * value[0, t] + value[1, t] * value[1, t])


@uncounted(error_model="numpy")
def differentiate(any_struts: AnyStruts, loops: Loops, adjoint: Adjoint) -> None:
    """Add up the derivatives of a combination of mean squares by coefficients and slopes."""
    for b in range(loops.block.shape[0]):
        for source in range(loops.block[b, 1]):
            if fill_force(any_struts.struts, loops, b, source):
                add_entries(any_struts, loops, b, source, adjoint)
    pull(any_struts.networks, any_struts.struts.omega, adjoint)


@uncounted()
def add_entries(any_struts: AnyStruts, loops: Loops, b: int, source: int, adjoint: Adjoint) -> None:
    """Add derivatives by the coefficients of gains, and the adjoints of networks, by m and e of a block."""
    struts, networks = any_struts.struts, any_struts.networks
    q, s, _, _, right, entry, _, _ = loops.block[b]
    for i in range(q):
        for j in range(q):
            if loops.reached[entry + i * q + j]:
                solved = loops.loop[entry + right + j * (q + s + q) + q + source]
                own = moments(loops.force[q + i], solved, struts.omega)
                for v in range(struts.origin.size):
                    by_value = 2.0 * struts.gain[v, entry + i * q + j] * own[struts.order[v]]
                    adjoint.by_value[networks.variable[v]] += by_value
                for t in range(networks.root.size):
                    gain = struts.gain[struts.origin.size + t, entry + i * q + j]
                    if gain != 0.0:
                        row = adjoint.rows[adjoint.place[networks.root[t]]]
                        add_product(2.0 * gain, loops.force[q + i], solved, row)

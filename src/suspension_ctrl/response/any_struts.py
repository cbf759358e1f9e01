"""Mean squares over designs of any number of struts of any kind: the loop of `ManyStruts` with networks."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Integer, Real
from . import networked_blocks
from .lanes import WIDTH, load, spread, store, total
from .many_struts import ManyStruts
from .mean_position import balance
from .network_rows import NETWORK, NEXT, STATES, Networks, fill_direct, moves
from .networked_blocks import add_seen, fill_elements, fill_plant, fill_squares
from .working_point import MOST, NEAR, Points, begin, fill_damping, fill_values, improve, keep, linearise

_TILE = 16
"""Designs that are settled and closed together, see `ManyStruts`."""


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


class Room(NamedTuple):
    """Work arrays of a tile of designs (p,)."""

    added: Real  # (p, v), values of the variables to those of the origin
    curve: Real  # (p, l, 3, k + 1), of every law
    state: Real  # (p, l, 8), of every law
    position: Real  # (p, q), mean deflections
    damping: Real  # (p, t), beside each network
    nodes: Real  # (m, 3), at 0 Hz
    work: Real  # (3, q, q), equations of the mean deflections
    left: Integer  # (p,), designs that are not settled
    iterations: Integer  # (p,), -1 before
    blocks: networked_blocks.Room


@compilable()
def room_for(any_struts: AnyStruts, p: int) -> Room:
    """Return work arrays of p designs."""
    networks, number = any_struts.networks, any_struts.networks.laws.number
    laws, q, t = networks.law.shape[0], networks.sag.size, networks.root.size
    curve, state = np.empty((p, laws, 3, number.shape[2])), np.empty((p, laws, STATES))
    added, position, damping = np.empty((p, any_struts.struts.origin.size)), np.zeros((p, q)), np.empty((p, t))
    nodes, work = np.empty((networks.row.size, 3)), np.empty((3, q, q))
    left, iterations = np.empty(p, dtype=np.int64), np.empty(p, dtype=np.int64)
    own = networked_blocks.room_for(any_struts, p)
    return Room(added, curve, state, position, damping, nodes, work, left, iterations, own)


@compiled(nogil=True, error_model="numpy")
def solve(any_struts: AnyStruts, designs: Real, points: Points) -> Real:
    """Return the mean squares (p, k) of designs (p, v), and fill in their working points if there is room."""
    struts, result = any_struts.struts, np.empty((designs.shape[0], any_struts.struts.channel.size))
    room = room_for(any_struts, min(_TILE, designs.shape[0]))
    positions = points.iterations.size > 0 or moves(any_struts.networks)
    for first in range(0, designs.shape[0], _TILE):
        count = min(_TILE, designs.shape[0] - first)
        settle(any_struts, designs, first, count, positions, room)
        fill_squares(any_struts, count, room.blocks)
        for p in range(count):
            keep(points, first + p, room.state[p], room.position[p], room.iterations[p])
            for term in range(struts.channel.size):
                found = total(load(room.blocks.sums, (p, struts.channel[term], 0)))
                result[first + p, term] = found if room.iterations[p] > 0 else np.nan
    return result


@uncounted(error_model="numpy")
def settle(any_struts: AnyStruts, designs: Real, first: int, count: int, positions: bool, room: Room) -> None:
    """Fill in the direct elements of so many designs (p, v) at their working points, and the iterations."""
    left = count
    for p in range(count):
        start_design(any_struts, designs, first + p, p, room)
    for iteration in range(MOST):
        for i in range(left):
            linearise_design(any_struts, room.left[i], positions, room)
        if any_struts.networks.law.shape[0] > 0:
            fill_seen(any_struts, left, room)
        left = improve_designs(any_struts, left, iteration, room)
        if left == 0:
            break


@uncounted(error_model="numpy")
def start_design(any_struts: AnyStruts, designs: Real, design: int, p: int, room: Room) -> None:
    """Begin with one of the designs in place p."""
    networks, values = any_struts.networks, room.blocks.values[p]
    for c in range(values.size):
        values[c] = networks.setting[c]
    fill_values(networks.variable, designs, design, values)
    for v in range(room.added.shape[1]):
        room.added[p, v] = designs[design, v] - any_struts.struts.origin[v]
    fill_damping(networks, values, room.damping[p])
    begin(networks.law, networks.laws, values, room.curve[p], room.state[p])
    room.left[p], room.iterations[p] = p, -1


@uncounted(error_model="numpy")
def linearise_design(any_struts: AnyStruts, p: int, positions: bool, room: Room) -> None:
    """Fill in the direct elements of a design at its deviations, and its mean deflections."""
    networks, blocks, curve, state = any_struts.networks, room.blocks, room.curve[p], room.state[p]
    values, direct = blocks.values[p], blocks.direct[p]
    if positions:
        balance(networks, curve, values, state, room.nodes, room.position[p], room.work)
    else:
        linearise(networks.law, networks.laws.most, curve, values, state)
    fill_direct(networks, values, state, direct)
    fill_elements(any_struts, room.added[p], direct, blocks.elements[p])


@uncounted(error_model="numpy")
def fill_seen(any_struts: AnyStruts, left: int, room: Room) -> None:
    """Fill in the deviations that result for every law of so many designs that are left."""
    networks, seen = any_struts.networks, room.blocks.seen
    for i in range(left):
        for law in range(seen.shape[1]):
            store(spread(0.0), seen, (room.left[i], law, 0))
    for start in range(0, any_struts.struts.omega.size, WIDTH):
        fill_plant(any_struts.struts, start, room.blocks.plant)
        for i in range(0, left, 2):
            add_seen(any_struts, start, room.left[i], room.left[min(i + 1, left - 1)], room.blocks)
    for i in range(left):
        for law in range(seen.shape[1]):
            p, wheels = room.left[i], any_struts.wheels[networks.law[law, NETWORK]]
            room.state[p, law, NEXT] = np.sqrt(total(load(seen, (p, law, 0))) / wheels)


@uncounted(error_model="numpy")
def improve_designs(any_struts: AnyStruts, left: int, iteration: int, room: Room) -> int:
    """Take the next deviations of the designs that are left, and return how many still are."""
    networks, still = any_struts.networks, 0
    for i in range(left):
        p = room.left[i]
        if improve(networks.law, networks.square, room.damping[p], room.state[p], iteration) < NEAR:
            room.iterations[p] = iteration + 1
        else:
            room.left[still] = p
            still += 1
    return still

"""Derivatives of mean squares of blocks of two struts with linear networks, such as dampers on mounts.

Those of networks by their coefficients are carried up to the dynamic stiffness of each strut, at eight frequencies
at a time, see `two_struts`.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Integer, Real
from ...vehicles.networks import INERTER, LAW, MEASURED, PARALLEL, RUBBER, SERIES
from ..any_struts import AnyStruts
from ..lanes import WIDTH, Lanes, Pair, at, load, product, put, reciprocal, spread, total
from ..network_rows import COEFFICIENT, DAMPING, DIRECT, INERTANCE, KIND, LOSS, PART, STATES, Networks, fill_direct
from ..networked_blocks import Links, fill_elements, links_of, stiffness_of_entry
from ..networks_in_lanes import fill_nodes, stiffness_of, times
from ..working_point import fill_values
from . import two_struts
from .two_struts import Directions, add_changes, choose, clear, has
from .wanted import Wanted, combine, fill_weights, fold


class Room(NamedTuple):
    """Work arrays of a design."""

    links: Links
    values: Real  # (c,), coefficients
    added: Real  # (v,), values of the variables to those of the origin
    direct: Real  # (m, 4), direct elements of every node
    elements: Real  # (e, 4), at each entry of D
    nodes: Real  # (16 (1 + x),), rows of the networks
    above: Integer  # (m,), node of which each is a part, -1 of the last
    leaf: Integer  # (y, 4), node, which of its coefficients, variable and network of each tangent
    tangent: Real  # (16 y,), derivatives of networks
    own: Integer  # (b, 2, y), tangents of both struts of each block
    owned: Integer  # (b, 2), number of these
    heard: Integer  # (b, h, 2), responses that have a weight
    number: Integer  # (b,), number of these
    moments: Real  # (b, h, 6 + 2 y, 8)
    slopes: Real  # (v, m), derivatives of the distinct mean squares
    weight: Real  # (s, k)
    folded: Real  # (s, m)


def with_slopes(any_struts: AnyStruts, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted."""
    squares = any_struts(designs)
    return squares, differentiated(any_struts, wanted, designs, squares)


def fits(any_struts: AnyStruts) -> bool:
    """Whether all blocks have two struts that no variable couples, and networks are linear."""
    return len(any_struts.networks.law) == 0 and two_struts.fits(any_struts.struts)


@compiled(nogil=True, error_model="numpy")
def differentiated(any_struts: AnyStruts, wanted: Wanted, designs: Real, squares: Real) -> Real:
    """Return the derivatives (p, s, v) of what is wanted, of designs (p, v) with mean squares (p, k)."""
    networks, state = any_struts.networks, np.empty((0, STATES))
    room, result = (
        room_for(any_struts, wanted),
        np.empty((designs.shape[0], wanted.largest.size, designs.shape[1])),
    )
    for p in range(designs.shape[0]):
        fill_values(networks.variable, designs, p, room.values)
        for v in range(room.added.size):
            room.added[v] = designs[p, v] - any_struts.struts.origin[v]
        fill_direct(networks, room.values, state, room.direct)
        fill_elements(any_struts, room.added, room.direct, room.elements)
        fill_weights(wanted, squares, p, room.weight)
        for s in range(wanted.largest.size):
            fold(any_struts.struts.channel, room.weight[s], room.folded[s])
        fill_moments(any_struts, room)
        fill_slopes(any_struts, room)
        combine(room.folded, room.slopes, p, result)
    return result


@compilable()
def room_for(any_struts: AnyStruts, wanted: Wanted) -> Room:
    """Return work arrays."""
    struts, networks, channels, most, last = any_struts.struts, any_struts.networks, 0, 0, 0
    for term in range(struts.channel.size):
        channels = max(channels, struts.channel[term] + 1)
    for b in range(struts.sizes.shape[0]):
        most = max(most, struts.sizes[b, 2])
    for i in range(networks.row.size):
        last = max(last, networks.row[i])
    m, v, blocks, values = (
        networks.row.size,
        struts.origin.size,
        struts.sizes.shape[0],
        np.empty(networks.setting.size),
    )
    for c in range(values.size):
        values[c] = networks.setting[c]
    above, leaf = np.empty(m, dtype=np.int64), np.empty((2 * m, 4), dtype=np.int64)
    fill_above(networks, above)
    y = fill_leaves(networks, above, leaf)
    own, count = np.empty((blocks, 2, y), dtype=np.int64), np.zeros((blocks, 2), dtype=np.int64)
    fill_own(any_struts, leaf[:y], own, count)
    heard, number = np.empty((blocks, most, 2), dtype=np.int64), np.empty(blocks, dtype=np.int64)
    direct, elements = np.empty((m, DIRECT)), np.empty((struts.gain.shape[1], DIRECT))
    nodes, tangent = np.zeros((1 + last) * 2 * WIDTH), np.empty(y * 2 * WIDTH)
    moments, slopes = np.empty((blocks, most, 6 + 2 * y, WIDTH)), np.empty((v, channels))
    weight, folded = np.empty(wanted.factor.shape), np.empty((wanted.largest.size, channels))
    return Room(
        links_of(any_struts), values, np.empty(v), direct, elements, nodes, above, leaf[:y], tangent, own, count,
        heard, number, moments, slopes, weight, folded,
    )  # fmt: skip


@uncounted()
def fill_above(networks: Networks, above: Integer) -> None:
    """Fill in the node of which each (m,) is a part, -1 of the last of a network."""
    for i in range(above.size):
        above[i] = -1
        for j in range(2 if networks.node[i, KIND] >= PARALLEL else 0):
            above[networks.node[i, PART + j]] = i


@uncounted()
def fill_leaves(networks: Networks, above: Integer, leaf: Integer) -> int:
    """Fill in and count the coefficients of networks that are variables, see `Room`."""
    found = 0
    for i in range(above.size):
        kind, last = networks.node[i, KIND], i
        while above[last] >= 0:
            last = above[last]
        for j in range(2 if kind == RUBBER else 1 if kind < LAW else 0):
            for v in range(networks.variable.size):
                if networks.node[i, COEFFICIENT + j] == networks.variable[v]:
                    leaf[found, 0], leaf[found, 1], leaf[found, 2], leaf[found, 3] = i, j, v, last
                    found += 1
    for y in range(found):
        for t in range(networks.root.size):
            if networks.root[t] == leaf[y, 3]:
                leaf[y, 3] = t
                break
    return found


@uncounted()
def fill_own(any_struts: AnyStruts, leaf: Integer, own: Integer, count: Integer) -> None:
    """Fill in and count the tangents of both struts of each block (b, 2, y)."""
    struts = any_struts.struts
    for b in range(count.shape[0]):
        for j in range(2):
            for y in range(leaf.shape[0]):
                if struts.gain[struts.origin.size + leaf[y, 3], 4 * b + 3 * j] != 0.0:
                    own[b, j, count[b, j]] = y
                    count[b, j] += 1


@uncounted(error_model="numpy")
def fill_moments(any_struts: AnyStruts, room: Room) -> None:
    """Fill in the changes of squares of all blocks, see `two_struts`."""
    struts, output = any_struts.struts, 0
    damping, inertance = has(struts, DAMPING), has(struts, INERTANCE)
    for b in range(room.number.size):
        k = struts.sizes[b, 2]
        room.number[b] = choose(room.folded, struts.response[output : output + k], 1, room.heard[b])
        clear(room.moments[b], room.number[b])
        output += k
    for start in range(0, struts.omega.size, WIDTH):
        w, row = load(struts.omega, (start,)), 0
        fill_nodes(any_struts.networks, w, start, room.values, room.direct, room.nodes)
        fill_tangents(any_struts.networks, w, start, room)
        for b in range(room.number.size):
            q, s, k = struts.sizes[b]
            first = stiffness_of_entry(room.links, w, 4 * b, room.elements, room.nodes)
            second = stiffness_of_entry(room.links, w, 4 * b + 3, room.elements, room.nodes)
            rows, heard = struts.rows[row : row + (q + k) * (q + s)], room.heard[b, : room.number[b]]
            count = room.owned[b, 0], room.owned[b, 1]
            directions = Directions(damping, inertance, room.tangent, room.own[b], count)
            add_changes(w, first, second, rows, start, s, k, s, heard, directions, room.moments[b])
            row += (q + k) * (q + s)


@uncounted(error_model="numpy", forceinline=True)
def fill_tangents(networks: Networks, w: Lanes, start: int, room: Room) -> None:
    """Fill in the derivatives of networks at eight frequencies by their variables, by filled rows of nodes."""
    node, ratio, row = networks.node, networks.ratio, networks.row
    for y in range(room.leaf.shape[0]):
        i = room.leaf[y, 0]
        value, square = leaf_at(networks, w, start, i, room.leaf[y, 1]), ratio[i] * ratio[i]
        while room.above[i] >= 0:
            i, below = room.above[i], i
            square *= ratio[i] * ratio[i]
            if node[i, KIND] == SERIES:
                beside = node[i, PART] + node[i, PART + 1] - below
                a = stiffness_of(w, room.direct, below, room.nodes, row[below])
                b = stiffness_of(w, room.direct, beside, room.nodes, row[beside])
                joint = product(b, reciprocal((a[0] + b[0], a[1] + b[1])))
                value = product(product(value, joint), joint)
        put(times(square, value), room.tangent, y)


@uncounted(forceinline=True)
def leaf_at(networks: Networks, w: Lanes, start: int, leaf: int, part: int) -> Pair:
    """Return the derivative of an element by its first or second coefficient."""
    kind, nothing, one = networks.node[leaf, KIND], spread(0.0), spread(1.0)
    order = kind if kind <= INERTER else LOSS if part == 1 else 0
    value = one, nothing
    if kind == MEASURED:
        value = at(networks.measured, networks.node[leaf, COEFFICIENT + 1], start)
    elif order == DAMPING:
        value = nothing, w
    elif order == INERTANCE:
        value = -(w * w), nothing
    elif order == LOSS:
        value = nothing, one
    return value


@uncounted()
def fill_slopes(any_struts: AnyStruts, room: Room) -> None:
    """Fill in the derivatives (v, m) of the distinct mean squares that have a weight."""
    struts, output = any_struts.struts, 0
    v = struts.origin.size
    for i in range(v):
        for channel in range(room.slopes.shape[1]):
            room.slopes[i, channel] = 0.0
    for b in range(room.number.size):
        for h in range(room.number[b]):
            channel = struts.response[output + room.heard[b, h, 0]]
            for j in range(2):
                entry, start = 4 * b + 3 * j, j * (room.moments.shape[2] // 2)
                for i in range(v):
                    gain = struts.gain[i, entry]
                    if gain != 0.0:
                        change = total(load(room.moments, (b, h, start + struts.order[i], 0)))
                        room.slopes[i, channel] += 2.0 * gain * change
                for g in range(room.owned[b, j]):
                    y = room.own[b, j, g]
                    change = total(load(room.moments, (b, h, start + 3 + g, 0)))
                    gain = struts.gain[v + room.leaf[y, 3], entry]
                    room.slopes[room.leaf[y, 2], channel] += 2.0 * gain * change
        output += struts.sizes[b, 2]

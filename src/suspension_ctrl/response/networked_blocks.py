"""Blocks of struts with networks at eight frequencies at a time: deflections of networks, and squares of terms."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..quantities import Bool, Integer, Real
from .lanes import WIDTH, Lanes, Pair, at, fused, load, put, row_at, spread, store
from .many_struts import ManyStruts, across
from .network_rows import IN_SERIES, LOSS, NETWORK, OF_RATE
from .networks_in_lanes import direct_at, fill_nodes, share_at
from .struts_in_lanes import add_closed, factor, rows_for, solve
from .two_struts import add_two_struts, squared_deflections

if TYPE_CHECKING:
    from .any_struts import AnyStruts

_ROW = 2 * WIDTH  # numbers of a row of eight complex numbers


class Links(NamedTuple):
    """Rows of networks that act at each of e entries of D, one entry after the other."""

    first: Integer  # (e + 1,), the first link of each entry
    row: Integer  # (z,), row of the network
    gain: Real  # (z,)


class Room(NamedTuple):
    """Work arrays of some designs (p,), for eight frequencies at a time."""

    links: Links

    values: Real  # (p, c), coefficients
    direct: Real  # (p, m, 4), direct elements of every node
    elements: Real  # (p, e, 4), direct elements at each entry of D
    seen: Real  # (p, l, 8), mean squares of the laws
    sums: Real  # (p, m, 8), of the distinct mean squares
    plant: Real  # (16 l,), rows of all blocks
    nodes: Real  # (2, 16 (1 + x)), rows of the networks of two designs
    port: Real  # (2, t, 8), squared deflections of their networks
    loop: Real  # of two designs, see `struts_in_lanes`
    crossed: Bool  # (b,), whether a variable couples struts of a block


@compilable()
def links_of(case: "AnyStruts") -> Links:
    """Return the rows of networks at the entries of D, without those that have direct elements alone."""
    networks, gain, v = case.networks, case.struts.gain, case.struts.origin.size
    t, entries, found = networks.root.size, gain.shape[1], 0
    links = Links(
        np.empty(entries + 1, dtype=np.int64), np.empty(entries * t, dtype=np.int64), np.empty(entries * t)
    )
    for entry in range(entries):
        links.first[entry] = found
        for i in range(t):
            row = networks.row[networks.root[i]]
            if row > 0 and gain[v + i, entry] != 0.0:
                links.row[found], links.gain[found] = row, gain[v + i, entry]
                found += 1
    links.first[entries] = found
    return links


@compilable()
def room_for(case: "AnyStruts", p: int) -> Room:
    """Return work arrays of p designs."""
    struts, networks, most, rows, channels = case.struts, case.networks, 0, 0, 0
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        most, rows = max(most, q), rows + (q + k) * (q + s)
    for term in range(struts.channel.size):
        channels = max(channels, struts.channel[term] + 1)
    last = 0
    for i in range(networks.row.size):
        last = max(last, networks.row[i])
    t, laws, entries = networks.root.size, networks.law.shape[0], struts.gain.shape[1]
    values, direct = np.empty((p, networks.setting.size)), np.empty((p, networks.row.size, LOSS + 1))
    elements, seen, sums = (
        np.empty((p, entries, LOSS + 1)),
        np.empty((p, laws, WIDTH)),
        np.empty((p, channels, WIDTH)),
    )
    plant, nodes, port = np.empty(rows * _ROW), np.zeros((2, (1 + last) * _ROW)), np.empty((2, t, WIDTH))
    loop, crossed = np.empty(2 * rows_for(most) * _ROW), np.empty(struts.sizes.shape[0], dtype=np.bool_)
    entry = 0
    for b in range(crossed.size):
        q = struts.sizes[b, 0]
        crossed[b], entry = across(struts, entry, q), entry + q * q
    return Room(links_of(case), values, direct, elements, seen, sums, plant, nodes, port, loop, crossed)


@uncounted()
def fill_elements(case: "AnyStruts", added: Real, direct: Real, elements: Real) -> None:
    """Fill in direct elements (e, 4) at each entry of D, of variables with values `added` (v,) and of networks."""
    struts, root = case.struts, case.networks.root
    for entry in range(elements.shape[0]):
        for j in range(LOSS + 1):
            elements[entry, j] = 0.0
        for v in range(added.size):
            elements[entry, struts.order[v]] += struts.gain[v, entry] * added[v]
        for t in range(root.size):
            gain = struts.gain[added.size + t, entry]
            for j in range(LOSS + 1 if gain != 0.0 else 0):
                nominal = case.nominal[t, j] if j < case.nominal.shape[1] else 0.0
                elements[entry, j] += gain * (direct[root[t], j] - nominal)


@uncounted(forceinline=True)
def add_seen(case: "AnyStruts", start: int, p: int, r: int, room: Room) -> None:
    """Add the mean squares of the laws of two designs at eight frequencies from `start`, or of one twice."""
    networks, w = case.networks, load(case.struts.omega, (start,))
    fill_ports(case, start, p, r, room)
    for j in range(1 + (r != p)):
        design = r if j else p
        for law in range(networks.law.shape[0]):
            share = spread(networks.square[law])
            if networks.law[law, IN_SERIES]:
                share = share_at(networks, law, w, room.direct[design], room.nodes[j])
            square = load(room.port, (j, networks.law[law, NETWORK], 0))
            density = load(case.density, (networks.law[law, OF_RATE], start))
            found = fused(square * density, share, load(room.seen, (design, law, 0)))
            store(found, room.seen, (design, law, 0))


@uncounted(forceinline=True)
def fill_ports(case: "AnyStruts", start: int, p: int, r: int, room: Room) -> None:
    """Fill in the squared deflections (2, t, 8) of the networks of two designs."""
    struts, row, entry = case.struts, 0, 0
    for t in range(case.networks.root.size):
        store(spread(0.0), room.port, (0, t, 0))
        store(spread(0.0), room.port, (1, t, 0))
    fill_two(case, start, p, r, room)
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        plant = room.plant[row * _ROW :]
        if q == 2 and not room.crossed[b]:
            for j in range(1 + (r != p)):
                add_ports_of_two(case, start, entry, s, r if j else p, plant, j, room)
        else:
            put_stiffness(case, start, entry, q, room.crossed[b], p, r, room)
            factor(q, plant, room.crossed[b], room.loop)
            for source in range(s):
                solve(q, s, plant, source, room.crossed[b], room.loop)
                add_ports(case, entry, q, room)
        row, entry = row + (q + k) * (q + s), entry + q * q


@uncounted(forceinline=True)
def fill_two(case: "AnyStruts", start: int, p: int, r: int, room: Room) -> None:
    """Fill in the rows of the networks of two designs."""
    w = load(case.struts.omega, (start,))
    for j in range(1 + (r != p)):
        design = r if j else p
        fill_nodes(case.networks, w, start, room.values[design], room.direct[design], room.nodes[j])


@uncounted(forceinline=True)
def stiffness_of_entry(links: Links, w: Lanes, entry: int, elements: Real, nodes: Real) -> Pair:
    """Return the dynamic stiffness at an entry of D of a design, with filled rows of its networks."""
    re, im = direct_at(w, elements, entry)
    for i in range(links.first[entry], links.first[entry + 1]):
        (x, y), factor = row_at(nodes, links.row[i]), spread(links.gain[i])
        re, im = fused(factor, x, re), fused(factor, y, im)
    return re, im


@uncounted(forceinline=True)
def add_ports_of_two(
    case: "AnyStruts", start: int, entry: int, sources: int, p: int, plant: Real, j: int, room: Room
) -> None:
    """Add the squared deflections of networks in a block of two struts, of the first or second of two designs."""
    w = load(case.struts.omega, (start,))
    first = stiffness_of_entry(room.links, w, entry, room.elements[p], room.nodes[j])
    second = stiffness_of_entry(room.links, w, entry + 3, room.elements[p], room.nodes[j])
    squares = squared_deflections(first, second, plant, sources)
    for t in range(case.networks.root.size):
        gain, place = case.struts.gain[case.struts.origin.size + t], (j, t, 0)
        found = fused(spread(gain[entry]), squares[0], load(room.port, place))
        store(fused(spread(gain[entry + 3]), squares[1], found), room.port, place)


@uncounted(forceinline=True)
def put_stiffness(
    case: "AnyStruts", start: int, entry: int, q: int, crossed: bool, p: int, r: int, room: Room
) -> None:
    """Put D of a block of two designs where their loop is closed."""
    w = load(case.struts.omega, (start,))
    for j in range(2):
        elements, nodes = room.elements[r if j else p], room.nodes[j if r != p else 0]
        for i in range(0, q * q, 1 if crossed else q + 1):
            put(stiffness_of_entry(room.links, w, entry + i, elements, nodes), room.loop, j * rows_for(q) + i)


@uncounted(forceinline=True)
def add_ports(case: "AnyStruts", entry: int, q: int, room: Room) -> None:
    """Add the squared deflections of networks in a block of two designs, solved for a source."""
    for t in range(case.networks.root.size):
        for i in range(q):
            gain = case.struts.gain[case.struts.origin.size + t, entry + i * q + i]
            for j in range(2 if gain != 0.0 else 0):
                re, im = row_at(room.loop, (j * rows_for(q)) + 2 * q * q + i)
                square = fused(re, re, im * im)
                store(fused(spread(gain), square, load(room.port, (j, t, 0))), room.port, (j, t, 0))


@uncounted(forceinline=True)
def fill_plant(struts: ManyStruts, start: int, plant: Real) -> None:
    """Fill in the rows (16 l,) of all blocks: side by side they lie in few pages of memory."""
    for i in range(struts.rows.shape[0]):
        put(at(struts.rows, i, start), plant, i)


@uncounted(forceinline=True)
def fill_squares(case: "AnyStruts", count: int, room: Room) -> None:
    """Fill in the lanes (p, m, 8) of the distinct mean squares of so many designs."""
    struts = case.struts
    for p in range(count):
        for channel in range(room.sums.shape[1]):
            store(spread(0.0), room.sums, (p, channel, 0))
    for start in range(0, struts.omega.size, WIDTH):
        fill_plant(struts, start, room.plant)
        for p in range(0, count, 2):
            add_squares(case, start, p, min(p + 1, count - 1), room)


@uncounted(forceinline=True)
def add_squares(case: "AnyStruts", start: int, p: int, r: int, room: Room) -> None:
    """Add the squares of all terms of neighbouring designs at eight frequencies from `start`, or of one."""
    struts, row, entry, output = case.struts, 0, 0, 0
    w = load(struts.omega, (start,))
    fill_two(case, start, p, r, room)
    for b in range(struts.sizes.shape[0]):
        q, s, k = struts.sizes[b]
        plant, response = room.plant[row * _ROW :], struts.response[output : output + k]
        if q == 2 and not room.crossed[b]:
            for j in range(1 + (r != p)):
                elements, nodes = room.elements[p + j], room.nodes[j]
                first = stiffness_of_entry(room.links, w, entry, elements, nodes)
                second = stiffness_of_entry(room.links, w, entry + 3, elements, nodes)
                add_two_struts(first, second, plant, s, response, 1, room.sums[p + j])
        else:
            put_stiffness(case, start, entry, q, room.crossed[b], p, r, room)
            add_closed(plant, room.crossed[b], struts.sizes[b], response, 1, room.loop, room.sums[p : r + 1])
        row, entry, output = row + (q + k) * (q + s), entry + q * q, output + k

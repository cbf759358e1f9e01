"""Trees of struts: the networks of a vehicle at each of their ports, as data of compiled passes."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...compiled import compilable
from ...quantities import Bool, Integer, Real
from ...vehicles.assembly import Network
from ...vehicles.networks import INERTER, LAW, PARALLEL, SERIES, Program, elements_of
from ...vehicles.struts import MeasuredStiffness, Rubber
from .curves import fill_law

_NONE = -1


class Tree(NamedTuple):
    """Nodes of all networks at all ports, parts before the node that they make up, and l force laws."""

    kind: Integer  # (n,)
    parts: Integer  # (n, 2), nodes; of a series with an inerter the first part holds it
    port: Integer  # (n,), strut of the last node of a network, else -1
    state: Integer  # (n, 2), states of the first part of a series: its deflection, with an inerter also its rate
    states: int  # number of states of all series
    law: Integer  # (n,), of a LAW, else -1
    of_rate: Bool  # (l,)
    curved: bool  # whether a law is a power of the rate
    node: Integer  # (n,), node of the vehicle's program
    source: Integer  # (l,), law of the vehicle's program


class Numbers(NamedTuple):
    """Values of the nodes and curves of the laws, of one design."""

    ratio: Real  # (n,), installation ratio
    value: Real  # (n,), stiffness or damping
    inertance: Real  # (n,), of each node [kg]
    knots: Integer  # (l,), number of knots of each law
    knot: Real  # (l, k)
    slope: Real  # (l, k + 1)
    base: Real  # (l, k + 1), force of each segment at 0
    power: Real  # (l, 2), factor c and exponent a of c |v|^a


class _Node(NamedTuple):
    kind: int
    parts: tuple[int, int]
    port: int
    state: tuple[int, int]
    law: int
    node: int
    inertia: bool


def tree_of(networks: Sequence[Network], program: Program, states: int) -> Tree:
    """Return the trees of networks, their states behind so many others; ValueError without a response in time."""
    _check_in_time(networks)
    nodes, first = list[_Node](), 0
    for network, root in zip(networks, program.root.tolist(), strict=True):
        for port in np.flatnonzero(network.share).tolist():
            _append(program, range(first, root + 1), port, states, nodes)
        first = root + 1
    table = np.array([[one.kind, *one.parts, one.port, *one.state, one.law, one.node] for one in nodes])
    table = np.ascontiguousarray(table.astype(np.int64).reshape(-1, 8).T)
    kind, port, law, node = table[0], table[3], table[6], table[7]
    parts, state = np.ascontiguousarray(table[1:3].T), np.ascontiguousarray(table[4:6].T)
    source = program.law[node[law != _NONE]]
    of_rate, curved = program.laws.of_rate[source], bool((program.laws.power[source] != _NONE).any())
    added = int(np.count_nonzero(state != _NONE))
    return Tree(kind, parts, port, state, added, law, of_rate, curved, node, source)


def _check_in_time(networks: Sequence[Network]) -> None:
    for kind in (Rubber, MeasuredStiffness):
        for network, element in elements_of(networks, kind):
            needed = "of elements with a response in time, a Zener element for rubber"
            raise ValueError(f"struts must be {needed}, got {network.prefix}{element.name}")


def _append(program: Program, own: range, port: int, states: int, nodes: list[_Node]) -> None:
    """Append the nodes of a network at a port."""
    offset, laws = len(nodes) - own[0], sum(node.law != _NONE for node in nodes)
    used = states + sum(state != _NONE for node in nodes for state in node.state)
    for i in own:
        kind, state, (a, b) = int(program.kind[i]), (_NONE, _NONE), (program.parts[i] + offset).tolist()
        inertia = kind == INERTER or (kind == PARALLEL and (nodes[a].inertia or nodes[b].inertia))
        if kind == SERIES:
            if nodes[a].inertia and nodes[b].inertia:
                raise ValueError("series must have an inerter in one of its parts at most in time, got two")
            a, b = (b, a) if nodes[b].inertia else (a, b)
            state = (used, used + 1 if nodes[a].inertia else _NONE)
            used += 1 + nodes[a].inertia
        law = laws if kind == LAW else _NONE
        laws += kind == LAW
        parts = (a, b) if kind in (PARALLEL, SERIES) else (_NONE, _NONE)
        nodes.append(_Node(kind, parts, port if i == own[-1] else _NONE, state, law, i, inertia))


@compilable(error_model="numpy")
def numbers_of(program: Program, tree: Tree, values: Real) -> Numbers:
    """Return the numbers for coefficients (c,) of the vehicle."""
    n, laws, most = tree.kind.size, tree.source.size, 2 * program.laws.number.shape[2]
    ratio, value, inertance = np.ones(n), np.zeros(n), np.zeros(n)
    for i in range(n):
        a, b = tree.parts[i]
        ratio[i] = program.ratio[tree.node[i]]
        coefficient = program.coefficient[tree.node[i], 0]
        value[i] = values[coefficient] if coefficient >= 0 else 0.0
        if tree.kind[i] == INERTER:
            inertance[i] = ratio[i] ** 2 * value[i]
        elif tree.kind[i] == PARALLEL:
            inertance[i] = ratio[i] ** 2 * (inertance[a] + inertance[b])
    knots, knot, power = np.zeros(laws, dtype=np.int64), np.zeros((laws, most)), np.zeros((laws, 2))
    slope, base = np.zeros((laws, most + 1)), np.zeros((laws, most + 1))
    for l in range(laws):  # noqa: E741
        knots[l] = fill_law(program.laws, tree.source[l], values, knot[l], slope[l], base[l], power[l])
    return Numbers(ratio, value, inertance, knots, knot, slope, base, power)

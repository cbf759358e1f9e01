"""Trees of struts: the networks of a vehicle at each of their ports, as data of compiled passes.

Elements hang in slots: the ports of the vehicle come first, then the first and the second part of every series.
Elements in one slot are in parallel.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ...compiled import compiled
from ...quantities import Bool, Integer, Real
from ...vehicles.assembly import Network
from ...vehicles.elements import MeasuredStiffness, Rubber
from ...vehicles.networks import DAMPER, INERTER, LAW, PARALLEL, SERIES, SPRING, Program, elements_of
from .curves import fill_law

_NONE = -1


class Tree(NamedTuple):
    """What hangs in the slots: l force laws, s series, the parts of a series before it, and linear elements."""

    law_slot: Integer  # (l,)
    law_ratio: Real  # (l,), of the deflection of a law to that of its slot
    of_rate: Bool  # (l,)
    source: Integer  # (l,), law of the vehicle's program
    slot: Integer  # (s,)
    ratio: Real  # (s,)
    first: Integer  # (s,), slot of the first part, the one with an inerter; the second follows
    state: Integer  # (s, 2), states of the first part: its deflection, with an inerter also its rate, else -1
    kind: Integer  # (n,), of the linear elements
    linear_slot: Integer  # (n,)
    linear_ratio: Real  # (n,)
    coefficient: Integer  # (n,), of the vehicle
    slots: int
    states: int  # number of states of all series
    curved: bool  # whether a law is a power of the rate


class Numbers(NamedTuple):
    """Values of the elements and curves of the laws, of one design."""

    linear: Real  # (3, slots), stiffness, damping and inertance of the linear elements in each slot
    knots: Integer  # (l,), number of knots of each law
    knot: Real  # (l, k)
    slope: Real  # (l, k + 1)
    base: Real  # (l, k + 1), force of each segment at 0
    power: Real  # (l, 2), factor c and exponent a of c |v|^a


class _Element(NamedTuple):
    kind: int
    slot: int
    first: int
    state: tuple[int, int]
    node: int
    ratio: float


class _Growth(NamedTuple):
    """A tree that elements are hung into."""

    program: Program
    elements: list[_Element]
    inertia: list[bool]  # (s,), whether an inerter hangs in a slot
    states: list[int]

    def hang(self, node: int, slot: int, ratio: float = 1.0) -> None:
        """Hang a node of the program into a slot."""
        kind, ratio = int(self.program.kind[node]), ratio * float(self.program.ratio[node])
        parts, first, state = self.program.parts[node].tolist(), _NONE, (_NONE, _NONE)
        if kind == PARALLEL:
            for part in parts:
                self.hang(part, slot, ratio)
            return
        if kind == SERIES:
            first, state = self._series(parts)
        self.inertia[slot] |= kind == INERTER
        self.elements.append(_Element(kind, slot, first, state, node, ratio))

    def _series(self, parts: list[int]) -> tuple[int, tuple[int, int]]:
        """Hang the parts of a series into new slots; return the first and the states."""
        first = len(self.inertia)
        self.inertia.extend([False, False])
        for slot, part in enumerate(parts, first):
            self.hang(part, slot)
        if self.inertia[first] and self.inertia[first + 1]:
            raise ValueError("series must have an inerter in one of its parts at most in time, got two")
        if self.inertia[first + 1]:
            self._swap(first)
        deflection, inertia = self.states[-1] + 1, self.inertia[first]
        self.states.extend([deflection, deflection + 1] if inertia else [deflection])
        return first, (deflection, deflection + 1 if inertia else _NONE)

    def _swap(self, first: int) -> None:
        """Exchange the parts of a series."""
        other = {first: first + 1, first + 1: first}
        self.elements[:] = [one._replace(slot=other.get(one.slot, one.slot)) for one in self.elements]
        self.inertia[first : first + 2] = [True, False]


def tree_of(networks: Sequence[Network], program: Program, states: int) -> Tree:
    """Return the trees of networks, their states behind so many others; ValueError without a response in time."""
    _check_in_time(networks)
    ports = max((len(network.share) for network in networks), default=0)
    growth = _Growth(program, [], [False] * ports, [states - 1])
    for network, root in zip(networks, program.root.tolist(), strict=True):
        for port in np.flatnonzero(network.share).tolist():
            growth.hang(root, port)
    columns = [np.array(column) for column in zip(*growth.elements, strict=True)] or [np.zeros(0)] * 6
    kind, slot, first, state, node = (column.astype(np.int64) for column in columns[:-1])
    law, series, ratio = kind == LAW, kind == SERIES, columns[-1].astype(float)
    linear, source = ~law & ~series, program.law[node[law]]
    return Tree(
        *(slot[law], ratio[law], program.laws.of_rate[source], source),
        *(slot[series], ratio[series], first[series], state.reshape(-1, 2)[series]),
        *(kind[linear], slot[linear], ratio[linear], program.coefficient[node[linear], 0]),
        len(growth.inertia),
        len(growth.states) - 1,
        bool((program.laws.power[source] != _NONE).any()),
    )


def _check_in_time(networks: Sequence[Network]) -> None:
    for kind in (Rubber, MeasuredStiffness):
        for network, element in elements_of(networks, kind):
            needed = "of elements with a response in time, a Zener element for rubber"
            raise ValueError(f"struts must be {needed}, got {network.prefix}{element.name}")


@compiled(error_model="numpy")
def numbers_of(program: Program, tree: Tree, values: Real) -> Numbers:
    """Return the numbers for coefficients (c,) of the vehicle."""
    laws, most = tree.source.size, 2 * program.laws.number.shape[2]
    linear, knots, power = np.zeros((3, tree.slots)), np.zeros(laws, dtype=np.int64), np.zeros((laws, 2))
    for i in range(tree.kind.size):
        order = 0 if tree.kind[i] == SPRING else 1 if tree.kind[i] == DAMPER else 2
        linear[order, tree.linear_slot[i]] += tree.linear_ratio[i] ** 2 * values[tree.coefficient[i]]
    knot, slope, base = np.zeros((laws, most)), np.zeros((laws, most + 1)), np.zeros((laws, most + 1))
    for i in range(laws):
        knots[i] = fill_law(program.laws, tree.source[i], values, knot[i], slope[i], base[i], power[i])
    return Numbers(linear, knots, knot, slope, base, power)

"""Passes over the trees of struts: deflections down, forces up, rates down.

The deflection of the first part of every series is a state. Its rate w solves F_a(w) = F_b(v - w), both forces
straight over the rate on the present segments of the laws.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable
from ...quantities import Integer, Real
from ...vehicles.networks import DAMPER, LAW, PARALLEL, SERIES, SPRING
from .curves import CREEP
from .trees import Numbers, Tree

_SETTLED = 5e-5  # s, a series that relaxes faster is in equilibrium
_RELAXATION = 1e-3  # s, in which rounding of that equilibrium decays


class Scratch(NamedTuple):
    """Present values of the nodes and laws."""

    deflection: Real  # (n,)
    rate: Real  # (n,)
    by_rate: Real  # (n,), force of a node = by_rate * rate + force
    force: Real  # (n,)
    stiffness: Real  # (n,)
    own: Real  # (l,), each law's own deflection or rate
    segment: Integer  # (l,), each law's present segment


@compilable(error_model="numpy", forceinline=True)
def scratch_of(tree: Tree) -> Scratch:
    """Return zeros."""
    nodes, laws = np.zeros((5, tree.kind.size)), tree.of_rate.size
    own, segment = np.zeros(laws), np.zeros(laws, dtype=np.int64)
    return Scratch(nodes[0], nodes[1], nodes[2], nodes[3], nodes[4], own, segment)


@compilable(error_model="numpy", forceinline=True)
def force_of(numbers: Numbers, law: int, segment: int, own: float) -> tuple[float, float]:
    """Return force and slope of a law, its segment prolonged beyond its knots."""
    force = numbers.base[law, segment] + numbers.slope[law, segment] * own
    slope = numbers.slope[law, segment]
    c, a = numbers.power[law]
    if c > 0 and segment != 1:
        size = max(abs(own), 0.1 * CREEP)
        slope += a * c * size ** (a - 1)
        force += np.sign(own) * c * size**a
    return force, slope


@compilable(error_model="numpy", forceinline=True)
def excess(numbers: Numbers, scratch: Scratch, law: int) -> tuple[float, float]:
    """Return how far a law is above and below its present segment, negative inside."""
    segment, own = scratch.segment[law], scratch.own[law]
    above = own - numbers.knot[law, segment] if segment < numbers.knots[law] else -np.inf
    below = numbers.knot[law, segment - 1] - own if segment > 0 else -np.inf
    return above, below


@compilable(error_model="numpy", forceinline=True)
def locate(numbers: Numbers, scratch: Scratch, law: int) -> None:
    """Set the segment of a law by its present value."""
    segment = 0
    while segment < numbers.knots[law] and scratch.own[law] > numbers.knot[law, segment]:
        segment += 1
    scratch.segment[law] = segment


@compilable(error_model="numpy", forceinline=True)
def deflect(tree: Tree, numbers: Numbers, scratch: Scratch, ports: Real, x: Real) -> None:
    """Take deflections from the ports (q,) and states down to the nodes and laws."""
    m = scratch.deflection
    for i in range(tree.kind.size - 1, -1, -1):
        if tree.port[i] >= 0:
            m[i] = ports[tree.port[i]]
        own, (a, b) = numbers.ratio[i] * m[i], tree.parts[i]
        if tree.kind[i] == PARALLEL:
            m[a], m[b] = own, own
        elif tree.kind[i] == SERIES:
            m[a] = x[tree.state[i, 0]]
            m[b] = own - m[a]
        elif tree.kind[i] == LAW and not tree.of_rate[tree.law[i]]:
            scratch.own[tree.law[i]] = own


@compilable(error_model="numpy", forceinline=True)
def gather(tree: Tree, numbers: Numbers, scratch: Scratch, x: Real) -> None:
    """Take forces, straight over the rates, from the elements up to the ports."""
    g, h, k = scratch.by_rate, scratch.force, scratch.stiffness
    for i in range(tree.kind.size):
        (a, b), value = tree.parts[i], numbers.value[i]
        g[i], h[i], k[i] = 0.0, 0.0, 0.0
        if tree.kind[i] == SPRING:
            h[i], k[i] = value * numbers.ratio[i] * scratch.deflection[i], value
        elif tree.kind[i] == DAMPER:
            g[i] = value
        elif tree.kind[i] == LAW:
            own = scratch.own[tree.law[i]]
            force, slope = force_of(numbers, tree.law[i], scratch.segment[tree.law[i]], own)
            if tree.of_rate[tree.law[i]]:
                g[i], h[i] = slope, force - slope * own
            else:
                h[i], k[i] = force, slope
        elif tree.kind[i] == PARALLEL:
            g[i], h[i], k[i] = g[a] + g[b], h[a] + h[b], k[a] + k[b]
        elif tree.kind[i] == SERIES:
            _join(tree, scratch, i, x)
        g[i] *= numbers.ratio[i] ** 2
        h[i] *= numbers.ratio[i]
        k[i] *= numbers.ratio[i] ** 2


@compilable(error_model="numpy", forceinline=True)
def _join(tree: Tree, scratch: Scratch, i: int, x: Real) -> None:
    """Put in the force of a series."""
    g, h, k, (a, b) = scratch.by_rate, scratch.force, scratch.stiffness, tree.parts[i]
    if tree.state[i, 1] >= 0:
        g[i], h[i], k[i] = g[b], h[b] - g[b] * x[tree.state[i, 1]], k[b]
        return
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        g[i], h[i], k[i] = g[a] * g[b] / damping, (g[a] * h[b] + g[b] * h[a]) / damping, g[a] * k[b] / damping
        return
    share = k[b] / stiffness if stiffness > 0 else 0.5
    g[i] = share**2 * g[a] + (1 - share) ** 2 * g[b]
    h[i], k[i] = share * h[a] + (1 - share) * h[b], share * k[a]


@compilable(error_model="numpy", forceinline=True)
def spread(tree: Tree, numbers: Numbers, scratch: Scratch, ports: Real, x: Real, dx: Real) -> float:
    """Take rates from the ports (q,) down to the laws and the states; return the largest change of a law's own."""
    v, change = scratch.rate, 0.0
    for i in range(tree.kind.size - 1, -1, -1):
        if tree.port[i] >= 0:
            v[i] = ports[tree.port[i]]
        own, (a, b) = numbers.ratio[i] * v[i], tree.parts[i]
        if tree.kind[i] == PARALLEL:
            v[a], v[b] = own, own
        elif tree.kind[i] == SERIES:
            v[a] = _rate_of_first(tree, numbers, scratch, i, own, x, dx)
            v[b] = own - v[a]
            dx[tree.state[i, 0]] = v[a]
        elif tree.kind[i] == LAW and tree.of_rate[tree.law[i]]:
            change = max(change, abs(own - scratch.own[tree.law[i]]))
            scratch.own[tree.law[i]] = own
    return change


@compilable(error_model="numpy", forceinline=True)
def _rate_of_first(tree: Tree, numbers: Numbers, scratch: Scratch, i: int, own: float, x: Real, dx: Real) -> float:
    """Return the rate of the first part of a series."""
    g, h, k, (a, b) = scratch.by_rate, scratch.force, scratch.stiffness, tree.parts[i]
    if tree.state[i, 1] >= 0:
        rate = x[tree.state[i, 1]]
        dx[tree.state[i, 1]] = (g[b] * (own - rate) + h[b] - g[a] * rate - h[a]) / numbers.inertance[a]
        return float(rate)
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return float((g[b] * own + h[b] - h[a]) / damping)
    if stiffness == 0:
        return own / 2
    rate = own * k[b] / stiffness
    return float(rate + (g[b] * (own - rate) + h[b] - g[a] * rate - h[a]) / (stiffness * _RELAXATION))

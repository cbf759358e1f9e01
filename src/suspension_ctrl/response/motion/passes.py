"""Passes over the trees of struts: deflections down, forces up, rates down, for one order of the power series.

The deflection of the first part of every series is a state. Its rate w solves F_a(w) = F_b(v - w), both forces
straight over the rate on the present segments of the laws. In higher orders these equations keep their slopes; the
force of a power |v|^a has a further term, by the recurrence for powers of a series [1]_.

.. [1] D. E. Knuth, "The Art of Computer Programming", vol. 2, section 4.7, equation (9).
"""

import numpy as np

from ...compiled import compilable
from ...vehicles.networks import DAMPER, LAW, SERIES, SPRING
from .curves import CREEP
from .system import Work
from .trees import Numbers, Tree

DEFLECTION, RATE, BY_RATE, FORCE, STIFFNESS = range(5)
"""Rows of `Work.slots`."""
_SLOPE, _REST = range(2)
_SETTLED = 5e-5  # s, a series that relaxes faster is in equilibrium
_RELAXATION = 1e-3  # s, in which rounding of that equilibrium decays
_SLOWEST = 0.1 * CREEP  # m/s, beyond which a power of the rate is not prolonged towards 0


@compilable(error_model="numpy", forceinline=True)
def force_of(numbers: Numbers, law: int, segment: int, own: float) -> tuple[float, float]:
    """Return force and slope of a law, its segment prolonged beyond its knots."""
    force = numbers.base[law, segment] + numbers.slope[law, segment] * own
    slope = numbers.slope[law, segment]
    c, a = numbers.power[law]
    if c > 0 and segment != 1:
        size = max(abs(own), _SLOWEST)
        slope += a * c * size ** (a - 1)
        force += np.sign(own) * c * size**a
    return force, slope


@compilable(error_model="numpy", forceinline=True)
def set_law(numbers: Numbers, work: Work, law: int) -> None:
    """Put in slope and force of a law at the start of the series, before its own values of higher order."""
    own = work.own[0, law]
    force, slope = force_of(numbers, law, work.segment[law], own)
    work.law[_SLOPE, law], work.law[_REST, law], work.curved[0, law] = slope, force - slope * own, force


@compilable(error_model="numpy", forceinline=True)
def bend(numbers: Numbers, work: Work, law: int, order: int) -> None:
    """Put in the part of the force of a law that its own values of lower orders determine."""
    c, a = numbers.power[law]
    total = 0.0
    if c > 0 and work.segment[law] != 1:
        for j in range(1, order):
            total += (a * j - (order - j)) * work.own[j, law] * work.curved[order - j, law]
        start = work.own[0, law]
        total /= order * np.sign(start) * max(abs(start), _SLOWEST)
    work.law[_REST, law] = total


@compilable(error_model="numpy", forceinline=True)
def deflect(tree: Tree, work: Work, order: int) -> None:
    """Take deflections from the ports and states down to the slots and laws."""
    m = work.slots[DEFLECTION]
    for i in range(tree.kind.size - 1, -1, -1):
        own = tree.ratio[i] * m[tree.slot[i]]
        if tree.kind[i] == SERIES:
            m[tree.first[i]] = work.x[order, tree.state[i, 0]]
            m[tree.first[i] + 1] = own - m[tree.first[i]]
        elif tree.kind[i] == LAW and not tree.of_rate[tree.law[i]]:
            work.own[order, tree.law[i]] = own


@compilable(error_model="numpy", forceinline=True)
def gather(tree: Tree, numbers: Numbers, work: Work, order: int) -> None:
    """Take forces, straight over the rates, from the elements up to the ports."""
    g, h, k = work.slots[BY_RATE], work.slots[FORCE], work.slots[STIFFNESS]
    for s in range(tree.slots):
        h[s] = 0.0
        if order == 0:
            g[s], k[s] = 0.0, 0.0
    for i in range(tree.kind.size):
        slot, ratio, own_g, own_h, own_k = tree.slot[i], tree.ratio[i], 0.0, 0.0, 0.0
        if tree.kind[i] == SPRING:
            own_k = numbers.value[i]
            own_h = own_k * ratio * work.slots[DEFLECTION, slot]
        elif tree.kind[i] == DAMPER:
            own_g = numbers.value[i]
        elif tree.kind[i] == LAW:
            law = tree.law[i]
            slope, own_h = work.law[_SLOPE, law], work.law[_REST, law]
            if tree.of_rate[law]:
                own_g = slope
            else:
                own_h += slope * work.own[order, law]
                own_k = slope
        elif tree.kind[i] == SERIES:
            own_g, own_h, own_k = _joined(tree, work, i, order)
        h[slot] += ratio * own_h
        if order == 0:
            g[slot] += ratio**2 * own_g
            k[slot] += ratio**2 * own_k


@compilable(error_model="numpy", forceinline=True)
def _joined(tree: Tree, work: Work, i: int, order: int) -> tuple[float, float, float]:
    """Return force of a series by its rate, rest of the force, and stiffness."""
    g, h, k, a = work.slots[BY_RATE], work.slots[FORCE], work.slots[STIFFNESS], tree.first[i]
    b = a + 1
    if tree.state[i, 1] >= 0:
        return g[b], h[b] - g[b] * work.x[order, tree.state[i, 1]], k[b]
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return g[a] * g[b] / damping, (g[a] * h[b] + g[b] * h[a]) / damping, g[a] * k[b] / damping
    share = k[b] / stiffness if stiffness > 0 else 0.5
    damping = share**2 * g[a] + (1 - share) ** 2 * g[b]
    return damping, share * h[a] + (1 - share) * h[b], share * k[a]


@compilable(error_model="numpy", forceinline=True)
def spread(tree: Tree, numbers: Numbers, work: Work, order: int) -> float:
    """Take rates from the ports down to the laws and the states; return the largest change of a law's own."""
    v, change = work.slots[RATE], 0.0
    for i in range(tree.kind.size - 1, -1, -1):
        own = tree.ratio[i] * v[tree.slot[i]]
        if tree.kind[i] == SERIES:
            first = tree.first[i]
            v[first] = _rate_of_first(tree, numbers, work, i, own, order)
            v[first + 1] = own - v[first]
            work.x[order + 1, tree.state[i, 0]] = v[first] / (order + 1)
        elif tree.kind[i] == LAW and tree.of_rate[tree.law[i]]:
            law = tree.law[i]
            change = max(change, abs(own - work.own[order, law]))
            work.own[order, law] = own
            if order > 0:
                work.curved[order, law] = work.law[_REST, law] + work.law[_SLOPE, law] * own
    return change


@compilable(error_model="numpy", forceinline=True)
def _rate_of_first(tree: Tree, numbers: Numbers, work: Work, i: int, own: float, order: int) -> float:
    """Return the rate of the first part of a series."""
    g, h, k, a = work.slots[BY_RATE], work.slots[FORCE], work.slots[STIFFNESS], tree.first[i]
    b = a + 1
    if tree.state[i, 1] >= 0:
        rate = work.x[order, tree.state[i, 1]]
        force = g[b] * (own - rate) + h[b] - g[a] * rate - h[a]
        work.x[order + 1, tree.state[i, 1]] = force / numbers.inertance[a] / (order + 1)
        return float(rate)
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return float((g[b] * own + h[b] - h[a]) / damping)
    if stiffness == 0:
        return own / 2
    rate = own * k[b] / stiffness
    return float(rate + (g[b] * (own - rate) + h[b] - g[a] * rate - h[a]) / (stiffness * _RELAXATION))

"""Passes over the trees of struts: deflections down, forces up, rates down, for one order of the power series.

The deflection of the first part of every series is a state. Its rate w solves F_a(w) = F_b(v - w), both forces
straight over the rate on the present segments of the laws. In higher orders these equations keep their slopes; the
force of a power |v|^a has a further term, by the recurrence for powers of a series [1]_.

.. [1] D. E. Knuth, "The Art of Computer Programming", vol. 2, section 4.7, equation (9).
"""

import numpy as np

from ...compiled import uncounted
from .curves import CREEP
from .system import Work
from .trees import Numbers, Tree

DEFLECTION, RATE, FORCE, BY_RATE, STIFFNESS, ELASTIC, VISCOUS, RESTING = range(8)
"""Rows of `Work.slots`; the last three sum laws and linear elements: by deflection, by rate, the rest."""
_SLOPE, _REST = range(2)
_SETTLED = 5e-5  # s, a series that relaxes faster is in equilibrium
_RELAXATION = 1e-3  # s, in which rounding of that equilibrium decays
_SLOWEST = 0.1 * CREEP  # m/s, beyond which a power of the rate is not prolonged towards 0


@uncounted(error_model="numpy", forceinline=True)
def force_of(numbers: Numbers, law: int, segment: int, own: float) -> tuple[float, float]:
    """Return force and slope of a law, its segment prolonged beyond its knots."""
    force = numbers.base[law, segment] + numbers.slope[law, segment] * own
    slope = numbers.slope[law, segment]
    c, a = numbers.power[law, 0], numbers.power[law, 1]
    if c > 0 and segment != 1:
        size = max(abs(own), _SLOWEST)
        slope += a * c * size ** (a - 1)
        force += np.sign(own) * c * size**a
    return force, slope


@uncounted(error_model="numpy", forceinline=True)
def set_law(numbers: Numbers, work: Work, law: int) -> None:
    """Put in slope and force of a law at the start of the series, before its own values of higher order."""
    own = work.own[0, law]
    force, slope = force_of(numbers, law, work.segment[law], own)
    work.law[_SLOPE, law], work.law[_REST, law], work.curved[0, law] = slope, force - slope * own, force


@uncounted(error_model="numpy", forceinline=True)
def bend(numbers: Numbers, work: Work, law: int, order: int) -> None:
    """Put in the part of the force of a law that its own values of lower orders determine."""
    c, a = numbers.power[law, 0], numbers.power[law, 1]
    total = 0.0
    if c > 0 and work.segment[law] != 1:
        for j in range(1, order):
            total += (a * j - (order - j)) * work.own[j, law] * work.curved[order - j, law]
        start = work.own[0, law]
        total /= order * np.sign(start) * max(abs(start), _SLOWEST)
    work.law[_REST, law] = total


@uncounted(error_model="numpy", forceinline=True)
def assemble(tree: Tree, numbers: Numbers, work: Work) -> None:
    """Put in stiffness and damping of the slots, every law on its slope."""
    elastic, viscous, resting = work.slots[ELASTIC], work.slots[VISCOUS], work.slots[RESTING]
    g, k = work.slots[BY_RATE], work.slots[STIFFNESS]
    for s in range(tree.slots):
        elastic[s], viscous[s], resting[s] = numbers.linear[0, s], numbers.linear[1, s], 0.0
    for law in range(tree.law_slot.size):
        slot, ratio = tree.law_slot[law], tree.law_ratio[law]
        slope, rest = work.law[_SLOPE, law], work.law[_REST, law]
        resting[slot] += ratio * rest
        if tree.of_rate[law]:
            viscous[slot] += ratio**2 * slope
        else:
            elastic[slot] += ratio**2 * slope
    for s in range(tree.slots):
        g[s], k[s] = viscous[s], elastic[s]
    for i in range(tree.slot.size):
        damping, stiffness = _joined(tree, work, i)
        g[tree.slot[i]] += tree.ratio[i] ** 2 * damping
        k[tree.slot[i]] += tree.ratio[i] ** 2 * stiffness


@uncounted(error_model="numpy", forceinline=True)
def _joined(tree: Tree, work: Work, i: int) -> tuple[float, float]:
    """Return damping and stiffness of a series."""
    g, k, a = work.slots[BY_RATE], work.slots[STIFFNESS], tree.first[i]
    b = a + 1
    if tree.state[i, 1] >= 0:
        return g[b], k[b]
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return g[a] * g[b] / damping, g[a] * k[b] / damping
    share = k[b] / stiffness if stiffness > 0 else 0.5
    return share**2 * g[a] + (1 - share) ** 2 * g[b], share * k[a]


@uncounted(error_model="numpy", forceinline=True)
def deflect(tree: Tree, work: Work, order: int) -> None:
    """Take deflections from the ports and states down to the slots and laws."""
    m = work.slots[DEFLECTION]
    for i in range(tree.slot.size - 1, -1, -1):
        first = tree.first[i]
        m[first] = work.x[order, tree.state[i, 0]]
        m[first + 1] = tree.ratio[i] * m[tree.slot[i]] - m[first]
    for law in range(tree.law_slot.size):
        if not tree.of_rate[law]:
            work.own[order, law] = tree.law_ratio[law] * m[tree.law_slot[law]]


@uncounted(error_model="numpy", forceinline=True)
def gather(tree: Tree, work: Work, order: int) -> None:
    """Take forces but those by the rate from the elements up to the ports."""
    h, m = work.slots[FORCE], work.slots[DEFLECTION]
    for s in range(tree.slots):
        h[s] = work.slots[ELASTIC, s] * m[s] + (work.slots[RESTING, s] if order == 0 else 0.0)
    if order > 0 and tree.curved:
        for law in range(tree.law_slot.size):
            h[tree.law_slot[law]] += tree.law_ratio[law] * work.law[_REST, law]
    for i in range(tree.slot.size):
        h[tree.slot[i]] += tree.ratio[i] * _force(tree, work, i, order)


@uncounted(error_model="numpy", forceinline=True)
def _force(tree: Tree, work: Work, i: int, order: int) -> float:
    """Return the force of a series but that by its rate."""
    g, h, k, a = work.slots[BY_RATE], work.slots[FORCE], work.slots[STIFFNESS], tree.first[i]
    b = a + 1
    if tree.state[i, 1] >= 0:
        return float(h[b] - g[b] * work.x[order, tree.state[i, 1]])
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return float((g[a] * h[b] + g[b] * h[a]) / damping)
    share = k[b] / stiffness if stiffness > 0 else 0.5
    return float(share * h[a] + (1 - share) * h[b])


@uncounted(error_model="numpy", forceinline=True)
def spread(tree: Tree, numbers: Numbers, work: Work, order: int) -> float:
    """Take rates from the ports down to the laws and the states; return the largest change of a law's own."""
    v, change = work.slots[RATE], 0.0
    for i in range(tree.slot.size - 1, -1, -1):
        first, own = tree.first[i], tree.ratio[i] * v[tree.slot[i]]
        v[first] = _rate_of_first(tree, numbers, work, i, own, order)
        v[first + 1] = own - v[first]
        work.x[order + 1, tree.state[i, 0]] = v[first] / (order + 1)
    for law in range(tree.law_slot.size):
        if tree.of_rate[law]:
            own = tree.law_ratio[law] * v[tree.law_slot[law]]
            change = max(change, abs(own - work.own[order, law]))
            work.own[order, law] = own
            if order > 0 and tree.curved:
                work.curved[order, law] = work.law[_REST, law] + work.law[_SLOPE, law] * own
    return change


@uncounted(error_model="numpy", forceinline=True)
def _rate_of_first(tree: Tree, numbers: Numbers, work: Work, i: int, own: float, order: int) -> float:
    """Return the rate of the first part of a series."""
    g, h, k, a = work.slots[BY_RATE], work.slots[FORCE], work.slots[STIFFNESS], tree.first[i]
    b = a + 1
    if tree.state[i, 1] >= 0:
        rate = work.x[order, tree.state[i, 1]]
        force = g[b] * (own - rate) + h[b] - g[a] * rate - h[a]
        work.x[order + 1, tree.state[i, 1]] = force / numbers.linear[2, a] / (order + 1)
        return float(rate)
    damping, stiffness = g[a] + g[b], k[a] + k[b]
    if damping > _SETTLED * stiffness:
        return float((g[b] * own + h[b] - h[a]) / damping)
    if stiffness == 0:
        return own / 2
    rate = own * k[b] / stiffness
    return float(rate + (g[b] * (own - rate) + h[b] - g[a] * rate - h[a]) / (stiffness * _RELAXATION))

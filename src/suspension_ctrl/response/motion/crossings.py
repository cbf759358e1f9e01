"""Crossings: the moment at which a law leaves its segment or a tyre the road, by its power series.

A segment is prolonged by `_MARGIN` at both ends: what has just begun a segment is within it, rounding or not.
"""

import numpy as np

from ...compiled import uncounted
from ...quantities import Real
from .system import Equations, Work
from .trees import Numbers

_MARGIN = 1e-9  # m, m/s, share of a static load
_ITERATIONS = 100  # at most


@uncounted(error_model="numpy", forceinline=True)
def margin_of(e: Equations, work: Work, i: int) -> float:
    """Return by how much a segment is prolonged."""
    laws = work.segment.size - e.static.size
    return _MARGIN * (e.static[i - laws] if i >= laws else 1.0)


@uncounted(error_model="numpy", forceinline=True)
def bound(numbers: Numbers, work: Work, i: int) -> None:
    """Put in the bounds of the present segment of a law or tyre."""
    laws, segment = numbers.knots.size, work.segment[i]
    low, high = -np.inf, np.inf
    if i >= laws:
        low, high = (0.0, np.inf) if segment else (-np.inf, 0.0)
    else:
        high = numbers.knot[i, segment] if segment < numbers.knots[i] else np.inf
        low = numbers.knot[i, segment - 1] if segment > 0 else -np.inf
    work.bounds[0, i], work.bounds[1, i] = low, high


@uncounted(error_model="numpy", forceinline=True)
def locate(numbers: Numbers, work: Work, i: int) -> bool:
    """Set the segment of a law or tyre by its present value; return whether it changes."""
    before, segment, own = work.segment[i], 0, work.own[0, i]
    if i >= numbers.knots.size:
        segment = 1 if own > 0 else 0
    else:
        while segment < numbers.knots[i] and own > numbers.knot[i, segment]:
            segment += 1
    work.segment[i] = segment
    bound(numbers, work, i)
    return bool(segment != before)


@uncounted(error_model="numpy", forceinline=True)
def first_exit(e: Equations, work: Work, terms: int, longest: float, tolerance: float) -> tuple[float, int]:
    """Return when a law or tyre first leaves its segment, and which; after the longest time none, -1."""
    at, which, own, reach = longest, -1, work.own, work.reach
    for i in range(reach.size):
        reach[i] = 0.0
    for k in range(terms, 0, -1):
        for i in range(reach.size):
            reach[i] = (reach[i] + abs(own[k, i])) * longest
    for i in range(reach.size):
        margin = margin_of(e, work, i)
        low, high = work.bounds[0, i] - margin, work.bounds[1, i] + margin
        if not low <= own[0, i] - reach[i] <= own[0, i] + reach[i] <= high:
            found = exit_of(own[:, i], terms, at, low, high, margin, margin * tolerance / _MARGIN)
            if found < at:
                at, which = found, i
    return at, which


@uncounted(error_model="numpy")
def exit_of(own: Real, terms: int, longest: float, low: float, high: float, margin: float, jump: float) -> float:
    """Return when a series leaves its bounds, at least the longest time if it does not.

    Safe steps: at a rate w and with a curvature of C at most, a distance d is not reached before the root of
    ``C s^2/2 + w s = d``; near a crossing this is Newton's method. A series that begins outside has left if it
    goes outwards, or is out by more than a `jump`.
    """
    bend, time = 0.0, 0.0
    for k in range(terms, 1, -1):
        bend = bend * longest + 2 * k * (k - 1) * abs(own[k])
    if own[0] > high:
        if own[1] > 0 or own[0] > high + jump:
            return 0.0
        high = own[0] + margin
    if own[0] < low:
        if own[1] < 0 or own[0] < low - jump:
            return 0.0
        low = own[0] - margin
    for _ in range(_ITERATIONS):
        value, rate = own[terms], 0.0
        for k in range(terms - 1, -1, -1):
            rate = rate * time + value
            value = value * time + own[k]
        above, below = high - value, value - low
        if (above < margin / 2 and rate > 0) or (below < margin / 2 and rate < 0):
            return time
        up = 2 * above / (rate + np.sqrt(rate**2 + bend * above)) if high < np.inf else np.inf
        down = 2 * below / (-rate + np.sqrt(rate**2 + bend * below)) if low > -np.inf else np.inf
        time += min(up, down)
        if not time < longest:
            return longest
    return time


@uncounted(error_model="numpy", forceinline=True)
def switch(e: Equations, numbers: Numbers, work: Work, terms: int, time: float, which: int) -> None:
    """Let laws and tyres that have left their segment at a time go on with the next.

    Beside the one that has left first these are all that are beyond, within the margin, and go outwards.
    """
    for i in range(work.segment.size):
        own, rate = work.own[terms, i], 0.0
        for k in range(terms - 1, -1, -1):
            rate = rate * time + own
            own = own * time + work.own[k, i]
        margin = margin_of(e, work, i) / 4
        if own > work.bounds[1, i] + margin and (i == which or rate > 0):
            work.segment[i] += 1
        elif own < work.bounds[0, i] - margin and (i == which or rate < 0):
            work.segment[i] -= 1
        else:
            continue
        bound(numbers, work, i)

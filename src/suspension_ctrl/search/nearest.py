"""Distances to nearest neighbours within a set of points, by sweeps along strips."""

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Integer, Real
from .sorting import lexicographic

_POINTS = 1.0  # in a strip, over the root of all


def nearest_others(points: Real) -> Real:
    """Return the distance (k,) of each point (n, m) to the nearest different one; copies of a point are one.

    Infinite of a single point. Strips are cut across the coordinate of the largest range and sorted along that of
    the next; of points on a curve or surface each meets few others.
    """
    if len(points) == 0:
        return np.empty(0)
    columns = np.ascontiguousarray(points.T)
    ranges = np.ptp(columns, axis=1)  # along rows of numbers side by side, in a tenth of the time
    widest = ranges.argmax()
    columns[[0, widest]], ranges[widest] = columns[[widest, 0]], ranges[0]
    second = 1 + ranges[1:].argmax() if len(ranges) > 1 else 0
    by_first, by_second = lexicographic(columns[:1]), lexicographic(columns[second : second + 1])
    squares = np.empty(len(points))
    _sweep(columns.T.copy(), second, by_first, by_second, max(1, round(_POINTS * len(points) ** 0.5)), squares)
    gaps = np.sqrt(squares)
    return gaps[gaps > 0]


@compiled()
def _sweep(points: Real, second: int, by_first: Integer, by_second: Integer, size: int, squares: Real) -> None:
    """Fill in the square (n,) of the distance of each point (n, m) to the nearest other, 0 if a copy comes later.

    `by_first` and `by_second` (n,) are orders along the coordinates 0 and `second`; strips have `size` points.
    """
    n = by_first.size
    strip, order, placed = np.empty(n, dtype=np.int64), np.empty(n, dtype=np.int64), np.empty_like(points)
    starts = np.arange(0, n, size)
    for place in range(n):
        strip[by_first[place]] = place // size
    filled = starts.copy()
    for i in by_second:
        place = filled[strip[i]]
        filled[strip[i]] = place + 1
        order[place] = i
        for k in range(points.shape[1]):
            placed[place, k] = points[i, k]
    low, high, near = points[by_first[starts], 0], points[by_first[filled - 1], 0], np.empty_like(starts)
    for s in range(starts.size):
        near[:] = starts
        for i in range(starts[s], filled[s]):
            best = _nearest(placed, second, i, starts[s], filled[s], i + 1, i - 1, np.inf)
            for step in (1, -1):
                t = s + step
                while 0 <= t < starts.size and best > 0.0 and _gap(placed[i, 0], low[t], high[t]) < best:
                    while near[t] < filled[t] and placed[near[t], second] < placed[i, second]:
                        near[t] += 1
                    best = _nearest(placed, second, i, starts[t], filled[t], near[t], near[t] - 1, best)
                    t += step
            squares[order[i]] = best


@uncounted()
def _gap(x: float, low: float, high: float) -> float:
    """Return the square of the distance of a number to an interval."""
    beyond = max(low - x, x - high, 0.0)
    return beyond * beyond


@uncounted()
def _nearest(points: Real, second: int, i: int, start: int, end: int, up: int, down: int, best: float) -> float:
    """Return the least square of the distance of point i to others of a strip, at most `best`; 0 of a later copy.

    The strip is from `start` to `end`, and looked through from `up` and `down` on in turn, as both come nearer.
    """
    y = points[i, second]
    while True:
        rises = up < end and (points[up, second] - y) ** 2 < best
        falls = down >= start and (points[down, second] - y) ** 2 < best
        if rises:
            best = _nearer(points, i, up, best)
            up += 1
        if falls:
            best = _nearer(points, i, down, best)
            down -= 1
        if not (rises or falls):
            return best


@uncounted()
def _nearer(points: Real, i: int, j: int, best: float) -> float:
    """Return the square of the distance of point i to point j, at most `best`; 0 if j is a later copy of it."""
    square = 0.0
    for k in range(points.shape[1]):
        square += (points[j, k] - points[i, k]) ** 2
    if square == 0.0:  # seldom; the minimum below is no branch, which a processor would guess wrong
        return 0.0 if j > i else best
    return min(best, square)

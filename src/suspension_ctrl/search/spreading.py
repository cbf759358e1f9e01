"""Points that cover a set evenly: repeatedly the one that is farthest from all chosen before.

T. F. Gonzalez, "Clustering to minimize the maximum intercluster distance", Theoretical Computer Science 38, 1985.
"""

import numpy as np
from scipy.spatial import cKDTree

from ..compiled import compilable, compiled
from ..quantities import Integer, Real

_BLOCK = 64  # points side by side, which are neighbours
_ROUNDING = 1 + 1e-9  # of a squared distance: far above 1e-15
_FEW, ONE_SET = 300_000, 3_000_000
"""Distances up to which nothing is compiled, which takes a second once: of sets that come again, and of one."""


def farthest_first(points: Real, start: Integer, size: int, few: int = _FEW) -> Integer:
    """Return the indices (size,) of finite points (n, m): those of `start`, then repeatedly the farthest point.

    Of equally distant ones it is the first; copies of chosen points come last.
    """
    return (by_points if size * len(points) <= few else by_blocks)(points, start, size)


def by_points(points: Real, start: Integer, size: int) -> Integer:
    """Return `farthest_first` by the distances of all points to each that is chosen."""
    columns, nearest = np.ascontiguousarray(points.T), np.full(len(points), np.inf)
    chosen = np.empty(size, dtype=np.int64)
    for i in range(size):
        chosen[i] = start[i] if i < start.size else nearest.argmax()
        squares = (columns - columns[:, chosen[i], np.newaxis]) ** 2
        np.minimum(nearest, squares.sum(axis=0), out=nearest)
        nearest[chosen[i]] = -1.0  # not chosen again, even if only copies are left
    return chosen


def by_blocks(points: Real, start: Integer, size: int) -> Integer:
    """Return `farthest_first` by the distances to blocks of neighbours, then to points of those in reach."""
    order = np.asarray(cKDTree(points, _BLOCK, compact_nodes=False, balanced_tree=False).indices, dtype=np.int64)
    place = np.empty_like(order)
    place[order] = np.arange(order.size)
    columns, firsts = np.ascontiguousarray(points[order].T), np.arange(0, order.size, _BLOCK)
    low, high = (bound.reduceat(columns, firsts, axis=1) for bound in (np.minimum, np.maximum))
    chosen = np.empty(size, dtype=np.int64)
    _choose(columns, order, low, high, place[start], chosen)
    return order[chosen]


@compiled()
def _choose(columns: Real, order: Integer, low: Real, high: Real, start: Integer, chosen: Integer) -> None:
    """Fill in the places `chosen` (size,) of `farthest_first`, of points (m, n) with indices `order` (n,).

    `low` and `high` (m, b) are bounds of blocks. A chosen point changes distances in a block only if it is nearer
    to them than the farthest point of the block to all that are chosen.
    """
    nearest, radius = np.full(order.size, np.inf), np.full(low.shape[1], np.inf)
    farthest = np.zeros(radius.size, dtype=np.int64)
    for i in range(chosen.size):
        chosen[i] = c = start[i] if i < start.size else farthest[_first_largest(radius, farthest, order)]
        nearest[c] = -1.0  # not chosen again, even if only copies are left
        for b in range(radius.size):
            if _square_to_box(columns, c, low, high, b) <= _ROUNDING * radius[b]:
                farthest[b] = _approach(columns, c, nearest, order, b * _BLOCK)
                radius[b] = nearest[farthest[b]]


@compilable()
def _first_largest(radius: Real, farthest: Integer, order: Integer) -> int:
    """Return the block of the farthest point, of equally distant ones that of the first."""
    best = 0
    for b in range(1, radius.size):
        if radius[b] > radius[best] or (radius[b] == radius[best] and order[farthest[b]] < order[farthest[best]]):
            best = b
    return best


@compilable()
def _square_to_box(columns: Real, c: int, low: Real, high: Real, b: int) -> float:
    """Return the squared distance of a point to the bounds of a block, 0 within them."""
    total = 0.0
    for k in range(columns.shape[0]):
        beyond = max(low[k, b] - columns[k, c], columns[k, c] - high[k, b], 0.0)
        total += beyond * beyond
    return total


@compilable()
def _approach(columns: Real, c: int, nearest: Real, order: Integer, first: int) -> int:
    """Update the squared distances of a block for a chosen point; return its farthest place."""
    best = first
    for place in range(first, min(first + _BLOCK, nearest.size)):
        total = 0.0
        for k in range(columns.shape[0]):
            total += (columns[k, place] - columns[k, c]) ** 2
        nearest[place] = min(nearest[place], total)
        if nearest[place] > nearest[best] or (nearest[place] == nearest[best] and order[place] < order[best]):
            best = place
    return best

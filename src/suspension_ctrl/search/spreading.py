"""Points that cover a set evenly: repeatedly the one that is farthest from all chosen before.

T. F. Gonzalez, "Clustering to minimize the maximum intercluster distance", Theoretical Computer Science 38, 1985.
"""

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Bool, Integer, Real
from .morton import along_curve

_BLOCK = 64  # points side by side, which are neighbours
_ROUNDING = 1 + 1e-9  # of a squared distance: far above 1e-15
FEW, ONE_SET = 300_000, 3_000_000
"""Distances up to which nothing is compiled, which takes a second once: of sets that come again, and of one."""


def farthest_first(points: Real, start: Integer, size: int, few: int = FEW) -> Integer:
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
    order = along_curve(points)
    blocks = np.pad(order, (0, -order.size % _BLOCK), mode="edge").reshape(-1, _BLOCK)
    columns = np.ascontiguousarray(np.ascontiguousarray(points.T)[:, blocks].transpose(1, 0, 2))
    nearest = np.full(blocks.shape, np.inf)
    nearest.flat[order.size :] = -1.0  # copies that fill up the last block
    place = np.empty_like(order)
    place[order] = np.arange(order.size)
    low, high = (np.ascontiguousarray(bound(columns, axis=2).T) for bound in (np.min, np.max))
    chosen = np.empty(size, dtype=np.int64)
    _choose(columns, blocks, low, high, nearest, place[start], chosen)
    return blocks.flat[chosen]


@compiled()
def _choose(
    columns: Real, order: Integer, low: Real, high: Real, nearest: Real, start: Integer, chosen: Integer
) -> None:
    """Fill in the places `chosen` (size,) of `farthest_first`, of blocks (b, m, _BLOCK) of points.

    `order` (b, _BLOCK) are the indices of the points, `nearest` (b, _BLOCK) the squares of their distances to what
    is chosen; `low` and `high` (m, b) are bounds of blocks. A chosen point changes distances in a block only if it
    is nearer to them than the farthest point of the block, or than that was when it was last looked for.
    """
    size = low.shape[1]
    radius, reach, squares = np.full(size, np.inf), np.empty(size), np.empty(_BLOCK)
    bits = radius.view(np.int64)
    farthest, known = np.zeros(size, dtype=np.int64), np.zeros(size, dtype=np.bool_)
    for i in range(chosen.size):
        c = start[i] if i < start.size else _farthest(nearest, order, radius, bits, farthest, known)
        chosen[i], block, place = c, c // _BLOCK, c % _BLOCK
        nearest[block, place] = -1.0  # not chosen again, even if only copies are left
        _to_boxes(columns, block, place, low, high, reach)
        for b in range(size):
            if reach[b] <= _ROUNDING * radius[b]:
                _approach(columns, block, place, b, squares, nearest)
                known[b] = False


@uncounted()
def _farthest(nearest: Real, order: Integer, radius: Real, bits: Integer, farthest: Integer, known: Bool) -> int:
    """Return the place of the farthest point, of equally distant ones the first.

    Blocks of which the farthest is not `known` are looked through while one of them may have it: what was farthest
    is no farther by now, and of equally distant points no later. `bits` are those of `radius`, which have the
    order of numbers that are not negative; whole numbers are compared in vectors.
    """
    while True:
        largest = bits[0]
        for b in range(bits.size):
            largest = max(largest, bits[b])
        best = -1
        for b in range(bits.size):
            if bits[b] == largest and (best < 0 or _index(order, farthest[b]) < _index(order, farthest[best])):
                best = b
        if known[best]:
            return farthest[best]
        place = 0
        for j in range(1, nearest.shape[1]):
            gap = nearest[best, j] - nearest[best, place]
            if gap > 0.0 or (gap == 0.0 and order[best, j] < order[best, place]):
                place = j
        farthest[best], radius[best], known[best] = best * _BLOCK + place, nearest[best, place], True


@uncounted()
def _index(order: Integer, place: int) -> int:
    """Return the index of the point at a place in blocks."""
    return order[place // _BLOCK, place % _BLOCK]


@uncounted()
def _to_boxes(columns: Real, block: int, place: int, low: Real, high: Real, squares: Real) -> None:
    """Put in the squared distances (b,) of a point to the bounds of blocks, 0 within them; in vectors."""
    for b in range(squares.size):
        squares[b] = 0.0
    for k in range(low.shape[0]):
        x = columns[block, k, place]
        for b in range(squares.size):
            beyond = max(max(low[k, b] - x, x - high[k, b]), 0.0)
            squares[b] += beyond * beyond


@uncounted()
def _approach(columns: Real, block: int, place: int, b: int, squares: Real, nearest: Real) -> None:
    """Lower the squared distances of a block to those to a chosen point; `squares` is work space. In vectors."""
    for j in range(squares.size):
        squares[j] = 0.0
    for k in range(columns.shape[1]):
        x = columns[block, k, place]
        for j in range(squares.size):
            beyond = columns[b, k, j] - x
            squares[j] += beyond * beyond
    for j in range(squares.size):
        nearest[b, j] = min(nearest[b, j], squares[j])

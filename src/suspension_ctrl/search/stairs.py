"""Non-dominated points of up to three objectives and the volume that they dominate, in one sweep.

C. M. Fonseca, L. Paquete, M. Lopez-Ibanez, "An improved dimension-sweep algorithm for the hypervolume indicator",
IEEE CEC 2006.
"""

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Bool, Integer, Real
from .bits import Words, above, below, empty_set, put, take
from .selection import lexicographic

MOST = 3
"""Largest number of objectives."""


def swept(objectives: Real, lengths: Real) -> tuple[Bool, float]:
    """Return a mask (n,) of the rows of objectives (n, m <= `MOST`) that no other dominates, and their volume.

    `lengths` (n, m) are the distances of objectives to the corner up to which volume counts, 0 of those beyond it.
    Copies of a point are all in the mask.
    """
    best = np.empty(len(objectives), dtype=np.bool_)
    if best.size == 0:
        return best, 0.0
    columns, sides = _three(objectives, 0.0), _three(lengths, 1.0)
    order, levels = lexicographic(columns), lexicographic(columns[[1, 2, 0]])
    return best, _sweep(columns, sides, order, levels, *empty_set(order.size), best)


def _three(points: Real, filling: float) -> Real:
    """Return points (n, m) as three columns (3, n)."""
    columns = np.full((MOST, len(points)), filling)
    columns[: points.shape[1]] = points.T
    return columns


@compiled()
def _sweep(
    columns: Real, sides: Real, order: Integer, levels: Integer, words: Words, starts: Integer, best: Bool
) -> float:
    """Fill in which points (3, n) no other dominates, return their volume.

    They are taken in `order` (n,), by their first objective. Those so far that no other beats in the second and
    third are stairs, a set of places in `levels` (n,), the order by the second: the higher, the less the third.
    """
    level, volume, last = np.empty(order.size, dtype=np.int64), 0.0, -1
    for place in range(order.size):
        level[levels[place]] = place
    for i in order:
        if last >= 0 and _same(columns, i, last):
            best[i] = best[last]
            continue
        last, before = i, below(words, starts, level[i])
        best[i] = before < 0 or columns[2, levels[before]] > columns[2, i]
        if best[i]:
            side = sides[2, levels[before]] if before >= 0 else 0.0
            volume += sides[0, i] * _step(columns, sides, levels, words, starts, level[i], side)
    return volume


@uncounted()
def _same(columns: Real, i: int, j: int) -> bool:
    """Whether two points are copies."""
    return columns[0, i] == columns[0, j] and columns[1, i] == columns[1, j] and columns[2, i] == columns[2, j]


@uncounted()
def _step(
    columns: Real, sides: Real, levels: Integer, words: Words, starts: Integer, place: int, covered: float
) -> float:
    """Put a stair in at a place, take out those that it covers, and return the area that it adds.

    `covered` is the side along the third objective of the stair before, which dominates the area up to there.
    """
    i, area = levels[place], 0.0
    side = sides[1, i]
    put(words, starts, place)
    while True:
        after = above(words, starts, place)
        rest = sides[1, levels[after]] if after >= 0 else 0.0
        area += (sides[2, i] - covered) * (side - rest)
        if after < 0 or columns[2, levels[after]] < columns[2, i]:
            return area
        side, covered = rest, sides[2, levels[after]]
        take(words, starts, after)

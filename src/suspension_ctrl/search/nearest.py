"""Distances to nearest neighbours within a set of points, by a sweep along one coordinate."""

import numpy as np

from ..compiled import compiled
from ..quantities import Real


def nearest_others(points: Real) -> Real:
    """Return the distance (k,) of each point (n, m) to the nearest different one; copies of a point are one.

    Infinite of a single point. The sweep takes n^1.5 steps where the points lie on a surface, n on a curve.
    """
    if len(points) == 0:
        return np.empty(0)
    along = np.ptp(points, axis=0).argmax()
    order = np.argsort(points[:, along], kind="stable")
    columns = np.ascontiguousarray(points[order].T)
    columns[[0, along]] = columns[[along, 0]]
    squares = np.empty(len(points))
    _sweep(columns, squares)
    gaps = np.empty_like(squares)
    gaps[order] = np.sqrt(squares)
    return gaps[gaps > 0]


@compiled()
def _sweep(columns: Real, squares: Real) -> None:
    """Fill in the square (n,) of the distance of each point (m, n), by its first coordinate, to the nearest other.

    It is 0 of a point with a copy behind it.
    """
    n = columns.shape[1]
    for i in range(n):
        best = np.inf
        for step in (1, -1):
            j = i + step
            while 0 <= j < n and best > 0.0:
                square = (columns[0, j] - columns[0, i]) ** 2
                if square >= best:
                    break
                for k in range(1, columns.shape[0]):
                    square += (columns[k, j] - columns[k, i]) ** 2
                if square < best and (square > 0.0 or step == 1):
                    best = square
                j += step
        squares[i] = best

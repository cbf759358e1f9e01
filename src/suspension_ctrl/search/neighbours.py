"""Neighbourhoods of MOEA/D: the nearest weight vectors of each."""

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..quantities import Bool, Integer, Real
from .decomposition import weight_vectors

_ROWS = 32  # of the distance matrix at a time: they stay in the processor's cache
_NETWORK = 256  # most integers that numpy sorts by a network
_FLAT = 3  # objectives up to which weights lie in a plane, where blocks of them have few candidates
_ASPECT = 1.22  # height of the triangle of weights in roots of its area, about; 1.32 if it is regular
_MARGIN = 6  # of the radius of the candidates of a block over that of a neighbourhood, in distances of weights


@lru_cache
def neighbourhoods(size: int, objectives: int, neighbours: int) -> Integer:
    """Return the indices (N, T), read-only, of the T nearest `weight_vectors` of each, itself first.

    Blocks of weights that lie together are compared with those nearest to their middle alone; the few weights to
    which others may be nearer are compared with all.
    """
    weights = weight_vectors(size, objectives)
    keys, everyone = Keys.of(weights), np.arange(size)
    nearest = np.empty((size, neighbours), dtype=np.int64)
    left = everyone
    if objectives <= _FLAT:
        order = winding(weights)
        count = min(size, int((np.sqrt(neighbours) + _MARGIN) ** 2))
        settled = [settle(rows, keys, count, nearest) for rows in blocks(order)]
        left = order[~np.concatenate(settled)]
    for rows in blocks(left):
        nearest[rows] = least(keys.between(rows, everyone), neighbours)
    nearest &= keys.low
    nearest.flags.writeable = False
    return nearest


class Keys(NamedTuple):
    """Sort keys of distances between points: the bits of 1 + |a - b|^2, the last of them replaced by b's index.

    Positive floats order like their bits, and the last bits are below the accuracy needed: one sort of integers
    gives the neighbours. The squares are a product of matrices.
    """

    left: Real  # (N, m + 2)
    right: Real  # (m + 2, N)
    low: int  # mask of the bits of an index

    @classmethod
    def of(cls, points: Real) -> "Keys":
        """Return the keys of points (N, m)."""
        squares, ones = (points**2).sum(axis=1), np.ones(len(points))
        left = np.column_stack([-2 * points, ones, 1 + squares])
        return cls(left, np.stack([*points.T, squares, ones]), (1 << (len(points) - 1).bit_length()) - 1)

    def between(self, rows: Integer, columns: Integer) -> Integer:
        """Return the keys (k, n) of points by their indices."""
        keys: Integer = (self.left[rows] @ self.right.take(columns, axis=1)).view(np.int64)
        keys &= ~self.low
        keys |= columns
        return keys


def winding(points: Real) -> Integer:
    """Return an order (N,) of points (N, m) in which those that lie together mostly follow one another.

    It winds through strips of equal width along the first coordinate, forwards and backwards by the second. Strips
    of equal counts would be thick at the tip of a triangle of weights, and blocks there thin slices across them.
    """
    along = points[:, 0] - points[:, 0].min()
    strips = max(1, round(_ASPECT * np.sqrt(len(points) / _ROWS)))
    strip = np.minimum((along * (strips / along.max())).astype(np.int64), strips - 1)
    return np.lexsort((np.where(strip % 2, -points[:, 1], points[:, 1]), strip))


def blocks(indices: Integer) -> Iterator[Integer]:
    """Yield the indices (n,) in blocks."""
    for first in range(0, len(indices), _ROWS):
        yield indices[first : first + _ROWS]


def settle(rows: Integer, keys: Keys, count: int, nearest: Integer) -> Bool:
    """Put keys of the nearest of `count` candidates into `nearest` (N, T); return which rows (k,) that settles.

    Candidates are the points nearest to the middle of the rows. Any other point is farther from a row than their
    radius less the distance of the row from the middle.
    """
    mean = keys.left[rows].mean(axis=0)  # of the middle, but for a constant
    squares = mean @ keys.right - (mean[-1] - mean[:-2] @ mean[:-2] / 4)
    candidates = np.argpartition(squares, count - 1)[:count]
    radius = np.inf if count == squares.size else np.sqrt(squares[candidates[-1]])
    found = np.sort(keys.between(rows, candidates), axis=1)[:, : nearest.shape[1]]
    nearest[rows] = found
    reach = np.maximum(np.stack([found[:, -1].view(float) - 1, squares[rows]]), 0)
    return np.asarray(np.sqrt(reach).sum(axis=0) < radius)


def least(keys: Integer, count: int) -> Integer:
    """Return the `count` least keys of each row (k, n), ascending.

    Numpy sorts up to 256 integers by a network of instructions without branches, and is several times slower with
    more: parts of a row are sorted, and the first of each sorted again. That is checked, as keys may lie unevenly.
    """
    rows, n = keys.shape
    parts = -(-n // _NETWORK)
    width, share = -(-n // parts), count / parts
    first = int(share + 4 * np.sqrt(share)) + 2
    if first > width // 2:
        return np.sort(np.partition(keys, count - 1, axis=1)[:, :count], axis=1)
    ordered = np.full((rows, parts * width), np.iinfo(np.int64).max)
    ordered[:, :n] = keys
    ordered = np.sort(ordered.reshape(rows, parts, width), axis=2)
    few = ordered[:, :, :first].reshape(rows, parts * first)
    found = np.sort(np.partition(few, count - 1, axis=1)[:, :count], axis=1)
    short = ordered[:, :, first].min(axis=1) < found[:, -1]
    found[short] = np.sort(keys[short], axis=1)[:, :count]
    return found

"""How far a set of points falls short of each point of a reference front: what IGD+ and epsilon are made of."""

from dataclasses import dataclass
from itertools import count
from math import gcd, inf
from typing import NamedTuple

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Integer, Real

_BLOCK = 32  # points of a front side by side, in vectors
_EACH = 16  # points that come near a block, after which what is out of reach is looked up anew


class Shortfall(NamedTuple):
    """What a set of points lacks to each point of a front, (b, `_BLOCK`) in the blocks of `Goals`."""

    squares: Real  # of the distance d+ of the nearest to all that is no worse than a point of the front
    shifts: Real  # by which the best weakly dominates a point of the front
    order: Integer  # of the points of the front; the last block repeats one

    @property
    def igd_plus(self) -> float:
        """Mean distance d+, summed in the order of the front."""
        distances = np.empty(self.order.max() + 1)
        distances[self.order] = np.sqrt(self.squares)
        return float(distances.mean())

    @property
    def epsilon(self) -> float:
        """Largest shift."""
        return float(self.shifts.max())


@dataclass(frozen=True, eq=False)
class Goals:
    """The points of a front in blocks of neighbours, of which those out of reach of a point are passed by."""

    order: Integer  # (b, _BLOCK)
    blocks: Real  # (b, m, _BLOCK)
    worst: Real  # (b, m) largest of each objective

    @classmethod
    def of(cls, front: Real) -> "Goals":
        """Return the points of a front (r, m)."""
        order = np.concatenate(_halves(front, np.arange(len(front))))
        order = np.pad(order, (0, -order.size % _BLOCK), mode="edge").reshape(-1, _BLOCK)
        blocks = np.ascontiguousarray(front[order].transpose(0, 2, 1))
        return cls(order, blocks, blocks.max(axis=2))

    def shortfall(self, points: Real, before: Shortfall | None = None) -> Shortfall:
        """Return the shortfall of points (n, m), together with those of the shortfall `before`."""
        squares, shifts = np.full((2, *self.order.shape), inf) if before is None else np.stack(before[:2])
        if len(points):
            mixed = np.ascontiguousarray(points.T)[:, _mixed(len(points))]
            _lower(self.blocks, self.worst, mixed, squares, shifts)
        return Shortfall(squares, shifts, self.order)


def _mixed(n: int) -> Integer:
    """Return an order (n,) by steps of a golden section, in which the first of sorted points are everywhere."""
    step = next(step for step in count(int(n * (5**0.5 - 1) / 2) + 1) if gcd(step, n) == 1)
    return step * np.arange(n) % n


def _halves(front: Real, chosen: Integer) -> list[Integer]:
    """Return chosen points of a front (r, m), halved across their widest objective down to blocks."""
    if len(chosen) <= _BLOCK:
        return [chosen]
    values = front[chosen]
    middle = -(-len(chosen) // _BLOCK) // 2 * _BLOCK
    order = chosen[np.argpartition(values[:, np.ptp(values, axis=0).argmax()], middle)]
    return [*_halves(front, order[:middle]), *_halves(front, order[middle:])]


@compiled()
def _lower(blocks: Real, worst: Real, points: Real, squares: Real, shifts: Real) -> None:
    """Lower squares and shifts (b, _BLOCK) of blocks (b, m, _BLOCK) to those of points (m, n).

    Those to the worst corner of a block are less than those to its points. Rounding keeps the order of numbers, so
    that squares and shifts are those without blocks, bit by bit.
    """
    n = points.shape[1]
    least, shift, some = np.empty(n), np.empty(n), np.empty((2, _BLOCK))
    for b in range(worst.shape[0]):
        _to_corner(points, worst, b, least, shift)
        square, most, count = _largest(squares, b), _largest(shifts, b), 0
        for i in range(n):
            if least[i] < square or shift[i] < most:
                _approach(blocks, points, b, i, some, squares, shifts)
                count += 1
                if count % _EACH == 1:
                    square, most = _largest(squares, b), _largest(shifts, b)


@uncounted()
def _to_corner(points: Real, worst: Real, b: int, squares: Real, shifts: Real) -> None:
    """Put in square and shift (n,) of each point to the worst corner of a block; in vectors."""
    for i in range(squares.size):
        squares[i], shifts[i] = 0.0, -np.inf
    for k in range(points.shape[0]):
        corner = worst[b, k]
        for i in range(squares.size):
            beyond = points[k, i] - corner
            shifts[i] = max(shifts[i], beyond)
            squares[i] += max(beyond, 0.0) * max(beyond, 0.0)


@uncounted(fastmath={"nnan", "nsz"})
def _largest(values: Real, b: int) -> float:
    """Return the largest value of a block."""
    largest = values[b, 0]
    for r in range(values.shape[1]):
        largest = max(largest, values[b, r])
    return largest


@uncounted()
def _approach(blocks: Real, points: Real, b: int, i: int, some: Real, squares: Real, shifts: Real) -> None:
    """Lower squares and shifts of a block to those of a point; `some` is work space."""
    for r in range(squares.shape[1]):
        some[0, r], some[1, r] = 0.0, -np.inf
    for k in range(blocks.shape[1]):
        x = points[k, i]
        for r in range(squares.shape[1]):
            beyond = x - blocks[b, k, r]
            some[1, r] = max(some[1, r], beyond)
            some[0, r] += max(beyond, 0.0) * max(beyond, 0.0)
    for r in range(squares.shape[1]):
        squares[b, r] = min(squares[b, r], some[0, r])
        shifts[b, r] = min(shifts[b, r], some[1, r])

"""Halton's sequence: points that fill a cube evenly, however many are taken.

`scipy.stats.qmc` has it too, and takes a quarter of a second to import.
"""

from itertools import count, islice
from math import isqrt

import numpy as np

from ..quantities import Real


def halton(points: int, d: int) -> Real:
    """Return the first points (points, d) of the sequence in the unit cube, of each coordinate in a prime base.

    J. H. Halton, "On the efficiency of certain quasi-random sequences of points", Numerische Mathematik 2, 1960.
    """
    found = np.empty((points, d))
    for column, base in zip(found.T, islice(filter(_is_prime, count(2)), d), strict=True):
        column[:] = _mirrored(base, points)
    return found


def _mirrored(base: int, points: int) -> Real:
    """Return the numbers 0, 1, ... (points,) with their digits mirrored at the point."""
    found, left, place = np.zeros(points), np.arange(points), 1.0
    while left.any():
        place /= base
        found += place * (left % base)
        left //= base
    return found


def _is_prime(n: int) -> bool:
    return all(n % divisor for divisor in range(2, isqrt(n) + 1))

"""Order of points in which neighbours mostly follow one another, along Morton's curve.

G. M. Morton, "A computer oriented geodetic data base and a new technique in file sequencing", IBM, 1966.
"""

import numpy as np

from ..quantities import Integer, Real

_BITS = 16  # of a key: numpy sorts such whole numbers by their digits


def along_curve(points: Real) -> Integer:
    """Return the indices (n,) of finite points (n, m) along the curve through equal cells of their box.

    The bits of a cell's place along the coordinates, in turn, are its key; beyond 16 coordinates none counts.
    """
    m = min(points.shape[1], _BITS)
    bits = _BITS // m
    key = np.zeros(len(points), dtype=np.uint16)
    for k, column in enumerate(points.T[:m]):
        place = _places(column, 1 << bits)
        for bit in range(bits):
            key |= (place >> bit & 1) << (bit * m + k)
    return np.argsort(key, kind="stable")


def _places(values: Real, cells: int) -> "np.ndarray[tuple[int, ...], np.dtype[np.uint16]]":
    """Return the cells (n,) of values, from 0, of so many equal ones between the least and the largest."""
    least, span = values.min(initial=np.inf), np.ptp(values) if values.size else 0.0
    shares = (values - least) / (span if span > 0 else 1.0)
    return np.minimum(shares * cells, cells - 1).astype(np.uint16)

"""Integrals over frequency as weighted sums: Gauss-Legendre nodes in the square root of frequency."""

from collections.abc import Iterable
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.special import roots_legendre

from .. import checks
from ..quantities import Real
from .lanes import WIDTH

_PARTS = 1000
_LEAST = 16  # nodes of a panel for 1e-9 beside a slow pole, K/C of a soft and heavily damped strut


_legendre = lru_cache(maxsize=32)(roots_legendre)  # 8,192 nodes take most of a second


class Rule(NamedTuple):
    """Nodes and weights of a quadrature over frequency."""

    f: Real  # (n,) [Hz], ascending
    w: Real  # (n,)


def frequency_nodes(band: tuple[float, float], nodes: int, breakpoints: Iterable[float] = ()) -> Rule:
    """Return ascending nodes f [Hz] and weights w: ``(g(f) * w).sum()`` is the integral of g over the band.

    In u = sqrt(f) the spectrum of a road is rational: Gauss-Legendre quadrature converges geometrically.
    Kinks of the integrand, `breakpoints` [Hz], divide the band into panels, which share the nodes evenly.
    """
    checks.interval("band", band, "Hz")
    low, high = band
    checks.at_least("nodes", nodes, 2)
    edges = np.sqrt([low, *(f for f in sorted(breakpoints) if low < f < high), high])
    panels = edges.size - 1
    x, w = _legendre(nodes if panels == 1 else max(_LEAST, -(-nodes // panels)))
    f, weight = zip(*(_panel(x, w, start, end) for start, end in pairwise(edges)), strict=True)
    return Rule(np.concatenate(f), np.concatenate(weight))


def _panel(x: Real, w: Real, start: float, end: float) -> tuple[Real, Real]:
    """Gauss-Legendre nodes x and weights w of (-1, 1), carried to u in (start, end) and on to f = u^2."""
    half = (end - start) / 2
    u = start + half * (1 + x)
    return u**2, w * half * 2 * u  # df = 2 u du


def in_lanes(f: Real, w: Real, densities: Real) -> tuple[Real, Real, Real]:
    """Return nodes f (n,) [Hz] with weights (n,) and densities (k, n), filled up to an odd number of eights.

    What is added has no weight. Rows as long as a power of two would share a few lines of the processor's cache.
    """
    more = (WIDTH - f.size) % (2 * WIDTH)
    nothing = np.zeros((len(densities), more))
    weights = np.concatenate([w, np.zeros(more)])
    return np.concatenate([f, np.full(more, f[-1])]), weights, np.concatenate([densities, nothing], axis=1)


def middles(band: tuple[float, float]) -> Real:
    """Return the middles (1000,) of equal parts of a band, in which a user's own measure gets spectra [Hz]."""
    low, high = band
    return low + (high - low) * (np.arange(_PARTS) + 0.5) / _PARTS

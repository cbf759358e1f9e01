"""Spectra estimated from histories by Welch's method, and their mean squares in bands with intervals."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real

_LINES, _LONG = 4, 20.0  # lines in the narrowest band; s, resolves a resonance at 1 Hz with damping ratio 0.1
_LEAST, _SEGMENTS = 1.5, 8  # lines in the narrowest band, and lengths of a segment in a history, at least
_OVERLAP = 1 / 36  # squared correlation of segments under Hann's window that overlap by half


class Estimate(NamedTuple):
    """One-sided spectra (k, m) at lines (k,) [Hz] of histories that last some time [s], a mean of periodograms."""

    f: Real
    psd: Real
    duration: float = np.inf
    averages: float = np.inf  # independent periodograms to which those of overlapping segments are equal


def third_octaves(band: tuple[float, float]) -> Real:
    """Return the edges (b + 1,) of the bands of IEC 61260-1, base ten, with middles in a band [Hz]."""
    checks.interval("band", band, "Hz")
    checks.positive("lower end of band", band[0], "Hz")
    first, last = (10 * np.log10(end) for end in band)
    middles = np.arange(np.ceil(first - 0.05), np.floor(last + 0.05) + 1)
    if not middles.size:
        raise ValueError(f"band must hold the middle of a third octave, got {checks.shown(band)}")
    return np.asarray(10 ** (np.append(middles - 0.5, middles[-1] + 0.5) / 10))


def welch(values: Real, time_step: float, edges: Real, segment: float | None = None) -> Estimate:
    """Return the spectra of histories (n, m) by segments that overlap by half, without means, by Hann's window.

    The `segment` [s] has four lines in the narrowest band and lasts 20 s, but an eighth of the history at most.
    """
    from scipy import signal

    duration, narrowest = len(values) * time_step, float(np.diff(edges).min())
    if edges[-1] > 0.5 / time_step:
        raise ValueError(f"time must have steps of {0.5 / edges[-1]:.4g} s at most, got {time_step:.4g} s")
    if segment is None:
        segment = min(max(_LINES / narrowest, _LONG), duration / _SEGMENTS)
        if segment < _LEAST / narrowest * (1 - 1e-9):
            needed = f"{_SEGMENTS * _LEAST / narrowest:.4g} s for a band of {narrowest:.3g} Hz"
            raise ValueError(f"time must last {needed}, got {duration:.4g} s")
    checks.within("segment", segment, 8 * time_step, duration * (1 + 1e-9))
    points = min(round(segment / time_step), len(values))
    f, psd = signal.welch(values, 1 / time_step, nperseg=points, axis=0)
    k = max(1, (len(values) - points // 2) // (points - points // 2))
    return Estimate(f, psd, duration, k / (1 + 2 * _OVERLAP * (k - 1) / k))


def mean_squares(f: Real, psd: Real, edges: Sequence[float] | Real) -> Real:
    """Return the mean squares (b, m) in bands of spectra (k, m) that are straight between lines (k,)."""
    if not f[0] <= edges[0] <= edges[-1] <= f[-1]:
        got = f"{f[0]:.4g} to {f[-1]:.4g} Hz"
        raise ValueError(f"spectra must reach from {edges[0]:.4g} to {edges[-1]:.4g} Hz, got {got}")
    found = []
    for low, high in pairwise(edges):
        at = np.concatenate([[low], f[(f > low) & (f < high)], [high]])
        between = np.stack([np.interp(at, f, one) for one in psd.T], axis=-1)
        found.append(np.trapezoid(between, at, axis=0))
    return np.array(found)


def intervals(estimate: Estimate, edges: Real, share: float = 0.95) -> Real:
    """Return the limits (2, b, m), relative to an estimated mean square, between which the true one lies.

    A mean square in a band is chi-square distributed with 2 T (int S df)^2/int S^2 df degrees of freedom, at
    least those of one line; the mean of an estimated S^2 is 1 + 1/K times S^2 with K independent periodograms.
    Beyond the lines of one segment it is unknown.
    """
    from scipy import stats

    if not np.isfinite(estimate.duration):
        return np.full((2, len(edges) - 1, estimate.psd.shape[1]), np.nan)
    whole, squares = (mean_squares(estimate.f, estimate.psd**power, edges) for power in (1, 2))
    free = (
        2 * estimate.duration * whole**2 / np.maximum(squares, np.finfo(float).tiny) * (1 + 1 / estimate.averages)
    )
    free = np.maximum(free, 2 * estimate.averages)
    tail = (1 - share) / 2
    return np.array([free / stats.chi2.ppf(1 - tail, free), free / stats.chi2.ppf(tail, free)])

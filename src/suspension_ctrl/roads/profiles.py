"""Profiles: the elevation of one or several tracks along the road, as realised from a spectrum or measured."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks
from .coherence import Coherence, Surface, coherence_matrix

_CLOSEST = 1e-6
"""Least mean distance between two points [m]."""
UNEVEN = 0.01
"""What the distance between two points may differ from the mean by, as a part of it."""


class SpectralRoad(Surface, Protocol):
    """What a realisation needs of a road: its spectrum and the coherence of its tracks."""

    @property
    def coherence(self) -> Coherence:
        """Model of coherence."""

    def psd(self, f: ArrayLike, speed: float) -> NDArray[np.float64]:
        """Return the spectrum (n,) [m^2/Hz] at the frequencies `f` (n,) [Hz] at a speed [m/s]."""


@dataclass(frozen=True, eq=False)
class Profile:
    """Elevation of tracks along the road, at even distances.

    Parameters
    ----------
    distance : (n,) array_like
        Ascending [m]; steps may differ from their mean, a micrometre at least, by 1 % of it.
    height : (n, tracks) array_like
        Elevation of each track [m].
    tracks : (tracks,) sequence of float
        Where each track is across the road, positive to the left [m].

    Raises
    ------
    ValueError
        If the shapes do not fit, a number is not finite, the distances are uneven or there are less than two.
    """

    distance: NDArray[np.float64]
    height: NDArray[np.float64]
    tracks: tuple[float, ...] = (0.0,)

    def __post_init__(self) -> None:
        distance, height = np.array(self.distance, dtype=float), np.array(self.height, dtype=float)
        tracks = np.array(self.tracks, dtype=float)
        if distance.ndim != 1 or tracks.ndim != 1 or height.shape != (distance.size, tracks.size):
            raise ValueError(
                f"height must have the shape (distances, tracks), got {height.shape} for {distance.shape} "
                f"and {tracks.shape}"
            )
        if distance.size < 2 or tracks.size < 1:
            raise ValueError(f"a profile must have two points and a track, got shape {height.shape}")
        for name, values in (("distance", distance), ("height", height), ("tracks", tracks)):
            if not np.isfinite(values).all():
                raise ValueError(f"{name} must be finite, got {values[~np.isfinite(values)][0]}")
            values.flags.writeable = False
        _check_even(distance)
        object.__setattr__(self, "distance", distance)
        object.__setattr__(self, "height", height)
        object.__setattr__(self, "tracks", tuple(tracks.tolist()))

    @property
    def step(self) -> float:
        """Mean distance between two points [m]."""
        return float(self.distance[-1] - self.distance[0]) / (self.distance.size - 1)

    def at(self, distance: ArrayLike) -> NDArray[np.float64]:
        """Return the elevation of every track at any distances, straight between the points.

        Parameters
        ----------
        distance : (k,) array_like
            Within those of the profile [m].

        Returns
        -------
        (k, tracks) ndarray
            Elevation [m].

        Raises
        ------
        ValueError
            If a distance lies outside the profile.
        """
        where = np.atleast_1d(np.asarray(distance, dtype=float))
        first, last = self.distance[[0, -1]].tolist()
        outside = ~((where >= first) & (where <= last))
        if outside.any():
            raise ValueError(f"distance must lie from {first:g} to {last:g} m, got {where[outside][0]}")
        return np.stack([np.interp(where, self.distance, track) for track in self.height.T], axis=-1)


def realisation(
    road: SpectralRoad, length: float, step: float, seed: int | np.random.Generator, tracks: Sequence[float]
) -> Profile:
    """Return a Gaussian profile with the road's spectrum and, between tracks, its coherence.

    A sum of waves of the wavenumbers k/length below 1/(2 step), k = 1, 2, ..., with amplitudes drawn at random
    so that the expectation of the periodogram at each is the road's spectrum. The profile has the period `length`
    and no mean.

    Parameters
    ----------
    road : SpectralRoad
        The road.
    length : float
        Length of the road, a whole number of steps [m].
    step : float
        Distance between two points [m].
    seed : int or numpy.random.Generator
        Where the random numbers come from.
    tracks : (t,) sequence of float
        Where each track is across the road, positive to the left [m].

    Returns
    -------
    Profile
        At the distances 0, step, ... below `length`.

    Raises
    ------
    ValueError
        If `length` is not a whole number of at least four steps, or as the road's `psd` and coherence raise.
    """
    checks.positive("step", step, "m")
    checks.positive("length", length, "m")
    y = np.asarray(tracks, dtype=float)
    if y.ndim != 1 or y.size == 0 or not np.isfinite(y).all():
        raise ValueError(f"tracks must be finite and one-dimensional, got {tracks!r}")
    points = round(length / step)
    if points < 4 or abs(length / step - points) > 1e-6:
        raise ValueError(f"length must be a whole number of steps of {step} m, four at least, got {length} m")
    n = np.arange(1, (points + 1) // 2) / length
    amplitude = points / 2 * np.sqrt(road.psd(n, 1.0) / length)  # of the real and of the imaginary part
    waves = np.zeros((points // 2 + 1, y.size), dtype=complex)
    waves[1 : n.size + 1] = amplitude[:, None] * _alike(road, n, y, np.random.default_rng(seed))
    return Profile(step * np.arange(points, dtype=float), np.fft.irfft(waves, points, axis=0), tuple(y.tolist()))


def _alike(
    road: SpectralRoad, n: NDArray[np.float64], y: NDArray[np.float64], rng: np.random.Generator
) -> NDArray[np.complex128]:
    """Complex normal numbers (n, t), variance one per part, whose covariance over t is the tracks' coherence."""
    independent = rng.standard_normal((n.size, y.size)) + 1j * rng.standard_normal((n.size, y.size))
    variance, direction = np.linalg.eigh(coherence_matrix(road.coherence, n, y, road))
    scaled = independent * np.sqrt(np.maximum(variance, 0.0))
    return np.einsum("nij,nj->ni", direction, scaled)


def _check_even(distance: NDArray[np.float64]) -> None:
    steps = np.diff(distance)
    mean = (distance[-1] - distance[0]) / steps.size
    if not (steps > 0).all():
        raise ValueError(f"distance must ascend, got {distance[np.argmax(~(steps > 0)) + 1]} out of order")
    if mean < _CLOSEST:
        raise ValueError(f"distance must have steps of {_CLOSEST:g} m at least, got {mean:g} m")
    worst = int(np.abs(steps - mean).argmax())
    if not abs(steps[worst] - mean) <= UNEVEN * mean:
        raise ValueError(
            f"distance must be even, each step within {UNEVEN:.0%} of the mean {mean:g} m, "
            f"got {steps[worst]:g} m after {distance[worst]:g} m"
        )

"""Profiles: the elevation of one or several tracks along the road, realised from a spectrum or measured."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, Record, frozen_array, unit

UNEVEN = 0.01  # largest deviation of a step from the mean step, relative
_CLOSEST = 1e-6  # m, least mean distance between two points
_FINER = 4  # most points of an even profile for each of an uneven one


@dataclass(frozen=True, eq=False, repr=False)
class Profile(Record):
    """Elevation of tracks along the road, at even distances.

    Parameters
    ----------
    distance : (n,) array_like
        Two or more, ascending [m]. Steps differ from their mean by at most 1 %; the mean is at least 1 micrometre.
    height : (n, tracks) array_like
        Elevation of each track, finite [m].
    tracks : (tracks,) sequence of float
        Place of each track across the road, positive to the left [m].

    Examples
    --------
    A bump of half a sine, 3.7 m long and 0.1 m high, at 5 m/s:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> distance = np.arange(0.0, 40.0, 0.05)  # m
    >>> place = distance - 21.85  # from the middle of the bump
    >>> height = np.where(abs(place) < 1.85, 0.1 * np.cos(np.pi * place / 3.7), 0.0)
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> history = sc.simulate(car.vehicle, car.setting, sc.Profile(distance, height[:, None]), speed=5.0)
    >>> travel = 1e3 * history["suspension_travel [m]"]
    >>> print(f"compression {-travel.min():.0f} mm, rebound {travel.max():.0f} mm")
    compression 52 mm, rebound 50 mm
    """

    distance: Real = field(metadata=unit("m"))
    height: Real = field(metadata=unit("m"))
    tracks: tuple[float, ...] = field(default=(0.0,), metadata=unit("m"))

    def __post_init__(self) -> None:
        distance, height = frozen_array(self.distance), frozen_array(self.height)
        tracks = np.array(self.tracks, dtype=float)
        if distance.ndim != 1 or tracks.ndim != 1 or height.shape != (distance.size, tracks.size):
            got = f"{height.shape} for {distance.shape} and {tracks.shape}"
            raise ValueError(f"height must have the shape (distances, tracks), got {got}")
        if distance.size < 2 or tracks.size < 1:
            raise ValueError(f"a profile must have two points and a track, got shape {height.shape}")
        for name, values in (("distance", distance), ("height", height), ("tracks", tracks)):
            if not np.isfinite(values).all():
                raise ValueError(f"{name} must be finite, got {values[~np.isfinite(values)][0]}")
        _check_even(distance)
        self._keep(distance=distance, height=height, tracks=tuple(tracks.tolist()))

    @classmethod
    def from_uneven(cls, distance: ArrayLike, height: ArrayLike, tracks: Sequence[float] = (0.0,)) -> "Profile":
        """Return a profile of points at uneven distances (n,), straight between them.

        The even step is the mean step over the least whole number that makes it no longer than the shortest step,
        four at most.
        """
        x, h = np.asarray(distance, dtype=float), np.asarray(height, dtype=float)
        if x.ndim != 1 or x.size < 2 or h.shape != (x.size, len(tracks)):
            got = f"{h.shape} for {x.shape} and {len(tracks)}"
            raise ValueError(f"height must have the shape (distances, tracks), got {got}")
        mean = _check_ascending(x)
        finer = min(math.ceil(mean / float(np.diff(x).min()) * (1 - UNEVEN)), _FINER)
        even = np.linspace(x[0], x[-1], (x.size - 1) * finer + 1)
        return cls(even, np.stack([np.interp(even, x, one) for one in h.T], axis=1), tuple(tracks))

    def averaged(self, contact_length: float) -> "Profile":
        """Return the profile under a tyre that averages over a contact length [m], shorter by that length.

        The mean is that of the straight lines between points, centred at each point (fixed footprint).
        """
        checks.positive("contact_length", contact_length, "m")
        x, half = self.distance, contact_length / 2
        inside = x[(x - half >= x[0]) & (x + half <= x[-1])]
        if inside.size < 2:
            raise ValueError(
                f"contact_length must be shorter than the profile by two points, got {contact_length} m"
            )
        slope = np.diff(self.height, axis=0) / np.diff(x)[:, None]
        area = np.zeros_like(self.height)
        area[1:] = np.cumsum((self.height[1:] + self.height[:-1]) / 2 * np.diff(x)[:, None], axis=0)

        def up_to(place: Real) -> Real:
            i = np.clip(np.searchsorted(x, place, side="right") - 1, 0, x.size - 2)
            along = (place - x[i])[:, None]
            return area[i] + along * (self.height[i] + along / 2 * slope[i])

        return Profile(inside, (up_to(inside + half) - up_to(inside - half)) / contact_length, self.tracks)

    @property
    def step(self) -> float:
        """Mean distance between two points [m]."""
        return float(self.distance[-1] - self.distance[0]) / (self.distance.size - 1)

    def at(self, distance: ArrayLike) -> Real:
        """Return the elevation (k, tracks) [m] at distances (k,) inside the profile [m], linear between points."""
        where = np.atleast_1d(np.asarray(distance, dtype=float))
        first, last = self.distance[[0, -1]].tolist()
        outside = ~((where >= first) & (where <= last))
        if outside.any():
            raise ValueError(f"distance must lie from {first:g} to {last:g} m, got {where[outside][0]}")
        return np.stack([np.interp(where, self.distance, track) for track in self.height.T], axis=-1)


def is_even(distance: Real) -> bool:
    """Whether all steps of distances (n,) are within 1 % of their mean."""
    steps = np.diff(distance)
    return bool((np.abs(steps - steps.mean()) <= UNEVEN * steps.mean()).all())


def _check_ascending(distance: Real) -> float:
    """Return the mean step [m]; ValueError unless distances (n,) ascend in steps that are not tiny."""
    steps = np.diff(distance)
    mean = float(distance[-1] - distance[0]) / steps.size
    if not (steps > 0).all():
        raise ValueError(f"distance must ascend, got {distance[np.argmax(~(steps > 0)) + 1]} out of order")
    if mean < _CLOSEST:
        raise ValueError(f"distance must have steps of {_CLOSEST:g} m at least, got {mean:g} m")
    return mean


def _check_even(distance: Real) -> None:
    mean, steps = _check_ascending(distance), np.diff(distance)
    worst = int(np.abs(steps - mean).argmax())
    if not abs(steps[worst] - mean) <= UNEVEN * mean:
        got = f"{steps[worst]:g} m after {distance[worst]:g} m"
        raise ValueError(f"distance must be even, each step within {UNEVEN:.0%} of the mean {mean:g} m, got {got}")

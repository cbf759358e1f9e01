"""Profiles: the elevation of one or several tracks along the road, realised from a spectrum or measured.

A CSV file of a profile has the columns ``distance [m]`` and ``height [m]``, or ``left [m]`` and ``right [m]``, or
for tracks anywhere such as ``height at y = 0.75 m [m]``. Lines that start with ``#`` name the source.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..documents import naming
from ..quantities import Real, Record, frozen_array, unit
from ..tables import read_table, write_csv

UNEVEN = 0.01  # largest deviation of a step from the mean step, relative
DISTANCE, HEIGHT, LEFT, RIGHT = "distance [m]", "height [m]", "left [m]", "right [m]"
_CLOSEST = 1e-6  # m, least mean distance between two points
_TRACK = re.compile(r"height at y = (-?\d+(?:\.\d+)?(?:e-?\d+)?) m \[m\]", re.ASCII)
_TRACK_COLUMN = "height at y = {} m [m]"


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


def _check_even(distance: Real) -> None:
    steps = np.diff(distance)
    mean = (distance[-1] - distance[0]) / steps.size
    if not (steps > 0).all():
        raise ValueError(f"distance must ascend, got {distance[np.argmax(~(steps > 0)) + 1]} out of order")
    if mean < _CLOSEST:
        raise ValueError(f"distance must have steps of {_CLOSEST:g} m at least, got {mean:g} m")
    worst = int(np.abs(steps - mean).argmax())
    if not abs(steps[worst] - mean) <= UNEVEN * mean:
        got = f"{steps[worst]:g} m after {distance[worst]:g} m"
        raise ValueError(f"distance must be even, each step within {UNEVEN:.0%} of the mean {mean:g} m, got {got}")


def read_profile(path: str | PathLike[str], track_width: float | None = None) -> Profile:
    """Read a profile from a CSV file; columns ``left [m]`` and ``right [m]`` need the track width [m].

    Two columns without names are distance and height.
    """
    table = read_table(path)
    with naming(path):
        return profile_of(*table, track_width)


def profile_of(names: Sequence[str], values: Real, track_width: float | None = None) -> Profile:
    """Return the profile of a table (n, c) with columns of these names, see `read_profile`."""
    if not names and values.shape[1] == 2:
        names = [DISTANCE, HEIGHT]
    if names[:1] != [DISTANCE] or len(names) < 2:
        raise ValueError(f"first column must be {DISTANCE!r} and then heights, got {checks.shown(names)}")
    return Profile(values[:, 0], values[:, 1:], _tracks(names[1:], track_width))


def write_profile(path: str | PathLike[str], profile: Profile) -> None:
    """Write a profile for `read_profile`, to the last bit; on an error no file is written."""
    import pandas as pd

    names = [_TRACK_COLUMN.format(np.format_float_positional(y, trim="-")) for y in profile.tracks]
    columns = [DISTANCE, *([HEIGHT] if profile.tracks == (0.0,) else names)]
    write_csv(Path(path), pd.DataFrame(np.column_stack([profile.distance, profile.height]), columns=columns))


def _tracks(names: Sequence[str], width: float | None) -> tuple[float, ...]:
    """Places of the tracks of the height columns [m]."""
    if names == [LEFT, RIGHT]:
        if width is None:
            raise ValueError(f"{LEFT!r} and {RIGHT!r} need a track width in m, got none")
        checks.positive("track width", width, "m")
        return width / 2, -width / 2
    if width is not None:
        raise ValueError(f"a track width goes with {LEFT!r} and {RIGHT!r} only, got {checks.shown(names)}")
    if names == [HEIGHT]:
        return (0.0,)
    for name in names:
        if not _TRACK.fullmatch(name):
            known = f"{HEIGHT!r}, or {LEFT!r} and {RIGHT!r}, or all like {_TRACK_COLUMN.format(0.75)!r}"
            raise ValueError(f"columns after {DISTANCE!r} must be {known}, got {checks.shown(name)}")
    return tuple(float(y) for name in names for y in _TRACK.findall(name))

"""Obstacles: shapes along the road that every wheel passes once, from level ground at elevation 0."""

from abc import abstractmethod
from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, unit
from .events import Event

_SIDES = {"both": (-np.inf, np.inf), "left": (0.0, np.inf), "right": (-np.inf, 0.0)}  # range of y [m]
_CONTACT = 0.1  # m, length of the contact of a car's tyre
_MOST = 1e4  # waves


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Obstacle(Event):
    """A shape along the road, across it or on one side."""

    side: str = "both"

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("side", self.side, _SIDES)

    @abstractmethod
    def height_at(self, distance: ArrayLike) -> Real:
        """Return the elevation [m] at distances from the place where a wheel meets it [m]."""

    @property
    @abstractmethod
    def places(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the elevation, from 0 on."""

    @property
    @abstractmethod
    def shortest_wave(self) -> float:
        """Length of its shortest wave or flank [m]."""

    def elevation(self, time: Real, contact_points: Real, speed: float, /) -> Real:
        """Return the elevation (n, r), see `Event.elevation`."""
        x, y = contact_points.T
        low, high = _SIDES[self.side]
        place = speed * np.asarray(time, dtype=float)[:, None] - (x.max() - x)
        return np.where((y >= low) & (y <= high), self.height_at(place), 0.0)

    def knots(self, contact_points: Real, speed: float, /) -> Real:
        """Return the times (k,) [s], see `Event.knots`."""
        checks.positive("speed", speed, "m/s")
        if self.steady:
            return np.array([0.0, self.places[-1] / speed])
        x = contact_points[:, 0]
        return np.unique(np.add.outer(x.max() - x, self.places)) / speed

    def finest(self, speed: float, /) -> float:
        """Return the duration of its shortest wave or flank [s]."""
        checks.positive("speed", speed, "m/s")
        return self.shortest_wave / speed


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Shape(Obstacle):
    """A shape that a tyre averages over its contact length: the fixed footprint of Captain et al. [1]_.

    .. [1] K. M. Captain, A. B. Boghani and D. N. Wormley, "Analytical tire models for dynamic vehicle simulation",
       Vehicle System Dynamics 8 (1979).
    """

    contact_length: float = field(default=0.0, metadata=unit("m"))

    @property
    @abstractmethod
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape, from 0 on."""

    @abstractmethod
    def point_height(self, distance: Real) -> Real:
        """Return the elevation [m] at distances from the shape's beginning [m]."""

    @abstractmethod
    def area(self, distance: Real) -> Real:
        """Return the integral of the elevation up to distances from the shape's beginning [m^2]."""

    def height_at(self, distance: ArrayLike) -> Real:
        """Return the elevation [m] at distances from the place where the contact begins [m]."""
        x, contact = np.asarray(distance, dtype=float), self.contact_length
        return (self.area(x) - self.area(x - contact)) / contact if contact else self.point_height(x)

    @property
    def places(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the elevation, from 0 on."""
        return tuple(sorted({corner + end for corner in self.corners for end in (0.0, self.contact_length)}))

    @property
    def shortest_wave(self) -> float:
        """Length of its shortest wave or flank [m]."""
        flanks = np.append(np.diff(self.corners), self.contact_length)
        return float(flanks[flanks > 0].min())


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SpeedBump(Shape):
    """A speed bump of sine-squared profile, ``h sin^2(pi x / l)``.

    Parameters
    ----------
    height, length : float
        Height h and length l [m].
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> bump = sc.SpeedBump(height=0.05, length=2.0)
    >>> [round(float(bump.height_at(x)), 4) for x in (0.0, 0.5, 1.0, 2.5)]
    [0.0, 0.025, 0.05, 0.0]
    """

    height: float = field(metadata=unit("m"))
    length: float = field(metadata=unit("m"))

    @property
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape."""
        return 0.0, self.length

    def point_height(self, distance: Real) -> Real:
        """Return the elevation [m]."""
        x = np.clip(distance, 0.0, self.length)
        return np.asarray(self.height / 2 * (1 - np.cos(2 * pi * x / self.length)))  # 0 at its end to the bit

    def area(self, distance: Real) -> Real:
        """Return the integral of the elevation [m^2]."""
        x = np.clip(distance, 0.0, self.length)
        turn = 2 * pi / self.length
        return np.asarray(self.height / 2 * (x - np.sin(turn * x) / turn))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Polygon(Shape):
    """A shape of straight pieces."""

    @property
    @abstractmethod
    def heights(self) -> tuple[float, ...]:
        """Elevations [m] at the corners; the last one stays."""

    def point_height(self, distance: Real) -> Real:
        """Return the elevation [m]."""
        return np.interp(distance, self.corners, self.heights)

    def area(self, distance: Real) -> Real:
        """Return the integral of the elevation [m^2]."""
        corners, heights = np.array(self.corners), np.array(self.heights)
        steps = np.diff(corners)
        sums = np.concatenate([[0.0], np.cumsum(steps * (heights[1:] + heights[:-1]) / 2)])
        piece = np.clip(np.searchsorted(corners, distance, side="right") - 1, 0, corners.size - 1)
        inside = np.maximum(distance - corners[piece], 0.0)
        slopes = np.append(np.divide(np.diff(heights), steps, out=np.zeros_like(steps), where=steps > 0), 0.0)
        return np.asarray(sums[piece] + heights[piece] * inside + slopes[piece] * inside**2 / 2)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class TrapezoidalBump(Polygon):
    """A speed bump or table with straight flanks.

    Parameters
    ----------
    height, length : float
        Height and total length [m].
    ramp : float
        Length of each flank, at most half of the total length [m].
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> table = sc.TrapezoidalBump(height=0.08, length=6.0, ramp=1.0)
    >>> table.height_at([0.5, 3.0, 5.75]).round(3).tolist()
    [0.04, 0.08, 0.02]
    """

    height: float = field(metadata=unit("m"))
    length: float = field(metadata=unit("m"))
    ramp: float = field(metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.ramp > self.length / 2:
            raise ValueError(f"ramp must be at most half of the length {self.length:g} m, got {self.ramp:g}")

    @property
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape."""
        return 0.0, self.ramp, self.length - self.ramp, self.length

    @property
    def heights(self) -> tuple[float, ...]:
        """Elevations [m] at the corners."""
        return 0.0, self.height, self.height, 0.0


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Ramp(Polygon):
    """A straight rise to a level that stays.

    Parameters
    ----------
    height, length : float
        Rise, and length of the slope [m].
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.Ramp(height=0.1, length=2.0).height_at([1.0, 5.0]).tolist()
    [0.05, 0.1]
    """

    height: float = field(metadata=unit("m"))
    length: float = field(metadata=unit("m"))

    @property
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape."""
        return 0.0, self.length

    @property
    def heights(self) -> tuple[float, ...]:
        """Elevations [m] at the corners."""
        return 0.0, self.height


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class _Rectangle(Shape):
    """A shape with vertical edges; the contact of the tyre makes slopes of them."""

    length: float = field(metadata=unit("m"))
    contact_length: float = field(default=_CONTACT, metadata=unit("m"))

    @property
    @abstractmethod
    def level(self) -> float:
        """Elevation between the edges [m]."""

    @property
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape."""
        return 0.0, self.length

    def point_height(self, distance: Real) -> Real:
        """Return the elevation [m]."""
        return np.where((distance >= 0) & (distance <= self.length), self.level, 0.0)

    def area(self, distance: Real) -> Real:
        """Return the integral of the elevation [m^2]."""
        return self.level * np.clip(distance, 0.0, self.length)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Plank(_Rectangle):
    """A plank across the road, longer than the contact of the tyre.

    Parameters
    ----------
    height, length : float
        Height, and length along the road [m].
    contact_length : float
        Length over which a tyre averages the elevation, > 0: each edge is a slope of this length [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.Plank(height=0.03, length=0.3).height_at([0.05, 0.2, 0.35]).round(3).tolist()
    [0.015, 0.03, 0.015]
    """

    height: float = field(metadata=unit("m"))

    @property
    def level(self) -> float:
        """Elevation between the edges [m]."""
        return self.height


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Cleat(Plank):
    """A cleat across the road, shorter than the contact of the tyre, which lifts by height times length over it.

    Parameters
    ----------
    height, length : float
        Height, and length along the road [m].
    contact_length : float
        Length over which a tyre averages the elevation, > 0: each edge is a slope of this length [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.Cleat(height=0.02, length=0.025).height_at([0.05, 0.2]).round(4).tolist()
    [0.005, 0.0]
    """


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Pothole(_Rectangle):
    """A pothole with vertical edges.

    Parameters
    ----------
    depth, length : float
        Depth, and length along the road [m].
    contact_length : float
        Length over which a tyre averages the elevation, > 0: each edge is a slope of this length [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> hole = sc.Pothole(depth=0.06, length=0.5, side="right")
    >>> hole.height_at([0.05, 0.3]).round(3).tolist()
    [-0.03, -0.06]
    """

    depth: float = field(metadata=unit("m"))

    @property
    def level(self) -> float:
        """Elevation between the edges [m]."""
        return -self.depth


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Step(Shape):
    """A step up to a level that stays.

    Parameters
    ----------
    height : float
        Height [m].
    contact_length : float
        Length over which a tyre averages the elevation, > 0: each edge is a slope of this length [m].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.Step(height=0.05).height_at([0.05, 1.0]).round(3).tolist()
    [0.025, 0.05]
    """

    height: float = field(metadata=unit("m"))
    contact_length: float = field(default=_CONTACT, metadata=unit("m"))

    @property
    def corners(self) -> tuple[float, ...]:
        """Distances [m] of the ends and kinks of the shape."""
        return (0.0,)

    def point_height(self, distance: Real) -> Real:
        """Return the elevation [m]."""
        return np.where(distance >= 0, self.height, 0.0)

    def area(self, distance: Real) -> Real:
        """Return the integral of the elevation [m^2]."""
        return self.height * np.maximum(distance, 0.0)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Sine(Obstacle):
    """Sine waves along the road, ``h sin(2 pi x / l)``.

    Parameters
    ----------
    height, length : float
        Amplitude h and length l of a wave [m].
    waves : float, optional
        Number of waves, a multiple of 0.5 up to 1e4 [-]; without it they go on for ever: a steady response.
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.Sine(height=0.01, length=4.0, waves=0.5).height_at([1.0, 3.0]).round(3).tolist()
    [0.01, 0.0]
    """

    height: float = field(metadata=unit("m"))
    length: float = field(metadata=unit("m"))
    waves: float | None = field(default=None, metadata=unit("", 0.5, _MOST))

    def __post_init__(self) -> None:
        super().__post_init__()
        check_waves(self.waves)

    @property
    def steady(self) -> bool:
        """Whether it goes on for ever."""
        return self.waves is None

    @property
    def places(self) -> tuple[float, ...]:
        """Distances [m] between which the elevation is smooth; of steady waves the ends of one."""
        return 0.0, (self.waves or 1.0) * self.length

    @property
    def shortest_wave(self) -> float:
        """Length of a wave [m]."""
        return self.length

    def height_at(self, distance: ArrayLike) -> Real:
        """Return the elevation [m] at distances from the beginning [m]."""
        x = np.asarray(distance, dtype=float)
        x = x if self.steady else np.clip(x, 0.0, self.places[-1])
        return np.asarray(self.height * np.sin(2 * pi * x / self.length))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Chirp(Obstacle):
    """Waves along the road whose wavenumber rises evenly.

    Parameters
    ----------
    height : float
        Amplitude [m].
    longest, shortest : float
        Length of the first and of the last wave [m].
    waves : float
        Number of waves, a multiple of 0.5 up to 1e4 [-].
    side : str
        The wheels that meet it: "both", "left" or "right".

    Examples
    --------
    Ten waves of a mean wavenumber of 0.25 cycle/m are 40 m long:

    >>> import suspension_ctrl as sc
    >>> sc.Chirp(height=0.01, longest=10.0, shortest=2.5, waves=10.0).places[-1]
    40.0
    """

    height: float = field(metadata=unit("m"))
    longest: float = field(metadata=unit("m"))
    shortest: float = field(metadata=unit("m"))
    waves: float = field(metadata=unit("", 0.5, _MOST))

    def __post_init__(self) -> None:
        super().__post_init__()
        check_waves(self.waves)
        if self.shortest > self.longest:
            raise ValueError(f"shortest must be at most longest, {self.longest:g} m, got {self.shortest:g}")

    @property
    def places(self) -> tuple[float, ...]:
        """Distances [m] between which the elevation is smooth: its ends."""
        return 0.0, 2 * self.waves / (1 / self.longest + 1 / self.shortest)

    @property
    def shortest_wave(self) -> float:
        """Length of the last wave [m]."""
        return self.shortest

    def height_at(self, distance: ArrayLike) -> Real:
        """Return the elevation [m] at distances from the beginning [m]."""
        length = self.places[-1]
        x = np.clip(distance, 0.0, length)
        return np.asarray(self.height * np.sin(2 * pi * swept(x, length, 1 / self.longest, 1 / self.shortest)))


def check_waves(waves: float | None) -> None:
    """Raise ValueError unless a number of waves ends at elevation 0."""
    if waves is not None and (2 * waves) % 1:
        raise ValueError(f"waves must be a multiple of 0.5, got {waves:g}")


def swept(x: Real, end: float, first: float, last: float) -> Real:
    """Return the cycles from 0 to x of a frequency that rises evenly from `first` at 0 to `last` at `end`."""
    return np.asarray(first * x + (last - first) * x**2 / (2 * end))

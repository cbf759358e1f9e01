"""Obstacles along the road that every wheel passes once, from level ground at elevation 0."""

from abc import abstractmethod
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, unit
from .events import Event

_SIDES = {"both": (-np.inf, np.inf), "left": (0.0, np.inf), "right": (-np.inf, 0.0)}  # range of y [m]


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

"""Bumps and ramps with slopes of their own."""

from abc import abstractmethod
from dataclasses import dataclass, field
from math import pi

import numpy as np

from ..quantities import Real, unit
from .obstacles import Shape


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

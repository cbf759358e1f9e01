"""Planks, cleats, potholes and steps: vertical edges, of which the contact of the tyre makes slopes."""

from abc import abstractmethod
from dataclasses import dataclass, field

import numpy as np

from ..quantities import Real, unit
from .obstacles import Shape

_CONTACT = 0.1  # m, length of the contact of a car's tyre


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Rectangle(Shape):
    """A shape with two vertical edges."""

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
class Plank(Rectangle):
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
class Pothole(Rectangle):
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

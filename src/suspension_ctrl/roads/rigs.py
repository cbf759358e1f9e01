"""Inputs of a test rig with a post under each wheel: heave, pitch, roll and warp."""

from abc import abstractmethod
from dataclasses import dataclass, field
from math import pi

import numpy as np

from .. import checks
from ..quantities import Real, unit
from .events import Event
from .waves import MOST_WAVES, check_waves, swept

_MOTIONS = ("heave", "pitch", "roll", "warp")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Rig(Event):
    """One wave on all posts, each with the sign that the motion gives it.

    In heave all posts rise. Pitch is positive nose down, roll left side up: the rear posts rise, or the left ones,
    and the others fall. Warp is their product. Of more than two axles those between move in proportion.
    """

    motion: str
    amplitude: float = field(metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("motion", self.motion, _MOTIONS)

    @abstractmethod
    def cycles(self, time: Real) -> Real:
        """Return the cycles of the wave (n,) at times (n,) [s]."""

    def elevation(self, time: Real, contact_points: Real, _speed: float, /) -> Real:
        """Return the elevation (n, r), see `Event.elevation`."""
        wave = self.amplitude * np.sin(2 * pi * self.cycles(np.asarray(time, dtype=float)))
        return np.multiply.outer(wave, self._shares(contact_points))

    def _shares(self, contact_points: Real) -> Real:
        """Return the part (r,) of each post, from -1 to 1; ValueError if the wheels cannot move like this."""
        x, y = contact_points.T
        behind, left = (x.max() + x.min()) / 2 - x, y - (y.max() + y.min()) / 2
        places = {"heave": [], "pitch": [behind], "roll": [left], "warp": [behind, left]}[self.motion]
        if not all(place.any() for place in places):
            raise ValueError(f"motion must be one that the wheels can make by their places, got {self.motion}")
        return np.prod([np.ones(x.size), *(place / np.abs(place).max() for place in places)], axis=0)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RigSine(Rig):
    """A sine on a test rig.

    Parameters
    ----------
    motion : str
        "heave", "pitch", "roll" or "warp".
    amplitude : float
        Amplitude of each post [m].
    frequency : float
        Frequency [Hz].
    waves : float, optional
        Number of waves, a multiple of 0.5 up to 1e4 [-]; without it they go on for ever: a steady response.

    Examples
    --------
    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> wheels = np.array([(1.3, 0.75), (1.3, -0.75), (-1.3, 0.75), (-1.3, -0.75)])
    >>> warp = sc.RigSine(motion="warp", amplitude=0.01, frequency=0.5)
    >>> warp.elevation(np.array([0.5]), wheels, 0.0).round(3).tolist()
    [[-0.01, 0.01, 0.01, -0.01]]
    """

    frequency: float = field(metadata=unit("Hz"))
    waves: float | None = field(default=None, metadata=unit("", 0.5, MOST_WAVES))

    def __post_init__(self) -> None:
        super().__post_init__()
        check_waves(self.waves)

    @property
    def steady(self) -> bool:
        """Whether it goes on for ever."""
        return self.waves is None

    def cycles(self, time: Real) -> Real:
        """Return the cycles (n,)."""
        cycles = self.frequency * time
        return cycles if self.waves is None else np.clip(cycles, 0.0, self.waves)

    def knots(self, _contact_points: Real, _speed: float, /) -> Real:
        """Return the times (k,) [s], see `Event.knots`."""
        return np.array([0.0, (self.waves or 1.0) / self.frequency])

    def finest(self, _speed: float, /) -> float:
        """Return the duration of a wave [s]."""
        return 1 / self.frequency


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RigChirp(Rig):
    """A sine sweep on a test rig, whose frequency rises evenly.

    Parameters
    ----------
    motion : str
        "heave", "pitch", "roll" or "warp".
    amplitude : float
        Amplitude of each post [m].
    lowest, highest : float
        Frequency at the beginning and at the end [Hz].
    waves : float
        Number of waves, a multiple of 0.5 up to 1e4 [-].

    Examples
    --------
    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> sweep = sc.RigChirp(motion="heave", amplitude=0.005, lowest=0.5, highest=9.5, waves=100.0)
    >>> sweep.knots(np.zeros((1, 2)), 0.0).tolist()
    [0.0, 20.0]
    """

    lowest: float = field(metadata=unit("Hz"))
    highest: float = field(metadata=unit("Hz"))
    waves: float = field(metadata=unit("", 0.5, MOST_WAVES))

    def __post_init__(self) -> None:
        super().__post_init__()
        check_waves(self.waves)
        if self.highest < self.lowest:
            raise ValueError(f"highest must be at least lowest, {self.lowest:g} Hz, got {self.highest:g}")

    def cycles(self, time: Real) -> Real:
        """Return the cycles (n,)."""
        end = 2 * self.waves / (self.lowest + self.highest)
        return swept(np.clip(time, 0.0, end), end, self.lowest, self.highest)

    def knots(self, _contact_points: Real, _speed: float, /) -> Real:
        """Return the times (k,) [s], see `Event.knots`."""
        return np.array([0.0, 2 * self.waves / (self.lowest + self.highest)])

    def finest(self, _speed: float, /) -> float:
        """Return the duration of the shortest wave [s]."""
        return 1 / self.highest

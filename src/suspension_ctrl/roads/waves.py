"""Waves along the road: sines and sweeps."""

from dataclasses import dataclass, field
from math import pi

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import Real, unit
from .obstacles import Obstacle

MOST_WAVES = 1e4


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
    waves: float | None = field(default=None, metadata=unit("", 0.5, MOST_WAVES))

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
    waves: float = field(metadata=unit("", 0.5, MOST_WAVES))

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

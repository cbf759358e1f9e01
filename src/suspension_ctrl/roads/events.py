"""Events: elevation in time under each wheel that passes an obstacle once or stands on a post of a test rig.

Every event begins on level ground at elevation 0. Time counts from the moment when the foremost wheel meets it.
"""

from abc import ABC, abstractmethod

from ..quantities import Checked, Real


class Event(Checked, ABC):
    """Elevation under each wheel over time."""

    @abstractmethod
    def elevation(self, time: Real, contact_points: Real, speed: float, /) -> Real:
        """Return the elevation (n, r) [m].

        Parameters
        ----------
        time : (n,) array
            Times from the moment when the foremost wheel meets the event, any order and sign [s].
        contact_points : (r, 2) array
            Points of the wheels, x forward and y to the left [m].
        speed : float
            Speed [m/s]; a test rig, on which the vehicle stands, has none.
        """

    @abstractmethod
    def knots(self, contact_points: Real, speed: float, /) -> Real:
        """Return the times (k,) [s], ascending from 0, between which the elevation under every wheel is smooth.

        After the last one the elevation stays. A steady event has the ends of its period.
        """

    @abstractmethod
    def finest(self, speed: float, /) -> float:
        """Return the duration of its shortest wave or flank [s]."""

    @property
    def steady(self) -> bool:
        """Whether it repeats for ever with the period ``knots[-1]``; its peaks are those of the steady state."""
        return False

"""An event and a level road behind it as one period of the elevation under the wheels."""

from typing import NamedTuple

import numpy as np

from ..quantities import Real
from ..roads.events import Event

_LEVEL = 1e-9  # m, height of a level road at the end of an event
_SHORT = 1e-4  # of its shortest wave, for difference quotients of the elevation


class PaddedEvent(NamedTuple):
    """Elevation under r wheels over a period.

    An event that ends on another level follows once more, upside down.
    """

    event: Event
    contacts: Real  # (r, 2) [m]
    speed: float  # m/s
    end: float  # of the event and of the level road [s]
    level: Real  # (r,), elevation there [m]

    @classmethod
    def of(cls, event: Event, contacts: Real, speed: float, padding: float) -> "PaddedEvent":
        """Place an event before a level road of this length [s]; a steady one is one period of itself."""
        last = float(event.knots(contacts, speed)[-1])
        if event.steady:
            return cls(event, contacts, speed, last, np.zeros(len(contacts)))
        level = event.elevation(np.array([last + padding]), contacts, speed)[0]
        return cls(event, contacts, speed, last + padding, np.where(np.abs(level) > _LEVEL, level, 0.0))

    @property
    def period(self) -> float:
        """Duration of the period [s]."""
        return 2 * self.end if self.level.any() else self.end

    @property
    def knots(self) -> Real:
        """Times (k,) of the event between which the elevation is smooth [s]."""
        return self.event.knots(self.contacts, self.speed)

    def times(self, count: int) -> Real:
        """Return even times (count,) over the period [s]."""
        return np.linspace(0.0, self.period, count, endpoint=False)

    def height(self, time: Real) -> Real:
        """Return the elevation (n, r) [m] at times (n,) [s]."""
        within = time % self.period
        height = self.event.elevation(within % self.end, self.contacts, self.speed)
        return np.where(within[:, None] < self.end, height, self.level - height)

    def rate(self, time: Real) -> Real:
        """Return its rate (n, r) [m/s], at a kink the mean of both sides."""
        step = _SHORT * self.event.finest(self.speed)
        return (self.height(time + step) - self.height(time - step)) / (2 * step)

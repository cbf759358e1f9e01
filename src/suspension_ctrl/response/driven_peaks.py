"""Peaks in an event of vehicles with force laws: designs integrated in time until their responses decay."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Bool, Real
from ..roads.events import Event
from ..vehicles.assembly import ResponseName
from ..vehicles.vehicle import Setting, Vehicle
from .motion.courses import course_over, road_at
from .motion.drivable import Drivable, Motion, integrated, motion_of
from .motion.integration import responses_in_time
from .motion.system import Course

_BEYOND = (1.5, 4.0, 10.0, 27.0, 72.0)  # s of level road behind an event, as long as needed
_TOLERANCE = 1e-3  # of the largest value of each state, error of a step
_PIECES = 16  # cubics of the elevation in the shortest wave of an event
_ROWS = 48  # in that wave, at least
_APART = 1e-3  # s, longest distance of rows; twice of it where no response has kinks at the knots of a law
_SMOOTH = ("travel", "displacement")
_BESIDE = 1e-3  # of that, rows on both sides of a knot of the event, where the load of a damped tyre jumps
_SAME = 1e-6  # of that, times so close to each other are one
_LAST = 1.0  # s, end of the level road, on which responses must have decayed
_SMALLER = 0.5  # of the peak, the most that a response may have there
_STILL = 5e-4  # of its range, what a response may move there however small its peak
_EVENTS = 64  # that are kept


class Passage(NamedTuple):
    """An event and the level road behind it, with responses at k times."""

    course: Course
    time: Real  # (k,) [s]
    kinked: Bool  # (k,), whether a knot of the event is near
    road: tuple[Real, Real]  # elevation and rate there (k, r)
    steady: bool

    @classmethod
    def of(cls, event: Event, contacts: Real, speed: float, beyond: float, longest: float) -> "Passage":
        """Place a level road [s] behind an event; times are even, and on its knots and beside them."""
        ends = event.knots(contacts, speed)
        last = ends[-1] + (0.0 if event.steady else beyond)
        apart = min(longest, event.finest(speed) / _ROWS)
        beside = np.clip(np.concatenate([ends - _BESIDE * apart, ends + _BESIDE * apart]), 0.0, last)
        time = np.sort(np.concatenate([ends, beside, np.linspace(0.0, last, int(np.ceil(last / apart)) + 1)]))
        time = time[np.append(True, np.diff(time) > _SAME * apart)]
        kinked = (np.abs(time[:, None] - ends) < 1.5 * apart).any(axis=1)
        course = course_over(event, contacts, np.array([[0.0, speed]]), last, _PIECES)
        return cls(course, time, kinked, road_at(course, time, event.steady), event.steady)

    def responses(self, motion: Motion, jerks: Bool) -> Real:
        """Return the responses (m, k) as changes from rest; jerks are slopes of accelerations between rows."""
        options: Any = {"periodic": self.steady, "tolerance": _TOLERANCE, "road": self.road}
        found = responses_in_time(motion, self.course, self.time, **options)
        if motion.equations.constant.any():  # a payload
            found -= _at_rest(motion)
        if jerks.any():
            found[:, jerks] = _slopes(found[:, jerks], self.time)
        return np.ascontiguousarray(found.T)

    def crest(self, history: Real) -> Real:
        """Return maxima (m,) of (m, k), off knots by the parabola through the largest value and its neighbours."""
        largest = history.argmax(axis=1)
        time, at = self.time, np.clip(largest, 1, self.time.size - 2)
        before, here, after = (history[np.arange(len(at)), at + i] for i in (-1, 0, 1))
        rise, fall = (here - before) / (time[at] - time[at - 1]), (here - after) / (time[at + 1] - time[at])
        bend = (rise + fall) / (time[at + 1] - time[at - 1])
        slope = rise - bend * (time[at] - time[at - 1])
        smooth = (rise >= 0) & (fall >= 0) & (bend > 0) & ~self.kinked[at]
        more = np.divide(slope**2, 4 * bend, out=np.zeros_like(bend), where=smooth)
        return np.maximum(here + more, history[np.arange(len(at)), largest])

    def decayed(self, history: Real) -> bool:
        """Whether responses (m, k) at the end stay within half of their peaks, or stand still."""
        if self.steady:
            return True
        last = history[:, np.searchsorted(self.time, self.time[-1] - _LAST) :]
        rest = last[:, -1]
        most, least, late, low = (f(one, axis=1) for one in (history, last) for f in (np.max, np.min))
        still = late - low <= _STILL * (most - least)
        inside = (late - rest <= _SMALLER * (most - rest)) & (rest - low <= _SMALLER * (rest - least))
        return bool((still | inside).all())


def driven_peaks(
    vehicle: Vehicle, coefficients: Real, event: Event, speed: float, responses: Sequence[str]
) -> tuple[Real, Real, Bool]:
    """Return the largest and the smallest values (p, m), see `peaks`, and which designs (p,) come to rest."""
    highest, lowest = np.empty((2, len(coefficients), len(responses)))
    rested, plain = np.zeros(len(coefficients), dtype=bool), vehicle.without_jerk(responses)
    drivable = Drivable.of(vehicle, plain)
    jerks = np.array([one != name for one, name in zip(plain, responses, strict=True)])
    smooth = all(vehicle.meanings[name].kind in _SMOOTH for name in responses)
    longest = 2 * _APART if smooth else _APART
    for beyond in _BEYOND:
        passage = _passage(event, vehicle, speed, beyond, longest)
        for p in np.flatnonzero(~rested):
            history = passage.responses(drivable.motion(coefficients[p]), jerks)
            highest[p], lowest[p] = passage.crest(history), -passage.crest(-history)
            rested[p] = passage.decayed(history)
        if rested.all():
            break
    return highest, lowest, rested


@lru_cache(_EVENTS)
def _passage(event: Event, vehicle: Vehicle, speed: float, beyond: float, longest: float) -> Passage:
    return Passage.of(event, vehicle.contact_points, speed, beyond, longest)


def _slopes(values: Real, time: Real) -> Real:
    """Return slopes (k, j) of values (k, j) from each time to the next, 0 between close times, as of rounding."""
    steps = np.diff(time)
    slopes = np.diff(values, axis=0) / steps[:, None]
    slopes[steps < steps.max() / 2] = 0.0
    return np.vstack([slopes, slopes[-1:]])


def at_rest(vehicle: Vehicle, setting: Setting, responses: Sequence[ResponseName], lift_off: bool) -> Real:
    """Return the responses (m,) with which `simulate` begins on level ground, by the weight of a payload."""
    if not integrated(vehicle, lift_off):
        return np.zeros(len(responses))
    plain = vehicle.without_jerk(responses)
    rest = _at_rest(motion_of(vehicle, vehicle.coefficients(setting), plain, lift_off))
    return np.where([one == name for one, name in zip(plain, responses, strict=True)], rest, 0.0)


def _at_rest(motion: Motion) -> Real:
    """Return the responses (m,) on a level road."""
    level = Course(np.array([0.0, _APART]), np.zeros((1, motion.equations.b.shape[1], 4)))
    return responses_in_time(motion, level, np.zeros(1))[0]

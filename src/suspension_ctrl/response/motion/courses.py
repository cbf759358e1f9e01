"""Courses: the elevation under each wheel over time, as cubics between knots."""

from typing import NamedTuple

import numpy as np

from ...quantities import Integer, Real
from ...roads.events import Event
from ...roads.obstacles import Obstacle
from ...roads.profiles import Profile
from .system import Course

_SAME_TRACK = 1e-3  # m

_SAME = 1e-12  # of the whole time: times so close to each other are one knot
_PIECES = 64  # of the course in the shortest wave of an event, at least
_ROWS, _FINE = 100, 1e-3  # rows in its shortest wave, and their distance [s], at most
_BEYOND = 5.0  # s, driven after an event
_APART = 5e-3  # s, longest distance of rows on a profile
_STANDING = 1e-9  # m/s
_THIRDS = np.array([0.0, 1.0, 2.0, 3.0]) / 3
_THROUGH = np.linalg.inv(np.vander(_THIRDS, increasing=True))
"""From values at 0, 1/3, 2/3 and 1 to the cubic through them."""


class Passage(NamedTuple):
    """A course with the times and places of its rows."""

    course: Course
    time: Real  # (m,) [s]
    distance: Real  # (m,), of the origin [m]
    periodic: bool

    @classmethod
    def over_profile(cls, profile: Profile, contacts: Real, speed: Real, periodic: bool) -> "Passage":
        """Return the passage of wheels over a profile at a speed by rows (s, 2), see `driving.simulate`."""
        x, n, step = contacts[:, 0], profile.distance.size, profile.step
        start = 0.0 if periodic else x.min()
        ahead = np.round((x - start) / step, 9) * step
        length = n if periodic else n - 1 - np.ceil(np.round(ahead.max() / step, 9))
        if length < 1:
            needed, got = f"longer by a step than the wheelbase of {np.ptp(x):g} m", f"{step * (n - 1):g} m"
            raise ValueError(f"profile must be {needed}, got {got}")
        duration = float(time_at(speed, np.array(length * step)))
        steps = int(np.ceil(duration / min(step / speed[:, 1].max(), _APART) * (1 - 1e-9)))
        if len(speed) == 1:  # rows at the points of the profile
            steps = int(length) * max(1, int(np.ceil(step / speed[0, 1] / _APART * (1 - 1e-9))))
        rows = duration / steps * np.arange(steps + 1, dtype=float)
        heights = heights_under(profile, contacts)
        course = _over_heights(heights, step, ahead, speed, duration, periodic)
        time = rows[:-1] if periodic else rows
        return cls(course, time, profile.distance[0] - start + distance_at(speed, time), periodic)

    @classmethod
    def over_event(cls, event: Event, contacts: Real, speed: Real) -> "Passage":
        """Return the passage of wheels over an event and some seconds beyond; of a steady one, one period."""
        knots, finest = _knots(event, contacts, speed)
        end = knots[-1] if event.steady else knots[-1] + _BEYOND
        rows = np.linspace(0.0, end, int(np.ceil(end / min(finest / _ROWS, _FINE))) + 1)
        time = rows[:-1] if event.steady else rows
        course = course_over(event, contacts, speed, end)
        return cls(course, time, distance_at(speed, time) - contacts[:, 0].max(), event.steady)


def _knots(event: Event, contacts: Real, speed: Real) -> tuple[Real, float]:
    """Return the knots of an event (k,) and its shortest wave [s]; along the road by the distance driven."""
    if isinstance(event, Obstacle):
        return time_at(speed, event.knots(contacts, 1.0)), event.finest(float(speed[:, 1].max()))
    return event.knots(contacts, 0.0), event.finest(0.0)


def course_over(event: Event, contacts: Real, speed: Real, end: float, pieces: int = _PIECES) -> Course:
    """Return the course over an event until a time, so many cubics through four points in the shortest wave."""
    ends, finest = _knots(event, contacts, speed)
    fine = np.arange(0.0, ends[-1], finest / pieces)
    knots = _distinct(np.concatenate([ends, speed[:, 0], fine]), end)
    times = (knots[:-1, None] + np.diff(knots)[:, None] * _THIRDS).ravel()
    along = isinstance(event, Obstacle)  # at 1 m/s the time is the distance
    heights = event.elevation(distance_at(speed, times) if along else times, contacts, 1.0)
    return _through(knots, heights.reshape(len(knots) - 1, 4, -1))


def _over_heights(heights: Real, step: float, ahead: Real, speed: Real, end: float, periodic: bool) -> Course:
    """Return the course of wheels `ahead` (r,) [m] of the first point over heights (n, r), straight in between."""
    times, reach = [speed[:, 0]], float(distance_at(speed, np.array([end]))[0])
    for lead in np.unique(ahead).tolist():
        points = np.arange(np.ceil(lead / step), np.floor((lead + reach) / step) + 1) * step - lead
        times.append(time_at(speed, np.maximum(points, 0.0)))
    knots, n = _distinct(np.concatenate(times), end), len(heights)
    pieces = np.zeros((len(knots) - 1, len(ahead), 4))
    first, middle = knots[:-1], (knots[1:] + knots[:-1]) / 2
    for wheel, lead in enumerate(ahead.tolist()):
        index = np.floor((distance_at(speed, middle) + lead) / step).astype(int)
        low, high = (heights[i % n if periodic else np.clip(i, 0, n - 1), wheel] for i in (index, index + 1))
        slope = (high - low) / step
        pieces[:, wheel, 0] = low + slope * (distance_at(speed, first) + lead - index * step)
        pieces[:, wheel, 1] = slope * np.interp(first, *speed.T)
        pieces[:, wheel, 2] = slope * _acceleration(speed)[_row_of(speed[:, 0], middle)] / 2
    return Course(knots, pieces)


def _through(knots: Real, heights: Real) -> Course:
    """Return the cubics through heights (k, 4, r) at the thirds of each piece between knots (k + 1,)."""
    powers = np.diff(knots)[:, None] ** np.arange(4)
    pieces = np.einsum("pi,kir->krp", _THROUGH, heights) / powers[:, None, :]
    return Course(knots, np.ascontiguousarray(pieces))


def road_at(course: Course, time: Real, periodic: bool = False) -> tuple[Real, Real]:
    """Return elevation and rate of the road (m, r) at times (m,), on a kink the mean rate of both sides."""
    end, near, last = course.knots[-1], _SAME * course.knots[-1], len(course.pieces) - 1
    behind, ahead = time - near, time + near
    if periodic:
        behind, ahead = np.where(behind < 0, behind + end, behind), np.where(ahead >= end, ahead - end, ahead)
    sides = [np.clip(_row_of(course.knots, side), 0, last) for side in (behind, ahead)]
    since = [(side - course.knots[i])[:, None] for i, side in zip(sides, (behind, ahead), strict=True)]
    rates = [_rate(course.pieces[i], s) for i, s in zip(sides, since, strict=True)]
    s, c = np.maximum(time[:, None] - course.knots[sides[1], None], 0.0), course.pieces[sides[1]]
    return c[..., 0] + s * (c[..., 1] + s * (c[..., 2] + s * c[..., 3])), (rates[0] + rates[1]) / 2


def _rate(piece: Real, since: Real) -> Real:
    """Return the rates (m, r) of pieces (m, r, 4) at times since their knots (m, 1)."""
    return np.asarray(piece[..., 1] + since * (2 * piece[..., 2] + since * 3 * piece[..., 3]))


def _distinct(times: Real, end: float) -> Real:
    """Return the distinct times (k,) from 0 to the end."""
    times = np.sort(np.append(times[(times > 0) & (times < end)], [0.0, end]))
    times = times[np.append(True, np.diff(times) > _SAME * end)]
    times[-1] = end
    return times


def distance_at(speed: Real, time: Real) -> Real:
    """Return the distance driven at times (k,), the speed straight between its rows (s, 2), then constant."""
    i = _row_of(speed[:, 0], time)
    return np.asarray(_places(speed)[i] + (time - speed[i, 0]) * (speed[i, 1] + np.interp(time, *speed.T)) / 2)


def time_at(speed: Real, distance: Real) -> Real:
    """Return the times (k,) at distances driven."""
    places = _places(speed)
    i = _row_of(places, distance)
    rest, v = distance - places[i], speed[i, 1]
    sum_of_speeds = v + np.sqrt(np.maximum(v**2 + 2 * _acceleration(speed)[i] * rest, 0.0))
    return np.asarray(speed[i, 0] + 2 * rest / np.maximum(sum_of_speeds, _STANDING))


def _row_of(ends: Real, x: Real) -> Integer:
    """Return the last row (k,) that x has reached."""
    return np.asarray(np.searchsorted(ends, x, side="right") - 1)


def _acceleration(speed: Real) -> Real:
    """Return the acceleration (s,) from each row on."""
    return np.append(np.diff(speed[:, 1]) / np.diff(speed[:, 0]), 0.0)


def _places(speed: Real) -> Real:
    """Return the distance (s,) at the rows of the speed."""
    steps = np.diff(speed[:, 0]) * (speed[1:, 1] + speed[:-1, 1]) / 2
    return np.concatenate([[0.0], np.cumsum(steps)])


def heights_under(profile: Profile, contacts: Real) -> Real:
    """Return the heights (n, r) under contact points (r, 2) [m], linear across between tracks."""
    tracks, first = np.unique(profile.tracks, return_index=True)
    across = contacts[:, 1]
    if across.min() < tracks[0] - _SAME_TRACK or across.max() > tracks[-1] + _SAME_TRACK:
        places = ", ".join(f"{y:g}" for y in dict.fromkeys(across.tolist()))
        needed = f"across to y = {places} m, as by road.profile(..., tracks=({places},))"
        raise ValueError(f"profile must reach {needed}, got tracks at {list(profile.tracks)} m")
    shares = np.array([np.interp(across, tracks, one) for one in np.eye(len(tracks))])
    return np.asarray(profile.height[:, first] @ shares)

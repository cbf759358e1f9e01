"""Courses: the elevation under each wheel over time, as cubics between knots."""

import numpy as np

from ...quantities import Real
from ...roads.events import Event
from .integrator import Course

_SAME = 1e-9
"""Times so close to each other, as a share of the time between two rows, are one knot."""
_PIECES = 16  # in the shortest wave of an event
_THIRDS = np.array([0.0, 1.0, 2.0, 3.0]) / 3
_THROUGH = np.linalg.inv(np.vander(_THIRDS, increasing=True))
"""From values at 0, 1/3, 2/3 and 1 to the cubic through them."""


def over_profile(heights: Real, step: float, ahead: Real, speed: Real, rows: Real, periodic: bool) -> Course:
    """Return the course of wheels `ahead` (r,) [m] of the first point over tracks (n, r), straight between points.

    The speed is straight between its rows (k, 2) of time and speed, and stays after the last. The result has rows
    at even times (m,) [s].
    """
    apart = rows[1] - rows[0]
    last, period = rows[-1], len(heights)
    times = [rows, speed[:, 0]]
    reach = float(_distance(speed, last))
    for lead in ahead.tolist():
        points = np.arange(np.ceil(lead / step), np.floor((lead + reach) / step) + 1) * step - lead
        times.append(_time(speed, np.maximum(points, 0.0)))
    knots = _distinct(np.concatenate(times), last, apart)
    pieces = np.zeros((len(knots) - 1, len(ahead), 4))
    first, middle = knots[:-1], (knots[1:] + knots[:-1]) / 2
    v, rate = _speed(speed, first), _acceleration(speed, middle)
    for wheel, lead in enumerate(ahead.tolist()):
        place = (_distance(speed, middle) + lead) / step
        index = np.floor(place).astype(int)
        if not periodic:
            index = np.clip(index, 0, period - 2)
        low, high = (heights[i % period, wheel] for i in (index, index + 1))
        slope = (high - low) / step
        pieces[:, wheel, 0] = low + slope * (_distance(speed, first) + lead - index * step)
        pieces[:, wheel, 1] = slope * v
        pieces[:, wheel, 2] = slope * rate / 2
    return Course(knots, pieces, _rows(knots, rows, apart))


def over_event(event: Event, contact_points: Real, speed: float, rows: Real) -> Course:
    """Return the course over an event, cubics through four points each, with rows at even times (m,) [s]."""
    apart = rows[1] - rows[0]
    longest = min(event.finest(speed) / _PIECES, apart)
    ends = [rows, event.knots(contact_points, speed)]
    fine = np.arange(0.0, rows[-1], longest)
    knots = _distinct(np.concatenate([*ends, fine]), rows[-1], apart)
    span = np.diff(knots)
    times = knots[:-1, None] + span[:, None] * _THIRDS
    heights = event.elevation(times.ravel(), contact_points, speed).reshape(*times.shape, -1)
    return through(knots, heights, _rows(knots, rows, apart))


def through(knots: Real, heights: Real, row: Real) -> Course:
    """Return the cubics through heights (k, 4, r) at the thirds of each piece between knots (k + 1,)."""
    powers = np.diff(knots)[:, None] ** np.arange(4)
    pieces = np.einsum("pi,kir->krp", _THROUGH, heights) / powers[:, None, :]
    return Course(knots, np.ascontiguousarray(pieces), row)


def road_at_rows(course: Course) -> tuple[Real, Real]:
    """Return elevation and rate of the road (m, r) at the rows, on a kink the mean rate of both sides."""
    c, span = course.pieces, np.diff(course.knots)[:, None]
    at_end = c[..., 0] + span * (c[..., 1] + span * (c[..., 2] + span * c[..., 3]))
    rate_at_end = c[..., 1] + span * (2 * c[..., 2] + span * 3 * c[..., 3])
    height = np.vstack([c[..., 0], at_end[-1:]])
    rate = np.vstack([c[:1, :, 1], (c[1:, :, 1] + rate_at_end[:-1]) / 2, rate_at_end[-1:]])
    kept = course.row >= 0
    return height[kept], rate[kept]


def _distinct(times: Real, last: float, apart: float) -> Real:
    """Return the distinct times (k,) from 0 to the last."""
    times = np.sort(times[(times >= 0) & (times <= last * (1 + 1e-12))])
    return times[np.append(True, np.diff(times) > _SAME * apart)]


def _rows(knots: Real, rows: Real, apart: float) -> Real:
    """Return the row at each knot (k,), -1 for none."""
    nearest = np.clip(np.round(knots / apart).astype(np.int64), 0, len(rows) - 1)
    return np.where(np.abs(knots - rows[nearest]) <= 2 * _SAME * apart, nearest, -1)


def _speed(speed: Real, time: Real) -> Real:
    return np.interp(time, *speed.T)


def _acceleration(speed: Real, time: Real) -> Real:
    """Return the acceleration at times between the rows of the speed."""
    slopes = np.append(np.diff(speed[:, 1]) / np.diff(speed[:, 0]), 0.0)
    return np.asarray(slopes[np.searchsorted(speed[:, 0], time, side="right") - 1])


def _places(speed: Real) -> Real:
    """Return the distance at the rows of the speed."""
    steps = np.diff(speed[:, 0]) * (speed[1:, 1] + speed[:-1, 1]) / 2
    return np.concatenate([[0.0], np.cumsum(steps)])


def _distance(speed: Real, time: Real) -> Real:
    """Return the distance driven at times."""
    i = np.searchsorted(speed[:, 0], time, side="right") - 1
    since, places = time - speed[i, 0], _places(speed)
    return np.asarray(places[i] + since * (speed[i, 1] + _speed(speed, time)) / 2)


def _time(speed: Real, distance: Real) -> Real:
    """Return the times at distances driven."""
    i = np.searchsorted(_places(speed), distance, side="right") - 1
    rest, v = distance - _places(speed)[i], speed[i, 1]
    a = np.append(np.diff(speed[:, 1]) / np.diff(speed[:, 0]), 0.0)[i]
    return np.asarray(speed[i, 0] + 2 * rest / (v + np.sqrt(np.maximum(v**2 + 2 * a * rest, 0.0))))

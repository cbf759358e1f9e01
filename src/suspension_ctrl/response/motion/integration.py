"""Vehicles with force laws, on changing speed, or with tyres that lift off: responses integrated in time."""

import numpy as np

from ...quantities import Real
from .courses import road_at
from .drivable import Motion
from .integrator import NO_EQUILIBRIUM, REACHED, drive
from .system import Course

TOLERANCE = 3e-8
"""Error of a step as a share of the largest value of each state."""
_RECURS = 1e-5  # change of a state from one period to the next, as a share of its largest value
_LEAD = 20.0  # s, end of a long period that is driven first
_LONGEST = 600.0  # s, until a response must recur
_INSTANT = 1e-3  # s
_NO_TIMES = np.zeros(0)


def responses_in_time(
    motion: Motion,
    course: Course,
    time: Real,
    start: float | None = None,
    periodic: bool = False,
    tolerance: float = TOLERANCE,
    road: tuple[Real, Real] | None = None,
) -> Real:
    """Return the responses (m, p) at times (m,) of a course.

    The vehicle begins in equilibrium on the first heights, or on a level road of height `start` [m]. A periodic
    course is driven again until the states recur. `road`, see `road_at`, may be given for many motions.
    """
    rows = (
        _periodic(motion, course, time, tolerance) if periodic else _driven(motion, course, time, start, tolerance)
    )
    v, (height, rate) = len(motion.equations.a), road or road_at(course, time, periodic)
    states, tension = rows[:, :v], rows[:, motion.states :]
    found, tyres = motion.responses.of(states, height, rate, tension), motion.tyres
    if motion.equations.static.size:
        excess = tyres.tension.of(states, height, rate, tension) - tyres.static
        found -= np.maximum(excess, 0.0) @ tyres.on_responses.T
    return found


def _driven(motion: Motion, course: Course, time: Real, start: float | None, tolerance: float) -> Real:
    """Return states and tensions (m, n + q) from an equilibrium."""
    state = np.full(motion.states, np.nan)
    if start is not None:
        level = np.zeros((1, course.pieces.shape[1], 4))
        level[..., 0] = start
        _run(motion, Course(np.array([0.0, _INSTANT]), level), state, _NO_TIMES, tolerance)
    return _run(motion, course, state, time, tolerance)


def _periodic(motion: Motion, course: Course, time: Real, tolerance: float) -> Real:
    """Return states and tensions (m, n + q) of the steady response to a periodic course."""
    period, state = float(course.knots[-1]), np.full(motion.states, np.nan)
    if period > 2 * _LEAD:
        begin = int(np.searchsorted(course.knots, period - _LEAD))
        lead = Course(course.knots[begin:] - course.knots[begin], course.pieces[begin:])
        _run(motion, lead, state, _NO_TIMES, tolerance)
    for _ in range(int(np.ceil(_LONGEST / period)) + 2):
        first = state.copy()
        rows = _run(motion, course, state, time, tolerance)
        if (np.abs(state - first) <= _RECURS * np.abs(rows[:, : motion.states]).max(axis=0)).all():
            return rows
    raise ValueError(
        f"response must recur from period to period within {_LONGEST:g} s for a steady state, got none"
    )


def _run(motion: Motion, course: Course, state: Real, time: Real, tolerance: float) -> Real:
    """Return states and tensions (m, n + q) at times, and take the state on to the end.

    ValueError without equilibrium to begin in; ArithmeticError if the integration makes no progress.
    """
    rows = np.empty((time.size, motion.states + motion.equations.f.shape[1]))
    time = np.minimum(time, course.knots[-1])
    end = drive(motion, course, state, tolerance, time, rows)
    if end == NO_EQUILIBRIUM:
        raise ValueError("struts must hold the vehicle in equilibrium, got others")
    if end != REACHED:
        raise ArithmeticError(f"integration must go on, got stuck in motion at a tolerance of {tolerance:g}")
    return rows

"""Vehicles with force laws, on changing speed, or with tyres that lift off: responses integrated in time."""

import numpy as np

from ...quantities import Real
from .courses import road_at_rows
from .equations import Motion
from .integrator import Course, drive

TOLERANCE = 3e-8
"""Error of a step as a share of the largest value of each state."""
_RECURS = 1e-5  # change of a state from one period to the next, as a share of its largest value
_LEAD = 20.0  # s, end of a long period that is driven first
_LONGEST = 600.0  # s, until a response must recur
_INSTANT = 1e-3  # s


def responses_in_time(
    motion: Motion,
    course: Course,
    start: float | None = None,
    periodic: bool = False,
    tolerance: float = TOLERANCE,
) -> Real:
    """Return the responses (k, m) at the rows of a course.

    The vehicle begins in equilibrium on the first heights, or on a level road of height `start` [m]. A periodic
    course is driven again until the states recur; its last knot has a row, which the result is without.
    """
    rows = _periodic(motion, course, tolerance) if periodic else _driven(motion, course, start, tolerance)
    v, (height, rate) = len(motion.equations.a), road_at_rows(course, periodic)
    states, tension = rows[:, :v], rows[:, motion.states :]
    found, tyres = motion.responses.of(states, height, rate, tension), motion.tyres
    if motion.equations.static.size:
        excess = tyres.tension.of(states, height, rate, tension) - tyres.static
        found -= np.maximum(excess, 0.0) @ tyres.on_responses.T
    return found[:-1] if periodic else found


def _driven(motion: Motion, course: Course, start: float | None, tolerance: float) -> Real:
    """Return states and tensions (k, n + q) from an equilibrium."""
    first = np.full(motion.states, np.nan)
    if start is not None:
        level = np.zeros((1, course.pieces.shape[1], 4))
        level[..., 0] = start
        before = Course(np.array([0.0, _INSTANT]), level, np.array([0, -1]))
        first = _run(motion, before, first, tolerance)[0, : motion.states]
    return _run(motion, course, first, tolerance)


def _periodic(motion: Motion, course: Course, tolerance: float) -> Real:
    """Return states and tensions (k, n + q) of the steady response to a periodic course, its end included."""
    period, state = float(course.knots[-1]), np.full(motion.states, np.nan)
    if period > 2 * _LEAD:
        begin = int(np.searchsorted(course.knots, period - _LEAD))
        row = np.append(np.full(len(course.knots) - begin - 1, -1), 0)
        lead = Course(course.knots[begin:] - course.knots[begin], course.pieces[begin:], row)
        state = _run(motion, lead, state, tolerance)[0, : motion.states]
    for _ in range(int(np.ceil(_LONGEST / period)) + 2):
        rows = _run(motion, course, state, tolerance)
        first, state = rows[0, : motion.states], rows[-1, : motion.states]
        if (np.abs(state - first) <= _RECURS * np.abs(rows[:, : motion.states]).max(axis=0)).all():
            return rows
    raise ValueError(
        f"response must recur from period to period within {_LONGEST:g} s for a steady state, got none"
    )


def _run(motion: Motion, course: Course, start: Real, tolerance: float) -> Real:
    """Return states and tensions (k, n + q) at the rows; ValueError if the integration fails."""
    equations, tree, numbers, *_ = motion
    rows = np.empty((int(course.row.max()) + 1, motion.states + equations.f.shape[1]))
    if not drive(equations, tree, numbers, course, start, tolerance, rows):
        raise ValueError("struts must hold the vehicle in equilibrium and in motion, got others")
    return rows

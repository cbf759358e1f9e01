"""Integration in time of a vehicle with force laws, by power series of the motion.

A step ends on a knot of the road, where a law leaves its segment or a tyre the road, or where the series would
need too many terms: a step needs no second try.
"""

import numpy as np

from ...compiled import compiled, uncounted
from ...quantities import Real
from .crossings import first_exit, switch
from .drivable import Motion
from .equilibrium import begin, find_segments, settle
from .expansion import accelerate, place, react, states_at
from .system import TERMS, Course, Equations, Work, work_of
from .trees import Numbers, Tree, numbers_of

_FLOOR = 1e-3  # m, m/s, rad: errors of smaller states are relative to this
_SAFETY = 0.9  # of the longest step
_STEPS = 100_000  # between two knots of the road, at most

REACHED, NO_EQUILIBRIUM, STUCK = range(3)
"""How an integration ends: at the last knot, not begun, without progress."""


@uncounted(error_model="numpy", forceinline=True)
def _expand(
    e: Equations, tree: Tree, numbers: Numbers, work: Work, longest: float, tolerance: float
) -> tuple[int, float]:
    """Put in the power series; return the number of terms and the step [s] for which they suffice.

    Two terms in succession are below the tolerance then, as shares of each state's largest value.
    """
    last, term, power = np.inf, np.inf, 1.0
    for order in range(TERMS + 1):
        react(e, tree, numbers, work, order)
        if order == TERMS or (term <= 1 and last <= 1):
            break
        accelerate(e, work, order)
        last, term, power = term, 0.0, power * longest
        for i in range(work.size.size):
            term = max(term, abs(work.x[order + 1, i]) / work.size[i])
        term *= power / tolerance
    if order < TERMS or (term <= 1 and last <= 1):
        return order, longest
    return order, longest * _SAFETY * min(term ** (-1 / TERMS), last ** (-1 / (TERMS - 1)))


@uncounted(error_model="numpy", forceinline=True)
def _record(work: Work, terms: int, start: float, end: float, row: int, times: Real, rows: Real) -> int:
    """Fill in the rows of a step from one time to another; return the next row."""
    n = work.size.size
    while row < times.size and times[row] <= end:
        time = max(times[row] - start, 0.0)
        states_at(work, terms, time, rows[row, :n])
        for i in range(rows.shape[1] - n):
            total = work.tension[terms, i]
            for k in range(terms - 1, -1, -1):
                total = total * time + work.tension[k, i]
            rows[row, n + i] = total
        row += 1
    return row


@uncounted(error_model="numpy", forceinline=True)
def _go_on(work: Work, terms: int, step: float, state: Real) -> None:
    """Begin the next series where a step ends."""
    states_at(work, terms, step, state)
    for i in range(state.size):
        work.x[0, i] = state[i]
        work.size[i] = max(work.size[i], abs(state[i]) + _FLOOR)


@compiled(error_model="numpy")
def _travel(
    e: Equations,
    tree: Tree,
    numbers: Numbers,
    course: Course,
    work: Work,
    state: Real,
    tolerance: float,
    times: Real,
    rows: Real,
) -> int:
    """Take the states over a course, see `drive`."""
    row, knots = 0, course.knots
    for piece in range(knots.size - 1):
        time, rest, left = 0.0, knots[piece + 1] - knots[piece], _STEPS
        while rest > 0:
            place(course, piece, time, work.z)
            terms, longest = _expand(e, tree, numbers, work, rest, tolerance)
            step, which = first_exit(e, work, terms, longest, tolerance)
            start, reached = knots[piece] + time, step == rest
            end = knots[piece + 1] if reached else start + step
            row = _record(work, terms, start, end, row, times, rows)
            if which >= 0:
                switch(e, numbers, work, terms, step, which)
            _go_on(work, terms, step, state)
            time, rest, left = time + step, 0.0 if reached else rest - step, left - 1
            if left == 0 or not np.isfinite(state[0]):
                return STUCK
    return REACHED


def drive(motion: Motion, course: Course, state: Real, tolerance: float, times: Real, rows: Real) -> int:
    """Take the states (n,) over a course; return how it ends.

    States and tensions (m, n + q) at times (m,) are filled in. States of NaN are put in first, in equilibrium on
    the first heights.
    """
    e, tree = motion.equations, motion.tree
    values = np.require(motion.values, requirements=("C", "W"))  # read-only arrays are another type
    numbers, work = numbers_of(motion.program, tree, values), work_of(e, tree)
    if not np.isnan(state[0]):
        begin(numbers, work)
    elif not settle(e, tree, numbers, course, work, state):
        return NO_EQUILIBRIUM
    place(course, 0, 0.0, work.z)
    find_segments(e, tree, numbers, work, state)
    work.size[:] = np.abs(state) + _FLOOR
    return int(_travel(e, tree, numbers, course, work, state, tolerance, times, rows))

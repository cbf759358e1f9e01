"""Designs of least measure within the limits of a ride problem, by sequential quadratic programming (SLSQP)."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from operator import itemgetter
from typing import Any

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.measures.limits import Limit
from ..response.measures.measure import Measure
from ..response.measures.vibration import WheelMeasure
from ..response.problem import RideProblem
from ..search.run import Run

HELD = 1e-6
"""Tolerance of a limit, as a share of it."""

_TOLERANCE = 1e-7  # of the objective, beside that of a working point of force laws
_STARTS = 2  # designs of a run with the least of a measure


def least_within_limits(
    problem: RideProblem, objective: Measure, starts: Real, *, at: Limit | None = None, tolerance: float = 1e-12
) -> tuple[float, ...]:
    """Return the design of least `objective` within the limits of the problem, and `at` a further one.

    SLSQP starts from each of the `starts` (k, d) and ends where the objective changes by less than `tolerance`, as
    a share of its value at the first start; the best result counts. The maximum over wheels is not
    differentiable: it is replaced by a slack variable bounded below by each wheel (epigraph form).
    """
    from scipy.optimize import minimize

    if problem.kinds:
        raise ValueError(f"kinds must be none where a search descends, got {checks.shown(problem.kinds)}")
    smooth, wheels = _of_wheels(problem, objective, at)
    equal = 0 if at is None else len(_limits_of_wheels(problem, at))
    lower, width = np.asarray(problem.lower), np.subtract(problem.upper, problem.lower)
    first, last = len(smooth.measures), len(smooth.measures) + len(smooth.constraints) - equal
    scale = np.abs(smooth.evaluate(starts[:1])[0, :wheels]).max() or 1.0

    def values_at(point: Real) -> Real:
        return smooth.evaluate([lower + np.clip(point[:-1], 0, 1) * width])[0]

    def room(point: Real) -> Real:
        """Return the distance from the slack variable, the last value of a point, and from limits."""
        values = values_at(point)
        return np.concatenate([point[-1] - values[:wheels] / scale, -values[first:last]])

    def off(point: Real) -> Real:
        return values_at(point)[last:]

    def held(end: Real) -> bool:
        return bool(room(end).min() >= -HELD and np.abs(off(end)).max(initial=0.0) <= HELD)

    limits = [{"type": "ineq", "fun": room}, *([{"type": "eq", "fun": off}] if equal else [])]
    settings: dict[str, Any] = {"method": "SLSQP", "jac": "3-point", "constraints": limits}
    settings |= {"bounds": [(0, 1)] * len(lower) + [(None, None)], "options": {"ftol": tolerance, "maxiter": 200}}
    slack = smooth.evaluate(starts)[:, :wheels].max(axis=1) / scale
    units = np.column_stack([(starts - lower) / np.where(width > 0, width, 1.0), slack])
    ends = [end for end in (minimize(itemgetter(-1), unit, **settings).x for unit in units) if held(end)]
    if not ends:
        got = ", ".join(map(str, (*problem.constraints, *([] if at is None else [at]))))
        raise ValueError(f"limits must be those of a design within the bounds, got {got}")
    best = min(ends, key=itemgetter(-1))
    return tuple((lower + np.clip(best[:-1], 0, 1) * width).tolist())


def with_least(problem: RideProblem, run: Run) -> Run:
    """Return the run with the design of least of each measure beside its own; as it is where nothing is smooth.

    That is with kinds of variables, with measures by functions of a ride, and where the worst wheel counts in each
    of several load cases. A limit is met up to `HELD`.
    """
    if problem.kinds or not _is_smooth(problem) or not (rows := run.on_front()).size:
        return run
    designs = list[tuple[float, ...]]()
    for j, measure in enumerate(problem.measures):
        if isinstance(measure, WheelMeasure) and _is_mean(problem):
            continue
        starts = run.designs[rows[run.objectives[rows, j].argsort(kind="stable")[:_STARTS]]]
        with suppress(ValueError):  # where a descent fails the design of the run stays
            designs.append(least_within_limits(problem, measure, starts, tolerance=_TOLERANCE))
    if not designs:
        return run
    values = problem.evaluate(designs)
    m = len(problem.measures)
    g = values[:, m:]
    return replace(
        run,
        designs=np.vstack([run.designs, designs]),
        objectives=np.vstack([run.objectives, values[:, :m]]),
        constraints=np.vstack([run.constraints, np.where((g > 0) & (g <= HELD), 0.0, g)]),
    )


def _is_smooth(problem: RideProblem) -> bool:
    """Whether measures and limits are mean squares, or of statics and roll."""
    judged = [(one, one) for one in problem.measures] + [(one, one.measure) for one in problem.constraints]
    return not any(measure.of_ride and problem.in_cases(one)[0].values for one, measure in judged)


def _is_mean(problem: RideProblem) -> bool:
    """Whether an objective is the mean over load cases: that of the worst wheel is not the worst of means."""
    return len(problem.cases) > 1 and not problem.worst_case


def _of_wheels(problem: RideProblem, objective: Measure, at: Limit | None) -> tuple[RideProblem, int]:
    """Return the problem of single wheels, objective first and `at` last, and the number of wheels it has."""
    wheels = [objective] if _is_mean(problem) else _measures_of_wheels(problem, objective)
    labels = {one.label for one in wheels}
    others = [one for one in problem.measures if one.label not in labels] if len(wheels) < 2 else []
    limits = dict.fromkeys(
        each
        for one in (*problem.constraints, *([] if at is None else [at]))
        for each in _limits_of_wheels(problem, one)
    )
    smooth = problem.replace(measures=(*wheels, *others), constraints=tuple(limits))
    return smooth, len(wheels)


def _limits_of_wheels(problem: RideProblem, limit: Limit) -> list[Limit]:
    return [replace(limit, measure=one) for one in _measures_of_wheels(problem, limit.measure)]


def _measures_of_wheels(problem: RideProblem, measure: Measure) -> Sequence[Measure]:
    """Return a measure of the worst wheel as measures of single wheels, any other measure as it is."""
    if not isinstance(measure, WheelMeasure):
        return [measure]
    vehicle = problem.cases[0].vehicle
    places = [str(vehicle.meanings[name].where) for name in measure.responses(vehicle)]
    return [replace(measure, where=place, name="") for place in places] if len(places) > 1 else [measure]

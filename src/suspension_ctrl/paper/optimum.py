"""Best strut within a limit of suspension travel, by SLSQP and from a Pareto set (Table 5)."""

from collections.abc import Mapping
from dataclasses import replace
from operator import itemgetter
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.measures.measure import Measure
from ..response.measures.vibration import ACC, DTL, SWS, WheelMeasure
from ..response.problem import RideProblem
from ..search.indicators import non_dominated
from . import experiment, tables

if TYPE_CHECKING:
    import pandas as pd

    from ..search.run import Run

AT_LIMIT = 0.002
"""Largest distance of the travel from the limit, of a design picked for Table 5, as a share of the limit."""

_STARTS = 8  # designs of a run nearest to the limit, from which SLSQP starts
_HELD = 1e-6  # tolerance of a limit, as a share of it


def least_within_limit(
    problem: RideProblem, limit: float, objective: Measure, starts: Real, *, at_limit: bool = False
) -> tuple[float, ...]:
    """Return the design of least `objective` with SWS up to `limit` [m], or equal to it `at_limit`.

    Sequential quadratic programming (SLSQP) starts from each of the `starts` (k, d); the best result counts. The
    maximum over wheels is not differentiable: it is replaced by a slack variable bounded below by each wheel
    (epigraph form).
    """
    from scipy.optimize import minimize

    checks.positive("sws_limit", limit, "m")
    if problem.kinds:
        raise ValueError(f"kinds must be none where a search descends, got {checks.shown(problem.kinds)}")
    least, travels = _of_each_wheel(problem, objective), _of_each_wheel(problem, SWS())
    smooth = problem.replace(measures=(*least, *travels))
    lower, width = np.asarray(problem.lower), np.subtract(problem.upper, problem.lower)
    first, last = len(least), len(least) + len(travels)
    scale = smooth.evaluate(starts[:1])[0, :first].max()

    def values_at(point: Real) -> Real:
        return smooth.evaluate([lower + np.clip(point[:-1], 0, 1) * width])[0]

    def spare_travel(point: Real) -> Real:
        return 1 - values_at(point)[first:last] / limit

    def room(point: Real) -> Real:
        """Return the distance (c,) from the slack variable, the last value of a point, and from other limits."""
        values = values_at(point)
        return np.concatenate([point[-1] - values[:first] / scale, -values[last:]])

    def held(end: Real) -> bool:
        spare = spare_travel(end)
        return bool(min(room(end).min(), -np.abs(spare).max() if at_limit else spare.min()) >= -_HELD)

    limits = [{"type": "ineq", "fun": room}, {"type": "eq" if at_limit else "ineq", "fun": spare_travel}]
    settings: dict[str, Any] = {"method": "SLSQP", "jac": "3-point", "constraints": limits}
    settings |= {"bounds": [(0, 1)] * len(lower) + [(0, None)], "options": {"ftol": 1e-12, "maxiter": 200}}
    slack = smooth.evaluate(starts)[:, :first].max(axis=1) / scale
    units = np.column_stack([(starts - lower) / np.where(width > 0, width, 1.0), slack])
    ends = [end for end in (minimize(itemgetter(-1), unit, **settings).x for unit in units) if held(end)]
    if not ends:
        raise ValueError(f"sws_limit must be a travel that a design within the bounds has, got {limit} m")
    best = min(ends, key=itemgetter(-1))
    return tuple((lower + np.clip(best[:-1], 0, 1) * width).tolist())


def _of_each_wheel(problem: RideProblem, measure: Measure) -> list[Measure]:
    """Return a measure of the worst wheel as measures of single wheels, any other measure as it is."""
    if isinstance(measure, WheelMeasure):
        return [replace(measure, where=wheel) for wheel in problem.cases[0].vehicle.tyres]
    return [measure]


def pick_at_limit(
    problem: RideProblem, run: "Run", limit: float, objective: Measure, below: float = AT_LIMIT
) -> tuple[float, ...]:
    """Return the design of least `objective` of a Pareto set with SWS up to a share `below` under the limit."""
    sws = run.objectives[:, problem.measures.index(SWS())]
    at_limit = ((1 - below) * limit <= sws) & (sws <= limit)
    candidates = np.flatnonzero(non_dominated(run.objectives) & at_limit)
    if candidates.size == 0:
        raise ValueError(
            f"sws_limit must be a travel within {100 * below:g} % of which the Pareto set has a design, its "
            f"{sws.size} have {sws.min():.4f} to {sws.max():.4f} m, got {limit} m"
        )
    best = candidates[run.objectives[candidates, problem.measures.index(objective)].argmin()]
    return tuple(run.designs[best].tolist())


def table5(problem: RideProblem, run: "Run", limit: float, own: Mapping[str, tuple[float, ...]]) -> "pd.DataFrame":
    """Return Table 5: a vehicle's `own` designs or the paper's, the best within the limit, and picked designs."""
    columns = experiment.table5()
    published = {"reference car": columns["reference"], "published optimum": columns["optimised"]}
    papers = {"reference car": experiment.reference_design(), "published optimum": experiment.optimised_design()}
    designs = dict(own or papers)
    travel = run.objectives[:, problem.measures.index(SWS())]
    starts = run.designs[np.abs(travel - limit).argsort(kind="stable")[:_STARTS]]
    for objective in (ACC(), DTL()):
        name = f"least {objective} up to the limit" if own else f"exact, least {objective}"
        designs[name] = least_within_limit(problem, limit, objective, starts, at_limit=not own)
    below = 1.0 if own else AT_LIMIT
    for objective in (ACC(), DTL()):
        designs[f"picked, least {objective}"] = pick_at_limit(problem, run, limit, objective, below)
    return tables.beside_published(problem, designs, {} if own else published)

"""The best strut within a limit of suspension travel: exact, and picked from a Pareto set (Table 5)."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize, minimize_scalar

from . import checks
from .indicators import non_dominated
from .objectives import RideProblem
from .optimisers import Run

_AT_LIMIT = 0.002
"""How far below the limit, as a fraction of it, the travel of a picked design may be."""

_HELD = 1e-6
"""How far beyond a limit, as a share of it, a design may be that is called within."""

_SPRINGS = 200
"""Spring stiffnesses tried along the curve before the best one is refined."""


def damper_at_limit(problem: RideProblem, spring: float, limit: float) -> float:
    """Return the damper [N s/m] that brings SWS to `limit` [m] with this spring [N/m].

    Travel falls as damping rises; NaN where no damper within the bounds meets the limit.
    """

    def excess(damper: float) -> float:
        return float(problem.evaluate([[spring, damper]])[0, 1]) - limit

    low, high = problem.lower[1], problem.upper[1]
    if excess(low) < 0 or excess(high) > 0:
        return float("nan")
    return float(brentq(excess, low, high, xtol=1e-9, rtol=1e-14))


def best_at_limit(problem: RideProblem, limit: float, objective: str) -> tuple[float, float]:
    """Return the design with the least `objective` on the curve SWS = `limit`.

    Parameters
    ----------
    problem : RideProblem
        Bounds and objectives.
    limit : float
        Suspension working space [m].
    objective : {"ACC", "DTL"}
        What is least.

    Returns
    -------
    (float, float)
        Spring [N/m] and damper [N s/m].

    Raises
    ------
    ValueError
        If no design within the bounds has this travel.
    """
    checks.positive("sws_limit", limit, "m")
    column = problem.objectives.index(objective)

    def along_curve(spring: float) -> float:
        damper = damper_at_limit(problem, spring, limit)
        return damper if np.isnan(damper) else float(problem.evaluate([[spring, damper]])[0, column])

    springs = np.linspace(problem.lower[0], problem.upper[0], _SPRINGS)
    values = np.array([along_curve(spring) for spring in springs])
    if np.isnan(values).all():
        corners = problem.evaluate([problem.lower, problem.upper])[:, 1]
        raise ValueError(
            f"sws_limit must be a travel that a design within the bounds has, about {corners.min():.4f} to "
            f"{corners.max():.4f} m, got {limit} m"
        )
    best = int(np.nanargmin(values))
    start = _last_on_curve(problem, springs[best], springs[max(best - 1, 0)], limit)
    end = _last_on_curve(problem, springs[best], springs[min(best + 1, _SPRINGS - 1)], limit)
    inside = minimize_scalar(along_curve, bounds=(start, end), method="bounded", options={"xatol": 1e-6}).x
    spring = float(min((start, springs[best], inside, end), key=along_curve))
    return spring, damper_at_limit(problem, spring, limit)


def _last_on_curve(problem: RideProblem, inside: float, toward: float, limit: float) -> float:
    """Return the spring [N/m] farthest from `inside` up to `toward` for which a damper meets the limit."""
    if not np.isnan(damper_at_limit(problem, toward, limit)):
        return toward
    while (middle := (inside + toward) / 2) not in (inside, toward):
        if np.isnan(damper_at_limit(problem, middle, limit)):
            toward = middle
        else:
            inside = middle
    return inside


def least_within_limit(
    problem: RideProblem, limit: float, objective: str, starts: NDArray[np.float64]
) -> tuple[float, ...]:
    """Return the design of any number of variables with the least `objective` among those up to SWS = `limit`.

    From each start sequential quadratic programming (SLSQP) goes downhill; the best of where it ends counts.

    Parameters
    ----------
    problem : RideProblem
        Bounds, objectives and constraints, all of which are held.
    limit : float
        Suspension working space [m].
    objective : str
        What is least.
    starts : (k, d) ndarray
        Designs, e.g. of a Pareto set.

    Returns
    -------
    tuple of float
        The design.

    Raises
    ------
    ValueError
        If no design within the limit is found.
    """
    checks.positive("sws_limit", limit, "m")
    lower, width = np.asarray(problem.lower), np.subtract(problem.upper, problem.lower)
    m, column, sws = len(problem.objectives), problem.objectives.index(objective), problem.objectives.index("SWS")
    scale = problem.evaluate(starts[:1])[0, column]

    def values(unit: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return objective and constraints (1 + c,), g <= 0, at a point (d,) of the unit cube."""
        scores = problem.evaluate([lower + np.clip(unit, 0, 1) * width])[0]
        return np.array([scores[column] / scale, scores[sws] / limit - 1, *scores[m:]])

    def height(unit: NDArray[np.float64]) -> float:
        """Return the objective at a point."""
        return float(values(unit)[0])

    def room(unit: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far within the constraints (c,) a point is."""
        return -values(unit)[1:]

    settings: dict[str, Any] = {
        "method": "SLSQP",
        "jac": "3-point",
        "bounds": [(0, 1)] * len(lower),
        "constraints": {"type": "ineq", "fun": room},
        "options": {"ftol": 1e-12, "maxiter": 200},
    }
    ends = [minimize(height, (start - lower) / width, **settings).x for start in starts]
    reached = np.array([values(end) for end in ends])
    allowed = np.flatnonzero((reached[:, 1:] <= _HELD).all(axis=1))
    if allowed.size == 0:
        raise ValueError(f"sws_limit must be a travel that a design within the bounds has, got {limit} m")
    best = allowed[reached[allowed, 0].argmin()]
    return tuple((lower + np.clip(ends[best], 0, 1) * width).tolist())


def pick_at_limit(problem: RideProblem, run: Run, limit: float, objective: str) -> tuple[float, ...]:
    """Return the design of a run's Pareto set with the least `objective` among those at SWS = `limit`.

    At the limit are those up to 0.2 % below it, and none beyond.

    Parameters
    ----------
    problem : RideProblem
        The problem of the run.
    run : Run
        Its final population.
    limit : float
        Suspension working space [m].
    objective : {"ACC", "DTL"}
        What is least.

    Returns
    -------
    tuple of float
        The design.

    Raises
    ------
    ValueError
        If the Pareto set has no design there.
    """
    sws = run.objectives[:, problem.objectives.index("SWS")]
    at_limit = ((1 - _AT_LIMIT) * limit <= sws) & (sws <= limit)
    there = np.flatnonzero(non_dominated(run.objectives) & at_limit)
    if there.size == 0:
        raise ValueError(
            f"sws_limit must be a travel within {100 * _AT_LIMIT:g} % of which the Pareto set has a design, its "
            f"{sws.size} have {sws.min():.4f} to {sws.max():.4f} m, got {limit} m"
        )
    best = there[run.objectives[there, problem.objectives.index(objective)].argmin()]
    return tuple(run.designs[best].tolist())

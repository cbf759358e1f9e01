"""The best strut within a limit of suspension travel: exact, and picked from a Pareto set (Table 5)."""

from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize, minimize_scalar

from .. import checks
from ..response.problem import RideProblem
from ..search.driver import Run
from ..search.indicators import non_dominated

AT_LIMIT = 0.002
"""How far below the limit, as a share of it, the travel of a picked design may be in Table 5."""

_HELD = 1e-6
"""How far beyond a limit, as a share of it, a design may be that is called within."""

_SPRINGS = 200
"""Spring stiffnesses tried along the curve before the best one is refined."""


def damper_at_limit(problem: RideProblem, spring: float, limit: float) -> float:
    """Return the damper [N s/m] that brings SWS to `limit` [m] with this spring [N/m].

    Travel falls as damping rises; NaN where no damper within the bounds meets the limit.
    """
    sws = problem.objectives.index("SWS")

    def excess(damper: float) -> float:
        return float(problem.evaluate([[spring, damper]])[0, sws]) - limit

    low, high = problem.lower[1], problem.upper[1]
    if excess(low) < 0 or excess(high) > 0:
        return float("nan")
    return float(brentq(excess, low, high, xtol=1e-9, rtol=1e-14))


def best_at_limit(problem: RideProblem, limit: float, objective: str) -> tuple[float, float]:
    """Return the design with the least `objective` on the curve SWS = `limit`; constraints are not held.

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
        corners = problem.evaluate([problem.lower, problem.upper])[:, problem.objectives.index("SWS")]
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

    From each start sequential quadratic programming (SLSQP) goes downhill; the best of where it ends counts. The
    largest of several wheels has kinks, on which that stops short: in its place stands a further variable that no
    wheel may exceed.

    Parameters
    ----------
    problem : RideProblem
        Bounds and constraints, which are held too.
    limit : float
        Suspension working space of every wheel [m].
    objective : {"ACC", "DTL"}
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
    wheels = problem.cases[0].vehicle.tyres
    least = [objective] if objective == "ACC" else [f"{objective} {wheel}".strip() for wheel in wheels]
    smooth = problem.replace(measures=(*least, *(f"SWS {wheel}".strip() for wheel in wheels)))
    lower, width = np.asarray(problem.lower), np.subtract(problem.upper, problem.lower)
    most, travels = len(least), len(least) + len(wheels)
    scale = smooth.evaluate(starts[:1])[0, :most].max()

    def room(point: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return what is left (c,) up to the point's last value, the objective over `scale`, and to all limits."""
        scores = smooth.evaluate([lower + np.clip(point[:-1], 0, 1) * width])[0]
        return np.concatenate(
            [point[-1] - scores[:most] / scale, 1 - scores[most:travels] / limit, -scores[travels:]]
        )

    settings: dict[str, Any] = {
        "method": "SLSQP",
        "jac": "3-point",
        "bounds": [(0, 1)] * len(lower) + [(0, None)],
        "constraints": {"type": "ineq", "fun": room},
        "options": {"ftol": 1e-12, "maxiter": 200},
    }
    units = np.column_stack([(starts - lower) / width, smooth.evaluate(starts)[:, :most].max(axis=1) / scale])
    ends = [minimize(itemgetter(-1), unit, **settings).x for unit in units]
    held = [end for end in ends if room(end).min() >= -_HELD]
    if not held:
        raise ValueError(f"sws_limit must be a travel that a design within the bounds has, got {limit} m")
    best = min(held, key=lambda end: float(end[-1]))
    return tuple((lower + np.clip(best[:-1], 0, 1) * width).tolist())


def pick_at_limit(
    problem: RideProblem, run: Run, limit: float, objective: str, below: float = AT_LIMIT
) -> tuple[float, ...]:
    """Return the design of a run's Pareto set with the least `objective` among those at SWS = `limit`.

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
    below : float
        How far below the limit, as a share of it, designs still count as at it; none does beyond. With 1 all
        within the limit do.

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
    at_limit = ((1 - below) * limit <= sws) & (sws <= limit)
    there = np.flatnonzero(non_dominated(run.objectives) & at_limit)
    if there.size == 0:
        raise ValueError(
            f"sws_limit must be a travel within {100 * below:g} % of which the Pareto set has a design, its "
            f"{sws.size} have {sws.min():.4f} to {sws.max():.4f} m, got {limit} m"
        )
    best = there[run.objectives[there, problem.objectives.index(objective)].argmin()]
    return tuple(run.designs[best].tolist())

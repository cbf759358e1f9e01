"""Designs chosen from the front of a run: knee, compromise, least of a measure within limits, others between.

Objectives are scaled to the front, from 0 at their least to 1 at their largest value.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..quantities import Integer, Real, quantity
from ..search.population import Population
from ..search.problem import Minimisable, headers_of
from ..search.spreading import farthest_first

if TYPE_CHECKING:
    import pandas as pd

KNEE, COMPROMISE, BETWEEN, NONE_WORSE = "knee", "compromise", "between", "none worse"
EQUAL = 0.05
"""Largest change against the present design that counts as none [%]: it is shown as 0.0."""
SAME = 1e-4
"""Largest difference of scaled objectives of designs that count as one."""
_FLAT = 1e-6  # largest span of an objective that is equal throughout a front, as a share of its size

Within = Mapping[str, float | str | tuple[float | str, float | str]]


class Front(NamedTuple):
    """The front of a run: its non-dominated feasible designs, each once."""

    designs: Real  # (k, d)
    objectives: Real  # (k, m)
    constraints: Real  # (k, c)


def front_of(problem: Minimisable, run: Population) -> Front:
    """Return the front of a run; ValueError unless it is of the problem and has a feasible design."""
    checks.of_kind("run", run, Population)
    shape = len(problem.variables), len(problem.objectives)
    if (run.designs.shape[1], run.objectives.shape[1]) != shape:
        needed = f"of the problem, {shape[0]} variables and {shape[1]} objectives"
        raise ValueError(f"run must be {needed}, got {run.designs.shape[1]} and {run.objectives.shape[1]}")
    rows = run.on_front()
    if rows.size == 0:
        raise ValueError(f"run must have a feasible design, got none of {len(run.designs)}")
    return Front(run.designs[rows], run.objectives[rows], run.constraints[rows])


def flat(objectives: Real) -> NDArray[np.bool_]:
    """Return which objectives (m,) are equal throughout a front (k, m), but for rounding and ends of descents."""
    return np.ptp(objectives, axis=0) <= _FLAT * np.abs(objectives).max(axis=0)


def scaled(objectives: Real) -> Real:
    """Return objectives (k, m) of a front from 0 at their least to 1 at their largest value, 0 of flat ones."""
    equal = flat(objectives)
    span = np.where(equal, np.inf, np.ptp(objectives, axis=0))
    return np.asarray((objectives - objectives.min(axis=0)) / span)


def improving(changes: Real) -> Integer:
    """Return the rows of changes (k, m) [%] that gain in a measure and lose in none, first the largest sum."""
    rows = np.flatnonzero((changes <= EQUAL).all(axis=1) & (changes < -EQUAL).any(axis=1))
    return rows[changes[rows].sum(axis=1).argsort(kind="stable")]


def chosen(objectives: Real, names: tuple[str, ...], count: int, changes: Real | None = None) -> dict[int, str]:
    """Return the names of candidates by row of objectives (k, m), by rising first objective.

    First the least of each objective, of several equal ones that of the least sum; knee and compromise; if none of
    them is `improving` by changes (k, m) against the present design, the row that is most so; then, up to `count`,
    repeatedly the row farthest from all before it. Rows that are equal up to `SAME` are one.
    """
    points = scaled(objectives)
    total = points.sum(axis=1)
    found: dict[int, list[str]] = {}

    def equal(row: int) -> int | None:
        """Return the row found so far that is equal to another."""
        return next((one for one in found if np.abs(points[one] - points[row]).max() <= SAME), None)

    least = [(int(np.lexsort((total, points[:, j]))[0]), f"least {name}") for j, name in enumerate(names)]
    for row, name in [*least, (_knee(points), KNEE), (_compromise(points), COMPROMISE)]:
        known = equal(row)
        found.setdefault(row if known is None else known, []).append(name)
    better = [] if changes is None else improving(changes).tolist()
    if better and not set(better) & set(found):
        found[better[0]] = [NONE_WORSE]
    size = min(max(count, len(found)), len(points))
    for row in farthest_first(points, np.array(list(found)), size).tolist():
        if equal(row) is None:
            found[row] = [BETWEEN]
    order = sorted(found, key=lambda row: tuple(objectives[row].tolist()))
    return {row: ", ".join(found[row]) for row in order}


def _knee(points: Real) -> int:
    """Return the row of scaled objectives (k, m) farthest below the plane through the unit points."""
    return int(points.sum(axis=1).argmin())


def _compromise(points: Real) -> int:
    """Return the row of scaled objectives (k, m) nearest to the ideal point."""
    return int(np.linalg.norm(points, axis=1).argmin())


def knee(problem: Minimisable, run: Population) -> "pd.Series[float]":
    """Return the knee of a front: from there a gain in one objective costs most in the others.

    With objectives scaled to the front, from 0 to 1, it is the design farthest below the plane through the m
    points that have one objective at 1 and all others at 0: that of the least sum. Of two objectives these points
    are the ends of the front, and the plane is the chord of Das [1]_.

    Parameters
    ----------
    problem : Problem or RideProblem
        The problem of the run.
    run : Run
        The result of a search; its non-dominated feasible designs are the front.

    Returns
    -------
    Series
        Variables and objectives with units in the labels, as a row of ``run.front()``.

    Raises
    ------
    ValueError
        If the run is of another problem, or has no feasible design.

    References
    ----------
    .. [1] I. Das, "On characterizing the 'knee' of the Pareto curve based on normal-boundary intersection",
       Structural Optimization 18, 1999.

    Examples
    --------
    Of the discomfort and the travel of the paper's car on class C:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(
    ...     file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, measures=["ACC", "SWS"]
    ... )
    >>> run = sc.minimise(problem, sc.Nsga2(population=100), iterations=30, seed=1)
    >>> best = sc.knee(problem, run)
    >>> print(f"ACC {best['ACC [m/s^2]']:.1f} m/s^2, SWS {1e3 * best['SWS [m]']:.0f} mm")
    ACC 1.4 m/s^2, SWS 9 mm
    """
    front = front_of(problem, run)
    return _row(problem, front, _knee(scaled(front.objectives)), KNEE)


def pick(
    problem: Minimisable, run: Population, *, minimise: str, within: Within | None = None
) -> "pd.Series[float]":
    """Return the design of the front with the least of one objective within limits on others.

    Parameters
    ----------
    problem : Problem or RideProblem
        The problem of the run.
    run : Run
        The result of a search; its non-dominated feasible designs are the front.
    minimise : str
        Name of an objective.
    within : mapping of str to float, text or pair of them, optional
        By objective its largest value, or least and largest value, in SI units or with a unit:
        ``{"SWS": "28.7mm"}``.

    Returns
    -------
    Series
        Variables and objectives with units in the labels, as a row of ``run.front()``.

    Raises
    ------
    ValueError
        If an objective is unknown, the run is of another problem, or no design is within the limits.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=200), iterations=30, seed=1)
    >>> best = sc.pick(problem, run, minimise="ACC", within={"SWS": "20mm", "DTL": "1kN"})
    >>> bool(best["SWS [m]"] <= 0.02 and best["DTL [N]"] <= 1e3)
    True
    """
    names = list(problem.objectives)
    checks.one_of("minimise", minimise, names)
    checks.mapped("within", within or {})
    front = front_of(problem, run)
    inside = np.ones(len(front.objectives), dtype=bool)
    for name, given in (within or {}).items():
        checks.one_of("within", name, names)
        low, high = interval(name, given, problem.units.get(name, ""))
        values = front.objectives[:, names.index(name)]
        inside &= (low <= values) & (values <= high)
        if not inside.any():
            unit = problem.units.get(name, "")
            have = f"{values.min():.6g} to {values.max():.6g} {unit}".rstrip()
            raise ValueError(
                f"within must leave a design of the front, whose {len(values)} have {name} from {have}, "
                f"got {checks.shown(given)} for {name}"
            )
    rows = np.flatnonzero(inside)
    return _row(
        problem, front, int(rows[front.objectives[rows, names.index(minimise)].argmin()]), f"least {minimise}"
    )


def interval(name: str, given: Any, unit: str) -> tuple[float, float]:
    """Return the least and the largest value of an objective."""
    unit = "" if unit == "-" else unit
    pair = given if isinstance(given, tuple | list) and len(given) == 2 else (-np.inf, given)
    low, high = (quantity(name, one, unit) if isinstance(one, str) else one for one in pair)
    for value in (low, high):
        if not isinstance(value, int | float | np.number) or np.isnan(value):
            raise ValueError(f"within must have a number or a pair of them for {name}, got {checks.shown(given)}")
    return float(low), float(high)


def _row(problem: Minimisable, front: Front, row: int, name: str) -> "pd.Series[float]":
    import pandas as pd

    values = np.concatenate([front.designs[row], front.objectives[row]])
    return pd.Series(values, index=list(headers_of(problem)), name=name)

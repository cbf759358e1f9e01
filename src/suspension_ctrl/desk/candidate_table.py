"""Candidates of a front as a table: designs, changes against the present one, modes, travel, active bounds."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, column_headers
from ..response.curves import setting_of
from ..response.linearisation import linear_at
from ..response.measures.gaussian import LargestPeak
from ..response.measures.measure import Measure
from ..response.measures.peak import Peak, responses_at
from ..response.problem import RideProblem
from ..search.population import Population
from ..search.problem import Minimisable, headers_of
from ..vehicles.modes import FREQUENCY, RATIO
from ..vehicles.vehicle import AssembledVehicle
from .active import reached
from .choosing import chosen, front_of

if TYPE_CHECKING:
    import pandas as pd

PRESENT = "present design"
DISTANCE = 1000.0
"""Distance of the expected largest travel [m]."""

COUNT = 7
"""Number of candidates."""

Present = Mapping[str, float] | ArrayLike
"""A design by variable, in their order, or a row of a front."""
P = TypeVar("P", bound=Minimisable)


def candidates(
    problem: Minimisable, run: Population, *, present: Present | None = None, count: int = COUNT
) -> "pd.DataFrame":
    """Return designs of a front to choose from, side by side with the present design.

    They are the least of each objective; the `knee`; the compromise, nearest to the ideal point with objectives
    scaled to the front, from 0 to 1 [1]_; if all of these are worse than the present design in a measure, one that
    is worse in none, with the largest reductions in sum; and further designs between them, each the farthest from
    all before it [2]_. A design that is several of these has all their names.

    Parameters
    ----------
    problem : Problem or RideProblem
        The problem of the run.
    run : Run
        The result of a search; its non-dominated feasible designs are the front.
    present : mapping of str to float, or (d,) array_like, optional
        The design of today, by variable or in their order; it may be outside the bounds.
    count : int
        Number of candidates, more if more of them have names, fewer if the front has fewer designs that differ.

    Returns
    -------
    DataFrame
        By rising first objective, the present design as number 0 before them. Columns: ``name``; variables and
        objectives with units; the change of each objective against the present design [%]; ``active``, bounds
        within 1 % of their range, and limits within 1 %. Of a `RideProblem` with masses and links also
        undamped frequency and damping ratio of each mode in the first load case; the peak travel in each event,
        and the expected largest travel over 1 km of road, in the worst load case. Force laws are linearised.

    Raises
    ------
    ValueError
        If the run is of another problem or has no feasible design, or about the present design.

    References
    ----------
    .. [1] M. Zeleny, "Compromise programming", in Multiple Criteria Decision Making, University of South Carolina
       Press, 1973.
    .. [2] H. K. Singh, K. S. Bhattacharjee, T. Ray, "Distance-based subset selection for benchmarking in
       evolutionary multi/many-objective optimization", IEEE Trans. Evol. Comput. 23(5), 2019.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=100), iterations=30, seed=1)
    >>> table = sc.candidates(problem, run, present=file.setting)
    >>> [name for name in table.name if name != "between"]
    ['present design', 'least ACC', 'none worse', 'compromise', 'least DTL, knee', 'least SWS']
    >>> first = table.loc[1]
    >>> print(f"{first['ACC change [%]']:.0f} %, {first['heave [Hz]']:.1f} Hz; {first['active']}")
    -22 %, 0.4 Hz; damper at its lower bound
    """
    front = front_of(problem, run)
    changes = against_present(problem, front.objectives, present)
    names = chosen(front.objectives, tuple(problem.objectives), checks.at_least("count", count, 1), changes)
    rows = list(names)
    values = np.hstack([front.objectives[rows], front.constraints[rows]])
    return table_of(problem, list(names.values()), front.designs[rows], values, present)


def table_of(
    problem: Minimisable, names: Sequence[str], designs: Real, values: Real, present: Present | None
) -> "pd.DataFrame":
    """Return the table of `candidates` of designs (n, d) with values (n, m + c) by their names (n,)."""
    import pandas as pd

    labels, first, wide, m = list(names), 1, problem, len(problem.objectives)
    if present is not None:
        own = design_of(problem, present)
        wide = reaching(problem, own)
        labels, first = [PRESENT, *labels], 0
        designs, values = np.vstack([own, designs]), np.vstack([wide.evaluate(own[None]), values])
    table = pd.DataFrame(np.hstack([designs, values[:, :m]]), columns=list(headers_of(problem)))
    table.insert(0, "name", labels)
    parts = [table, *([] if present is None else [_changes(problem, values[:, :m])])]
    if isinstance(wide, RideProblem):
        parts += [_modes(wide, designs), _travels(wide, designs)]
    active = reached(problem, designs, values[:, m:])
    whole = pd.concat(parts, axis=1).assign(active=["; ".join(one) for one in active])
    return whole.set_axis(pd.RangeIndex(first, first + len(whole), name="candidate"))


def design_of(problem: Minimisable, present: Present, name: str = "present") -> Real:
    """Return the present design (d,), or another of this name; ValueError unless it has all variables."""
    names = list(problem.variables)
    if hasattr(present, "to_dict"):  # a row of a front
        row = present.to_dict()
        headers = dict(zip(headers_of(problem), names, strict=False))
        present = {headers.get(header, header): value for header, value in row.items()}
    if isinstance(present, Mapping):
        if missing := [one for one in names if one not in present]:
            needed, lacking = checks.listing(names, missing[0]), checks.listing(missing)
            raise ValueError(f"{name} must have {needed}, got none for {lacking}")
        present = [present[one] for one in names]
    values = checks.reals(f"{name} must be", present)
    if values.shape != (len(names),) or not np.isfinite(values).all():
        raise ValueError(f"{name} must be finite values of {checks.listing(names)}, got {checks.shown(present)}")
    return values


def reaching(problem: P, design: Real) -> P:
    """Return the problem with bounds that reach a design (d,), without kinds where they do not."""
    inside = (np.asarray(problem.lower) <= design) & (design <= np.asarray(problem.upper))
    if inside.all() or not isinstance(problem, RideProblem):
        return problem
    pairs = zip(problem.bounds.items(), design.tolist(), strict=True)
    bounds = {name: (min(low, value), max(high, value)) for (name, (low, high)), value in pairs}
    wide: Any = problem.replace(bounds=bounds, kinds={})
    return wide


def _changes(problem: Minimisable, objectives: Real) -> "pd.DataFrame":
    """Return the changes of objectives (n, m) against the first row [%], NaN against 0."""
    import pandas as pd

    changes = changes_of(objectives, objectives[0])
    return pd.DataFrame(changes, columns=[f"{name} change [%]" for name in problem.objectives])


def against_present(problem: Minimisable, objectives: Real, present: Present | None) -> Real | None:
    """Return the changes of objectives (k, m) against the present design [%]; None if it is not known."""
    if present is None:
        return None
    own = design_of(problem, present)
    before = reaching(problem, own).evaluate(own[None])[0, : objectives.shape[1]]
    return full_changes(objectives, before)


def full_changes(objectives: Real, before: Real) -> Real:
    """Return the changes of objectives (k, m) against present ones (m,) [%]; against 0 infinite or none."""
    changes = changes_of(objectives, before)
    return np.where(np.isnan(changes), np.where(objectives > before, np.inf, 0.0), changes)


def changes_of(values: ArrayLike, present: ArrayLike) -> Real:
    """Return the changes of values (..., m) against present ones (m,) [%], NaN against 0."""
    size = np.abs(present)
    return np.asarray(100 * np.subtract(values, present) / np.where(size > 0, size, np.nan))


def _modes(problem: RideProblem, designs: Real) -> "pd.DataFrame":
    """Return frequency and damping ratio of each mode of designs (n, d) in the first case; none of a plant."""
    import pandas as pd

    rows = []
    for design in designs.tolist():
        vehicle, setting = linear_at(problem.cases[0], setting_of(problem, design), problem.band)
        if not isinstance(vehicle, AssembledVehicle):
            return pd.DataFrame(index=range(len(designs)))
        modes = vehicle.modes(setting)
        both = zip(modes["name"], modes[FREQUENCY], modes[RATIO], strict=True)
        rows.append(
            {
                f"{name} {what}": value
                for name, f, ratio in both
                for what, value in (("[Hz]", f), ("damping [-]", ratio))
            }
        )
    return pd.DataFrame(rows)


def _travels(problem: RideProblem, designs: Real) -> "pd.DataFrame":
    """Return the peak travel of designs (n, d) in each event and the largest one expected on the road."""
    import pandas as pd

    measures = _travel_measures(problem)
    if not measures:
        return pd.DataFrame(index=range(len(designs)))
    judged = problem.replace(measures=[*measures, problem.measures[0]], constraints=(), worst_case=True)
    names = [one.label for one in measures]
    return pd.DataFrame(judged.evaluate(designs)[:, : len(names)], columns=column_headers(names, judged.units))


def _travel_measures(problem: RideProblem) -> Sequence[Measure]:
    """Return the measures of largest travel, none of a vehicle without travel."""
    try:
        for case in problem.cases:
            responses_at(case.vehicle, "travel")
    except ValueError:
        return []
    events = dict.fromkeys(event for case in problem.cases for event in case.events)
    peaks = [Peak("travel", event, name=f"peak travel in {event}") for event in events]
    return [*peaks, LargestPeak("travel", DISTANCE, name=f"largest travel in {DISTANCE / 1e3:g} km")]

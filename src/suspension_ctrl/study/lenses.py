"""Lenses of a comparison: quality at equal iterations, evaluations or time, and effort to a given quality.

Between two judged states quality is taken as linear in the logarithm of evaluations, and evaluations in time.
"""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
import pandas as pd

from .judging import INDICATORS

ITERATIONS, EVALUATIONS, TIME = "equal iterations", "equal evaluations", "equal time"
RUN = ["population", "algorithm", "seed", "set"]


def with_seconds(quality: pd.DataFrame, clock: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of `Study.table` with seconds interpolated in `clock`, `timing.seconds_by_evaluations`."""
    by = ["algorithm", "population"]
    timed = {key: part.sort_values("evaluations") for key, part in clock.groupby(by)}
    seconds = pd.Series(np.nan, index=quality.index)
    for key, part in quality.groupby(by):
        seconds[part.index] = np.interp(part.evaluations, timed[key].evaluations, timed[key].seconds)
    return quality.assign(seconds=seconds)


def at_equal(
    quality: pd.DataFrame, iterations: Sequence[int], cost: Mapping[tuple[str, int], int]
) -> pd.DataFrame:
    """Return a row of each run at equal iterations, evaluations and time (column ``lens``).

    At a number of iterations, equal evaluations are the most that an algorithm spends in them, equal time is that
    of the first algorithm. Rows are of the last judged state within; at equal time they are interpolated to the
    next one, but for the columns budget and members. A run that finished early keeps its final state. `quality` is
    from `with_seconds`; `cost` is the evaluations per iteration by algorithm and population, the first algorithm
    first.
    """
    (first, _), *_ = cost
    parts = []
    for population, count in product(quality.population.unique(), iterations):
        part = quality[quality.population == population]
        spent = {name: population + count * each for (name, size), each in cost.items() if size == population}
        timed = part[(part.algorithm == first) & (part.evaluations <= spent[first])]
        found = {
            ITERATIONS: _last(part[part.evaluations <= part.algorithm.map(spent)]),
            EVALUATIONS: _last(part[part.evaluations <= max(spent.values())]),
            TIME: _at_time(part, timed.seconds.max()),  # no rows if the first algorithm has no run
        }
        parts += [rows.assign(lens=lens, iterations=count) for lens, rows in found.items()]
    return pd.concat(parts, ignore_index=True)


def _last(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the last row of each run."""
    return rows.groupby(RUN, sort=False).tail(1)


def _at_time(quality: pd.DataFrame, seconds: float) -> pd.DataFrame:
    """Return a row of each run at a time [s]; a number that is not finite there is that of the state before."""
    rows, names = _last(quality[quality.seconds <= seconds]), ["evaluations", "seconds", *INDICATORS]
    before, after = rows[names], quality.groupby(RUN, sort=False)[names].shift(-1).loc[rows.index]
    share = (seconds - before.seconds) / (after.seconds - before.seconds)  # NaN of a run that has ended
    spent = before.evaluations + share * (after.evaluations - before.evaluations)
    along = np.log(spent / before.evaluations) / np.log(after.evaluations / before.evaluations)
    found = before + (after - before).mul(along, axis=0)
    found = found.assign(evaluations=spent, seconds=before.seconds + share * (after.seconds - before.seconds))
    return rows.assign(**found.where(np.isfinite(found), before))


def to_reach(quality: pd.DataFrame, target: float) -> pd.DataFrame:
    """Return a row per population, set and algorithm: runs, runs that reached the target, and median effort.

    A run reaches it where its relative hypervolume first crosses it, between two judged states.
    """
    # a run that does not reach the relative hypervolume counts as infinite effort; an infinite median is NaN
    first = quality[quality.relative_hypervolume >= target].groupby(RUN, sort=False).head(1)
    names = ["evaluations", "seconds", "relative_hypervolume"]
    after, before = first[names], quality.groupby(RUN, sort=False)[names].shift().loc[first.index]
    rise = after.relative_hypervolume - before.relative_hypervolume
    along = (target - before.relative_hypervolume) / rise  # NaN of a run that starts there
    spent = before.evaluations * (after.evaluations / before.evaluations) ** along
    share = (spent - before.evaluations) / (after.evaluations - before.evaluations)
    seconds = before.seconds + share * (after.seconds - before.seconds)
    reached = first.assign(evaluations=spent.fillna(after.evaluations), seconds=seconds.fillna(after.seconds))
    runs = quality[RUN].drop_duplicates().merge(reached[[*RUN, "evaluations", "seconds"]], on=RUN, how="left")
    groups = runs.fillna(np.inf).groupby(["population", "set", "algorithm"], sort=False)
    table = groups[["evaluations", "seconds"]].median().replace(np.inf, np.nan)
    table.insert(0, "runs", groups.size())
    table.insert(1, "reached", groups.evaluations.agg(lambda spent: np.isfinite(spent).sum()))
    return table.reset_index()

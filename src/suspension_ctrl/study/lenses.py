"""Lenses of a comparison: quality at equal iterations, evaluations or time, and effort to a given quality."""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
import pandas as pd

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
    """Return the last row of each run within equal iterations, evaluations and time (column ``lens``).

    At a number of iterations, equal evaluations are the most that an algorithm spends in them, equal time is that
    of the first algorithm. A run that finished early keeps its final state. `quality` is from `with_seconds`;
    `cost` is the evaluations per iteration by algorithm and population, the first algorithm first.
    """
    (first, _), *_ = cost
    parts = []
    for population, count in product(quality.population.unique(), iterations):
        part = quality[quality.population == population]
        spent = {name: population + count * each for (name, size), each in cost.items() if size == population}
        timed = part[(part.algorithm == first) & (part.evaluations <= spent[first])]
        limits = {
            ITERATIONS: part.evaluations <= part.algorithm.map(spent),
            EVALUATIONS: part.evaluations <= max(spent.values()),
            TIME: part.seconds <= timed.seconds.max(),  # no rows if the first algorithm has no run
        }
        for lens, within in limits.items():
            parts.append(part[within].groupby(RUN, sort=False).tail(1).assign(lens=lens, iterations=count))
    return pd.concat(parts, ignore_index=True)


def to_reach(quality: pd.DataFrame, target: float) -> pd.DataFrame:
    """Return a row per population, set and algorithm: runs, runs that reached the target, and median effort."""
    # a run that does not reach the relative hypervolume counts as infinite effort; an infinite median is NaN
    reached = quality[quality.relative_hypervolume >= target].groupby(RUN, sort=False).head(1)
    runs = quality[RUN].drop_duplicates().merge(reached[[*RUN, "evaluations", "seconds"]], on=RUN, how="left")
    groups = runs.fillna(np.inf).groupby(["population", "set", "algorithm"], sort=False)
    table = groups[["evaluations", "seconds"]].median().replace(np.inf, np.nan)
    table.insert(0, "runs", groups.size())
    table.insert(1, "reached", groups.evaluations.agg(lambda spent: np.isfinite(spent).sum()))
    return table.reset_index()

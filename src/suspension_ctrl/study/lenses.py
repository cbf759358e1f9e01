"""A comparison at equal iterations, evaluations or time, and the effort up to a given quality."""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np
import pandas as pd

ITERATIONS, EVALUATIONS, TIME = "equal iterations", "equal evaluations", "equal time"
RUN = ["population", "algorithm", "seed", "set"]


def with_seconds(quality: pd.DataFrame, clock: pd.DataFrame) -> pd.DataFrame:
    """Return rows of `Study.table` with seconds interpolated in the `clock` of `timing.seconds_by_evaluations`."""
    by = ["algorithm", "population"]
    timed = {key: part.sort_values("evaluations") for key, part in clock.groupby(by)}
    seconds = pd.Series(np.nan, index=quality.index)
    for key, part in quality.groupby(by):
        seconds[part.index] = np.interp(part.evaluations, timed[key].evaluations, timed[key].seconds)
    return quality.assign(seconds=seconds)


def at_equal(
    quality: pd.DataFrame,
    algorithms: Sequence[str],
    iterations: Sequence[int],
    cost: Mapping[tuple[str, int], int],
) -> pd.DataFrame:
    """Return the last row of each run at equal iterations, evaluations and time, by ``lens`` and ``iterations``.

    Evaluations are those of the algorithm that spends the most in that many iterations, time is that of the first
    algorithm for them. A run that finished early keeps its final state. `quality` is from `with_seconds`, `cost`
    holds the evaluations of an iteration by algorithm and population.
    """
    parts = []
    for population, count in product(quality.population.unique(), iterations):
        part = quality[quality.population == population]
        spent = {name: population + count * cost[name, population] for name in algorithms}
        timed = part[(part.algorithm == algorithms[0]) & (part.evaluations <= spent[algorithms[0]])]
        limits = {
            ITERATIONS: part.evaluations <= part.algorithm.map(spent),
            EVALUATIONS: part.evaluations <= max(spent.values()),
            TIME: part.seconds <= timed.seconds.max(),  # none where the first has no run
        }
        for lens, within in limits.items():
            last = part[within].groupby(RUN, sort=False).tail(1)
            parts.append(last.assign(lens=lens, iterations=count))
    return pd.concat(parts, ignore_index=True)


def to_reach(quality: pd.DataFrame, target: float) -> pd.DataFrame:
    """Return evaluations and seconds by run and set to a relative hypervolume of `target`, NaN if not reached."""
    runs = quality[RUN].drop_duplicates()
    reached = quality[quality.relative_hypervolume >= target].groupby(RUN, sort=False).head(1)
    return runs.merge(reached[[*RUN, "evaluations", "seconds"]], on=RUN, how="left")


def reached_by(reached: pd.DataFrame) -> pd.DataFrame:
    """Return the number of runs that reached the target and median effort, by population, set and algorithm.

    Other runs count as infinitely late: a median exists where more than half of the runs reached the target.
    """
    by = ["population", "set", "algorithm"]
    late = reached.fillna({"evaluations": np.inf, "seconds": np.inf})
    groups = late.groupby(by, sort=False)
    table = groups[["evaluations", "seconds"]].median().replace(np.inf, np.nan)
    table.insert(0, "runs", groups.size())
    table.insert(1, "reached", reached.groupby(by, sort=False).evaluations.count())
    return table.reset_index()

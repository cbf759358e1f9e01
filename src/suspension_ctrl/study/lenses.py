"""What a comparison holds equal: iterations, evaluations, time, or the quality to be reached."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

ITERATIONS, EVALUATIONS, TIME = "equal iterations", "equal evaluations", "equal time"
LENSES = (ITERATIONS, EVALUATIONS, TIME)
RUN = ["population", "algorithm", "seed", "set"]


def with_seconds(quality: pd.DataFrame, clock: pd.DataFrame) -> pd.DataFrame:
    """Return the quality with the seconds that its evaluations take when timed.

    Parameters
    ----------
    quality : DataFrame
        One row per run, budget and set, from `Study`; its ``seconds``, if any, are not timings and are replaced.
    clock : DataFrame
        Median time to each number of evaluations by algorithm and population, from
        `experiments.seconds_by_evaluations`; between two of them in proportion.
    """
    parts = []
    by = ["algorithm", "population"]
    timed = dict(list(clock.groupby(by)))
    for key, part in quality.groupby(by, sort=False):
        known = timed[key].sort_values("evaluations")
        seconds = np.interp(part.evaluations, known.evaluations, known.seconds)
        parts.append(part.assign(seconds=seconds))
    return pd.concat(parts).sort_index()


def at_equal(
    quality: pd.DataFrame,
    algorithms: Sequence[str],
    iterations: Sequence[int],
    cost: Mapping[tuple[str, int], int],
) -> pd.DataFrame:
    """Return what each run has reached where the algorithms have the same iterations, evaluations or time.

    Parameters
    ----------
    quality : DataFrame
        From `with_seconds`.
    algorithms : sequence of str
        Those that are compared; the first sets the time.
    iterations : sequence of int
        Numbers of iterations that are compared.
    cost : mapping
        Evaluations of an iteration by algorithm and population.

    Returns
    -------
    DataFrame
        Rows of `quality`, the last one of each run within the limit, with columns ``lens`` and ``iterations``.
        Evaluations are those of whoever spends the most in that many iterations, time is the time that the
        first algorithm takes for them. Who has spent all its evaluations in less time stands there with them.
    """
    parts = []
    for population in quality.population.unique():
        part = quality[quality.population == population]
        for count in iterations:
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
    """Return evaluations and seconds at which each run is first seen with a relative hypervolume of `target`.

    Parameters
    ----------
    quality : DataFrame
        From `with_seconds`.
    target : float
        Relative hypervolume.

    Returns
    -------
    DataFrame
        A row per population, algorithm, seed and set, NaN where it was not reached.
    """
    runs = quality[RUN].drop_duplicates()
    reached = quality[quality.relative_hypervolume >= target].groupby(RUN, sort=False).head(1)
    return runs.merge(reached[[*RUN, "evaluations", "seconds"]], on=RUN, how="left")


def reached_by(reached: pd.DataFrame) -> pd.DataFrame:
    """Return by population, set and algorithm how many runs reached the target, and the medians of those that did.

    A median is given where more than half of the runs got there; the others count as later than all of them.
    """
    by = ["population", "set", "algorithm"]
    late = reached.fillna({"evaluations": np.inf, "seconds": np.inf})
    groups = late.groupby(by, sort=False)
    table = pd.DataFrame(
        {
            "runs": groups.size(),
            "reached": reached.groupby(by, sort=False).evaluations.count(),
            "evaluations": groups.evaluations.median(),
            "seconds": groups.seconds.median(),
        }
    )
    return table.replace(np.inf, np.nan).reset_index()

"""Timed runs of a comparison, made one at a time, and their tables."""

import warnings
from collections.abc import Iterator, Mapping, MutableMapping
from dataclasses import replace

import pandas as pd

from ..quantities import Real, column_headers
from ..search.constraints import InfeasibleWarning
from ..search.driver import minimise
from ..search.indicators import ReferenceFront, evenly_spread, non_dominated
from ..search.moead_dra import MoeadDra
from ..search.problem import Minimisable
from .comparison import CONFIGURATION, EQUAL_EVALUATIONS, EQUAL_ITERATIONS, Comparison, optimiser
from .store import StoredRun
from .study import PlannedRun


def warm_up(comparison: Comparison) -> None:
    """Make a short run of each algorithm at each population, so that no timed run compiles or fills caches."""
    for algorithm, population in comparison.cost():
        # DEAP's sort has nothing to compile, and its time is quadratic.
        size = min(population, 50) if algorithm == "nsga2-standard-sort" else population
        short = optimiser(algorithm, size)
        if isinstance(short, MoeadDra):
            short = replace(short, utility_period=1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # usual after one iteration
            minimise(comparison.problem, short, iterations=1, seed=0)


def carry_out(comparison: Comparison, store: MutableMapping[str, StoredRun]) -> Iterator[PlannedRun]:
    """Warm up and make the timed runs that are not in `store` one after the other; store and yield each."""
    missing = [planned for planned in comparison.timed_runs() if planned.name not in store]
    if missing:
        warm_up(comparison)
    for planned in missing:
        evaluations = planned.evaluations
        run = minimise(comparison.problem, planned.optimiser, evaluations=evaluations, seed=planned.seed)
        kept = evenly_spread(run.objectives, planned.optimiser.population)
        store[planned.name] = StoredRun(run.history, run.to_frame().iloc[kept].reset_index(drop=True))
        yield planned


def front(problem: Minimisable, run: StoredRun) -> pd.DataFrame:
    """Return the non-dominated feasible rows of a final population."""
    return run.feasible[non_dominated(feasible_objectives(problem, run))]


def feasible_objectives(problem: Minimisable, run: StoredRun) -> Real:
    """Return the objectives (n, m) of the feasible designs of a final population."""
    return run.feasible[column_headers(problem.objectives, problem.units)].to_numpy()


def tidy(comparison: Comparison, store: Mapping[str, StoredRun]) -> pd.DataFrame:
    """Return a row per timed run: its key, evaluations and seconds of `Run.history`."""
    rows = []
    for planned in comparison.timed_runs():
        last = store[planned.name].course.iloc[-1]
        seconds = {name: last[name] for name in last.index if name.endswith("seconds")}
        rows.append({**planned.key, "evaluations": int(last.evaluations), **seconds})
    return pd.DataFrame(rows)


def judged(
    comparison: Comparison, store: Mapping[str, StoredRun], runs: pd.DataFrame, reference: ReferenceFront
) -> pd.DataFrame:
    """Return the rows of `tidy` with hypervolume and igd_plus of the final populations."""
    planned = comparison.timed_runs()
    finals = [feasible_objectives(comparison.problem, store[run.name]) for run in planned]
    return runs.assign(
        hypervolume=list(map(reference.hypervolume, finals)), igd_plus=list(map(reference.igd_plus, finals))
    )


def compared(runs: pd.DataFrame) -> pd.DataFrame:
    """Return a row per configuration, algorithm and budget of `tidy`: evaluations, mean times, ratio.

    The ratio is the mean time of the first algorithm over that of the row [%].
    """
    table = _by_algorithm(runs, evaluations="first", seconds="mean")
    table["microseconds_per_evaluation"] = 1e6 * table.seconds / table.evaluations
    return table.assign(ratio_percent=ratios_to_first(table, "seconds", str(runs.algorithm.iloc[0])))


def ratios_to_first(table: pd.DataFrame, column: str, first: str) -> "pd.Series[float]":
    """Return a column of the first algorithm over that of each row of `compared` [%], at its configuration."""
    same = [*CONFIGURATION, "budget"]
    baseline = table[table.algorithm == first].set_index(same)[column]
    return 100 * table.join(baseline.rename("first"), on=same)["first"] / table[column]


def quality(runs: pd.DataFrame) -> pd.DataFrame:
    """Return a row as in `compared`: medians of hypervolume and igd_plus of `judged`."""
    return _by_algorithm(runs, evaluations="first", hypervolume="median", igd_plus="median")


def _by_algorithm(runs: pd.DataFrame, **summaries: str) -> pd.DataFrame:
    """Return a row per configuration, algorithm and budget, columns summarised.

    Algorithms with most evaluations have rows at equal evaluations too, of their runs at equal iterations.
    """
    keys = [*CONFIGURATION, "algorithm", "budget"]
    table = runs.groupby(keys, sort=False).agg(summaries).reset_index()
    others = table[table.budget == EQUAL_EVALUATIONS]
    matched = table.merge(others[CONFIGURATION].drop_duplicates(), on=CONFIGURATION)
    own_runs = pd.MultiIndex.from_frame(others[[*CONFIGURATION, "algorithm"]])
    most = matched[~pd.MultiIndex.from_frame(matched[[*CONFIGURATION, "algorithm"]]).isin(own_runs)]
    table = pd.concat([table, most.assign(budget=EQUAL_EVALUATIONS)])
    return table.sort_values(CONFIGURATION, kind="stable", ignore_index=True)


def final_populations(comparison: Comparison, store: Mapping[str, StoredRun]) -> pd.DataFrame:
    """Return the final populations of Figure 5: first repeat, equal iterations, by algorithm and configuration."""
    first = {"repeat": 1, "budget": EQUAL_ITERATIONS}
    runs = [run for run in comparison.timed_runs() if first.items() <= run.key.items()]
    by = ["algorithm", *CONFIGURATION]
    parts = [store[run.name].final.assign(**{name: run.key[name] for name in by}) for run in runs]
    return pd.concat(parts, ignore_index=True)


def seconds_by_evaluations(comparison: Comparison, store: Mapping[str, StoredRun]) -> pd.DataFrame:
    """Return the median seconds to each number of evaluations by algorithm and population, of the longest runs."""
    by = ["algorithm", "population"]
    parts = []
    for run in comparison.timed_runs():
        course = store[run.name].course[["evaluations", "seconds"]]
        parts.append(course.assign(most=run.evaluations, **{name: run.key[name] for name in by}))
    histories = pd.concat(parts)
    longest = histories[histories.most == histories.groupby(by).most.transform("max")]
    return longest.groupby([*by, "evaluations"], sort=False).seconds.median().reset_index()

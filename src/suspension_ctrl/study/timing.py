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
from .comparison import CONFIGURATION, EQUAL_ITERATIONS, Comparison, optimiser
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
    """Warm up, make the timed runs that are not in `store` one after the other, and yield each stored one."""
    warm_up(comparison)
    for planned in comparison.timed_runs():
        if planned.name not in store:
            problem, evaluations = comparison.problem, planned.evaluations
            run = minimise(problem, planned.optimiser, evaluations=evaluations, seed=planned.seed)
            kept = evenly_spread(run.objectives, planned.optimiser.population)
            store[planned.name] = StoredRun(run.history, run.to_frame().iloc[kept].reset_index(drop=True))
        yield planned


def front(problem: Minimisable, run: StoredRun) -> pd.DataFrame:
    """Return the non-dominated feasible rows of a final population."""
    return run.feasible[non_dominated(feasible_objectives(problem, run))]


def feasible_objectives(problem: Minimisable, run: StoredRun) -> Real:
    """Return the objectives (n, m) of the feasible designs of a final population."""
    return run.feasible[column_headers(problem.objectives, problem.units)].to_numpy()


def tidy(comparison: Comparison, store: Mapping[str, StoredRun], reference: ReferenceFront) -> pd.DataFrame:
    """Return a row per timed run: its key, evaluations, seconds of `Run.history`, hypervolume and igd_plus."""
    rows = []
    for planned in comparison.timed_runs():
        run = store[planned.name]
        last, objectives = run.course.iloc[-1], feasible_objectives(comparison.problem, run)
        quality = {name: getattr(reference, name)(objectives) for name in ("hypervolume", "igd_plus")}
        seconds = {name: last[name] for name in run.course.columns if name.endswith("seconds")}
        rows.append({**planned.key, "evaluations": int(last.evaluations), **seconds, **quality})
    return pd.DataFrame(rows)


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

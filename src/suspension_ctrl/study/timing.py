"""The timed runs of a comparison, made one at a time, as a tidy table."""

import warnings
from collections.abc import Iterator, Mapping, MutableMapping
from dataclasses import replace
from typing import Any

import pandas as pd

from ..quantities import Real, column_headers
from ..search.constraints import InfeasibleWarning
from ..search.driver import Run, minimise
from ..search.indicators import ReferenceFront, evenly_spread, non_dominated
from ..search.moead_dra import MoeadDra
from ..search.problem import Described, Minimisable
from .comparison import EQUAL_ITERATIONS, Comparison, optimiser
from .store import VIOLATION, StoredRun
from .study import PlannedRun


def warm_up(comparison: Comparison) -> None:
    """Make a short run of each algorithm at each population, so that no timed one compiles or tabulates."""
    for algorithm, population in comparison.cost():
        # DEAP's quadratic sort has nothing to compile and would take its time.
        size = min(population, 50) if algorithm == "nsga2-standard-sort" else population
        short = optimiser(algorithm, size)
        if isinstance(short, MoeadDra):
            short = replace(short, utility_period=1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # after one iteration it says nothing
            minimise(comparison.problem, short, iterations=1, seed=0)


def carry_out(comparison: Comparison, store: MutableMapping[str, StoredRun]) -> Iterator[PlannedRun]:
    """Make the timed runs that `store` does not hold one after the other, handing out each when it is stored."""
    for planned in comparison.timed_runs():
        if planned.name not in store:
            run = minimise(
                comparison.problem, planned.optimiser, evaluations=planned.evaluations, seed=planned.seed
            )
            final = population(run, planned.optimiser.population)
            store[planned.name] = StoredRun(run.history, final)
        yield planned


def population(run: Run, size: int) -> pd.DataFrame:
    """Return `size` final designs of a run, spread evenly if it has more, with objectives and any violation."""
    return run.to_frame().iloc[evenly_spread(run.objectives, size)].reset_index(drop=True)


def front(problem: Described, final: pd.DataFrame) -> pd.DataFrame:
    """Return the non-dominated rows among the feasible ones of a final population."""
    feasible = feasible_rows(problem, final)
    return feasible[non_dominated(objectives_of(problem, feasible))]


def feasible_rows(problem: Minimisable, final: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of a final population that meet all constraints."""
    return final[final[VIOLATION] == 0] if problem.constraints else final


def objectives_of(problem: Described, final: pd.DataFrame) -> Real:
    """Return the objectives (n, m) in a table of a final population."""
    return final[column_headers(problem.objectives, problem.units)].to_numpy()


def tidy(comparison: Comparison, store: Mapping[str, StoredRun], reference: ReferenceFront) -> pd.DataFrame:
    """Return one row per timed run: its key, evaluations, seconds, hypervolume and igd_plus.

    The seconds are those of `Run.history`, the indicators those of the feasible designs of its final population.
    """
    return pd.DataFrame(
        [
            planned.key | _measured(comparison.problem, store[planned.name], reference)
            for planned in comparison.timed_runs()
        ]
    )


def _measured(problem: Described, run: StoredRun, reference: ReferenceFront) -> dict[str, Any]:
    last = run.course.iloc[-1]
    objectives = objectives_of(problem, feasible_rows(problem, run.final))
    return {
        "evaluations": int(last.evaluations),
        **{name: last[name] for name in run.course.columns if name.endswith("seconds")},
        "hypervolume": reference.hypervolume(objectives),
        "igd_plus": reference.igd_plus(objectives),
    }


def final_populations(comparison: Comparison, store: Mapping[str, StoredRun]) -> pd.DataFrame:
    """Return the final populations of the first repeat at equal iterations, stacked, as Figure 5 shows them.

    Columns: algorithm, population, iterations, then variables and objectives with their units.
    """
    shown = ("algorithm", "population", "iterations")
    return pd.concat(
        [
            store[run.name].final.assign(**{name: run.key[name] for name in shown})
            for run in comparison.timed_runs()
            if run.key["repeat"] == 1 and run.key["budget"] == EQUAL_ITERATIONS
        ],
        ignore_index=True,
    )


def seconds_by_evaluations(comparison: Comparison, store: Mapping[str, StoredRun]) -> pd.DataFrame:
    """Return the median time that each algorithm took to each number of evaluations, from its longest runs.

    Columns: algorithm, population, evaluations, seconds.
    """
    by = ["algorithm", "population"]
    histories = pd.concat(
        [
            store[run.name]
            .course[["evaluations", "seconds"]]
            .assign(most=run.evaluations, **{name: run.key[name] for name in by})
            for run in comparison.timed_runs()
        ]
    )
    longest = histories[histories.most == histories.groupby(by).most.transform("max")]
    return longest.groupby([*by, "evaluations"], sort=False).seconds.median().reset_index()

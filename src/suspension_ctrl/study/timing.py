"""The timed comparison of the algorithms: a plan of runs, carried out one at a time, as a tidy table."""

import warnings
from collections.abc import Callable, Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from .. import checks
from ..quantities import column_headers
from ..search.constraints import InfeasibleWarning
from ..search.driver import Optimiser, Run, minimise
from ..search.gamultiobj import Gamultiobj
from ..search.indicators import ReferenceFront, evenly_spread, non_dominated
from ..search.moead_dra import MoeadDra
from ..search.nsga2 import Nsga2
from ..search.problem import Described, Minimisable
from ..search.sampling import Sampling
from ..search.selection import deap_order
from .store import VIOLATION, Record

ALGORITHMS: dict[str, Callable[..., Optimiser]] = {
    "nsga2": Nsga2,
    "nsga2-standard-sort": partial(Nsga2, selection="deap-standard"),
    "nsga2-gamultiobj": Gamultiobj,
    "moead-dra": MoeadDra,
    "moead-dra-raw": partial(MoeadDra, normalise=False, objective_scales=(1.0, 1.0, 1e3)),
    "random": partial(Sampling, points="random"),
    "sobol": partial(Sampling, points="sobol"),
}
"""Optimisers by name. Raw MOEA/D-DRA takes equation (14) to the letter, in the paper's units (DTL in kN)."""

EQUAL_ITERATIONS, EQUAL_EVALUATIONS = "iterations", "evaluations"


@dataclass(frozen=True)
class PlannedRun:
    """One run of a comparison.

    Parameters
    ----------
    algorithm : str
        One of `ALGORITHMS`.
    population, iterations : int
        The configuration.
    repeat : int
        Counted from 1.
    seed : int
    budget : {"iterations", "evaluations"}
        What the run has in common with the others of its configuration.
    evaluations : int
        Designs it evaluates.
    """

    algorithm: str
    population: int
    iterations: int
    repeat: int
    seed: int
    budget: str
    evaluations: int

    @property
    def name(self) -> str:
        """A name for this run, fit for a file."""
        suffix = "_equal-evaluations" if self.budget == EQUAL_EVALUATIONS else ""
        return f"{self.algorithm}_n{self.population}_i{self.iterations}_r{self.repeat}{suffix}"

    @property
    def optimiser(self) -> Optimiser:
        """The algorithm with its settings."""
        return optimiser(self.algorithm, self.population)


def optimiser(algorithm: str, population: int) -> Optimiser:
    """Return the algorithm called `algorithm`, one of `ALGORITHMS`; ValueError for any other."""
    checks.one_of("algorithms", algorithm, ALGORITHMS)
    return ALGORITHMS[algorithm](population=population)


def plan(
    problem: Minimisable,
    algorithms: Sequence[str],
    populations: Sequence[int],
    iterations: Sequence[int],
    repeats: int,
    seed: int,
) -> list[PlannedRun]:
    """Return the runs of a comparison in the order in which they are made, algorithms taking turns.

    Every algorithm runs at each population and number of iterations. Those that spend fewer evaluations than
    another there run once more with as many, up to a part of an iteration. Repeat r has the seed `seed` + r - 1
    for every algorithm.
    """
    checks.at_least("repeats", repeats, 1)
    checks.at_least("seed", seed, 0)
    for count in iterations:
        checks.at_least("iterations", count, 1)
    runs = []
    for population in populations:
        optimisers = {name: optimiser(name, population) for name in algorithms}
        cost = {name: o.evaluations_per_iteration(len(problem.objectives)) for name, o in optimisers.items()}
        for count in iterations:
            spent = {name: population + count * cost[name] for name in algorithms}
            most = max(spent.values())
            again = [
                (name, EQUAL_EVALUATIONS, population + (most - population) // cost[name] * cost[name])
                for name in algorithms
                if spent[name] < most
            ]
            once = [(name, EQUAL_ITERATIONS, spent[name]) for name in algorithms]
            for repeat in range(1, repeats + 1):
                runs += [
                    PlannedRun(name, population, count, repeat, seed + repeat - 1, budget, evaluations)
                    for name, budget, evaluations in once + again
                ]
    return runs


def warm_up(problem: Minimisable, runs: Sequence[PlannedRun]) -> None:
    """Make a short run of each algorithm at each population, so that no timed one compiles or tabulates."""
    for algorithm, population in {(run.algorithm, run.population) for run in runs}:
        # DEAP's quadratic sort has nothing to compile and would take its time.
        size = min(population, 50) if algorithm == "nsga2-standard-sort" else population
        short = optimiser(algorithm, size)
        if isinstance(short, MoeadDra):
            short = replace(short, utility_period=1)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)  # after one iteration it says nothing
            minimise(problem, short, iterations=1, seed=0)
    deap_order(np.array([[0.0, 0.0], [1.0, 1.0]]), np.array([0, 1]))  # else compiled at the first tie


def carry_out(
    problem: Described, runs: Sequence[PlannedRun], store: MutableMapping[str, Record]
) -> Iterator[PlannedRun]:
    """Make the runs that `store` does not hold one after the other, handing out each when it is in the store."""
    for planned in runs:
        if planned.name not in store:
            run = minimise(problem, planned.optimiser, evaluations=planned.evaluations, seed=planned.seed)
            store[planned.name] = Record(run.history, population(problem, run, planned.population))
        yield planned


def population(problem: Described, run: Run, size: int) -> pd.DataFrame:
    """Return the final designs of a run with their objectives, units in the column names.

    Where the problem has constraints, a last column ``violation`` holds the total violations.
    Of a sample, which keeps all it has found, `size` designs are taken, spread evenly over its front.
    """
    names = column_headers([*problem.variables, *problem.objectives], problem.units)
    kept = evenly_spread(run.objectives, size)
    table = pd.DataFrame(np.hstack([run.designs[kept], run.objectives[kept]]), columns=names)
    return table.assign(**{VIOLATION: run.violation[kept]}) if problem.constraints else table


def front(problem: Described, final: pd.DataFrame) -> pd.DataFrame:
    """Return the non-dominated rows among the feasible ones of a final population."""
    feasible = feasible_rows(problem, final)
    return feasible[non_dominated(objectives_of(problem, feasible))]


def feasible_rows(problem: Minimisable, final: pd.DataFrame) -> pd.DataFrame:
    """Return the rows of a final population that meet all constraints."""
    return final[final[VIOLATION] == 0] if problem.constraints else final


def objectives_of(problem: Described, final: pd.DataFrame) -> NDArray[np.float64]:
    """Return the objectives (n, m) in a table of a final population."""
    return final[column_headers(problem.objectives, problem.units)].to_numpy()


def tidy(
    problem: Described, runs: Sequence[PlannedRun], store: Mapping[str, Record], reference: ReferenceFront
) -> pd.DataFrame:
    """Return one row per run.

    Columns: algorithm, population, iterations, budget, repeat, seed, evaluations, seconds, cpu_seconds,
    ``<phase>_seconds`` for each phase of its algorithm (see `Run`), hypervolume and igd_plus of the feasible
    designs of its final population.
    """
    return pd.DataFrame([_row(problem, planned, store[planned.name], reference) for planned in runs])


def _row(problem: Described, planned: PlannedRun, record: Record, reference: ReferenceFront) -> dict[str, Any]:
    last = record.course.iloc[-1]
    objectives = objectives_of(problem, feasible_rows(problem, record.final))
    return {
        **{key: getattr(planned, key) for key in _KEYS},
        "evaluations": int(last.evaluations),
        **{name: last[name] for name in record.course.columns if name.endswith("seconds")},
        "hypervolume": reference.hypervolume(objectives),
        "igd_plus": reference.igd_plus(objectives),
    }


_KEYS = ("algorithm", "population", "iterations", "budget", "repeat", "seed")


def final_populations(runs: Sequence[PlannedRun], store: Mapping[str, Record]) -> pd.DataFrame:
    """Return the final populations of the first repeat at equal iterations, stacked, as Figure 5 shows them.

    Columns: algorithm, population, iterations, then variables and objectives with their units.
    """
    shown = [planned for planned in runs if planned.repeat == 1 and planned.budget == EQUAL_ITERATIONS]
    return pd.concat(
        [store[p.name].final.assign(**{key: getattr(p, key) for key in _KEYS[:3]}) for p in shown],
        ignore_index=True,
    )


def seconds_by_evaluations(runs: Sequence[PlannedRun], store: Mapping[str, Record]) -> pd.DataFrame:
    """Return the median time that each algorithm took to each number of evaluations, from its longest runs.

    Columns: algorithm, population, evaluations, seconds.
    """
    longest: dict[tuple[str, int], int] = {}
    for p in runs:
        key = p.algorithm, p.population
        longest[key] = max(p.evaluations, longest.get(key, 0))
    histories = [
        store[p.name].course[["evaluations", "seconds"]].assign(algorithm=p.algorithm, population=p.population)
        for p in runs
        if p.evaluations == longest[p.algorithm, p.population]
    ]
    by = ["algorithm", "population", "evaluations"]
    return pd.concat(histories).groupby(by, sort=False).seconds.median().reset_index()

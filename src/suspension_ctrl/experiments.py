"""The comparison of the algorithms: a plan of runs, carried out one at a time, as a tidy table."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from . import checks
from .indicators import ReferenceFront, non_dominated
from .optimisers import MoeadDra, Nsga2, Run, minimise
from .optimisers.minimise import Optimiser
from .problems import Described, Minimisable, column_headers
from .selection import deap_order

ALGORITHMS: dict[str, Callable[..., Optimiser]] = {
    "nsga2": Nsga2,
    "nsga2-standard-sort": partial(Nsga2, selection="deap-standard"),
    "moead-dra": MoeadDra,
    "moead-dra-raw": partial(MoeadDra, normalise=False, objective_scales=(1.0, 1.0, 1e3)),
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


Results = Sequence[tuple[PlannedRun, Run]]


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
        minimise(problem, short, iterations=1, seed=0)
    deap_order(np.array([[0.0, 0.0], [1.0, 1.0]]), np.array([0, 1]))  # else compiled at the first tie


def carry_out(problem: Minimisable, runs: Sequence[PlannedRun]) -> Iterator[tuple[PlannedRun, Run]]:
    """Make the runs one after the other, handing out each when it is done."""
    for run in runs:
        yield run, minimise(problem, run.optimiser, evaluations=run.evaluations, seed=run.seed)


def tidy(results: Results, reference: ReferenceFront) -> pd.DataFrame:
    """Return one row per run.

    Columns: algorithm, population, iterations, budget, repeat, seed, evaluations, seconds, cpu_seconds,
    ``<phase>_seconds`` for each phase of its algorithm (see `Run`), hypervolume and igd_plus of its final
    population.
    """
    return pd.DataFrame([_row(planned, run, reference) for planned, run in results])


def _row(planned: PlannedRun, run: Run, reference: ReferenceFront) -> dict[str, Any]:
    last = run.history.iloc[-1]
    phases = {name: last[name] for name in run.history.columns if name.endswith("_seconds")}
    return {
        "algorithm": planned.algorithm,
        "population": planned.population,
        "iterations": planned.iterations,
        "budget": planned.budget,
        "repeat": planned.repeat,
        "seed": run.seed,
        "evaluations": run.evaluations,
        "seconds": run.seconds,
        "cpu_seconds": run.cpu_seconds,
        **phases,
        "hypervolume": reference.hypervolume(run.objectives),
        "igd_plus": reference.igd_plus(run.objectives),
    }


def front(problem: Described, run: Run) -> pd.DataFrame:
    """Return the non-dominated designs of a run with their objectives, units in the column names."""
    return _population(problem, run)[non_dominated(run.objectives)]


def final_populations(problem: Described, results: Results) -> pd.DataFrame:
    """Return the final populations of the first repeat at equal iterations, stacked, as Figure 5 shows them.

    Columns: algorithm, population, iterations, then variables and objectives with their units.
    """
    shown = [(p, run) for p, run in results if p.repeat == 1 and p.budget == EQUAL_ITERATIONS]
    keys = ["algorithm", "population", "iterations"]
    return pd.concat(
        [_population(problem, run).assign(**{key: getattr(p, key) for key in keys}) for p, run in shown],
        ignore_index=True,
    )


def _population(problem: Described, run: Run) -> pd.DataFrame:
    names = column_headers([*problem.variables, *problem.objectives], problem.units)
    return pd.DataFrame(np.hstack([run.designs, run.objectives]), columns=names)

"""Sections 2 and 3: NSGA-II and MOEA/D of every library on the same problem with the same evaluator."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from time import perf_counter
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from numba import njit
from numba.extending import register_jitable
from numpy.typing import NDArray

from peers import Contenders, Prepare, Task
from sections.timing import take_turns, timed
from suspension_ctrl import Problem, RideProblem
from suspension_ctrl.compiled_verbs import call
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.search.problem import Minimisable

SMALL = 100
"""Population at which libraries compile and import what they need before anything is timed."""

GENERATIONS = (1, 2, 3, 4, 5, 6, 8, 12, 20)
"""Lengths of the runs of which the first to reach a hypervolume counts."""


@dataclass
class Counted:
    """A problem that counts the designs its `evaluate` gets."""

    problem: Minimisable
    count: list[int] = field(default_factory=lambda: [0])

    def __post_init__(self) -> None:
        self.lower, self.upper = self.problem.lower, self.problem.upper
        self.objectives, self.constraints = self.problem.objectives, self.problem.constraints
        self.variables, self.units = self.problem.variables, self.problem.units
        self.kinds, self.kernel = self.problem.kinds, self.problem.kernel

    def evaluate(self, designs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the problem's objectives (n, m) of designs (n, d)."""
        self.count[0] += len(designs)
        return self.problem.evaluate(designs)


def evaluations(prepare: Prepare, task: Task) -> int:
    """Return how many designs a search evaluates, from an untimed run."""
    counted = Counted(task.problem)
    job = prepare(replace(task, problem=counted))
    result = job.run()
    return job.evaluations(result) if job.evaluations else counted.count[0]


def working(field: Contenders, problem: Minimisable) -> Contenders:
    """Return the contenders whose searches carry out a short run, which warms them up; the others as absent."""
    absent = dict(field.absent)

    def works(name: str, prepare: Prepare) -> bool:
        try:
            evaluations(prepare, Task(problem, SMALL, 2, 0))
        except Exception as error:  # whatever a foreign library raises, the others are still to be measured
            absent[name] = f"{type(error).__name__}: {error}".splitlines()[0]
            return False
        return True

    nsga2, moead = (
        {name: prepare for name, prepare in searches.items() if works(name, prepare)}
        for searches in (field.nsga2, field.moead)
    )
    return field._replace(nsga2=nsga2, moead=moead, absent=absent)


def _prepared(prepare: Prepare, task: Task, seed: int) -> Callable[[], Any]:
    return prepare(replace(task, seed=seed)).run


def by_population(
    searches: Mapping[str, Prepare],
    problem: Minimisable,
    populations: Sequence[int],
    generations: int,
    repeats: int,
    limit: float,
    repeat_limit: float,
) -> pd.DataFrame:
    """Return one row per timed run: contender, population, repeat, seconds, cpu_seconds, evaluations.

    Evaluations are counted at the least population, in a run of their own.

    A library is left out of a population for which, growing no faster than in proportion, it would take longer
    than `limit` seconds. One that takes longer than `repeat_limit` seconds is timed once. A small run before all
    others compiles and imports what a library needs for the problem.
    """
    for prepare in searches.values():
        _prepared(prepare, Task(problem, SMALL, 1, 0), 0)()
    rows: list[dict[str, Any]] = []
    expected = dict.fromkeys(searches, 0.0)
    for population in sorted(populations):
        task = Task(problem, population, generations, 0)
        entries = {n: s for n, s in searches.items() if expected[n] * population <= limit}
        found = take_turns(
            {name: partial(_prepared, prepare, task) for name, prepare in entries.items()},
            repeats,
            repeat_limit,
        )
        expected |= {row["contender"]: row["seconds"] / population for row in found}
        rows += [{**row, "population": population} for row in found]
    task = Task(problem, min(populations), generations, 0)
    counts = {name: evaluations(prepare, task) for name, prepare in searches.items()}
    table = pd.DataFrame(rows)
    return table.assign(evaluations=table.contender.map(counts).where(table.population == task.population))


@njit(cache=True)
def scaled(
    objectives: NDArray[np.float64], ideal: NDArray[np.float64], span: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return objectives (n, m) or (m,) with `ideal` at 0 and what lies `span` beyond it at 1."""
    return (objectives - ideal) / span


class ScaledKernel(NamedTuple):
    """A problem's kernel, its objectives with a front's ideal point at 0 and its nadir at 1."""

    kernel: Any
    ideal: NDArray[np.float64]
    span: NDArray[np.float64]

    @register_jitable
    def __call__(self, design: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the scaled objectives (3,) of a design (2,)."""
        return scaled(call(self.kernel, (design,)), self.ideal, self.span)


def scaled_problem(problem: RideProblem, reference: ReferenceFront) -> Problem:
    """Return the problem with the reference front between 0 and 1: not every MOEA/D normalises objectives."""
    ideal, span = reference.ideal, reference.nadir - reference.ideal
    return Problem(
        evaluate=lambda designs: scaled(problem.evaluate(designs), ideal, span),
        lower=problem.lower,
        upper=problem.upper,
        objectives=problem.objectives,
        kernel=ScaledKernel(problem.kernel, ideal, span),
    )


def scaled_front(reference: ReferenceFront) -> ReferenceFront:
    """Return the front of `scaled_problem`."""
    ideal, nadir = 0 * reference.ideal, 0 * reference.nadir + 1
    return replace(reference, objectives=reference.scaled(reference.objectives), ideal=ideal, nadir=nadir)


def to_target(
    searches: Mapping[str, Prepare],
    problem: Minimisable,
    reference: ReferenceFront,
    target: float,
    populations: Sequence[int],
    repeats: int,
    limit: float,
) -> pd.DataFrame:
    """Return one row per contender, population and repeat: generations and seconds to the hypervolume `target`.

    Runs of `GENERATIONS` lengths are made from the same seed, and the shortest counts whose final population
    has the hypervolume; NaN where none has. A search that does not get there, or whose setting up and run take
    longer than `limit` seconds without getting there, is not repeated at that population. A first repeat is
    not counted, unless the search fails in it.
    """
    rows: list[dict[str, Any]] = []
    for population in populations:
        open_ = dict(searches)
        for repeat in range(repeats + 1):
            order = list(open_.items())
            for name, prepare in order if repeat % 2 else order[::-1]:
                task = Task(problem, population, 1, repeat)
                row = _shortest_run(prepare, task, reference, target, limit)
                if np.isnan(row["seconds"]):
                    del open_[name]
                if repeat or name not in open_:  # the first repeat of those that get there is their warm-up
                    rows.append({"contender": name, "population": population, "repeat": repeat, **row})
    return pd.DataFrame(rows)


def _shortest_run(
    prepare: Prepare, task: Task, reference: ReferenceFront, target: float, limit: float
) -> dict[str, float]:
    for generations in GENERATIONS:
        start = perf_counter()
        job = prepare(replace(task, generations=generations))
        timing = timed(job.run)
        elapsed = perf_counter() - start
        if reference.hypervolume(job.objectives(timing.result)) >= target:
            return {"generations": generations, "seconds": timing.seconds}
        if elapsed > limit:
            break
    return {"generations": np.nan, "seconds": np.nan}

"""Run an optimiser on a problem: budget, seed, timings and history in one place."""

import warnings
from collections.abc import Iterator, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from time import perf_counter, process_time
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from deap.base import Toolbox
from numpy.typing import NDArray

from .. import checks
from .clock import PhaseClock
from .constraints import InfeasibleWarning, violations
from .population import State
from .problem import Minimisable

if TYPE_CHECKING:
    import pandas as pd


class Optimiser(Protocol):
    """Settings of an algorithm, the toolbox of its verbs, and the search made of them."""

    @property
    def population(self) -> int:
        """Designs at the start, all of which are evaluated."""

    @property
    def phases(self) -> tuple[str, ...]:
        """Verbs of the toolbox whose time is taken."""

    def evaluations_per_iteration(self, objectives: int) -> int:
        """Return how many designs an iteration evaluates."""

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the verbs of the algorithm for `problem`."""

    def search(self, problem: Minimisable, toolbox: Toolbox, rng: np.random.Generator) -> Iterator[State]:
        """Yield the state after the start and after each iteration, without end."""


@dataclass(frozen=True, eq=False)
class Run:
    """Result of `minimise`.

    Attributes
    ----------
    designs : (n, d) ndarray
        Final population.
    objectives : (n, m) ndarray
        Its objectives.
    constraints : (n, c) ndarray
        Values g of its constraints, met where g <= 0.
    evaluations : int
        Designs evaluated, the start included.
    seconds, cpu_seconds : float
        Wall-clock and processor time of the search alone [s].
    seed : int
        Seed that gives this run again.
    log : Log
        What `history` is made of.
    """

    designs: NDArray[np.float64]
    objectives: NDArray[np.float64]
    constraints: NDArray[np.float64]
    evaluations: int
    seconds: float
    cpu_seconds: float
    seed: int
    log: "Log"

    @cached_property
    def violation(self) -> NDArray[np.float64]:
        """Total violation of each design (n,): the sum of max(0, g) over its constraints."""
        return violations(self.constraints, 0)

    @property
    def feasible(self) -> NDArray[np.bool_]:
        """Which designs meet all constraints (n,)."""
        return self.violation == 0

    @cached_property
    def history(self) -> "pd.DataFrame":
        """One row for the start, iteration 0, and one per iteration, everything counted from the start of the run.

        Columns: ``iteration``, ``evaluations``, ``seconds``, ``cpu_seconds``, ``<phase>_seconds`` for each phase,
        ``ideal_<objective>`` for each objective, of feasible designs as soon as one is found. In a sequential
        MOEA/D-DRA whose sweep runs compiled, children are evaluated inside the phase ``sweep``, and ``evaluate``
        is the start alone.
        """
        import pandas as pd  # a third of a second: not at import of the package, nor in a run

        return pd.DataFrame(self.log.rows, columns=self.log.columns)


class Log(NamedTuple):
    """Rows and columns of a history, before a table is made of them."""

    columns: list[str]
    rows: list[tuple[float, ...]]


def minimise(
    problem: Minimisable,
    optimiser: Optimiser,
    *,
    iterations: int | None = None,
    evaluations: int | None = None,
    seed: int | None = None,
    toolbox: Toolbox | None = None,
) -> Run:
    """Search for the Pareto-optimal designs of a problem.

    Parameters
    ----------
    problem : Problem or RideProblem
        What to minimise.
    optimiser : Nsga2 or MoeadDra
        The algorithm with its settings.
    iterations, evaluations : int
        Exactly one of them: iterations after the start, or a number of evaluations, of which as many whole
        iterations are made as it allows.
    seed : int, optional
        Seed of every random draw; a fresh one, kept in the result, if not given.
    toolbox : deap.base.Toolbox, optional
        The optimiser's toolbox for this problem with some verbs exchanged.

    Returns
    -------
    Run
        Same seed, same machine, same versions: identical arrays.

    Raises
    ------
    ValueError
        If the budget is not one of the two or too small, the seed is negative, or the problem's evaluation
        returns a wrong shape or a value that is not finite.

    Warns
    -----
    InfeasibleWarning
        If no design of the final population meets all constraints.
    """
    per_iteration = optimiser.evaluations_per_iteration(len(problem.objectives))
    count = _iteration_count(optimiser.population, per_iteration, iterations, evaluations)
    if seed is None:
        seed = int(np.random.SeedSequence().generate_state(1)[0])
    checks.at_least("seed", seed, 0)
    toolbox = copy(toolbox or optimiser.toolbox(problem))
    clock = PhaseClock(toolbox, optimiser.phases)
    search = optimiser.search(problem, toolbox, np.random.default_rng(seed))
    rows = []
    wall = cpu = 0.0
    for iteration in range(count + 1):
        wall_start, cpu_start = perf_counter(), process_time()
        state = next(search)
        wall, cpu = wall + perf_counter() - wall_start, cpu + process_time() - cpu_start
        rows.append((iteration, state.evaluations, wall, cpu, *clock.seconds.values(), *state.ideal))
    seconds = [f"{phase}_seconds" for phase in clock.seconds]
    ideal = [f"ideal_{name}" for name in problem.objectives]
    log = Log(["iteration", "evaluations", "seconds", "cpu_seconds", *seconds, *ideal], rows)
    run = Run(
        state.designs, state.objectives, state.constraints, int(state.evaluations), wall, cpu, int(seed), log
    )
    if problem.constraints and not run.feasible.any():
        warnings.warn(_infeasible(problem.constraints, run), InfeasibleWarning, stacklevel=2)
    return run


def _infeasible(names: Sequence[str], run: Run) -> str:
    least = int(run.violation.argmin())
    broken = [f"{name} {g:.3g}" for name, g in zip(names, run.constraints[least], strict=True) if g > 0]
    return (
        f"no feasible design among {run.evaluations} evaluated, least total violation "
        f"{run.violation[least]:.3g}: {', '.join(broken)}"
    )


def _iteration_count(start: int, per_iteration: int, iterations: int | None, evaluations: int | None) -> int:
    if iterations is not None and evaluations is None:
        checks.at_least("iterations", iterations, 1)
        return iterations
    if evaluations is not None and iterations is None:
        checks.at_least("evaluations", evaluations, start + per_iteration)
        return (evaluations - start) // per_iteration
    raise ValueError(
        f"exactly one of iterations and evaluations must be given, got {iterations!r} and {evaluations!r}"
    )

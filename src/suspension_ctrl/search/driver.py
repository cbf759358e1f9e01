"""Run of an optimiser on a problem: budget, seed, times and history."""

import itertools
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import inf
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from deap.base import Toolbox
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, unit
from .clock import PhaseClock
from .constraints import InfeasibleWarning
from .deap_adapter import with_deap_operators
from .kinds import Coded, coded, decoded
from .population import Population, State
from .problem import Minimisable, headers_of

if TYPE_CHECKING:
    import pandas as pd


class Optimiser(Protocol):
    """Settings of an algorithm, the toolbox of its verbs, and the search made of them."""

    @property
    def population(self) -> int:
        """Designs at the start."""

    @property
    def phases(self) -> tuple[str, ...]:
        """Timed verbs of the toolbox."""

    def evaluations_per_iteration(self, objectives: int) -> int:
        """Return how many designs an iteration evaluates."""

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the verbs of the algorithm for `problem`."""

    def search(self, problem: Minimisable, toolbox: Toolbox, rng: np.random.Generator) -> Iterator[State]:
        """Yield the state after the start and after each iteration, without end."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Run(Population):
    """Result of `minimise`: the final population, its cost and history.

    Attributes
    ----------
    evaluations : int
        Designs evaluated, the start included.
    seconds, cpu_seconds : float
        Wall-clock and processor time of the search alone [s].
    seed : int
        Seed that gives this run again.
    repeats : int
        Of the evaluations, those of known designs of a problem without continuous variables (`Problem.kinds`).
    log : Log
        Rows and columns of `history`.
    """

    evaluations: int
    seconds: float = field(metadata=unit("s"))
    cpu_seconds: float = field(metadata=unit("s"))
    seed: int
    log: "Log"
    repeats: int = 0

    @cached_property
    def history(self) -> "pd.DataFrame":
        """A row for the start, iteration 0, and per iteration; counts and times [s] from the start of the run.

        Columns: ``iteration``, ``evaluations``, ``seconds``, ``cpu_seconds``, ``<phase>_seconds`` of each phase,
        ``ideal_<objective>`` of each objective, of feasible designs once there is one. A compiled sweep of
        MOEA/D-DRA evaluates its children in the phase ``sweep``; ``evaluate`` is then the start alone.
        """
        import pandas as pd  # a third of a second: not at import of the package, nor in a run

        return pd.DataFrame(list(self.log.rows), columns=list(self.log.columns))

    def __repr__(self) -> str:
        return f"{super().__repr__()}\n    {self.evaluations} evaluations, {self.seconds:.3g} s, seed {self.seed}"


class Log(NamedTuple):
    """Rows and columns of a history, before a table is made of them."""

    columns: tuple[str, ...]
    rows: tuple[tuple[float, ...], ...]


def minimise(
    problem: Minimisable,
    optimiser: Optimiser,
    *,
    iterations: int | None = None,
    evaluations: int | None = None,
    seconds: float | None = None,
    seed: int | None = None,
    toolbox: Toolbox | None = None,
    start: "ArrayLike | Population | pd.DataFrame | None" = None,
    callback: Callable[[Run], object] | None = None,
) -> Run:
    """Search for the Pareto-optimal designs of a problem.

    Parameters
    ----------
    problem : Problem or RideProblem
        Objectives and bounds.
    optimiser : Nsga2, MoeadDra, Gamultiobj or Sampling
        The algorithm with its settings.
    iterations, evaluations : int
        One of them: iterations after the start, or evaluations for the start and whole iterations.
    seconds : float
        Wall-clock time [s] after which no iteration begins; alone, or beside a number as a second limit.
    seed : int, optional
        Seed of every random draw; a fresh one, kept in the result, if not given.
    toolbox : deap.base.Toolbox, optional
        The optimiser's toolbox for this problem with other verbs, operators of DEAP among them.
    start : (k, d) array_like, Population or DataFrame, optional
        Designs in place of the first k sampled ones; a DataFrame by its columns of the variables.
    callback : callable, optional
        Function of the run so far, called after each iteration; True ends the search.

    Returns
    -------
    Run
        Same seed, same machine, same versions: identical arrays.

    Raises
    ------
    ValueError
        If no budget is given or one is too small, the seed is negative, `start` does not fit, or the evaluation
        returns a wrong shape or a value that is not finite.

    Warns
    -----
    InfeasibleWarning
        If no design of the final population meets all constraints.
    """
    per_iteration = optimiser.evaluations_per_iteration(len(problem.objectives))
    count = _iteration_count(optimiser.population, per_iteration, iterations, evaluations, seconds)
    if seed is None:
        seed = int(np.random.SeedSequence().generate_state(1)[0])
    checks.at_least("seed", seed, 0)
    toolbox = with_deap_operators(toolbox or optimiser.toolbox(problem), problem)
    searched = coded(problem)
    if start is not None:
        _start_from(toolbox, problem, searched, optimiser.population, start)
    clock = PhaseClock(toolbox, optimiser.phases)
    rows: list[tuple[float, ...]] = []
    end = perf_counter() + (inf if seconds is None else seconds)
    for state in _timed(optimiser.search(searched, toolbox, np.random.default_rng(seed)), clock, rows):
        if callback and len(rows) > 1 and callback(_run(problem, searched, state, clock, rows, seed)):
            break
        if len(rows) > count or perf_counter() >= end:
            break
    run = _run(problem, searched, state, clock, rows, seed)
    if problem.constraints and not run.feasible.any():
        warnings.warn(_infeasible(problem.constraints, run), InfeasibleWarning, stacklevel=2)
    return run


def _timed(search: Iterator[State], clock: PhaseClock, rows: list[tuple[float, ...]]) -> Iterator[State]:
    """Yield the states of a search; append a row of the log for each."""
    wall = cpu = 0.0
    for iteration in itertools.count():
        wall_start, cpu_start = perf_counter(), process_time()
        state = next(search)
        wall, cpu = wall + perf_counter() - wall_start, cpu + process_time() - cpu_start
        rows.append((iteration, state.evaluations, wall, cpu, *clock.seconds.values(), *state.ideal))
        yield state


def _run(
    problem: Minimisable,
    searched: Minimisable,
    state: State,
    clock: PhaseClock,
    rows: Sequence[tuple[float, ...]],
    seed: int,
) -> Run:
    """Return the run of a problem so far, from the state of the search on its codes."""
    phases = [f"{phase}_seconds" for phase in clock.seconds]
    ideal = [f"ideal_{name}" for name in problem.objectives]
    log = Log(("iteration", "evaluations", "seconds", "cpu_seconds", *phases, *ideal), tuple(rows))
    return Run(
        designs=decoded(searched, state.designs), objectives=state.objectives, constraints=state.constraints,
        headers=headers_of(problem), evaluations=int(state.evaluations), seconds=rows[-1][2],
        cpu_seconds=rows[-1][3], seed=int(seed), log=log, repeats=getattr(searched, "repeats", 0),
    )  # fmt: skip


def _start_from(toolbox: Toolbox, problem: Minimisable, searched: Minimisable, size: int, start: Any) -> None:
    """Put the designs of `start`, or their codes, before the samples of the toolbox."""
    if isinstance(start, Population):
        start = start.designs
    elif hasattr(start, "columns"):
        variables = list(headers_of(problem)[: len(problem.lower)])
        if missing := [name for name in variables if name not in start.columns]:
            raise ValueError(f"start must have the columns {', '.join(variables)}, got none called {missing[0]}")
        start = start[variables].to_numpy()
    designs = np.array(start, dtype=float)
    if designs.ndim != 2 or designs.shape[1] != len(problem.lower):
        raise ValueError(f"start must have shape (k, {len(problem.lower)}), got {designs.shape}")
    checks.rows_within("start", designs, problem.lower, problem.upper)
    if isinstance(searched, Coded):
        designs = searched.encode("start", designs)
    if len(designs) > size:
        raise ValueError(f"start must have no more designs than the population, {size}, got {len(designs)}")
    sample: Callable[..., Real] | None = getattr(toolbox, "sample", None)
    if sample is None:
        raise ValueError("start must be None for an optimiser whose toolbox has no verb sample, got designs")

    def sample_the_rest(rng: np.random.Generator, count: int) -> Real:
        return np.concatenate([designs, sample(rng, count)[len(designs) :]])

    toolbox.register("sample", sample_the_rest)


def _infeasible(names: Sequence[str], run: Run) -> str:
    least = int(run.violation.argmin())
    broken = [f"{name} {g:.3g}" for name, g in zip(names, run.constraints[least], strict=True) if g > 0]
    violation = f"least total violation {run.violation[least]:.3g}: {', '.join(broken)}"
    return f"no feasible design among {run.evaluations} evaluated, {violation}"


def _iteration_count(
    start: int, per_iteration: int, iterations: int | None, evaluations: int | None, seconds: float | None
) -> float:
    if seconds is not None:
        checks.positive("seconds", seconds, "s")
    numbers = [number for number in (iterations, evaluations) if number is not None]
    if len(numbers) > 1 or (not numbers and seconds is None):
        found = f"{iterations!r}, {evaluations!r} and {seconds!r}"
        raise ValueError(f"one of iterations and evaluations, or seconds, must be given, got {found}")
    if iterations is not None:
        checks.at_least("iterations", iterations, 1)
        return iterations
    if evaluations is not None:
        checks.at_least("evaluations", evaluations, start + per_iteration)
        return (evaluations - start) // per_iteration
    return inf

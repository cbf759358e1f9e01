"""The loop around every search: budget, seed, times, callback, and the `Run` at its end."""

import warnings
from collections.abc import Callable, Iterator, Sequence
from math import inf, nan
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any

import numpy as np
from deap.base import Toolbox
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real
from .clock import PhaseClock
from .constraints import InfeasibleWarning
from .deap_adapter import with_deap_operators
from .evaluation import WORST, FailureWarning, SearchProblem, without_worst
from .population import Population, State
from .problem import Minimisable, headers_of
from .run import Checkpoint, Log, Optimiser, Run
from .verbs import with_checked_verbs

if TYPE_CHECKING:
    import pandas as pd


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
    failures: str = "worst",
) -> Run:
    """Search for the Pareto-optimal designs of a problem.

    Parameters
    ----------
    problem : Problem or RideProblem
        Objectives and bounds.
    optimiser : Nsga2, MoeadDra, Gamultiobj or Sampling
        The algorithm with its settings.
    iterations, evaluations : int
        Budget, one of them: iterations after the start, or evaluations in all, rounded down to whole iterations.
    seconds : float
        Wall-clock time [s] after which no iteration begins; alone, or as a second limit beside the other budget.
    seed : int, optional
        Seed of every random draw; by default a new one, returned in `Run.seed`.
    toolbox : deap.base.Toolbox, optional
        The optimiser's toolbox for this problem with verbs exchanged, also by operators of DEAP.
    start : (k, d) array_like, Population or DataFrame, optional
        Designs that replace the first k sampled ones; a DataFrame has a column for each variable. If there are
        more than the population, all are evaluated and the best are kept.
    callback : callable, optional
        Function of the run so far, called after each iteration; the search ends if it returns True.
    failures : {"worst", "error"}
        A design with a value that is not finite counts as worst, or ends the search with an error.

    Returns
    -------
    Run
        The same seed gives identical arrays on the same machine with the same versions.

    Raises
    ------
    ValueError
        If no budget is given or one is too small, the seed is negative, `start` does not fit the problem, or the
        evaluation or a verb returns a wrong result.
    Exception
        Any exception of the evaluation, and KeyboardInterrupt, ends the search; its attribute ``run`` is the run
        so far, which has no designs before the end of the start.

    Warns
    -----
    InfeasibleWarning
        If no design of the final population meets all constraints.
    FailureWarning
        If designs could not be evaluated.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=100), iterations=20, seed=1)
    >>> front = run.front()
    >>> list(front.columns)
    ['spring [N/m]', 'damper [N s/m]', 'ACC [m/s^2]', 'SWS [m]', 'DTL [N]']
    >>> print(f"ACC from {front['ACC [m/s^2]'].min():.1f} m/s^2, SWS from {1e3 * front['SWS [m]'].min():.0f} mm")
    ACC from 1.6 m/s^2, SWS from 15 mm

    A callback ends a search early, here as soon as a design has a discomfort below 1.7 m/s^2:

    >>> early = sc.minimise(
    ...     problem,
    ...     sc.Nsga2(population=20),
    ...     iterations=1000,
    ...     seed=1,
    ...     callback=lambda run: run.objectives[:, 0].min() < 1.7,
    ... )
    >>> early.evaluations < 20_000
    True
    """
    _check_parts(problem, optimiser, callback)
    designs = None if start is None else _start_designs(problem, start)
    begin = optimiser.population if designs is None else max(optimiser.population, len(designs))
    count = _iteration_count(begin, optimiser, problem, iterations, evaluations, seconds)
    if seed is None:
        seed = int(np.random.SeedSequence().generate_state(1)[0])
    search = _Search(problem, optimiser, toolbox, checks.at_least("seed", seed, 0), failures)
    if designs is not None:
        search.start_from(designs)
    return search.until(count, seconds, callback)


def resumed(
    run: Run,
    problem: Minimisable,
    toolbox: Toolbox | None,
    callback: Callable[[Run], object] | None,
    failures: str,
    **limits: Any,
) -> Run:
    """Return the run of a continued search, see `Run.resume`."""
    names = headers_of(problem)
    if names != run.headers:
        other, missing = (
            next((one for one in some if one not in others), "")
            for some, others in ((names, run.headers), (run.headers, names))
        )
        needed, got = checks.listing(run.headers, missing), checks.listing(names, other)
        raise ValueError(f"problem must be that of the run, {needed}, got {got}")
    count = _iteration_count(0, run.checkpoint.optimiser, problem, **limits)
    search = _Search(problem, run.checkpoint.optimiser, toolbox, run.seed, failures)
    search.go_on_from(run)
    return search.until(count, limits["seconds"], callback)


_UNSEEN = 0.1
"""Seconds of iterations that may pass while neither budget nor interruption ends the search."""


class _Search:
    """A search with its toolbox, generator, log and present state."""

    def __init__(
        self, problem: Minimisable, optimiser: Optimiser, toolbox: Toolbox | None, seed: int, failures: str
    ) -> None:
        checks.one_of("failures", failures, ("worst", "error"))
        self.optimiser, self.seed, self.headers = optimiser, seed, headers_of(problem)
        self.problem = SearchProblem(problem, strict=failures == "error")
        default = optimiser.toolbox(problem)
        given = with_deap_operators(toolbox or default, self.problem.lower, self.problem.upper)
        self.toolbox = with_checked_verbs(given, default, self.problem)
        self.rng = np.random.default_rng(seed)
        self.generator = self.rng.bit_generator.state
        self.rows: list[tuple[float, ...]] = []
        self.state: State | None = None

    def start_from(self, designs: Real) -> None:
        """Replace the first samples of the toolbox by designs (k, d)."""
        codes = self.problem.coding.encode("start", designs)
        sample: Callable[..., Real] | None = getattr(self.toolbox, "sample", None)
        if sample is None:
            raise ValueError("start must be None for an optimiser whose toolbox has no verb sample, got designs")

        def sample_the_rest(rng: np.random.Generator, count: int) -> Real:
            return np.concatenate([codes, sample(rng, count)[len(codes) :]])

        self.toolbox.register("sample", sample_the_rest)

    def go_on_from(self, run: Run) -> None:
        """Continue the search of a run."""
        self.state, self.rows = run.checkpoint.state, list(run.log.rows)
        self.problem.failures, self.problem.first = run.failures, "in the run before" if run.failures else ""
        self.problem.repeats = run.repeats
        self.rng.bit_generator.state = dict(run.checkpoint.generator)

    def until(self, count: float, seconds: float | None, callback: Callable[[Run], object] | None) -> Run:
        """Run `count` more iterations, fewer if time or callback end the search."""
        end = perf_counter() + (inf if seconds is None else seconds)
        last = count + len(self.rows) - (self.state is not None)
        try:
            for _ in self._states():
                if callback and len(self.rows) > 1 and callback(self.run()):
                    break
                if len(self.rows) > last or perf_counter() >= end:
                    break
                if not callback:
                    self.problem.together = self._together(last + 1 - len(self.rows), end)
        except BaseException as error:
            error.run = self.run()  # type: ignore[attr-defined]
            raise
        run = self.run()
        if self.problem.constraints and not run.feasible.any():
            warnings.warn(_infeasible(self.problem.constraints, run), InfeasibleWarning, stacklevel=3)
        if run.failures:
            warnings.warn(self.problem.summary(run.evaluations), FailureWarning, stacklevel=3)
        return run

    def _together(self, left: float, end: float) -> int:
        """Return how many of the iterations left may pass unseen: those of `_UNSEEN`, or of half the time left."""
        if len(self.rows) < 2:
            return 1
        pace = max(self.rows[-1][2] - self.rows[-2][2], 1e-9)
        return int(max(1, min(left, min(_UNSEEN, (end - perf_counter()) / 2) / pace)))

    def _states(self) -> Iterator[State]:
        """Yield the states of the search; append a row to the log for each iteration."""
        spent = self.rows[-1][: 4 + len(self.optimiser.phases)] if self.rows else (-1, 0, 0.0, 0.0)
        clock = PhaseClock(self.toolbox, self.optimiser.phases)
        clock.seconds.update(zip(clock.seconds, spent[4:], strict=False))
        search = self.optimiser.search(self.problem, self.toolbox, self.rng, self.state)
        while True:
            number, _, wall, cpu, *_ = before = spent
            wall_start, cpu_start = perf_counter(), process_time()
            state = next(search)
            course = state.ideal[None] if state.course is None else state.course
            times = wall + perf_counter() - wall_start, cpu + process_time() - cpu_start
            spent = number + len(course), state.evaluations, *times, *clock.seconds.values()
            self.rows += _rows(before, spent, course)
            self.state, self.generator = state, self.rng.bit_generator.state
            yield state

    def run(self) -> Run:
        """Return the run so far."""
        problem, state = self.problem, self.state or self.problem.before_the_start()
        seconds, cpu_seconds = self.rows[-1][2:4] if self.rows else (0.0, 0.0)
        phases = [f"{phase}_seconds" for phase in self.optimiser.phases]
        ideal = [f"ideal_{name}" for name in problem.objectives]
        log = Log(("iteration", "evaluations", "seconds", "cpu_seconds", *phases, *ideal), tuple(self.rows))
        objectives, constraints = state.objectives, state.constraints
        if problem.failures:
            objectives, constraints = without_worst(objectives), without_worst(constraints)
        return Run(
            designs=problem.decode(state.designs), objectives=objectives, constraints=constraints,
            headers=self.headers, evaluations=state.evaluations, seconds=seconds, cpu_seconds=cpu_seconds,
            seed=self.seed, log=log, failures=problem.failures, repeats=problem.repeats,
            checkpoint=Checkpoint(self.optimiser, self.state, self.generator),
        )  # fmt: skip


def _rows(before: tuple[float, ...], spent: tuple[float, ...], course: Real) -> Iterator[tuple[float, ...]]:
    """Yield the rows of iterations by their ideal points (k, m), which share equally what was spent in all."""
    ideals = [[one if one < WORST else nan for one in ideal] for ideal in course.tolist()]
    if len(ideals) > 1:
        first, steps = np.array(before), np.arange(1, len(ideals))[:, np.newaxis]
        passed = (first + (spent - first) * steps / len(ideals)).tolist()
        for (iteration, evaluations, *seconds), ideal in zip(passed, ideals, strict=False):
            yield int(iteration), int(evaluations), *seconds, *ideal
    yield *spent, *ideals[-1]


def _start_designs(problem: Minimisable, start: Any) -> Real:
    """Return the checked designs (k, d) of an argument `start`."""
    if isinstance(start, Population):
        start = start.designs
    elif hasattr(start, "columns"):
        variables = list(headers_of(problem)[: len(problem.lower)])
        if missing := [name for name in variables if name not in start.columns]:
            needed = checks.listing(variables, missing[0])
            raise ValueError(f"start must have the columns {needed}, got none called {missing[0]}")
        start = start[variables].to_numpy()
    designs = checks.reals("start must be", start)
    if designs.ndim != 2 or designs.shape[1] != len(problem.lower):
        raise ValueError(f"start must have shape (k, {len(problem.lower)}), got {designs.shape}")
    checks.rows_within("start", designs, problem.lower, problem.upper)
    return designs


def _infeasible(constraints: Sequence[object], run: Run) -> str:
    least = int(run.violation.argmin())
    broken = [f"{name} {g:.3g}" for name, g in zip(constraints, run.constraints[least], strict=True) if g > 0]
    violation = f"least total violation {run.violation[least]:.3g}: {', '.join(broken)}"
    return f"no feasible design among {run.evaluations} evaluated, {violation}"


def _check_parts(problem: Minimisable, optimiser: Optimiser, callback: object) -> None:
    """Raise ValueError unless these can be a problem, an optimiser and a callback."""
    checks.with_method("problem", problem, "evaluate")
    checks.with_method("optimiser", optimiser, "search")
    if not (callback is None or callable(callback)):
        raise ValueError(f"callback must be callable, got {checks.shown(callback)}")


def _iteration_count(
    start: int,
    optimiser: Optimiser,
    problem: Minimisable,
    iterations: int | None,
    evaluations: int | None,
    seconds: float | None,
) -> float:
    """Return the number of iterations that the budget allows after `start` evaluations."""
    per_iteration = optimiser.evaluations_per_iteration(len(problem.objectives))
    if seconds is not None:
        checks.positive("seconds", seconds, "s")
    numbers = [number for number in (iterations, evaluations) if number is not None]
    if len(numbers) > 1 or (not numbers and seconds is None):
        got = f"{iterations!r}, {evaluations!r} and {seconds!r}"
        raise ValueError(f"one of iterations and evaluations, or seconds, must be given, got {got}")
    if iterations is not None:
        return checks.at_least("iterations", iterations, 1)
    if evaluations is not None:
        return (checks.at_least("evaluations", evaluations, start + per_iteration) - start) // per_iteration
    return inf

"""The result of a search: final population, cost, history, and a checkpoint from which it continues."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from deap.base import Toolbox

from ..quantities import unit
from .population import Population, State
from .problem import Minimisable

if TYPE_CHECKING:
    import pandas as pd

    from .evaluation import SearchProblem


class Optimiser(Protocol):
    """Settings of an algorithm, with the toolbox of its verbs and its search."""

    @property
    def population(self) -> int:
        """Designs at the start."""

    @property
    def phases(self) -> tuple[str, ...]:
        """Timed verbs of the toolbox."""

    def evaluations_per_iteration(self, objectives: int, /) -> int:
        """Return the number of evaluations in an iteration."""

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the toolbox of the algorithm for a problem."""

    def search(
        self, problem: "SearchProblem", toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the state after the start and each iteration, without end; continue after a given `state`.

        Up to `problem.together` iterations may pass from one state to the next, which has their ideal points.
        """


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Run(Population):
    """Result of `minimise`: the final population, its cost and history.

    Attributes
    ----------
    designs, objectives, constraints : (n, d), (n, m), (n, c) ndarray
        Of the final population; a constraint is met where it is <= 0.
    evaluations : int
        Designs evaluated, the start included.
    seconds, cpu_seconds : float
        Wall-clock and processor time of the search alone [s].
    seed : int
        Seed that gives this run again.
    log : Log
        Rows and columns of `history`.
    repeats : int
        Evaluations of designs evaluated before, of a problem without real variables (`Problem.kinds`).
    failures : int
        Number of designs that could not be evaluated; in the population their objectives are NaN.
    checkpoint : Checkpoint
        State from which `resume` continues.

    Examples
    --------
    A run holds the final population; `front` is its non-dominated feasible part with units:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Nsga2(population=40), iterations=10, seed=1)
    >>> run.designs.shape, run.objectives.shape, run.evaluations
    ((40, 2), (40, 3), 440)
    >>> list(run.front().columns)
    ['spring [N/m]', 'damper [N s/m]', 'ACC [m/s^2]', 'SWS [m]', 'DTL [N]']

    A search of ten iterations, kept in a file and resumed for ten more, is the search of twenty:

    >>> run.save("run.npz")
    >>> resumed = sc.Run.load("run.npz").resume(problem, iterations=10)
    >>> whole = sc.minimise(problem, sc.Nsga2(population=40), iterations=20, seed=1)
    >>> bool((resumed.designs == whole.designs).all())
    True
    """

    evaluations: int
    seconds: float = field(metadata=unit("s"))
    cpu_seconds: float = field(metadata=unit("s"))
    seed: int
    log: "Log"
    repeats: int = 0
    failures: int = 0
    checkpoint: "Checkpoint" = field(repr=False, compare=False)

    @cached_property
    def history(self) -> "pd.DataFrame":
        """A row for the start (iteration 0) and for each iteration; counts and times [s] are cumulative.

        Columns: ``iteration``, ``evaluations``, ``seconds``, ``cpu_seconds``, ``<phase>_seconds`` of each phase,
        ``ideal_<objective>`` of each objective, of feasible designs once there is one. Compiled iterations of
        MOEA/D-DRA are of the phase ``sweep`` as a whole; ``evaluate`` is then the start alone. Without a callback
        several of them run in one call, of a tenth of a second at most, and have equal shares of its time.
        """
        import pandas as pd  # a third of a second: not at import of the package, nor in a run

        return pd.DataFrame(list(self.log.rows), columns=list(self.log.columns))

    def resume(
        self,
        problem: Minimisable,
        *,
        iterations: int | None = None,
        evaluations: int | None = None,
        seconds: float | None = None,
        toolbox: Toolbox | None = None,
        callback: "Callable[[Run], object] | None" = None,
        failures: str = "worst",
    ) -> "Run":
        """Continue the search; the result is bit for bit that of one search of the total length.

        Parameters
        ----------
        problem : Problem or RideProblem
            The problem of the run.
        iterations, evaluations, seconds
            Budget of the continuation, as for `minimise`.
        toolbox, callback, failures
            As for `minimise`; a toolbox with own verbs must be given again.
        """
        from . import driver  # it imports this module

        limits = {"iterations": iterations, "evaluations": evaluations, "seconds": seconds}
        return driver.resumed(self, problem, toolbox, callback, failures, **limits)

    def save(self, path: str | Path) -> None:
        """Write the run to a file that `load` reads; a write is atomic.

        Parameters
        ----------
        path : str or Path
            The file, such as ``run.npz``: arrays and JSON, without problem and toolbox.

        Raises
        ------
        ValueError
            If the optimiser is not one of this package, or the run has no designs.
        """
        from . import checkpoints

        checkpoints.save(self, Path(path))

    @classmethod
    def load(cls, path: str | Path) -> "Run":
        """Return the run that `save` wrote; nothing in the file is executed.

        Raises
        ------
        ValueError
            If the file was not written by `save` or is damaged.
        """
        from . import checkpoints

        return checkpoints.load(Path(path))

    def __repr__(self) -> str:
        failed = f", {self.failures} failed" if self.failures else ""
        spent = f"{self.evaluations} evaluations{failed}, {self.seconds:.3g} s, seed {self.seed}"
        return f"{super().__repr__()}\n    {spent}"


class Checkpoint(NamedTuple):
    """Optimiser, state and random generator of a search after an iteration."""

    optimiser: Optimiser
    state: State | None  # None before the end of the start
    generator: Mapping[str, Any]


class Log(NamedTuple):
    """Columns and rows of `Run.history`."""

    columns: tuple[str, ...]
    rows: tuple[tuple[float, ...], ...]

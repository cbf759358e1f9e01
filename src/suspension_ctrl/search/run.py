"""The result of a search: the final population, its cost and history, and the search as it stands."""

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
    """Settings of an algorithm, the toolbox of its verbs, and the search made of them."""

    @property
    def population(self) -> int:
        """Designs at the start."""

    @property
    def phases(self) -> tuple[str, ...]:
        """Timed verbs of the toolbox."""

    def evaluations_per_iteration(self, objectives: int, /) -> int:
        """Return how many designs an iteration evaluates."""

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the verbs of the algorithm for `problem`."""

    def search(
        self, problem: "SearchProblem", toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the state after the start and after each iteration, without end; with a `state` go on after it."""


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
    log : Log
        Rows and columns of `history`.
    repeats : int
        Of the evaluations, those of known designs of a problem without continuous variables (`Problem.kinds`).
    failures : int
        Designs that could not be evaluated; their objectives are NaN where they are in the population.
    checkpoint : Checkpoint
        The search as it stands, for `resume`.

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
        """A row for the start, iteration 0, and per iteration; counts and times [s] from the start of the run.

        Columns: ``iteration``, ``evaluations``, ``seconds``, ``cpu_seconds``, ``<phase>_seconds`` of each phase,
        ``ideal_<objective>`` of each objective, of feasible designs once there is one. A compiled sweep of
        MOEA/D-DRA evaluates its children in the phase ``sweep``; ``evaluate`` is then the start alone.
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
        """Go on with the search, as if it had not ended: bit for bit what one search of both lengths gives.

        Parameters
        ----------
        problem : Problem or RideProblem
            The problem of the run.
        iterations, evaluations, seconds
            As for `minimise`, from here on.
        toolbox, callback, failures
            As for `minimise`; a toolbox of own verbs is given again.
        """
        from . import driver  # which makes runs

        limits = {"iterations": iterations, "evaluations": evaluations, "seconds": seconds}
        return driver.resumed(self, problem, toolbox, callback, failures, **limits)

    def save(self, path: str | Path) -> None:
        """Write the run to a file, whole or not at all; `load` reads it.

        Parameters
        ----------
        path : str or Path
            The file, such as ``run.npz``: arrays and JSON, without problem and toolbox.

        Raises
        ------
        ValueError
            If the optimiser is none of this package, or the run has no designs.
        """
        from . import checkpoints

        checkpoints.save(self, Path(path))

    @classmethod
    def load(cls, path: str | Path) -> "Run":
        """Return the run that `save` wrote; nothing in the file is executed.

        Raises
        ------
        ValueError
            If the file is another one or spoilt.
        """
        from . import checkpoints

        return checkpoints.load(Path(path))

    def __repr__(self) -> str:
        failed = f", {self.failures} failed" if self.failures else ""
        spent = f"{self.evaluations} evaluations{failed}, {self.seconds:.3g} s, seed {self.seed}"
        return f"{super().__repr__()}\n    {spent}"


class Checkpoint(NamedTuple):
    """A search after an iteration: its optimiser, its state and the state of its generator."""

    optimiser: Optimiser
    state: State | None  # None before the end of the start
    generator: Mapping[str, Any]


class Log(NamedTuple):
    """Rows and columns of a history, before a table is made of them."""

    columns: tuple[str, ...]
    rows: tuple[tuple[float, ...], ...]

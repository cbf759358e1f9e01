"""Random and Sobol samples of the box: the baselines of all searches."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from typing import Any, ClassVar

import numpy as np
from deap.base import Toolbox

from .. import checks
from ..quantities import Real
from .constraints import any_feasible, constrained, ideal_with
from .evaluation import SearchProblem
from .indicators import non_dominated
from .kinds import Coding
from .population import Generational, State
from .problem import Minimisable


def random_points(rng: np.random.Generator, size: int, variables: int) -> Iterator[Real]:
    """Yield samples (size, variables) of independent uniform points in the unit cube, without end."""
    while True:
        yield rng.random((size, variables))


def sobol_points(rng: np.random.Generator, size: int, variables: int) -> Iterator[Real]:
    """Yield consecutive parts (size, variables) of one scrambled Sobol sequence, without end."""
    from scipy.stats import qmc  # half a second: not at import of the package

    sequence = qmc.Sobol(variables, rng=rng)
    block = 1 << (size - 1).bit_length()  # the sequence is balanced in blocks of powers of two
    points = np.empty((0, variables))
    while True:
        if len(points) < size:
            points = np.concatenate([points, sequence.random(block)])
        yield points[:size]
        points = points[size:]


_POINTS: dict[str, Callable[..., Iterator[Real]]] = {"random": random_points, "sobol": sobol_points}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Sampling(Generational):
    """Settings of a sample: `population` evaluations at the start and in each iteration.

    The population of a run holds the non-dominated designs of all that were evaluated; as long as none is
    feasible, the designs of the least violation.

    Parameters
    ----------
    population : int
        Designs in each iteration, at least 4.
    points : {"random", "sobol"}
        Independent points, or a scrambled Sobol sequence.

    Examples
    --------
    The baseline of any search: the non-dominated designs of a Sobol sequence of 1100 points.

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Sampling(population=100), iterations=10, seed=1)
    >>> run.evaluations, len(run.front()) == len(run.designs)
    (1100, True)
    """

    points: str = "sobol"

    phases: ClassVar[tuple[str, ...]] = ("evaluate", "filter")

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("points", self.points, _POINTS)

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the toolbox of the sample for a problem."""
        toolbox = Toolbox()
        toolbox.register("points", _POINTS[self.points], variables=Coding(problem).lower.size)
        toolbox.register("evaluate", problem.evaluate)
        toolbox.register("filter", non_dominated)
        return toolbox

    def search(
        self, problem: SearchProblem, toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the states of the search, see `Optimiser.search`."""
        m, size = len(problem.objectives), self.population
        if state is not None:
            seeds: Any = rng.bit_generator.seed_seq
            rng = np.random.default_rng(seeds)  # the sequence restarts; `islice` skips the evaluated parts
        designs, values, ideal, evaluations = (state or problem.before_the_start()).arrays()
        for unit in islice(toolbox.points(rng, size), evaluations // size, None):
            sample = problem.lower + (problem.upper - problem.lower) * unit
            sampled = problem.values(toolbox.evaluate, sample)
            ideal, evaluations = ideal_with(ideal, sampled, any_feasible(values, m)), evaluations + size
            designs, values = np.concatenate([designs, sample]), np.concatenate([values, sampled])
            best = toolbox.filter(constrained(values, m))
            designs, values = designs[best], values[best]
            yield State.of(designs, values, ideal, evaluations)

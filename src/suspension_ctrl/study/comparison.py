"""Comparison of algorithms on one problem: its timed runs, and its studies over many seeds."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise, product
from math import ceil, log

from .. import checks
from ..quantities import Record
from ..search.gamultiobj import Gamultiobj
from ..search.indicators import ReferenceFront
from ..search.moead_dra import MoeadDra
from ..search.nsga2 import Nsga2
from ..search.problem import Minimisable
from ..search.run import Optimiser
from ..search.sampling import Sampling
from .study import PlannedRun, Study

ALGORITHMS: dict[str, Callable[..., Optimiser]] = {
    "nsga2": Nsga2,
    "nsga2-standard-sort": partial(Nsga2, selection="deap-standard"),
    "nsga2-gamultiobj": Gamultiobj,
    "moead-dra": MoeadDra,
    "moead-dra-raw": partial(MoeadDra, normalise=False, objective_scales=(1.0, 1.0, 1e3)),
    "random": partial(Sampling, points="random"),
    "sobol": partial(Sampling, points="sobol"),
}
"""Optimisers by name. Raw MOEA/D-DRA is equation (14) to the letter, in the paper's units (DTL in kN)."""

STEP = 1.5
"""Largest ratio of successive budgets; between them quality is taken as linear in the logarithm of evaluations."""

EQUAL_ITERATIONS, EQUAL_EVALUATIONS = "iterations", "evaluations"
CONFIGURATION = ["population", "iterations"]


def optimiser(algorithm: str, population: int) -> Optimiser:
    """Return the algorithm of this name in `ALGORITHMS`."""
    checks.one_of("algorithms", algorithm, ALGORITHMS)
    return ALGORITHMS[algorithm](population=population)


def evaluations(
    algorithms: Sequence[str], populations: Sequence[int], objectives: int
) -> dict[tuple[str, int], int]:
    """Return the evaluations of an iteration by algorithm and population; ValueError for one that is too small."""
    pairs = product(algorithms, populations)
    return {(name, n): optimiser(name, n).evaluations_per_iteration(objectives) for name, n in pairs}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Comparison(Record):
    """Runs of each algorithm on one problem at each population and number of iterations."""

    problem: Minimisable
    algorithms: Sequence[str]  # names in `ALGORITHMS`; the first is the baseline
    populations: Sequence[int]
    iterations: Sequence[int]
    repeats: int = 1  # timed runs of each algorithm at each configuration
    seeds: int = 1  # judged runs of each algorithm at each population
    seed: int = 0  # of the first run; the next run has the next number

    def __post_init__(self) -> None:
        self._keep(**{name: tuple(getattr(self, name)) for name in ("algorithms", "populations", "iterations")})
        for name, least in (("repeats", 1), ("seeds", 1), ("seed", 0)):
            self._keep(**{name: checks.at_least(name, getattr(self, name), least)})
        self._keep(iterations=tuple(checks.at_least("iterations", count, 1) for count in self.iterations))
        self.cost()

    def cost(self) -> dict[tuple[str, int], int]:
        """Return the evaluations of an iteration by algorithm and population."""
        return evaluations(self.algorithms, self.populations, len(self.problem.objectives))

    def timed_runs(self) -> list[PlannedRun]:
        """Return the timed runs in order, alternating algorithms: equal iterations, then equal evaluations."""
        runs = []
        for size, count, repeat in product(self.populations, self.iterations, range(1, self.repeats + 1)):
            for name, budget, evaluations in self._budgets_of(size, count):
                suffix = "_equal-evaluations" if budget == EQUAL_EVALUATIONS else ""
                file, seed = f"{name}_n{size}_i{count}_r{repeat}{suffix}", self.seed + repeat - 1
                key = {"algorithm": name, "population": size, "iterations": count, "budget": budget}
                key |= {"repeat": repeat, "seed": seed}
                runs.append(PlannedRun(file, optimiser(name, size), seed, evaluations, key))
        return runs

    def _budgets_of(self, population: int, count: int) -> Iterator[tuple[str, str, int]]:
        """Yield algorithm, budget and evaluations of runs at `count` iterations, then at equal evaluations."""
        cost = {name: each for (name, n), each in self.cost().items() if n == population}
        most = population + count * max(cost.values())
        for name, each in cost.items():
            yield name, EQUAL_ITERATIONS, population + count * each
        for name, each in cost.items():  # rounded down to whole iterations
            if population + count * each < most:
                yield name, EQUAL_EVALUATIONS, population + (most - population) // each * each

    def compared(self, population: int) -> list[int]:
        """Return the evaluations at which algorithms are compared, and those of the start."""
        spent = {n for count in self.iterations for _, _, n in self._budgets_of(population, count)}
        return sorted({population} | spent)

    def budgets(self, population: int) -> list[int]:
        """Return the evaluations at which runs are judged: those compared, and steps between them."""
        compared = self.compared(population)
        steps = (step for pair in pairwise(compared) for step in _between(*pair))
        return sorted({*compared, *steps})

    def studies(self, reference: ReferenceFront | None = None) -> dict[int, Study]:
        """Return the study over all seeds of each population, against a reference front if given."""
        return {
            n: Study(
                problems={"ride": self.problem},
                algorithms={name: optimiser(name, n) for name in self.algorithms},
                seeds=range(self.seed, self.seed + self.seeds),
                budgets=self.budgets(n),
                references={"ride": reference} if reference else {},
            )
            for n in self.populations
        }


def _between(low: int, high: int) -> Iterator[int]:
    """Yield whole numbers between two budgets, in a geometric series of a ratio of at most `STEP`."""
    parts = ceil(log(high / low) / log(STEP))
    yield from (round(low * (high / low) ** (k / parts)) for k in range(1, parts))

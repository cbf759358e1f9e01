"""NSGA-II as in MATLAB's ``gamultiobj`` of 2008, which the paper used, as a DEAP toolbox over arrays.

Documented by The MathWorks (Genetic Algorithm and Direct Search Toolbox, "gamultiobj Algorithm" and "Options
Reference"): a controlled elitist NSGA-II; tournaments of two; a fraction 0.8 of the children from intermediate
crossover, the others from adaptive-feasible mutation; at most a fraction 0.35 of the population from the first
front as long as others exist; crowding distance in objective space.

What is not documented is our choice. A pair of parents has one child. Beyond the first front, survivors are chosen
by rank, then by crowding distance, feasible designs before all others. A mutant steps in a uniformly random
direction, turned away from bounds on which it lies; its length is uniform up to a step and within the bounds.
"Adaptive with respect to the last successful or unsuccessful generation" is taken as Rechenberg's rule: the step
doubles if more than a fifth of the mutants survived, and halves otherwise.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import ceil
from typing import ClassVar

import numpy as np
from deap.base import Toolbox
from numpy.typing import NDArray

from ..quantities import Integer, Real, unit
from .constraints import any_feasible, constrained, ideal_with, violations
from .evaluation import SearchProblem
from .kinds import box
from .operators import sample_uniform, winners_of
from .population import Generational, State
from .problem import Minimisable
from .selection import ranks_and_crowding

_SUCCESS = 0.2
"""Share of surviving mutants above which the step grows (I. Rechenberg, "Evolutionsstrategie", 1973)."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Gamultiobj(Generational):
    """Settings of the controlled NSGA-II: `population` evaluations at the start and in each iteration.

    Parameters
    ----------
    population : int
        Size of the population N, at least 4.
    crossover_fraction : float
        Share of children made by crossover; the others are mutants.
    pareto_fraction : float
        Largest share of the survivors from the first front, as long as there are other fronts.

    Examples
    --------
    At most 35 % of the population is from the first front, so that dominated designs survive:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> run = sc.minimise(problem, sc.Gamultiobj(population=100), iterations=10, seed=1)
    >>> len(run.front()) < len(run.designs) == 100
    True
    """

    crossover_fraction: float = field(default=0.8, metadata=unit("", 0, 1))
    pareto_fraction: float = field(default=0.35, metadata=unit("", 0, 1))

    phases: ClassVar[tuple[str, ...]] = ("sample", "evaluate", "tournament", "mate", "mutate", "select")

    def toolbox(self, problem: Minimisable) -> Toolbox:
        """Return the toolbox of the algorithm for a problem."""
        lower, upper = box(problem)
        toolbox = Toolbox()
        toolbox.register("sample", sample_uniform, lower=lower, upper=upper)
        toolbox.register("evaluate", problem.evaluate)
        toolbox.register("tournament", ranked_tournament)
        toolbox.register("mate", intermediate_crossover)
        toolbox.register("mutate", feasible_steps, lower=lower, upper=upper)
        toolbox.register("select", select_controlled, pareto_fraction=self.pareto_fraction)
        return toolbox

    def search(
        self, problem: SearchProblem, toolbox: Toolbox, rng: np.random.Generator, state: State | None = None
    ) -> Iterator[State]:
        """Yield the states of the search, see `Optimiser.search`."""
        size, m = self.population, len(problem.objectives)
        crossed = round(self.crossover_fraction * size)
        state = state or problem.before_the_start()
        designs, values, ideal, evaluations = state.arrays()
        rank, crowding = state.memory.get("rank"), state.memory.get("crowding")
        step = float(state.memory["step"]) if state.memory else None
        while True:
            if step is None:
                children = np.array(toolbox.sample(rng, size), dtype=float)
            else:
                parents = designs[toolbox.tournament(rng, rank, crowding, 2 * crossed + size - crossed)]
                pairs, alone = parents[: 2 * crossed], parents[2 * crossed :]
                children = np.concatenate([toolbox.mate(rng, pairs), toolbox.mutate(rng, alone, step)])
            new_values = problem.values(toolbox.evaluate, children)
            ideal = ideal_with(ideal, new_values, any_feasible(values, m))
            evaluations += len(children)
            designs, values = np.concatenate([designs, children]), np.concatenate([values, new_values])
            pool = contenders(values, m, size)
            kept, rank, crowding = toolbox.select(constrained(values[pool], m), size)
            step = 1.0 if step is None else self._next_step(step, pool[kept])
            designs, values = designs[pool[kept]], values[pool[kept]]
            yield State.of(designs, values, ideal, evaluations, rank=rank, crowding=crowding, step=step)

    def _next_step(self, step: float, kept: Integer) -> float:
        """Return the next step from the survivors `kept` (N,), indices of parents, crossed children, mutants."""
        mutants = self.population + round(self.crossover_fraction * self.population)
        survived = np.count_nonzero(kept >= mutants) / max(1, 2 * self.population - mutants)
        return min(1.0, 2 * step) if survived > _SUCCESS else step / 2


def ranked_tournament(rng: np.random.Generator, rank: Integer, crowding: Real, size: int) -> Integer:
    """Return `size` winners of tournaments of two out of ranks (n,): lower rank, then larger crowding distance."""
    pairs = (rng.random((2, size)) * rank.size).astype(np.int64)
    return winners_of(np.ascontiguousarray(pairs.T), rank, crowding)


def intermediate_crossover(rng: np.random.Generator, parents: Real) -> Real:
    """Return children (n, d), each uniform in the box between two consecutive parents (2 n, d)."""
    first, second = parents[::2], parents[1::2]
    return first + rng.random(first.shape) * (second - first)


def feasible_steps(rng: np.random.Generator, designs: Real, step: float, lower: Real, upper: Real) -> Real:
    """Return mutants (n, d) in the box: steps of at most `step` box widths in random directions."""
    direction = rng.normal(size=designs.shape)
    direction *= (upper - lower) / np.linalg.norm(direction, axis=1, keepdims=True)
    blocked = ((direction > 0) & (designs >= upper)) | ((direction < 0) & (designs <= lower))
    direction[blocked] *= -1  # a direction that satisfies the bounds, as documented: off a bound, not against it
    bound = np.where(direction > 0, upper, lower)
    room = np.min((bound - designs) / direction, axis=1, initial=step)
    moved = designs + (rng.random(len(designs)) * room)[:, np.newaxis] * direction
    return np.clip(moved, lower, upper)


def contenders(values: Real, m: int, size: int) -> Integer:
    """Return the indices of the feasible values (n, m + c), ascending, filled up to `size` by least violation."""
    violation = violations(values, m)
    count = max(size, np.count_nonzero(violation == 0))
    return np.sort(np.argsort(violation, kind="stable")[:count])


def select_controlled(
    objectives: Real, size: int, pareto_fraction: float
) -> tuple[Integer, NDArray[np.int32], Real]:
    """Return indices, ascending, of `size` survivors of objectives (n, m), their fronts and crowding distances.

    At most `pareto_fraction` of them is from the first front if there are others: K. Deb, T. Goel, "Controlled
    elitist non-dominated sorting genetic algorithms for better convergence", EMO 2001.
    """
    rank, crowding = ranks_and_crowding(objectives, len(objectives))
    preferred = np.lexsort((-crowding, rank))
    best = np.count_nonzero(rank == 0)
    limit = min(best, ceil(pareto_fraction * size))
    preferred = np.concatenate([preferred[:limit], preferred[best:], preferred[limit:best]])
    index = np.sort(preferred[:size])
    return index, rank[index], crowding[index]

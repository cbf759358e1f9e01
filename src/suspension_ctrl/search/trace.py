"""What a search has seen: its populations along the way and every design that it evaluated."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from ..quantities import FrozenMapping, Real
from .compiled import call, verb_of
from .driver import Optimiser
from .population import Population, State
from .problem import Kernel, Minimisable


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace(Population):
    """All designs that a search evaluated, in order, and its populations along the way.

    Parameters
    ----------
    states : mapping of int to State
        By budget of evaluations, the state after the last iteration within it.
    """

    states: Mapping[int, State]


def trace(problem: Minimisable, optimiser: Optimiser, budgets: Iterable[int], seed: int) -> Trace:
    """Carry out the search that `minimise` makes from this seed and keep what it sees; nothing is timed.

    Parameters
    ----------
    problem : Problem or RideProblem
        What to minimise.
    optimiser : Optimiser
        The algorithm with its settings.
    budgets : iterable of int
        Evaluations at which the population is kept, none less than the start; the search ends at the largest.
    seed : int
        Seed of every random draw.

    Raises
    ------
    ValueError
        If a budget does not cover the start.
    """
    ordered = sorted(set(budgets))
    per_iteration = optimiser.evaluations_per_iteration(len(problem.objectives))
    if not ordered or ordered[0] < optimiser.population:
        raise ValueError(f"budgets must be >= {optimiser.population} evaluations, the start, got {ordered}")
    recorded = Recorded(problem, ordered[-1])
    states: dict[int, State] = {}
    search = optimiser.search(recorded, optimiser.toolbox(recorded), np.random.default_rng(seed))
    for state in search:
        reached = [b for b in ordered if state.evaluations <= b < state.evaluations + per_iteration]
        states |= dict.fromkeys(reached, state)
        if ordered[-1] in states:
            break
    designs, objectives, constraints = recorded.seen()
    return Trace(designs=designs, objectives=objectives, constraints=constraints, states=FrozenMapping(states))


class Recorded:
    """A problem that keeps what its evaluation and its kernel return, in order.

    Parameters
    ----------
    problem : Problem or RideProblem
        The problem itself.
    capacity : int
        Most designs to be kept.
    """

    def __init__(self, problem: Minimisable, capacity: int) -> None:
        self.lower, self.upper = problem.lower, problem.upper
        self.objectives, self.constraints = problem.objectives, problem.constraints
        self._evaluate = problem.evaluate
        self._designs = np.empty((capacity, len(problem.lower)))
        self._values = np.empty((capacity, len(problem.objectives) + len(problem.constraints)))
        self._count = np.zeros(1, dtype=np.int64)
        self.kernel: Kernel | None = None
        if problem.kernel is not None:
            self.kernel = KeptKernel(self._designs, self._values, self._count, verb_of(problem.kernel))

    def evaluate(self, designs: Real) -> Real:
        """Return the problem's values (n, m + c) of designs (n, d), and keep both."""
        start = int(self._count[0])
        rows = slice(start, start + len(designs))
        self._designs[rows] = designs
        self._values[rows] = values = self._evaluate(designs)
        self._count[0] = rows.stop
        return values

    def seen(self) -> tuple[Real, Real, Real]:
        """Return designs (n, d), their objectives (n, m) and constraints (n, c) kept so far."""
        count, m = self._count[0], len(self.objectives)
        values = self._values[:count]
        return self._designs[:count], np.ascontiguousarray(values[:, :m]), np.ascontiguousarray(values[:, m:])


class KeptKernel(NamedTuple):
    """A kernel that puts each design and its values into the next row of `designs` and `values`."""

    designs: Real
    values: Real
    count_so_far: NDArray[np.int64]
    kernel: Any

    @register_jitable
    def function(self, design: Real) -> Real:
        """Return the kernel's values (m + c,) of a design (d,)."""
        value: Real = call(self.kernel, (design,))
        self.designs[self.count_so_far[0]] = design
        self.values[self.count_so_far[0]] = value
        self.count_so_far[0] += 1
        return value

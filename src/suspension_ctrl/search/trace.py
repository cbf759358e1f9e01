"""Trace of a search: every design it evaluates and its populations at budgets of evaluations."""

import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from ..compiled import call, compilable, verb_of
from ..quantities import FrozenMapping, Integer, Real
from .evaluation import FailureWarning, Judged
from .population import Population, State
from .problem import Kernel, Minimisable
from .run import Optimiser


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace(Population):
    """All evaluated designs of a search, in order."""

    states: Mapping[int, State]  # after the last iteration within each budget of evaluations
    spent: Mapping[int, int]  # designs evaluated until then, fewer than asked for if some were known


def trace(problem: Minimisable, optimiser: Optimiser, budgets: Iterable[int], seed: int) -> Trace:
    """Return the trace of the search of `minimise` with this seed, up to the largest of the budgets."""
    ordered = sorted(set(budgets))
    per_iteration = optimiser.evaluations_per_iteration(len(problem.objectives))
    if not ordered or ordered[0] < optimiser.population:
        raise ValueError(f"budgets must be >= {optimiser.population} evaluations, the start, got {ordered}")
    recorded = Recorded(problem, ordered[-1])
    judged = Judged(recorded, strict=False)
    judged.reference = problem.evaluate  # a comparison of the kernel is no part of the search
    states, spent = dict[int, State](), dict[int, int]()
    for state in optimiser.search(judged, optimiser.toolbox(recorded), np.random.default_rng(seed)):
        reached = [b for b in ordered if state.evaluations <= b < state.evaluations + per_iteration]
        states |= dict.fromkeys(reached, replace(state, designs=judged.decode(state.designs)))
        spent |= dict.fromkeys(reached, recorded.count)
        if ordered[-1] in states:
            break
    if judged.failures:
        warnings.warn(judged.summary(state.evaluations), FailureWarning, stacklevel=2)
    designs, objectives, constraints = recorded.seen()
    return Trace(
        designs=designs, objectives=objectives, constraints=constraints,
        states=FrozenMapping(states), spent=FrozenMapping(spent),
    )  # fmt: skip


class Recorded:
    """A problem with a record of up to `capacity` evaluations, in order."""

    def __init__(self, problem: Minimisable, capacity: int) -> None:
        self.lower, self.upper = problem.lower, problem.upper
        self.objectives, self.constraints = problem.objectives, problem.constraints
        self.variables, self.kinds = getattr(problem, "variables", ()), getattr(problem, "kinds", {})
        self._evaluate = problem.evaluate
        self._designs = np.empty((capacity, len(problem.lower)))
        self._values = np.empty((capacity, len(problem.objectives) + len(problem.constraints)))
        self._count = np.zeros(1, dtype=np.int64)
        self.kernel: Kernel | None = None
        if problem.kernel is not None:
            self.kernel = KeptKernel(self._designs, self._values, self._count, verb_of(problem.kernel))

    def evaluate(self, designs: Real) -> Real:
        """Return the values (n, m + c) of designs (n, d), and keep both."""
        rows = slice(self._count[0], self._count[0] + len(designs))
        self._designs[rows] = designs
        self._values[rows] = values = self._evaluate(designs)
        self._count[0] = rows.stop
        return values

    @property
    def count(self) -> int:
        """Evaluations so far."""
        return int(self._count[0])

    def seen(self) -> tuple[Real, Real, Real]:
        """Return the designs (n, d), objectives (n, m) and constraints (n, c) so far."""
        values = self._values[: self._count[0]]
        objectives, constraints = np.split(values, [len(self.objectives)], axis=1)
        return self._designs[: len(values)], np.ascontiguousarray(objectives), np.ascontiguousarray(constraints)


class KeptKernel(NamedTuple):
    """A kernel with a record of designs (k, d) and values (k, m + c)."""

    designs: Real
    values: Real
    count_so_far: Integer
    kernel: Any

    @compilable()
    def __call__(self, design: Real) -> Real:
        """Return the kernel's values (m + c,) of a design (d,)."""
        value: Real = call(self.kernel, (design,))
        self.designs[self.count_so_far[0]] = design
        self.values[self.count_so_far[0]] = value
        self.count_so_far[0] += 1
        return value

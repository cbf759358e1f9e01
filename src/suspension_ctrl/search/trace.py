"""Trace of a search: all evaluated designs, and the populations at given budgets of evaluations."""

import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..quantities import FrozenMapping
from .evaluation import FailureWarning, SearchProblem
from .population import Population, State
from .problem import Minimisable, headers_of
from .run import Optimiser


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace(Population):
    """All evaluated designs of a search, in order."""

    states: Mapping[int, State]  # by budget, after the last iteration within it
    spent: Mapping[int, int]  # by budget, different designs evaluated within it: repeats are not counted


def trace(problem: Minimisable, optimiser: Optimiser, budgets: Iterable[int], seed: int) -> Trace:
    """Return the trace of `minimise` with this seed, up to the largest of the budgets [evaluations]."""
    ordered, m = sorted(set(budgets)), len(problem.objectives)
    per_iteration = optimiser.evaluations_per_iteration(m)
    if not ordered or ordered[0] < optimiser.population:
        raise ValueError(f"budgets must be >= {optimiser.population} evaluations, the start, got {ordered}")
    searched = SearchProblem(problem, strict=False, record=True)
    states, spent = dict[int, State](), dict[int, int]()
    for state in optimiser.search(searched, optimiser.toolbox(problem), np.random.default_rng(seed)):
        reached = [b for b in ordered if state.evaluations <= b < state.evaluations + per_iteration]
        states |= dict.fromkeys(reached, replace(state, designs=searched.decode(state.designs)))
        spent |= dict.fromkeys(reached, searched.recorded)
        if ordered[-1] in states:
            break
    if searched.failures:
        warnings.warn(searched.summary(state.evaluations), FailureWarning, stacklevel=2)
    designs, values = searched.record()
    return Trace(
        designs=designs, objectives=values[:, :m], constraints=values[:, m:], headers=headers_of(problem),
        states=FrozenMapping(states), spent=FrozenMapping(spent),
    )  # fmt: skip

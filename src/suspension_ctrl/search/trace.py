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
    seen, error = trace_so_far(problem, optimiser, budgets, seed)
    if error is not None:
        raise error
    return seen


def trace_so_far(
    problem: Minimisable, optimiser: Optimiser, budgets: Iterable[int], seed: int
) -> tuple[Trace, Exception | SystemExit | None]:
    """Return the trace of a search and None, or the trace until an evaluation raised an error and the error."""
    ordered, m = sorted(set(budgets)), len(problem.objectives)
    per_iteration = optimiser.evaluations_per_iteration(m)
    if not ordered or ordered[0] < optimiser.population:
        raise ValueError(f"budgets must be >= {optimiser.population} evaluations, the start, got {ordered}")
    searched = SearchProblem(problem, strict=False, record=True)
    states, spent, evaluations = dict[int, State](), dict[int, int](), 0
    error: Exception | SystemExit | None = None
    try:
        for state in optimiser.search(searched, optimiser.toolbox(problem), np.random.default_rng(seed)):
            evaluations = state.evaluations
            reached = [b for b in ordered if evaluations <= b < evaluations + per_iteration]
            states |= dict.fromkeys(reached, replace(state, designs=searched.decode(state.designs)))
            spent |= dict.fromkeys(reached, searched.recorded)
            if ordered[-1] in states:
                break
    except (Exception, SystemExit) as raised:  # an evaluation may raise anything
        error = raised
    if searched.failures:
        warnings.warn(searched.summary(evaluations), FailureWarning, stacklevel=3)
    designs, values = searched.record()
    seen = Trace(
        designs=designs, objectives=values[:, :m], constraints=values[:, m:], headers=headers_of(problem),
        states=FrozenMapping(states), spent=FrozenMapping(spent),
    )  # fmt: skip
    return seen, error

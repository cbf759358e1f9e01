"""One iteration of MOEA/D-DRA over the chosen subproblems: from mating range to replacement."""

from functools import partial
from typing import Any, NamedTuple

import numpy as np
from deap.base import Toolbox
from numba import njit
from numba.extending import is_jitted

from ..compiled import call, call_compiled, compiled, storable, verb_of
from ..quantities import Integer, Real
from .clock import untimed
from .constraints import feasible_objectives
from .population import State
from .problem import Minimisable, evaluate_checked


class Decomposed(NamedTuple):
    """A population with one individual per subproblem; a sweep changes its arrays in place."""

    designs: Real  # (N, d)
    values: Real  # (N, m + c), objectives, then constraints
    ideal: Real  # (m,) least value seen of each objective, of feasible designs once there is one
    weights: Real  # (N, m) weight vectors over the spans of the objectives
    neighbours: Integer  # (N, T) nearest subproblems of each, itself first

    def state(self, evaluations: int) -> State:
        """Return a copy of the population after so many evaluations."""
        return State.of(self.designs, self.values, self.ideal, evaluations)

    def span(self) -> Real:
        """Return the span (m,) from ideal point to worst feasible design (any, if none), 1 where it is zero."""
        m = self.ideal.size
        feasible = feasible_objectives(self.values, m)
        span = (feasible if len(feasible) else self.values[:, :m]).max(axis=0) - self.ideal
        return np.where(span > 0, span, 1.0)


def sweep_sequential(
    rng: np.random.Generator, chosen: Integer, population: Decomposed, toolbox: Toolbox, problem: Minimisable
) -> None:
    """Work on the chosen subproblems in order, each child after the replacements of the one before.

    Runs compiled if every verb is compiled and the problem has a kernel, otherwise in Python with the same draws.
    """
    verbs = [compiled_verb(untimed(getattr(toolbox, name))) for name in VERBS]
    verbs.append(compiled_evaluation(toolbox, problem))
    function = _STORED if all(map(storable, verbs)) else _FRESH
    if None in verbs:
        function = work_on
        verbs = [getattr(toolbox, name) for name in VERBS]
        verbs.append(lambda child: evaluate_checked(toolbox.evaluate, child[np.newaxis], problem)[0])
    function(rng, chosen, population, *verbs)


def sweep_batch(
    rng: np.random.Generator, chosen: Integer, population: Decomposed, toolbox: Toolbox, problem: Minimisable
) -> None:
    """Make the children of all chosen subproblems, evaluate them in one call, replace in order."""
    designs, values, ideal, weights, neighbours = population
    ranges = [toolbox.mating_range(rng, i, neighbours) for i in chosen]
    children = np.empty((chosen.size, designs.shape[1]))
    for row, (i, partners) in enumerate(zip(chosen, ranges, strict=True)):
        child = toolbox.reproduce(rng, designs, i, partners)
        children[row] = toolbox.mutate(rng, toolbox.repair(rng, child, designs[i]))
    born = evaluate_checked(toolbox.evaluate, children, problem)
    for child, value, partners in zip(children, born, ranges, strict=True):
        toolbox.update(rng, child, value, partners, designs, values, weights, ideal)


VERBS = ("mating_range", "reproduce", "repair", "mutate", "update")
"""The verbs inside a sweep, in the order of `work_on`."""


def work_on(
    rng: np.random.Generator,
    chosen: Integer,
    population: Decomposed,
    mating_range: Any,
    reproduce: Any,
    repair: Any,
    mutate: Any,
    update: Any,
    evaluate: Any,
) -> None:
    """Make, evaluate and place one child for each chosen subproblem, in order."""
    designs, values, ideal, weights, neighbours = population
    for i in chosen:
        partners = call(mating_range, (rng, i, neighbours))
        child = call(reproduce, (rng, designs, i, partners))
        child = call(repair, (rng, child, designs[i]))
        child = call(mutate, (rng, child))
        value = call(evaluate, (child,))
        good = value.size == values.shape[1]
        for j in range(value.size):
            good = good and np.isfinite(value[j])
        if not good:
            raise ValueError("kernel must return a finite value for each objective and constraint, got others")
        call(update, (rng, child, value, partners, designs, values, weights, ideal))


_STORED, _FRESH = compiled()(work_on), njit(work_on)


def compiled_verb(verb: partial[Any]) -> Any:
    """Return a verb of a toolbox in the form for compiled loops, None if it is not compiled."""
    if verb.func is call_compiled:
        return verb.args[0]
    if verb.args or not is_jitted(verb.func):
        return None
    code = verb.func.py_func.__code__
    trailing = code.co_varnames[code.co_argcount - len(verb.keywords) : code.co_argcount]
    if set(trailing) != set(verb.keywords):
        return None
    return verb_of((verb.func, tuple(verb.keywords[name] for name in trailing)))


def compiled_evaluation(toolbox: Toolbox, problem: Minimisable) -> Any:
    """Return the problem's kernel, None if it has none or the toolbox evaluates in another way."""
    evaluate = untimed(toolbox.evaluate)
    own = evaluate.func == problem.evaluate and not evaluate.args and not evaluate.keywords
    return verb_of(problem.kernel) if own and problem.kernel else None

"""One iteration of MOEA/D-DRA over the chosen subproblems: from mating range to replacement."""

from collections.abc import Callable
from functools import partial
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from deap.base import Toolbox
from numba import njit
from numba.core.registry import CPUDispatcher
from numpy.typing import NDArray

from .clock import untimed
from .constraints import feasible_objectives
from .population import State
from .problem import Minimisable, evaluate_checked

Verb = tuple[Callable[..., Any], tuple[Any, ...]]
"""A function and the settings that follow its arguments in a call."""


class Decomposed(NamedTuple):
    """A population with one individual per subproblem; its arrays change in place as the search goes on.

    Parameters
    ----------
    designs : (N, d) ndarray
    values : (N, m + c) ndarray
        Objectives, then constraints.
    ideal : (m,) ndarray
        Least value seen of each objective, among feasible designs as soon as there is one.
    weights : (N, m) ndarray
        Weight vectors over the objectives' spans: what multiplies each objective in each scalar problem.
    neighbours : (N, T) ndarray
        Nearest subproblems of each, itself first.
    """

    designs: NDArray[np.float64]
    values: NDArray[np.float64]
    ideal: NDArray[np.float64]
    weights: NDArray[np.float64]
    neighbours: NDArray[np.int64]

    def state(self, evaluations: int) -> State:
        """Return a copy of what the search shows of itself after so many evaluations."""
        return State.of(self.designs.copy(), self.values.copy(), self.ideal.copy(), evaluations)

    def span(self) -> NDArray[np.float64]:
        """Return the distance (m,) from the ideal point to the worst of each objective, 1 where there is none.

        Worst among feasible designs, among all while there is no feasible one.
        """
        m = self.ideal.size
        feasible = feasible_objectives(self.values, m)
        span = (feasible if len(feasible) else self.values[:, :m]).max(axis=0) - self.ideal
        return np.where(span > 0, span, 1.0)


def sweep_sequential(
    rng: np.random.Generator,
    chosen: NDArray[np.int64],
    population: Decomposed,
    toolbox: Toolbox,
    problem: Minimisable,
) -> None:
    """Work on the chosen subproblems in order, each child seeing every replacement before it.

    Runs compiled if every verb is compiled and the problem has a kernel; otherwise as plain Python with
    whatever the toolbox holds. The same draws are made either way.
    """
    compiled = [compiled_verb(untimed(getattr(toolbox, name))) for name in VERBS]
    compiled.append(compiled_evaluation(toolbox, problem))
    verbs = [verb for verb in compiled if verb is not None]
    function = work_on
    if len(verbs) < len(compiled):
        function = getattr(work_on, "py_func", work_on)  # itself where numba is switched off
        verbs = [(getattr(toolbox, name), ()) for name in VERBS]
        verbs.append((lambda child: evaluate_checked(toolbox.evaluate, child[np.newaxis], problem)[0], ()))
    function(rng, chosen, population, *chain.from_iterable(verbs))


def sweep_batch(
    rng: np.random.Generator,
    chosen: NDArray[np.int64],
    population: Decomposed,
    toolbox: Toolbox,
    problem: Minimisable,
) -> None:
    """Make the children of all chosen subproblems, evaluate them in one call, then replace in order."""
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
"""The verbs inside a sweep, in the order in which `work_on` takes them."""


@njit  # not cached on disk: numba cannot store the types of functions passed as arguments
def work_on(
    rng: np.random.Generator,
    chosen: NDArray[np.int64],
    population: Decomposed,
    mating_range: Callable[..., NDArray[np.int64]],
    range_settings: tuple[Any, ...],
    reproduce: Callable[..., NDArray[np.float64]],
    reproduce_settings: tuple[Any, ...],
    repair: Callable[..., NDArray[np.float64]],
    repair_settings: tuple[Any, ...],
    mutate: Callable[..., NDArray[np.float64]],
    mutate_settings: tuple[Any, ...],
    update: Callable[..., None],
    update_settings: tuple[Any, ...],
    evaluate: Callable[..., NDArray[np.float64]],
    evaluate_settings: tuple[Any, ...],
) -> None:
    """Make, evaluate and place one child for each chosen subproblem, in order; each verb before its settings."""
    designs, values, ideal, weights, neighbours = population
    for i in chosen:
        partners = mating_range(rng, i, neighbours, *range_settings)
        child = reproduce(rng, designs, i, partners, *reproduce_settings)
        child = repair(rng, child, designs[i], *repair_settings)
        child = mutate(rng, child, *mutate_settings)
        value = evaluate(child, *evaluate_settings)
        if value.size != values.shape[1] or not np.isfinite(value).all():
            raise ValueError("kernel must return a finite value for each objective and constraint, got others")
        update(rng, child, value, partners, designs, values, weights, ideal, *update_settings)


def compiled_verb(verb: partial[Any]) -> Verb | None:
    """Return a toolbox verb's compiled function with its settings in order, None if it is not compiled."""
    if verb.args or not isinstance(verb.func, CPUDispatcher):
        return None
    code = verb.func.py_func.__code__
    trailing = code.co_varnames[code.co_argcount - len(verb.keywords) : code.co_argcount]
    if set(trailing) != set(verb.keywords):
        return None
    return verb.func, tuple(verb.keywords[name] for name in trailing)


def compiled_evaluation(toolbox: Toolbox, problem: Minimisable) -> Verb | None:
    """Return the problem's kernel, or None if it has none or the toolbox evaluates in another way."""
    evaluate = untimed(toolbox.evaluate)
    own = evaluate.func == problem.evaluate and not evaluate.args and not evaluate.keywords
    return problem.kernel if own else None

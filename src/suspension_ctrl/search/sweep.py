"""One iteration of MOEA/D-DRA over the chosen subproblems: from mating range to replacement."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from deap.base import Toolbox
from numba import njit
from numba.core.errors import NumbaError
from numba.extending import is_jitted

from ..compiled import call, call_compiled, compilable, compiled, linked, storable, verb_of
from ..quantities import Integer, Real
from .clock import untimed
from .constraints import feasible_objectives
from .evaluation import WORST, SearchProblem
from .replacement import ReplaceInSweep, ReplaceWorse


class Decomposed(NamedTuple):
    """A population with one individual per subproblem; a sweep changes its arrays in place."""

    designs: Real  # (N, d)
    values: Real  # (N, m + c), objectives, then constraints
    ideal: Real  # (m,) least value seen of each objective, of feasible designs once there is one
    weights: Real  # (N, m) weight vectors over the spans of the objectives
    neighbours: Integer  # (N, T) nearest subproblems of each, itself first

    def span(self) -> Real:
        """Return the span (m,) from ideal point to worst feasible design (any, if none), 1 where it is zero."""
        m, evaluated = self.ideal.size, self.values[:, 0] < WORST
        found = self.values if evaluated.all() else self.values[evaluated]
        feasible = feasible_objectives(found, m)
        columns = np.ascontiguousarray(
            (feasible if len(feasible) else found[:, :m]).T
        )  # numpy is quick along these
        span = columns.max(axis=1, initial=-np.inf) - self.ideal
        return np.where(span > 0, span, 1.0)


def sweep_sequential(
    rng: np.random.Generator, chosen: Integer, population: Decomposed, toolbox: Toolbox, problem: SearchProblem
) -> None:
    """Work on the chosen subproblems in order, each child after the replacements of the one before.

    Runs compiled if every verb is compiled and the problem has a kernel, otherwise in Python with the same draws.
    A kernel is compared with `evaluate` after the first sweep.
    """
    box = np.array([problem.lower, problem.upper])
    children, born = np.empty((chosen.size, box.shape[1])), np.empty((chosen.size, population.values.shape[1]))
    try:
        problem.sweep = function, ours, verbs = problem.sweep or swept_by(toolbox, problem, population)
        if isinstance(verbs[UPDATE], ReplaceInSweep):
            verbs[UPDATE].start()
        made = function(rng, chosen, population, None if ours else box, problem.strict, children, born, *verbs)
    except NumbaError as error:
        raise ValueError(f"verbs must compile together, got {str(error).splitlines()[0]}") from None
    if made < 0:
        raise ValueError(_FAULTS[made])
    if function is not work_on:
        problem.take(children[:made], born[:made])


def swept_by(
    toolbox: Toolbox, problem: SearchProblem, population: Decomposed
) -> tuple[Callable[..., int], bool, list[Any]]:
    """Return the function of a search's sweeps, whether all its verbs are of this package, and these verbs."""
    verbs = [compiled_verb(untimed(getattr(toolbox, name))) for name in VERBS]
    verbs.append(compiled_evaluation(toolbox, problem))
    if None not in verbs:
        if isinstance(verbs[UPDATE], ReplaceWorse):
            verbs[UPDATE] = ReplaceInSweep.of(verbs[UPDATE], *population.weights.shape)
        ours = all(map(storable, verbs))
        return (_STORED if ours else _FRESH), ours, [*verbs[:-1], linked(verbs[-1])]
    verbs = [getattr(toolbox, name) for name in VERBS]
    verbs.append(lambda child: problem.values(toolbox.evaluate, child[np.newaxis])[0])
    return work_on, False, verbs


def sweep_batch(
    rng: np.random.Generator, chosen: Integer, population: Decomposed, toolbox: Toolbox, problem: SearchProblem
) -> None:
    """Make the children of all chosen subproblems, evaluate them in one call, replace in order."""
    designs, values, ideal, weights, neighbours = population
    ranges = [toolbox.mating_range(rng, i, neighbours) for i in chosen]
    children = np.empty((chosen.size, designs.shape[1]))
    for row, (i, partners) in enumerate(zip(chosen, ranges, strict=True)):
        child = toolbox.reproduce(rng, designs, i, partners)
        children[row] = toolbox.mutate(rng, toolbox.repair(rng, child, designs[i]))
    born = problem.values(toolbox.evaluate, children)
    for child, value, partners in zip(children, born, ranges, strict=True):
        toolbox.update(rng, child, value, partners, designs, values, weights, ideal)


VERBS = ("mating_range", "reproduce", "repair", "mutate", "update")
"""The verbs inside a sweep, in the order of `work_on`."""

UPDATE = VERBS.index("update")


_FAULTS = {
    -1: "kernel must return a value for each objective and constraint, got another number",
    -2: "mating_range must return indices of individuals, got others",
    -3: "reproduce, repair and mutate must return a value for each variable, got another number",
    -4: "repair and mutate must return designs within the bounds, got one outside",
}
"""Errors of compiled verbs, by the mark of `work_on`."""


def work_on(
    rng: np.random.Generator,
    chosen: Integer,
    population: Decomposed,
    box: Real | None,
    strict: bool,
    children: Real,
    born: Real,
    mating_range: Any,
    reproduce: Any,
    repair: Any,
    mutate: Any,
    update: Any,
    evaluate: Any,
) -> int:
    """Make, evaluate and place one child for each chosen subproblem, in order, and return their number.

    Fills `children` (k, e) and their values `born` (k, m + c). If `strict` it ends at the first that cannot be
    evaluated. Returns a mark of `_FAULTS` for a kernel, or verbs that leave the `box` (2, e), if there is one.
    """
    designs, values, ideal, weights, neighbours = population
    for k in range(chosen.size):
        i = chosen[k]
        partners = call(mating_range, (rng, i, neighbours))
        if box is not None and not all_below(partners, designs.shape[0]):  # numba leaves out what None rules out
            return -2
        child = call(reproduce, (rng, designs, i, partners))
        if child.size != designs.shape[1]:
            return -3
        child = call(repair, (rng, child, designs[i]))
        if child.size != designs.shape[1]:
            return -3
        child = call(mutate, (rng, child))
        if box is not None and place_of(child, box) < 0:
            return place_of(child, box)
        for v in range(child.size):
            children[k, v] = child[v]
        value = call(evaluate, (children[k],))
        if value.size != born.shape[1]:
            return -1
        if not all_finite(value, born[k]) and strict:
            return k + 1
        call(update, (rng, child, born[k], partners, designs, values, weights, ideal))
    return chosen.size


@compiled(inline="always")
def all_finite(value: Real, born: Real) -> bool:
    """Whether values (k,) are finite; copy them into `born`, or else `WORST`."""
    good = True
    for j in range(born.size):
        born[j] = value[j]
        good = good and abs(born[j]) < WORST
    for j in range(born.size):
        born[j] = born[j] if good else WORST
    return good


@compilable()
def all_below(indices: Integer, count: int) -> bool:
    """Whether there are two or more indices, from 0 to count - 1."""
    good = indices.size > 1
    for i in indices:
        good = good and 0 <= i < count
    return good


@compilable()
def place_of(child: Real, box: Real) -> int:
    """Return 0 for a child (d,) in the box (2, d), otherwise its mark of `_FAULTS`."""
    if child.size != box.shape[1]:
        return -3
    for v in range(child.size):
        if not box[0, v] <= child[v] <= box[1, v]:
            return -4
    return 0


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


def compiled_evaluation(toolbox: Toolbox, problem: SearchProblem) -> Any:
    """Return the problem's kernel, None if it has none or the toolbox evaluates in another way."""
    evaluate = untimed(toolbox.evaluate)
    own = evaluate.func == problem.evaluate and not evaluate.args and not evaluate.keywords
    return verb_of(problem.kernel) if own and problem.kernel else None

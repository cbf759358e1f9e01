"""One iteration of MOEA/D-DRA over the chosen subproblems: from mating range to replacement."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from deap.base import Toolbox
from numba import njit
from numba.core.errors import NumbaError
from numba.extending import is_jitted

from ..compiled import call, call_compiled, compilable, compiled, entry, linked, storable, verb_of
from ..quantities import Integer, Real
from .clock import untimed
from .constraints import feasible_objectives
from .decomposition import MatingRange
from .evaluation import WORST, SearchProblem
from .replacement import ReplaceInSweep, ReplaceWorse
from .reproduction import OUTSIDE, WRONG_SIZE, ChildByVerbs, child_maker


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
    children = np.empty((chosen.size, population.designs.shape[1]))
    born = np.empty((chosen.size, population.values.shape[1]))
    sweep = problem.sweep or swept_by(toolbox, problem, population)
    if isinstance(sweep.verbs[UPDATE], ReplaceInSweep):
        sweep.verbs[UPDATE].start()
    given = rng, np.ascontiguousarray(chosen), population, problem.strict, children, born, *sweep.verbs
    if not problem.sweep:
        try:
            problem.sweep = sweep._replace(run=entry(sweep.run, given))
        except NumbaError as error:
            raise ValueError(f"verbs must compile together, got {str(error).splitlines()[0]}") from None
    made, failures = problem.sweep.run(*given)
    if made < 0:
        raise ValueError(_FAULTS[made])
    if sweep.compiled:
        problem.take(children[:made], born[:made], failures)


class Sweep(NamedTuple):
    """The loop of a search's sweeps and its verbs, in the order of `work_on`."""

    run: Callable[..., tuple[int, int]]
    verbs: tuple[Any, ...]
    compiled: bool


UPDATE = 2  # place of the replacement among the verbs of `work_on`


def swept_by(toolbox: Toolbox, problem: SearchProblem, population: Decomposed) -> Sweep:
    """Return what carries out the sweeps of a search."""
    found = [compiled_verb(untimed(getattr(toolbox, name))) for name in VERBS]
    found.append(compiled_evaluation(toolbox, problem))
    if None in found:
        mating_range, reproduce, repair, mutate, update = (getattr(toolbox, name) for name in VERBS)
        make = ChildByVerbs(reproduce, repair, mutate, None)

        def evaluate_one(child: Real, value: Real) -> int:
            value[:] = problem.values(toolbox.evaluate, child[np.newaxis])[0]
            return 0

        return Sweep(work_on, (mating_range, make, update, evaluate_one), False)
    mating_range, reproduce, repair, mutate, update, evaluate = found
    make = child_maker(reproduce, repair, mutate, np.array([problem.lower, problem.upper]))
    if not isinstance(mating_range, MatingRange):
        mating_range = CheckedRange(mating_range)
    if isinstance(update, ReplaceWorse):
        update = ReplaceInSweep.of(update, *population.weights.shape)
    run = _STORED if all(map(storable, found)) else _FRESH
    return Sweep(run, (mating_range, make, update, linked(EvaluateChild(evaluate), vectors=2)), True)


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
"""The verbs inside a sweep, in their order."""


WRONG_VALUES, NOBODY = -1, -2
_FAULTS = {
    WRONG_VALUES: "kernel must return a value for each objective and constraint, got another number",
    NOBODY: "mating_range must return indices of individuals, got others",
    WRONG_SIZE: "reproduce, repair and mutate must return a value for each variable, got another number",
    OUTSIDE: "repair and mutate must return designs within the bounds, got one outside",
}
"""Errors of compiled verbs, by the mark of `work_on`."""


def work_on(
    rng: np.random.Generator,
    chosen: Integer,
    population: Decomposed,
    strict: bool,
    children: Real,
    born: Real,
    mating_range: Any,
    make: Any,
    update: Any,
    evaluate: Any,
) -> tuple[int, int]:
    """Make, evaluate and place one child for each chosen subproblem, in order; return their number and failures.

    Fills `children` (k, e) and their values `born` (k, m + c). If `strict` it ends at the first that cannot be
    evaluated. In place of the number there is a mark of `_FAULTS` for wrong results.
    """
    designs, values, ideal, weights, neighbours = population
    failures = 0
    for k in range(chosen.size):
        i, child, value = chosen[k], children[k], born[k]
        partners = call(mating_range, (rng, i, neighbours))
        if partners.size < 2:
            return NOBODY, failures
        fault = call(make, (rng, designs, i, partners, child))
        if fault < 0:
            return fault, failures
        failed = call(evaluate, (child, value))
        if failed < 0:
            return failed, failures
        failures += failed
        if failures > 0 and strict:
            return k + 1, failures
        call(update, (rng, child, value, partners, designs, values, weights, ideal))
    return chosen.size, failures


_STORED, _FRESH = compiled()(work_on), njit(work_on)


class CheckedRange(NamedTuple):
    """A user's mating range, empty in place of one with indices of nobody."""

    mating_range: Any

    @compilable()
    def __call__(self, rng: np.random.Generator, i: int, neighbours: Integer) -> Integer:
        """Return the partners (k,) of subproblem i."""
        partners: Integer = call(self.mating_range, (rng, i, neighbours))
        for p in partners:
            if not 0 <= p < neighbours.shape[0]:
                return partners[:0]
        return partners


class EvaluateChild(NamedTuple):
    """Evaluation of a child by a kernel, in place."""

    kernel: Any

    @compilable()
    def __call__(self, child: Real, value: Real) -> int:
        """Put the values of a child (d,) into `value` (m + c,), `WORST` if one is not finite; return failures.

        That is 0 or 1, or a mark of `_FAULTS`.
        """
        found = call(self.kernel, (child,))
        if found.size != value.size:
            return WRONG_VALUES
        failures = 0
        for j in range(value.size):
            value[j] = found[j]
            if not abs(found[j]) < WORST:
                failures = 1
        if failures:
            for j in range(value.size):
                value[j] = WORST
        return failures


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

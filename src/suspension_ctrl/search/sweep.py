"""Iterations of MOEA/D-DRA: the choice of subproblems, then from mating range to replacement for each."""

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from deap.base import Toolbox
from numba import njit
from numba.core.errors import NumbaError
from numba.extending import is_jitted

from ..compiled import compilable, compiled, entry
from ..compiled_verbs import Linked, call, call_compiled, linked, verb_of
from ..quantities import Integer, Real
from .clock import untimed
from .decomposition import ByTournament, MatingRange, RangeInSweep, choose
from .evaluation import WORST, SearchProblem
from .prefetch import prefetch
from .replacement import ReplaceInSweep, ReplaceWorse
from .reproduction import OUTSIDE, WRONG_SIZE, ChildByVerbs, ChildInSweep, child_maker
from .stream import put_back, stream_of
from .subproblems import Decomposed, scale_weights


def sweep_sequential(
    rng: np.random.Generator, population: Decomposed, course: Real, toolbox: Toolbox, problem: SearchProblem
) -> Real:
    """Carry out up to as many iterations as `course` (k, m) has rows; return the rows of those that were.

    A row is the ideal point after an iteration. The chosen subproblems are worked on in order, each child after
    the replacements of the one before.

    Runs compiled if every verb is compiled and the problem has a kernel, otherwise in Python with the same draws.
    An iteration whose choice of subproblems is exchanged runs alone, and one in which a design could not be
    evaluated is the last. A kernel is compared with `evaluate` after the first call.
    """
    children = np.empty((population.chosen.size, population.designs.shape[1]))
    born = np.empty((population.chosen.size, population.values.shape[1]))
    sweep = problem.sweep or swept_by(toolbox, problem, population)
    if not sweep.tournament:
        course = course[:1]
        population.begin(rng, toolbox)
    draws = stream_of(rng) if sweep.own and is_jitted(_UNCOUNTED) else rng
    given = draws, population, sweep.tournament, course, problem.strict, children, born, *sweep.verbs
    if not problem.sweep:
        try:
            problem.sweep = sweep._replace(run=entry(sweep.run, given))
        except NumbaError as error:
            raise ValueError(f"verbs must compile together, got {str(error).splitlines()[0]}") from None
    iterations, made, failures = problem.sweep.run(*given)
    put_back(draws, rng)
    if made < 0:
        raise ValueError(_FAULTS[made])
    if sweep.compiled:
        problem.take(children[:made], born[:made], failures)
    return course[:iterations]


class Sweep(NamedTuple):
    """The loop of a search's iterations and its verbs, in the order of `iterate`."""

    run: Callable[..., tuple[int, int, int]]
    tournament: int  # by which the loop chooses subproblems; 0: they are chosen before
    verbs: tuple[Any, ...]
    compiled: bool
    own: bool = False  # verbs of this package alone, which draw from a `Stream`


def swept_by(toolbox: Toolbox, problem: SearchProblem, population: Decomposed) -> Sweep:
    """Return what carries out the iterations of a search."""
    found = [compiled_verb(untimed(getattr(toolbox, name))) for name in VERBS]
    found.append(compiled_evaluation(toolbox, problem))
    if None in found:
        mating_range, reproduce, repair, mutate, update = (getattr(toolbox, name) for name in VERBS)
        make = ChildByVerbs(reproduce, repair, mutate, None)

        def range_of(rng: np.random.Generator, i: int, _near: Any, _everyone: Any, neighbours: Integer) -> Integer:
            return np.asarray(mating_range(rng, i, neighbours))

        def evaluate_one(child: Real, value: Real) -> int:
            value[:] = problem.values(toolbox.evaluate, child[np.newaxis])[0]
            return 0

        return Sweep(iterate, 0, (range_of, make, update, evaluate_one), False)
    mating_range, reproduce, repair, mutate, update, evaluate = found
    make = child_maker(reproduce, repair, mutate, np.array([problem.lower, problem.upper]))
    if isinstance(update, ReplaceWorse):
        everyone, near = population.neighbours.shape
        ordered = isinstance(mating_range, MatingRange) and near < everyone
        update = ReplaceInSweep.of(update, population.everyone, population.known, ordered)
    place = linked(EvaluateChild(evaluate))
    own = tuple(map(type, (mating_range, make, update, place))) == _OWN
    mating_range = RangeInSweep(mating_range.probability) if own else CheckedRange(mating_range)
    choice = compiled_verb(untimed(toolbox.choose_subproblems))
    tournament = choice.tournament if isinstance(choice, ByTournament) else 0
    return Sweep(_UNCOUNTED if own else _COUNTED, tournament, (mating_range, make, update, place), True, own)


def sweep_batch(
    rng: np.random.Generator, population: Decomposed, course: Real, toolbox: Toolbox, problem: SearchProblem
) -> Real:
    """Carry out an iteration with all children made of the population at its start; return its row of `course`."""
    population.begin(rng, toolbox)
    designs, values, ideal, weights = population.designs, population.values, population.ideal, population.weights
    ranges = [toolbox.mating_range(rng, i, population.neighbours) for i in population.chosen]
    children = np.empty((len(ranges), designs.shape[1]))
    for row, (i, partners) in enumerate(zip(population.chosen, ranges, strict=True)):
        child = toolbox.reproduce(rng, designs, i, partners)
        children[row] = toolbox.mutate(rng, toolbox.repair(rng, child, designs[i]))
    born = problem.values(toolbox.evaluate, children)
    for child, value, partners in zip(children, born, ranges, strict=True):
        toolbox.update(rng, child, value, partners, designs, values, weights, ideal)
    course[0] = ideal
    return course[:1]


VERBS = ("mating_range", "reproduce", "repair", "mutate", "update")
"""The verbs inside a sweep, in their order."""


WRONG_VALUES, NOBODY = -1, -2
_FAULTS = {
    WRONG_VALUES: "kernel must return a value for each objective and constraint, got another number",
    NOBODY: "mating_range must return indices of individuals, got others",
    WRONG_SIZE: "reproduce, repair and mutate must return a value for each variable, got another number",
    OUTSIDE: "repair and mutate must return designs within the bounds, got one outside",
}
"""Errors of compiled verbs, by the mark of `iterate`."""


def iterate(
    rng: np.random.Generator,
    population: Decomposed,
    tournament: int,
    course: Real,
    strict: bool,
    children: Real,
    born: Real,
    mating_range: Any,
    make: Any,
    update: Any,
    evaluate: Any,
) -> tuple[int, int, int]:
    """Carry out iterations, as many as `course` (k, m) has rows, and fill these with the ideal points after them.

    In each, make, evaluate and place one child for each chosen subproblem, in order. Returns the number of
    iterations, of children and failures of the last: the first with a failure; if `strict` it ends there. In place
    of the number of children there is a mark of `_FAULTS` for wrong results. Fills `children` (k, e) and their
    values `born` (k, m + c).
    """
    designs, values, ideal, vectors, normalise, neighbours, corners, utility = population[:8]
    weights, known, everyone, unchosen, chosen = population[8:]
    t, failures = 0, 0
    while t < course.shape[0] and failures == 0:
        if tournament > 0:
            if normalise:
                scale_weights(vectors, values, ideal, weights, known)
            choose(rng, utility, corners, tournament, unchosen, chosen)
        for k in range(chosen.size):
            i, child, value = chosen[k], children[k], born[k]
            if k + 1 < chosen.size:
                prefetch(neighbours, chosen[k + 1])
            partners = call(mating_range, (rng, i, neighbours[i], everyone, neighbours))
            fault = NOBODY if partners.size < 2 else call(make, (rng, designs, i, partners, child))
            failed = fault if fault < 0 else call(evaluate, (child, value))
            if failed < 0:
                return t, failed, failures
            failures += failed
            if failures > 0 and strict:
                return t, k + 1, failures
            call(update, (rng, child, value, partners, designs, values, weights, ideal))
        for j in range(course.shape[1]):
            course[t, j] = ideal[j]
        t += 1
    return t, chosen.size, failures


_OWN = MatingRange, ChildInSweep, ReplaceInSweep, Linked
"""Verbs that need no counts of references to arrays."""

_OPTIONS: dict[str, Any] = {"_nrt": False, "error_model": "numpy"}
_UNCOUNTED, _COUNTED = compiled(interleaved=False, **_OPTIONS)(iterate), njit(iterate)


class CheckedRange(NamedTuple):
    """A mating range, empty in place of one with indices of nobody."""

    mating_range: Any

    @compilable()
    def __call__(
        self, rng: np.random.Generator, i: int, _near: Integer, everyone: Integer, neighbours: Integer
    ) -> Integer:
        """Return the partners (k,) of subproblem i."""
        partners: Integer = call(self.mating_range, (rng, i, neighbours))
        if partners.size > everyone.size:
            return partners[:0]
        for p in partners:
            if not 0 <= p < everyone.size:
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

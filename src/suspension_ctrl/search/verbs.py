"""Checks of a toolbox: a verb that returns the wrong count, kind or place is one line that names the verb."""

from collections.abc import Iterator
from copy import copy
from functools import partial
from typing import Any

import numpy as np
from deap.base import Toolbox
from numba.extending import is_jitted

from .. import checks
from ..compiled import call_compiled
from ..quantities import Bool, Integer, Real
from .evaluation import SearchProblem
from .gamultiobj import intermediate_crossover, select_controlled
from .sweep import VERBS, sweep_sequential


def with_checked_verbs(toolbox: Toolbox, default: Toolbox, problem: SearchProblem) -> Toolbox:
    """Return a copy of a toolbox in which each verb that differs from the default one is checked at every call.

    Compiled verbs inside a sweep of MOEA/D-DRA stay as they are: it checks them.
    """
    wanted = set(vars(default))
    if strange := sorted(set(vars(toolbox)) ^ wanted):
        verbs = ", ".join(sorted(wanted - {"clone", "map"}))
        raise ValueError(f"toolbox must have the verbs {verbs}, got {'no ' * (strange[0] in wanted)}{strange[0]}")
    checked = copy(toolbox)
    swept = VERBS if getattr(getattr(default, "sweep", None), "func", None) is sweep_sequential else ()
    for name, own in vars(default).items():
        verb = getattr(toolbox, name)
        if not _same(verb, own) and not (name in swept and is_compiled(verb)):
            setattr(checked, name, partial(_call_checked, name, verb, own, problem))
    return checked


def is_compiled(verb: Any) -> bool:
    """Whether compiled loops can call a verb."""
    return isinstance(verb, partial) and (verb.func is call_compiled or is_jitted(verb.func))


def _same(verb: Any, own: Any) -> bool:
    if not isinstance(verb, partial) or verb.func is not own.func:
        return False
    return verb.func is not call_compiled or type(verb.args[0]) is type(own.args[0])


def _call_checked(
    name: str, verb: Any, own: Any, problem: SearchProblem, /, *arguments: Any, **settings: Any
) -> Any:
    """Call a verb in place of the optimiser's own one and return its result as arrays."""
    found, subject, d = verb(*arguments, **settings), f"{name} must return", len(problem.lower)
    match name:
        case "sample":
            return _designs(subject, found, (arguments[1], d), problem)
        case "mate" if own.func is intermediate_crossover:
            return _designs(subject, found, (len(arguments[1]) // 2, d), problem)
        case "mate" | "mutate":
            return _designs(subject, found, arguments[1].shape, problem)
        case "repair":
            return _designs(subject, found, (d,), problem)
        case "reproduce":
            return _numbers(subject, found, (d,))
        case "update_utility":
            return _numbers(subject, found, arguments[0].shape)
        case "tournament":
            return _indices(subject, found, arguments[3], len(arguments[1]))
        case "choose_subproblems":
            return _indices(subject, found, arguments[3], len(arguments[1]), distinct=True)
        case "mating_range":
            return _indices(subject, found, None, len(arguments[2]))
        case "select":
            return _selection(subject, found, arguments, 3 if own.func is select_controlled else 2)
        case "filter":
            return _mask(subject, found, len(arguments[0]))
        case "points":
            return _points(subject, found, arguments[1], d)
    return found


def _designs(subject: str, found: Any, shape: tuple[int, ...], problem: SearchProblem) -> Real:
    designs = _numbers(subject, found, shape)
    checks.rows_within(f"designs of {subject.split()[0]}", np.atleast_2d(designs), problem.lower, problem.upper)
    return designs


def _numbers(subject: str, found: Any, shape: tuple[int, ...]) -> Real:
    numbers = checks.reals(subject, found)
    if numbers.shape != shape:
        raise ValueError(f"{subject} an array of shape {shape}, got {numbers.shape}")
    if not np.isfinite(numbers).all():
        raise ValueError(f"{subject} finite numbers, got {numbers[~np.isfinite(numbers)][0]}")
    return numbers


def _indices(subject: str, found: Any, size: int | None, below: int, distinct: bool = False) -> Integer:
    indices = np.asarray(found)
    if indices.dtype.kind not in "iu" or indices.ndim != 1 or (size is not None and indices.size != size):
        counted = "indices" if size is None else f"{size} indices"
        got = f"{indices.dtype} of shape {indices.shape}" if indices.dtype.kind != "O" else checks.shown(found)
        raise ValueError(f"{subject} {counted}, got {got}")
    if indices.size and not (indices.min() >= 0 and indices.max() < below):
        raise ValueError(f"{subject} indices from 0 to {below - 1}, got {indices.min()} to {indices.max()}")
    if distinct and np.unique(indices).size < indices.size:
        raise ValueError(f"{subject} different indices, got one twice")
    return indices.astype(np.int64)


def _selection(subject: str, found: Any, arguments: Any, count: int) -> tuple[Any, ...]:
    objectives, size = arguments
    if not isinstance(found, tuple) or len(found) != count:
        raise ValueError(f"{subject} a tuple of {count} arrays, got {checks.shown(type(found).__name__)}")
    index, *others = found
    crowding = [checks.reals(subject, other) for other in others]
    if any(other.shape != (size,) for other in crowding):
        raise ValueError(f"{subject} arrays of shape {(size,)}, got {[other.shape for other in crowding]}")
    return (_indices(subject, index, size, len(objectives), distinct=True), *crowding)


def _mask(subject: str, found: Any, size: int) -> Bool:
    mask = np.asarray(found)
    if mask.dtype != bool or mask.shape != (size,):
        raise ValueError(f"{subject} {size} truth values, got {mask.dtype} of shape {mask.shape}")
    return mask


def _points(subject: str, found: Any, size: int, variables: int) -> Iterator[Real]:
    for points in found:
        numbers = _numbers(subject, points, (size, variables))
        if not (numbers.min() >= 0 and numbers.max() <= 1):
            raise ValueError(f"{subject} numbers from 0 to 1, got {numbers.min()} to {numbers.max()}")
        yield numbers

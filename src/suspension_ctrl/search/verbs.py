"""Checks of the verbs of a user's toolbox: a wrong result is an error of one line that names the verb."""

from collections.abc import Iterator
from copy import copy
from functools import partial
from typing import Any

import numpy as np
from deap.base import Toolbox
from numba.extending import is_jitted

from .. import checks
from ..compiled_verbs import call_compiled
from ..quantities import Bool, Integer, Real
from .evaluation import SearchProblem
from .gamultiobj import intermediate_crossover
from .sweep import VERBS, sweep_sequential


def with_checked_verbs(toolbox: Toolbox, default: Toolbox, problem: SearchProblem) -> Toolbox:
    """Return a copy of a toolbox that checks the results of its verbs; default ones are left out."""
    wanted = set(vars(default))
    if wrong := sorted(set(vars(toolbox)) ^ wanted):
        verbs = checks.listing(sorted(wanted - {"clone", "map"}), wrong[0])
        raise ValueError(f"toolbox must have the verbs {verbs}, got {'no ' * (wrong[0] in wanted)}{wrong[0]}")
    checked = copy(toolbox)
    swept = VERBS if getattr(getattr(default, "sweep", None), "func", None) is sweep_sequential else ()
    for name, own in vars(default).items():
        verb = getattr(toolbox, name)
        if not _same(verb, own) and not (name in swept and is_compiled(verb)):  # a compiled sweep checks its verbs
            setattr(checked, name, partial(_call_checked, name, verb, own, problem))
    return checked


def is_compiled(verb: Any) -> bool:
    """Whether compiled loops can call a verb."""
    return isinstance(verb, partial) and (verb.func is call_compiled or is_jitted(verb.func))


def _same(verb: Any, own: Any) -> bool:
    if not isinstance(verb, partial) or verb.func != own.func:  # bound methods are equal, not the same
        return False
    return verb.func is not call_compiled or type(verb.args[0]) is type(own.args[0])


def _call_checked(
    name: str, verb: Any, own: Any, problem: SearchProblem, /, *arguments: Any, **settings: Any
) -> Any:
    """Call a user's verb in place of the optimiser's `own` and return its checked result as arrays."""
    result, subject, d = verb(*arguments, **settings), f"{name} must return", len(problem.lower)
    match name:
        case "sample":
            return _designs(subject, result, (arguments[1], d), problem)
        case "mate" if own.func is intermediate_crossover:
            return _designs(subject, result, (len(arguments[1]) // 2, d), problem)
        case "mate" | "mutate":
            return _designs(subject, result, arguments[1].shape, problem)
        case "repair":
            return _designs(subject, result, (d,), problem)
        case "reproduce":
            return _numbers(subject, result, (d,))
        case "update_utility":
            return _numbers(subject, result, arguments[0].shape)
        case "tournament":
            return _indices(subject, result, arguments[3], len(arguments[1]))
        case "choose_subproblems":
            return _indices(subject, result, arguments[3], len(arguments[1]), distinct=True)
        case "mating_range":
            return _indices(subject, result, None, len(arguments[2]))
        case "select":
            return _selection(subject, result, arguments)
        case "filter":
            return _mask(subject, result, len(arguments[0]))
        case "points":
            return _points(subject, result, arguments[1], d)
    return result


def _designs(subject: str, result: Any, shape: tuple[int, ...], problem: SearchProblem) -> Real:
    designs = _numbers(subject, result, shape)
    checks.rows_within(f"designs of {subject.split()[0]}", np.atleast_2d(designs), problem.lower, problem.upper)
    return designs


def _numbers(subject: str, result: Any, shape: tuple[int, ...]) -> Real:
    numbers = checks.reals(subject, result)
    if numbers.shape != shape:
        raise ValueError(f"{subject} an array of shape {shape}, got {numbers.shape}")
    if not np.isfinite(numbers).all():
        raise ValueError(f"{subject} finite numbers, got {numbers[~np.isfinite(numbers)][0]}")
    return numbers


def _indices(subject: str, result: Any, size: int | None, below: int, distinct: bool = False) -> Integer:
    indices = np.asarray(result)
    if indices.dtype.kind not in "iu" or indices.ndim != 1 or (size is not None and indices.size != size):
        counted = "indices" if size is None else f"{size} indices"
        got = f"{indices.dtype} of shape {indices.shape}" if indices.dtype.kind != "O" else checks.shown(result)
        raise ValueError(f"{subject} {counted}, got {got}")
    if indices.size and not (indices.min() >= 0 and indices.max() < below):
        raise ValueError(f"{subject} indices from 0 to {below - 1}, got {indices.min()} to {indices.max()}")
    if distinct and np.unique(indices).size < indices.size:
        raise ValueError(f"{subject} different indices, got one twice")
    return indices.astype(np.int64)


def _selection(subject: str, result: Any, arguments: Any) -> tuple[Any, ...]:
    objectives, size = arguments
    if not isinstance(result, tuple) or len(result) != 3:
        raise ValueError(f"{subject} a tuple of 3 arrays, got {checks.shown(type(result).__name__)}")
    index, *others = result
    ordered = [checks.reals(subject, other) for other in others]  # fronts and crowding distances
    if any(other.shape != (size,) for other in ordered):
        raise ValueError(f"{subject} arrays of shape {(size,)}, got {[other.shape for other in ordered]}")
    return (_indices(subject, index, size, len(objectives), distinct=True), *ordered)


def _mask(subject: str, result: Any, size: int) -> Bool:
    mask = np.asarray(result)
    if mask.dtype != bool or mask.shape != (size,):
        raise ValueError(f"{subject} {size} truth values, got {mask.dtype} of shape {mask.shape}")
    return mask


def _points(subject: str, result: Any, size: int, variables: int) -> Iterator[Real]:
    for points in result:
        numbers = _numbers(subject, points, (size, variables))
        if not (numbers.min() >= 0 and numbers.max() <= 1):
            raise ValueError(f"{subject} numbers from 0 to 1, got {numbers.min()} to {numbers.max()}")
        yield numbers

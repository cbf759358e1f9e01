"""Operators and selections of DEAP on arrays.

An operator is one of DEAP if its first parameter is ``individual`` or ``ind1``, as throughout ``deap.tools``. DEAP
draws from Python's ``random``: the generator of the search seeds it for each call, and its state is restored after
the call. Every pair of parents mates; results are clipped to the bounds.
"""

import inspect
import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from copy import copy
from functools import partial
from types import SimpleNamespace
from typing import Any, Literal

import moocore
import numpy as np
from deap import base
from numpy.typing import NDArray

from ..quantities import Integer, Real


def with_deap_operators(toolbox: base.Toolbox, lower: Real, upper: Real) -> base.Toolbox:
    """Return a copy of a toolbox in which operators of DEAP work on arrays within bounds (e,)."""
    adapted = copy(toolbox)
    for name, adapter in (("mate", mate_by_deap), ("mutate", mutate_by_deap)):
        verb = getattr(adapted, name, None)
        if isinstance(verb, partial) and _is_deaps(verb.func):
            adapted.register(name, adapter, operator=verb, lower=lower, upper=upper)
    return adapted


def _is_deaps(function: Callable[..., Any]) -> bool:
    code = getattr(inspect.unwrap(function), "__code__", None)  # a signature takes ten times as long
    return code is not None and code.co_varnames[:1] in (("individual",), ("ind1",))


def mutate_by_deap(
    rng: np.random.Generator, designs: Real, operator: Callable[..., Any], lower: Real, upper: Real
) -> Real:
    """Return mutants of designs (n, d), or of one design (d,)."""
    with _drawing_from(rng):
        mutants = [operator(row)[0] for row in np.atleast_2d(designs).tolist()]
    return np.clip(np.reshape(mutants, designs.shape), lower, upper)


def mate_by_deap(
    rng: np.random.Generator, parents: Real, operator: Callable[..., Any], lower: Real, upper: Real
) -> Real:
    """Return children (n, d) of consecutive parents (n, d); the last of an odd number is copied."""
    rows = parents.tolist()
    with _drawing_from(rng):
        for pair in range(0, len(rows) - 1, 2):
            rows[pair : pair + 2] = operator(*rows[pair : pair + 2])
    return np.clip(np.array(rows), lower, upper)


@contextmanager
def _drawing_from(rng: np.random.Generator) -> Iterator[None]:
    before = random.getstate()
    random.seed(int(rng.integers(2**63)))
    try:
        yield
    finally:
        random.setstate(before)


def select_with_deap(
    objectives: Real, size: int, nd: Literal["standard", "log"] = "standard"
) -> tuple[Integer, NDArray[np.int32], Real]:
    """Return the result of `select_survivors` by ``deap.tools.selNSGA2``; `nd` is its sorting method."""
    from deap import tools  # a tenth of the package's import time, and few need it

    individuals = as_individuals(objectives)
    survivors = sorted(tools.selNSGA2(individuals, size, nd=nd), key=lambda i: i.index)
    index = np.array([i.index for i in survivors], dtype=np.int64)
    rank = moocore.pareto_rank(objectives).astype(np.int32)  # DEAP does not tell
    return index, rank[index], np.array([i.fitness.crowding_dist for i in survivors])


def as_individuals(objectives: Real) -> list[Any]:
    """Return the rows of objectives (n, m), to be minimised, as individuals of DEAP with an `index`."""
    # A local class: creator.create would make a global one.
    fitness = type("Minimised", (base.Fitness,), {"weights": (-1.0,) * objectives.shape[1]})
    return [SimpleNamespace(index=i, fitness=fitness(row)) for i, row in enumerate(objectives.tolist())]

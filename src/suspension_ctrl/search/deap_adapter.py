"""The one place where arrays become DEAP individuals and back.

A verb ``mate`` or ``mutate`` is an operator of DEAP if its function's first parameter is called ``individual`` or
``ind1``, as throughout ``deap.tools``; operators of this package begin with ``rng``. DEAP's operators draw from
Python's ``random``: it is seeded from the search's generator for the duration of a call, then restored. Every pair
of parents mates; results are clipped to the bounds.
"""

import inspect
import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from copy import copy
from functools import partial
from typing import Any, Literal

import numpy as np
from deap import base
from numpy.typing import NDArray

from ..quantities import Real
from .problem import Minimisable


def with_deap_operators(toolbox: base.Toolbox, problem: Minimisable) -> base.Toolbox:
    """Return a copy of a toolbox in which operators of DEAP take arrays."""
    adapted = copy(toolbox)
    lower, upper = np.asarray(problem.lower, dtype=float), np.asarray(problem.upper, dtype=float)
    for name, adapter in (("mate", mate_by_deap), ("mutate", mutate_by_deap)):
        verb = getattr(adapted, name, None)
        if isinstance(verb, partial) and _is_deaps(verb.func):
            adapted.register(name, adapter, operator=verb, lower=lower, upper=upper)
    return adapted


def _is_deaps(function: Callable[..., Any]) -> bool:
    first = next(iter(inspect.signature(function).parameters), "")
    return first in ("individual", "ind1")


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
    """Return children (n, d) of consecutive pairs of parents (n, d); a last one without a mate is copied."""
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
) -> tuple[NDArray[np.int64], Real]:
    """Keep `size` individuals by ``deap.tools.selNSGA2``; arguments and result as in `select_survivors`.

    `nd` is DEAP's non-dominated sorting: "standard", of order m n^2, or "log".
    """
    from deap import tools  # a tenth of the package's import time, and few need it

    individuals = as_individuals(objectives)
    survivors = sorted(tools.selNSGA2(individuals, size, nd=nd), key=lambda i: i.index)
    index = np.array([i.index for i in survivors], dtype=np.int64)
    return index, np.array([i.fitness.crowding_dist for i in survivors])


class Individual:
    """A row of a population: its number, and the fitness by which DEAP's selections judge it."""

    def __init__(self, index: int, fitness: base.Fitness) -> None:
        self.index = index
        self.fitness = fitness


def as_individuals(objectives: Real) -> list[Individual]:
    """Return a DEAP individual for each row of `objectives` (n, m), all of them minimised."""
    # A plain class in place of creator.create, which would make a global one.
    fitness = type("Minimised", (base.Fitness,), {"weights": (-1.0,) * objectives.shape[1]})
    return [Individual(i, fitness(row)) for i, row in enumerate(objectives.tolist())]

"""The one place where arrays become DEAP individuals and back."""

from typing import Literal

import numpy as np
from deap import base
from numpy.typing import NDArray


def select_with_deap(
    objectives: NDArray[np.float64], size: int, nd: Literal["standard", "log"] = "standard"
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
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


def as_individuals(objectives: NDArray[np.float64]) -> list[Individual]:
    """Return a DEAP individual for each row of `objectives` (n, m), all of them minimised."""
    # A plain class in place of creator.create, which would make a global one.
    fitness = type("Minimised", (base.Fitness,), {"weights": (-1.0,) * objectives.shape[1]})
    return [Individual(i, fitness(row)) for i, row in enumerate(objectives.tolist())]

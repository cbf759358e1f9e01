"""NSGA-II and MOEA/D of other libraries, each set up to do the same work as ours.

A module has the dictionaries ``NSGA2`` and ``MOEAD``: by name of a contender, a function from a `Task` to a `Job`.
Importing it imports the library, so a peer that is not installed is one whose module cannot be imported.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from suspension_ctrl.search.decomposition import weight_vectors
from suspension_ctrl.search.problem import Minimisable

PEERS = {
    "deap": "plain_deap",
    "genoxide": "with_genoxide",
    "jmetalpy": "with_jmetal",
    "puggles": "with_puggles",
    "pygmo": "with_pygmo",
    "pymoo": "with_pymoo",
    "vamos-optimization": "with_vamos",
}
"""Module of this package by distribution."""

OURS = "suspension_ctrl"


@dataclass(frozen=True)
class Task:
    """What every library is asked to do: a population evaluated at the start and once per generation.

    Operators are simulated binary crossover (probability 0.9, eta 20) and polynomial mutation (probability 1/d
    per variable, eta 20); in MOEA/D differential evolution (F = 0.5, every variable) where the library has it.
    """

    problem: Minimisable
    population: int
    generations: int
    seed: int

    crossover_probability = 0.9
    eta = 20.0
    scale_factor = 0.5
    neighbour_probability = 0.9

    @property
    def evaluations(self) -> int:
        """Designs evaluated in all."""
        return self.population * (self.generations + 1)

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Lower and upper bound of each variable."""
        return [(float(a), float(b)) for a, b in zip(self.problem.lower, self.problem.upper, strict=True)]

    @property
    def objectives(self) -> int:
        """Number of objectives m, the first columns of what the problem returns; limits follow."""
        return len(self.problem.objectives)

    def violation(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the sum of violated limits (n,) from values (n, m + c)."""
        return np.maximum(values[:, self.objectives :], 0.0).sum(axis=1)

    @property
    def mutation_probability(self) -> float:
        """Probability that a variable mutates."""
        return 1 / len(self.bounds)

    @property
    def neighbours(self) -> int:
        """Size of a MOEA/D neighbourhood, a tenth of the population but 20 at least."""
        return min(self.population, max(20, self.population // 10))

    @property
    def replacements(self) -> int:
        """Most subproblems that a child may replace, a hundredth of the population but 2 at least."""
        return max(2, self.population // 100)

    @property
    def weights(self) -> NDArray[np.float64]:
        """Weight vectors of MOEA/D, (N, m)."""
        return np.array(weight_vectors(self.population, self.objectives))


def weights_in_file(task: Task) -> TemporaryDirectory[str]:
    """Return a folder, there as long as the object is, with the weights in a file as jMetal names it."""
    folder = TemporaryDirectory()
    name = f"W{task.objectives}D_{task.population}.dat"
    np.savetxt(Path(folder.name) / name, task.weights)
    return folder


class Job(NamedTuple):
    """A search that is set up: `run` is what gets timed, `objectives` reads the final ones from its result.

    Of a problem with limits they are those of all final designs, also of designs beyond a limit.

    `evaluations` tells how many designs a run evaluated where that cannot be counted from outside.
    """

    run: Callable[[], Any]
    objectives: Callable[[Any], NDArray[np.float64]]
    evaluations: Callable[[Any], int] | None = None


Prepare = Callable[[Task], Job]


class Contenders(NamedTuple):
    """Who takes part: searches by name, the versions of their libraries, and who is absent for what reason."""

    nsga2: dict[str, Prepare]
    moead: dict[str, Prepare]
    versions: dict[str, str]
    absent: dict[str, str]


def contenders() -> Contenders:
    """Return ours and those of every peer that can be imported."""
    os.environ["RAYON_NUM_THREADS"] = "1"  # the threads of the libraries in Rust, read when they first start some
    found = Contenders({}, {}, {}, {})
    for distribution, module in {OURS: "ours", **PEERS}.items():
        try:
            peer = import_module(f"{__name__}.{module}")
            found.versions[distribution] = version(distribution)
        except Exception as error:  # whatever a foreign library raises, the others are still to be measured
            found.absent[distribution] = f"{type(error).__name__}: {error}".splitlines()[0]
            continue
        found.nsga2.update(peer.NSGA2)
        found.moead.update(peer.MOEAD)
    return found

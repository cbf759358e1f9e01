"""Quality of a set of objectives against a reference front, by moocore, in objectives scaled to that front."""

from dataclasses import dataclass

import moocore
import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks
from .problems import Minimisable


def non_dominated(objectives: ArrayLike) -> NDArray[np.bool_]:
    """Return which of the objectives (n, m), all to be minimised, no other one dominates; shape (n,)."""
    return moocore.is_nondominated(objectives, keep_weakly=True)


@dataclass(frozen=True)
class ReferenceFront:
    """A front to measure others by; its ideal point becomes 0 and its nadir 1 in every objective.

    Parameters
    ----------
    objectives : (n, m) ndarray
        Mutually non-dominated objectives.
    """

    objectives: NDArray[np.float64]

    HYPERVOLUME_REFERENCE = 1.1
    """Corner of the hypervolume in every scaled objective: a tenth beyond the nadir, so that ends count."""

    @classmethod
    def on_grid(cls, problem: Minimisable, points: int) -> "ReferenceFront":
        """Return the non-dominated designs of a regular grid with `points` values in each variable."""
        checks.at_least("points", points, 2)
        axes = [np.linspace(a, b, points) for a, b in zip(problem.lower, problem.upper, strict=True)]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
        objectives = problem.evaluate(grid)
        return cls(objectives[non_dominated(objectives)])

    def scaled(self, objectives: ArrayLike) -> NDArray[np.float64]:
        """Return objectives (n, m) with this front's ideal point at 0 and its nadir at 1."""
        ideal, nadir = self.objectives.min(axis=0), self.objectives.max(axis=0)
        return (np.asarray(objectives, dtype=float) - ideal) / (nadir - ideal)

    def hypervolume(self, objectives: ArrayLike) -> float:
        """Return the volume that objectives (n, m) dominate below 1.1 in scaled objectives [-]."""
        return float(moocore.hypervolume(self.scaled(objectives), ref=self.HYPERVOLUME_REFERENCE))

    def igd_plus(self, objectives: ArrayLike) -> float:
        """Return the modified inverted generational distance IGD+ of objectives (n, m) in scaled ones [-]."""
        return float(moocore.igd_plus(self.scaled(objectives), ref=self.scaled(self.objectives)))

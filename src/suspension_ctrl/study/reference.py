"""The reference front of a problem: a grid refined until its hypervolume converges."""

import hashlib
from collections.abc import Sequence
from math import prod
from typing import Any, NamedTuple, Self

import numpy as np
import pandas as pd

from .. import checks
from ..quantities import Real
from ..search.constraints import feasible_objectives
from ..search.indicators import ReferenceFront, best_of
from ..search.kinds import Coding
from ..search.problem import Minimisable
from .store import StoredRun

TOLERANCE = 1e-4
FIRST, MOST = 100, 20_000_000
"""Points per variable of the coarsest grid, and most designs of the finest."""
_CHUNK = 500_000  # designs in one evaluation


class Refined(NamedTuple):
    """A reference front with the grid and the convergence of its hypervolume."""

    front: ReferenceFront
    points: int  # per variable
    change: float  # of the hypervolume to that of half as many points, relative
    second: float  # to that of a second grid with 1/sqrt(2) as many points: only corners coincide

    @classmethod
    def of(cls, run: StoredRun) -> Self:
        """Return the front from the tables of `stored`."""
        numbers = run.course.iloc[0]
        ideal, nadir = run.course[["ideal", "nadir"]].to_numpy().T
        front = ReferenceFront(run.final.to_numpy(), ideal, nadir, numbers.volume)
        return cls(front, int(numbers.points), numbers.change, numbers.second)

    def stored(self) -> StoredRun:
        """Return the tables of the front: corners and numbers, a row per objective; and its points."""
        front, points, change, second = self
        corners = pd.DataFrame({"ideal": front.ideal, "nadir": front.nadir})
        numbers = {"volume": front.volume, "points": points, "change": change, "second": second}
        return StoredRun(corners.assign(**numbers), pd.DataFrame(front.objectives))

    def describe(self, problem: Minimisable) -> str:
        """Return the grid and its convergence in words."""
        points = " x ".join(str(axis.size) for axis in Coding(problem).grid_axes(self.points))
        return (
            f"the non-dominated designs of a {points} grid (hypervolume {self.front.volume:.4f}, which half as "
            f"many values change by {self.change:.1e} and a second grid by {self.second:.1e})"
        )


def refined(problem: Minimisable, tolerance: float = TOLERANCE, most: int = MOST) -> Refined:
    """Return the front of a grid of at most `most` designs, refined until its hypervolume converges."""
    checks.positive("tolerance", tolerance)
    points, before, coding = FIRST, None, Coding(problem)
    while points <= most >= prod(axis.size for axis in coding.grid_axes(points)):
        objectives = grid_front(problem, points)
        if len(objectives) and np.ptp(objectives, axis=0).all():  # indicators divide by the ranges
            front = ReferenceFront.of(objectives)
            change = np.inf if before is None else 1 - front.relative_hypervolume(before)
            if abs(change) <= tolerance:
                second = 1 - front.relative_hypervolume(grid_front(problem, round(points / np.sqrt(2))))
                if abs(second) <= tolerance:
                    return Refined(front, points, change, second)
            before = objectives
        points *= 2
    none = " (no front of feasible designs found)" if problem.constraints and before is None else ""
    raise ValueError(
        f"problem must have a front that a grid of {most} designs settles to {tolerance:g}, got one of "
        f"{coding.lower.size} variables that does not{none}; give a reference front"
    )


def grid_front(problem: Minimisable, points: int) -> Real:
    """Return the non-dominated feasible objectives (n, m) on a grid of `points` values per variable at most."""
    checks.at_least("points", points, 2)
    coding = Coding(problem)
    axes = coding.grid_axes(points)
    shape = [axis.size for axis in axes]
    m, total = len(problem.objectives), prod(shape)
    front = np.empty((0, m))
    for start in range(0, total, _CHUNK):
        places = np.unravel_index(np.arange(start, min(start + _CHUNK, total)), shape)
        codes = np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=-1)
        values = problem.evaluate(coding.decode(codes))
        front = best_of(np.concatenate([front, best_of(feasible_objectives(values, m))]))
    return front


def best_known(sets: Sequence[Real]) -> ReferenceFront:
    """Return the front of the union of sets of feasible objectives (n, m)."""
    best = best_of(np.concatenate(sets))
    if len(best) == 0:
        raise ValueError("constraints must leave a feasible design, got none in any run")
    if not np.ptp(best, axis=0).all():
        got = f"{len(best)} that do not"
        raise ValueError(f"the best designs of all runs must differ in every objective, got {got}")
    return ReferenceFront.of(best)


def summary(front: ReferenceFront) -> dict[str, Any]:
    """Return size, corners, volume and digest of a front, which identify it in a plan."""
    digest = _digest(front.objectives.tobytes() + np.float64(front.volume).tobytes())
    corners = {"ideal": front.ideal.tolist(), "nadir": front.nadir.tolist()}
    return {"points": len(front.objectives), **corners, "volume": front.volume, "digest": digest}


def fingerprint(problem: Minimisable) -> str:
    """Return a digest of the values of 64 designs; a change of a parameter or of the code changes it."""
    rng, coding = np.random.default_rng(0), Coding(problem)
    codes = coding.lower + (coding.upper - coding.lower) * rng.random((64, coding.lower.size))
    return _digest(problem.evaluate(coding.decode(codes)).tobytes())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]

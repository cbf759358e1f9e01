"""The reference front of a problem: that of a grid whose hypervolume settles, or of all runs."""

import hashlib
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from itertools import pairwise
from math import inf, isnan, nan, prod
from time import perf_counter
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
SECONDS = 60.0
"""Longest time for the grids of a problem [s]."""
FOLDER, NAME = "reference", "front"
"""Folder of the reference front in the folder of a comparison, and its name there."""
_PROBE, _CHUNK = 10_000, 500_000  # designs in the first two evaluations of a grid, and in the others


class Refined(NamedTuple):
    """The finest grid of a problem with the convergence of its hypervolume."""

    objectives: Real  # (n, m) non-dominated and feasible
    volume: float  # its hypervolume, scaled
    points: int  # per variable
    change: float = nan  # of the hypervolume to that of half as many points, relative; NaN of the coarsest grid
    second: float = nan  # to that of a second grid with 1/sqrt(2) as many points: only corners coincide

    def settles(self, tolerance: float) -> bool:
        """Whether both changes are within the tolerance."""
        return abs(self.change) <= tolerance and abs(self.second) <= tolerance

    def describe(self, problem: Minimisable) -> str:
        """Return the numbers of values of the variables, ``"grid of 400 x 400 values"``."""
        return f"grid of {' x '.join(str(axis.size) for axis in Coding(problem).grid_axes(self.points))} values"


class Reference(NamedTuple):
    """A reference front and its origin in words."""

    front: ReferenceFront
    origin: str

    @classmethod
    def of(cls, run: StoredRun) -> Self:
        """Return the reference from the tables of `stored`."""
        ideal, nadir = run.course[["ideal", "nadir"]].to_numpy().T
        volume, origin = float(run.course.volume.iloc[0]), str(run.course.origin.iloc[0])
        return cls(ReferenceFront(run.final.to_numpy(), ideal, nadir, volume), origin)

    def stored(self) -> StoredRun:
        """Return the tables of the front: corners, volume and origin, a row per objective; and its points."""
        corners = pd.DataFrame({"ideal": self.front.ideal, "nadir": self.front.nadir})
        course = corners.assign(volume=self.front.volume, origin=self.origin)
        return StoredRun(course, pd.DataFrame(self.front.objectives))


def sought(
    problem: Minimisable,
    runs: Sequence[Real],
    tolerance: float = TOLERANCE,
    most: int = MOST,
    seconds: float = SECONDS,
    known: Callable[[], Real] | None = None,
    keep: Callable[[Reference], None] | None = None,
) -> Reference | None:
    """Return the front of a grid that settles, or else that of runs (n, m), the finest grid and what is known.

    `known` returns feasible objectives (k, m) that are found in another way, such as an exact front; it is called
    if no grid settles; `keep` is called with the front of one that does, which depends on no run. None without two
    feasible designs that differ in every objective.
    """
    grid = refined(problem, tolerance, most, seconds)
    if grid and grid.settles(tolerance):
        front = ReferenceFront.of(grid.objectives, grid.volume)
        changes = f"half as many values change by {grid.change:.1e} and a second grid by {grid.second:.1e}"
        origin = f"a {grid.describe(problem)} (hypervolume {front.volume:.4f}, which {changes})"
        found = Reference(front, origin)
        if keep:
            keep(found)
        return found
    none = np.empty((0, len(problem.objectives)))
    also = none if known is None else known()
    best = best_of(np.concatenate([none, *runs, grid.objectives if grid else none, also]))
    if not spans(best):
        return None
    budget = f"within {most:,} designs and {seconds:g} s"
    sources = [
        "all timed runs",
        *[f"{len(also):,} designs of an exact front and between its points"] * bool(len(also)),
    ]
    if grid is None:
        return Reference(ReferenceFront.of(best), f"{' and '.join(sources)} (no grid {budget} has a front)")
    change = "" if isnan(grid.change) else f": half as many values change its hypervolume by {grid.change:.1e}"
    sources.append(f"a {grid.describe(problem)}")
    origin = f"{' and '.join(sources)} (no grid {budget} settles to {tolerance:g}{change})"
    return Reference(ReferenceFront.of(best), origin)


def refined(
    problem: Minimisable, tolerance: float = TOLERANCE, most: int = MOST, seconds: float = SECONDS
) -> Refined | None:
    """Return the finest grid in `most` designs and `seconds`, refined until it settles; None without a front."""
    checks.positive("tolerance", tolerance)
    points, found, end, coding = FIRST, None, perf_counter() + seconds, Coding(problem)
    with suppress(TimeoutError):
        while points <= most >= prod(axis.size for axis in coding.grid_axes(points)):
            objectives = grid_front(problem, points, end)
            if spans(objectives):
                # without a sample for distances, which takes longer than the grid
                front = ReferenceFront(objectives, objectives.min(axis=0), objectives.max(axis=0), 0.0)
                volume = front.hypervolume(objectives)
                change = nan if found is None else 1 - front.hypervolume(found.objectives) / volume
                found = Refined(objectives, volume, points, change)
                if abs(change) <= tolerance:
                    second = grid_front(problem, round(points / np.sqrt(2)), end)
                    found = found._replace(second=1 - front.hypervolume(second) / volume)
                    if found.settles(tolerance):
                        break
            points *= 2
    return found


def spans(front: Real) -> bool:
    """Whether a front (n, m) has points that differ in every objective: indicators divide by its ranges."""
    return len(front) > 0 and bool(np.ptp(front, axis=0).all())


def grid_front(problem: Minimisable, points: int, end: float = inf) -> Real:
    """Return the non-dominated feasible objectives (n, m) on a grid of `points` values per variable at most.

    TimeoutError as soon as it is clear that it would take until after `end`, a time of `perf_counter` [s].
    """
    checks.at_least("points", points, 2)
    coding = Coding(problem)
    axes = coding.grid_axes(points)
    shape = [axis.size for axis in axes]
    m, total = len(problem.objectives), prod(shape)
    fronts, begun = list[Real](), perf_counter()
    for start, stop in _parts(total):
        if start <= _PROBE:
            begun = perf_counter()  # again after the first evaluation, which may compile
        elif perf_counter() + (perf_counter() - begun) * (total - start) / (start - _PROBE) > end:
            raise TimeoutError
        places = np.unravel_index(np.arange(start, stop), shape)
        codes = np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=-1)
        values = problem.evaluate(coding.decode(codes))
        fronts.append(best_of(feasible_objectives(values, m)))
    return best_of(np.concatenate(fronts))


def _parts(total: int) -> Iterator[tuple[int, int]]:
    """Yield start and stop of each evaluation of a grid: two small ones, by which its time is estimated."""
    starts = [0, _PROBE, *range(2 * _PROBE, total, _CHUNK)]
    return pairwise([*(start for start in starts if start < total), total])


def best_known(sets: Sequence[Real]) -> ReferenceFront:
    """Return the front of the union of sets of feasible objectives (n, m)."""
    best = best_of(np.concatenate(sets))
    if len(best) == 0:
        raise ValueError("constraints must leave a feasible design, got none in any run")
    if not spans(best):
        got = f"{len(best)} that do not"
        raise ValueError(f"the best designs of all runs must differ in every objective, got {got}")
    return ReferenceFront.of(best)


def summary(front: ReferenceFront) -> dict[str, Any]:
    """Return size, corners, volume and digest of the points of a front, which identify it in a plan."""
    digest = _digest(front.objectives.tobytes())
    corners = {"ideal": front.ideal.tolist(), "nadir": front.nadir.tolist()}
    return {"points": len(front.objectives), **corners, "volume": front.volume, "digest": digest}


def fingerprint(problem: Minimisable) -> str:
    """Return a digest of the values of 64 designs; a change of a parameter or of the code changes it."""
    rng, coding = np.random.default_rng(0), Coding(problem)
    codes = coding.lower + (coding.upper - coding.lower) * rng.random((64, coding.lower.size))
    return _digest(problem.evaluate(coding.decode(codes)).tobytes())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]

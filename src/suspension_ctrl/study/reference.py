"""The reference front of a problem: a grid refined until its hypervolume converges, kept beside the results."""

import hashlib
import json
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple
from zipfile import BadZipFile

import numpy as np

from .. import checks, tables
from ..quantities import Real
from ..search.constraints import feasible_objectives
from ..search.indicators import ReferenceFront, best_of
from ..search.problem import Minimisable
from .machine import provenance

TOLERANCE = 1e-4
FIRST, MOST = 100, 20_000_000
"""Values per variable of the coarsest grid, and designs of the finest."""

_CHUNK = 500_000  # designs at a time


class Refined(NamedTuple):
    """A reference front and the grid it was made from."""

    front: ReferenceFront
    points: int  # per variable
    change: float  # of the hypervolume from half as many points, relative
    second: float  # the same from a second grid, of sqrt(2) fewer points: it shares the corners alone

    def describe(self, variables: int) -> str:
        """Return the grid and its convergence in words."""
        points = " x ".join([str(self.points)] * variables)
        return (
            f"the non-dominated designs of a {points} grid (hypervolume {self.front.volume:.4f}, which half as "
            f"many values change by {self.change:.1e} and a second grid by {self.second:.1e})"
        )


def refined(problem: Minimisable, tolerance: float = TOLERANCE, most: int = MOST) -> Refined:
    """Return the front of a grid that neither half as many points nor a second grid changes.

    ValueError if that takes more than `most` designs: it is for problems of few variables.
    """
    checks.positive("tolerance", tolerance)
    variables = len(problem.lower)
    points, before = FIRST, None
    while points**variables <= most:
        objectives = grid_front(problem, points)
        if len(objectives) and np.ptp(objectives, axis=0).all():  # otherwise there is nothing to scale by
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
        f"{variables} variables that does not{none}; give a reference front"
    )


def grid_front(problem: Minimisable, points: int) -> Real:
    """Return the non-dominated objectives (n, m) of feasible designs on a grid of `points` values per variable."""
    checks.at_least("points", points, 2)
    axes = [np.linspace(a, b, points) for a, b in zip(problem.lower, problem.upper, strict=True)]
    m = len(problem.objectives)
    front = np.empty((0, m))
    total = points ** len(axes)
    for start in range(0, total, _CHUNK):
        places = np.unravel_index(np.arange(start, min(start + _CHUNK, total)), [points] * len(axes))
        designs = np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=-1)
        merged = np.concatenate([front, best_of(feasible_objectives(problem.evaluate(designs), m))])
        front = best_of(merged)
    return front


def best_known(found: Sequence[Real]) -> ReferenceFront:
    """Return the front of the best of several sets of feasible objectives (n, m)."""
    merged = np.concatenate(found)
    if len(merged) == 0:
        raise ValueError("constraints must leave a feasible design, got none in any run")
    best = best_of(merged)
    if not np.ptp(best, axis=0).all():
        raise ValueError(
            f"the best designs of all runs must differ in every objective, got {len(best)} that do not"
        )
    return ReferenceFront.of(best)


def digest(front: ReferenceFront) -> str:
    """Return a digest of a front."""
    return hashlib.sha256(front.objectives.tobytes() + np.float64(front.volume).tobytes()).hexdigest()[:32]


def kept(path: Path, problem: Minimisable, tolerance: float = TOLERANCE) -> Refined:
    """Return `refined` from a file, which is written first if it is absent, spoilt or of another `key`."""
    wanted = key(problem, tolerance)
    with suppress(OSError, ValueError, KeyError, EOFError, BadZipFile):
        return _read(path, wanted)
    found = refined(problem, tolerance)
    content = {"key": wanted, **vars(found.front), **found._asdict()}
    del content["front"]
    tables.write_whole(path, lambda temporary: np.savez(temporary, **content))
    return found


def _read(path: Path, wanted: str) -> Refined:
    with path.open("rb") as file, np.load(file) as there:
        if there["key"] != wanted:
            raise ValueError("key must be that of the problem, got another")
        arrays = {name: there[name] for name in ("objectives", "ideal", "nadir")}
        front = ReferenceFront(**arrays, volume=float(there["volume"]))
        return Refined(front, int(there["points"]), float(there["change"]), float(there["second"]))


def key(problem: Minimisable, tolerance: float) -> str:
    """Return a digest of all that the front depends on: versions, bounds, tolerance, values of some designs.

    These stand for the whole function: any parameter or line of code that changes them makes another key.
    """
    rng = np.random.default_rng(0)
    lower, upper = (np.asarray(bound, dtype=float) for bound in (problem.lower, problem.upper))
    probes = problem.evaluate(lower + (upper - lower) * rng.random((64, lower.size)))
    settings = {
        "versions": provenance(),
        "outputs": [list(problem.objectives), list(problem.constraints)],
        "bounds": [lower.tolist(), upper.tolist()],
        "grid": [tolerance, FIRST, MOST],
        "front": [ReferenceFront.SAMPLE, ReferenceFront.HYPERVOLUME_REFERENCE],
    }
    return hashlib.sha256(json.dumps(settings, sort_keys=True).encode() + probes.tobytes()).hexdigest()[:32]

"""The reference front of a problem: a grid refined until its hypervolume converges, kept in a file."""

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
from ..search.kinds import box, coded, decoded
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
    second: float  # from a second grid, of sqrt(2) fewer points: only corners are common to both

    def describe(self, variables: int) -> str:
        """Return the grid and its convergence in words."""
        points = " x ".join([str(self.points)] * variables)
        return (
            f"the non-dominated designs of a {points} grid (hypervolume {self.front.volume:.4f}, which half as "
            f"many values change by {self.change:.1e} and a second grid by {self.second:.1e})"
        )


def refined(problem: Minimisable, tolerance: float = TOLERANCE, most: int = MOST) -> Refined:
    """Return the converged front of a grid of at most `most` designs, for problems of few variables.

    Half as many points and a second grid change its hypervolume by up to `tolerance`.
    """
    checks.positive("tolerance", tolerance)
    variables = len(box(problem)[0])
    points, before = FIRST, None
    while points**variables <= most:
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
        f"{variables} variables that does not{none}; give a reference front"
    )


def grid_front(problem: Minimisable, points: int) -> Real:
    """Return the non-dominated objectives (n, m) of feasible designs on a grid of `points` values per variable."""
    checks.at_least("points", points, 2)
    searched = coded(problem)
    axes = [np.linspace(a, b, points) for a, b in zip(*box(searched), strict=True)]
    m, total = len(problem.objectives), points ** len(axes)
    front = np.empty((0, m))
    for start in range(0, total, _CHUNK):
        places = np.unravel_index(np.arange(start, min(start + _CHUNK, total)), [points] * len(axes))
        designs = np.stack([axis[place] for axis, place in zip(axes, places, strict=True)], axis=-1)
        front = best_of(
            np.concatenate([front, best_of(feasible_objectives(problem.evaluate(decoded(searched, designs)), m))])
        )
    return front


def best_known(found: Sequence[Real]) -> ReferenceFront:
    """Return the front of the best of several sets of feasible objectives (n, m)."""
    best = best_of(np.concatenate(found))
    if len(best) == 0:
        raise ValueError("constraints must leave a feasible design, got none in any run")
    if not np.ptp(best, axis=0).all():
        got = f"{len(best)} that do not"
        raise ValueError(f"the best designs of all runs must differ in every objective, got {got}")
    return ReferenceFront.of(best)


def digest(front: ReferenceFront) -> str:
    """Return a digest of a front."""
    return _digest(front.objectives.tobytes() + np.float64(front.volume).tobytes())


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:32]


def kept(path: Path, problem: Minimisable, tolerance: float = TOLERANCE) -> Refined:
    """Return `refined` from a file, written anew if it is absent, spoilt or of another `key`."""
    wanted = key(problem, tolerance)
    with suppress(OSError, ValueError, KeyError, EOFError, BadZipFile):
        return _read(path, wanted)
    found = refined(problem, tolerance)
    numbers = dict(zip(found._fields[1:], found[1:], strict=True))
    content = {"key": wanted, **vars(found.front), **numbers}
    tables.write_whole(path, lambda temporary: np.savez(temporary, **content))
    return found


def _read(path: Path, wanted: str) -> Refined:
    with path.open("rb") as file, np.load(file) as there:
        if there["key"] != wanted:
            raise ValueError("key must be that of the problem, got another")
        arrays = {name: there[name] for name in ("objectives", "ideal", "nadir")}
        front = ReferenceFront(**arrays, volume=there["volume"].item())
        return Refined(front, *(there[name].item() for name in Refined._fields[1:]))


def key(problem: Minimisable, tolerance: float) -> str:
    """Return a digest of all that the front depends on: versions, bounds, kinds, tolerance, values of 64 designs.

    The values identify the function: a parameter or a line of code that changes them changes the key.
    """
    rng = np.random.default_rng(0)
    searched = coded(problem)
    lower, upper = box(searched)
    probes = problem.evaluate(decoded(searched, lower + (upper - lower) * rng.random((64, lower.size))))
    settings = {
        "versions": provenance(),
        "outputs": [list(problem.objectives), list(problem.constraints)],
        "kinds": sorted(getattr(problem, "kinds", {}).items()),
        "bounds": [lower.tolist(), upper.tolist()],
        "grid": [tolerance, FIRST, MOST],
        "front": [ReferenceFront.SAMPLE, ReferenceFront.HYPERVOLUME_REFERENCE],
    }
    return _digest(json.dumps(settings, sort_keys=True).encode() + probes.tobytes())

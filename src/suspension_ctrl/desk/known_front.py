"""What is known of a front for comparisons: its exact points, and designs between neighbours of them."""

from collections.abc import Callable
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np

from ..quantities import Integer, Real
from ..response.problem import RideProblem
from ..search.constraints import feasible_objectives
from ..search.indicators import best_of
from .continuation import continued
from .proofs import can_be_refined
from .smooth import atoms_of

POINTS, LEAST, SECONDS = 100, 5.0, 60.0
"""Most points of a front, and the least and about the longest time for them [s]."""
_PARTS = {2: 64, 3: 12}  # of a line between two neighbours, of the sides of a triangle of three


def can_be_continued(problem: RideProblem) -> bool:
    """Whether `pareto_front` takes the problem, and its measures are smooth."""
    real = all(kind in ("log", "fixed") for kind in problem.kinds.values())
    return real and len(problem.measures) <= 3 and can_be_refined(problem)


def finder(problem: RideProblem, seconds: float) -> Callable[[], Real] | None:
    """Return the function that finds a front in about as long as runs took [s]; None in too short a time."""
    if seconds < LEAST or not can_be_continued(problem):
        return None
    return partial(known_front, problem, seconds=min(seconds, SECONDS))


def known_front(problem: RideProblem, points: int = POINTS, seconds: float = SECONDS) -> Real:
    """Return non-dominated feasible objectives (n, m): those of `pareto_front` and of designs between its points.

    A front of N points alone is short of the hypervolume by the stairs between them, about 1/N. Designs on the
    line between neighbours are designs of the problem, worse than the front by about 1/N^2.
    """
    m = len(problem.objectives)
    try:
        found = continued(problem, points, seconds)
    except ValueError:  # no design found within the limits
        return np.empty((0, m))
    designs, objectives = (np.array([getattr(one, name) for one in found]) for name in ("design", "objectives"))
    between = designs_between(problem, designs, objectives)
    return best_of(np.vstack([objectives, feasible_objectives(problem.evaluate(between), m)]))


def designs_between(problem: RideProblem, designs: Real, objectives: Real) -> Real:
    """Return designs (k, d) between neighbours of designs (n, d) on a front of objectives (n, m)."""
    box, m = atoms_of(problem).box, objectives.shape[1]
    cells = _cells(objectives)
    if not len(cells):
        return designs
    shares = _shares(m, _PARTS[m])
    points = np.einsum("ks,csd->ckd", shares, box.points(designs)[cells])
    return box.designs(points.reshape(-1, designs.shape[1]))


def _cells(objectives: Real) -> Integer:
    """Return the lines (c, 2) between neighbours of two objectives, or triangles (c, 3) of three, by row."""
    from scipy.spatial import Delaunay, QhullError

    rows, m = np.arange(len(objectives)), objectives.shape[1]
    if m == 2:
        order = objectives[:, 0].argsort()
        return np.stack([order[:-1], order[1:]], axis=1)
    span = np.ptp(objectives, axis=0)
    plane = (objectives / np.where(span > 0, span, 1.0)) @ np.array([[1.0, 1.0], [-1.0, 1.0], [0.0, -2.0]])
    try:
        return np.asarray(Delaunay(plane).simplices)
    except (QhullError, ValueError):  # too few points, or all on a line
        return np.array(list(combinations(rows[:3], 3)), dtype=int)


def _shares(corners: int, parts: int) -> Real:
    """Return shares (k, corners) of the corners of a line or a triangle at the nodes of a lattice."""
    grid: Any = np.indices((parts + 1,) * (corners - 1)).reshape(corners - 1, -1)
    inside = grid[:, grid.sum(axis=0) <= parts] / parts
    return np.vstack([inside, 1 - inside.sum(axis=0)]).T

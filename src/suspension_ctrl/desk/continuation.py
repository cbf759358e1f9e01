"""The Pareto front of a ride problem point by point, each an exact optimum, continued from its neighbours."""

from collections import deque
from math import inf
from time import perf_counter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.problem import RideProblem
from ..search.constraints import violations
from ..search.indicators import evenly_spread, non_dominated
from ..search.problem import headers_of
from ..search.sampling import sobol_points
from .descent import End, descended
from .optimality import EXACT
from .programs import Program, Row, Writer
from .refinement import check_limits, program_of
from .smooth import atoms_of

if TYPE_CHECKING:
    import pandas as pd

_SAMPLE = 1024  # designs among which starts are chosen
_STARTS = 3  # of the sample, for the least of each objective
_MOST = 4  # descents, over the points asked for
_SHARE = 1e-4  # of the scaled objectives beside the shift along a ray
_ON_RAY = 1e-6  # largest distance of a point from its ray, in scaled objectives
_APART = 1e-6  # least distance of two points, in scaled objectives
_AREA = 0.5  # of the front in the plane of equal sums, about
_LATTICE = np.array([[1.0, -1.0, 0.0], [1.0, 0.0, -1.0]]) / np.sqrt(2.0)  # of triangles, in that plane
_AROUND = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, -1), (-1, 1)]


class Point(NamedTuple):
    """An exact point of a front."""

    design: Real  # (d,)
    objectives: Real  # (m,)
    residual: float


class Continuation:
    """The points known of a front: a sample of designs, the least of each objective, and what rays have met.

    Objectives are scaled by the least points, from 0 at the least of each to 1 at the largest.
    """

    def __init__(self, problem: RideProblem, seconds: float = inf) -> None:
        self._end = perf_counter() + seconds
        self.problem, self.atoms, self.m = problem, atoms_of(problem), len(problem.objectives)
        sample = next(sobol_points(np.random.default_rng(0), _SAMPLE, len(problem.variables)))
        designs = self.atoms.box.designs(sample)
        values = problem.evaluate(designs)
        violation = violations(values, self.m)
        self.points = [
            self._least(j, designs[np.lexsort((values[:, j], violation))[:_STARTS]]) for j in range(self.m)
        ]
        ends = np.array([point.objectives for point in self.points])
        self.low, span = ends.min(axis=0), np.ptp(ends, axis=0)
        self.span = np.where(span > 0, span, 1.0)
        feasible = violation == 0
        self._designs = np.vstack([[point.design for point in self.points], designs[feasible]])
        self.ends = self.scaled(ends)
        self._scaled = self.scaled(np.vstack([ends, values[feasible, : self.m]]))

    def scaled(self, objectives: Real) -> Real:
        """Return objectives (..., m) from 0 to 1 between the least points."""
        return np.asarray((objectives - self.low) / self.span)

    def meets(self, reference: Real) -> bool:
        """Keep the point of the front on the ray from a point (m,), or nearest to it; whether the ray meets it.

        The ray goes in equal scaled objectives: the largest excess over the reference is least [1]_. A small share
        of all objectives beside it leaves no objective that could still fall.
        """
        if perf_counter() > self._end:
            return False
        start = self._designs[(self._scaled - reference).max(axis=1).argmin()]
        end = descended(self._program(reference, start))
        if not end.feasible or end.conditions.residual > EXACT:
            return False
        point = self._point(end)
        scaled = self.scaled(point.objectives)
        self.points.append(point)
        self._designs, self._scaled = np.vstack([self._designs, point.design]), np.vstack([self._scaled, scaled])
        return bool(np.ptp(scaled - reference) <= _ON_RAY)

    def front(self) -> list[Point]:
        """Return the exact points that none dominates, of those that are the same the first."""
        exact = [point for point in self.points if point.residual <= EXACT]
        scaled = self.scaled(np.array([point.objectives for point in exact]).reshape(-1, self.m))
        _, first = np.unique(np.round(scaled / _APART), axis=0, return_index=True)
        first = np.sort(first)
        return [exact[row] for row in first[non_dominated(scaled[first])]]

    def places(self) -> Real:
        """Return the scaled objectives (k, m) of the best designs known."""
        return self._scaled[non_dominated(self._scaled)]

    def _program(self, reference: Real, start: Real) -> Program:
        writer = Writer(self.atoms)
        rows = [writer.objective(j) for j in range(self.m)]
        own = [writer.slack(1.0) for _ in rows]
        shift = writer.slack(1.0)
        for row, slack, low, span in zip(rows, own, self.low, self.span, strict=True):
            writer.rows.append(row.times(1 / span).plus(-float(low / span), {slack: -1.0}))
        writer.rows += [
            Row({slack: 1.0, shift: -1.0}, -at) for slack, at in zip(own, reference.tolist(), strict=True)
        ]
        return Program(writer, Row({shift: 1.0, **dict.fromkeys(own, _SHARE)}, size=1.0), start)

    def _least(self, j: int, starts: Real) -> Point:
        """Return the least of an objective that descents from starts (k, d) reach."""
        ends = [descended(program_of(self.problem, start, self.problem.objectives[j], {})) for start in starts]
        held = [end for end in ends if end.feasible]
        check_limits(held or ends)
        return self._point(min(held, key=lambda end: end.value))

    def _point(self, end: End) -> Point:
        objectives = self.problem.evaluate(end.design[np.newaxis])[0, : self.m]
        return Point(end.design, objectives, end.conditions.residual)


def pareto_front(problem: RideProblem, points: int = 50) -> "pd.DataFrame":
    """Return the exact Pareto front of two or three measures as evenly spread points.

    The least of each measure first; then, from points evenly spread in the line (two measures) or in the plane
    through the ends in scaled measures (three), the nearest design along the normal [1]_ [2]_, each from what is
    known around it. Every point is an optimum by `refine`'s residual, below 1e-8; dominated ones are left out.

    Parameters
    ----------
    problem : RideProblem
        Two or three measures; limits and bounds are its own. Variables are real or logarithmic.
    points : int
        Largest number of points, at least 2 and the number of measures; fewer where the front has gaps.

    Returns
    -------
    DataFrame
        As ``run.front()``, by rising first measure, and ``residual``: the largest of stationarity, feasibility and
        complementarity [-], see `refine`.

    Raises
    ------
    ValueError
        If the problem has more measures, whole numbers or a catalogue, or no design within its limits.

    References
    ----------
    .. [1] I. Das, J. E. Dennis, "Normal-boundary intersection: a new method for generating the Pareto surface in
       nonlinear multicriteria optimization problems", SIAM Journal on Optimization 8, 1998.
    .. [2] A. Pascoletti, P. Serafini, "Scalarizing vector optimization problems", Journal of Optimization Theory
       and Applications 42, 1984.

    Examples
    --------
    Discomfort against travel of the paper's car, in nine points:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(
    ...     file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, measures=["ACC", "SWS"]
    ... )
    >>> front = sc.pareto_front(problem, points=9)
    >>> len(front), bool((front["residual"] < 1e-8).all())
    (9, True)
    """
    import pandas as pd

    found = continued(problem, points)
    designs, objectives = (np.array([getattr(one, name) for one in found]) for name in ("design", "objectives"))
    table = pd.DataFrame(np.hstack([designs, objectives]), columns=list(headers_of(problem)))
    table["residual"] = [one.residual for one in found]
    return table


def continued(problem: RideProblem, points: int, seconds: float = inf) -> list[Point]:
    """Return at most `points` points of the front that are found in some time [s], by rising first objective."""
    checks.of_kind("problem", problem, RideProblem)
    m = len(problem.objectives)
    if m > 3:
        raise ValueError(f"problem must have two or three objectives, got {m}")
    for name, kind in problem.kinds.items():
        if kind not in ("log", "fixed"):
            raise ValueError(f"kinds must be log or fixed for a front, got {checks.shown(kind)} of {name}")
    checks.at_least("points", points, m)
    front = Continuation(problem, seconds)
    if m == 2:
        for share in np.linspace(0, 1, points)[1:-1]:
            front.meets((1 - share) * front.ends[0] + share * front.ends[1])
    else:
        _fill(front, points)
    found = front.front()
    objectives = np.array([point.objectives for point in found])
    chosen = [found[row] for row in evenly_spread(objectives, points)]
    return sorted(chosen, key=lambda point: tuple(point.objectives.tolist()))


def _fill(front: Continuation, points: int) -> None:
    """Cast rays from the nodes of a lattice in the plane of equal sums, finer until there are enough points."""
    spacing, left = np.sqrt(_AREA / points), _MOST * points
    while left > 0 and len(front.front()) < points:
        seen = {
            tuple(node)
            for node in np.rint(front.places() @ np.linalg.pinv(spacing * _LATTICE)).astype(int).tolist()
        }
        nodes = deque(seen)
        while nodes and left > 0:
            i, j = nodes.popleft()
            left -= 1
            if front.meets(np.array([i, j]) @ (spacing * _LATTICE)):
                new = [(i + a, j + b) for a, b in _AROUND if (i + a, j + b) not in seen]
                seen.update(new)
                nodes.extend(new)
        spacing /= np.sqrt(2)

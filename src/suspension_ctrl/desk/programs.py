"""Nonlinear programs of a ride problem: an objective within limits, the worst wheel by slack variables.

The maximum over wheels is not differentiable: it is replaced by a slack variable bounded below by each wheel
(epigraph form). Every row is a function of the values v of `Atoms` and of the slack variables.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from ..quantities import Integer, Real
from ..response.measures.limits import Limit
from .smooth import Atoms


class Mean(NamedTuple):
    """The mean of values over load cases, ``scale (sum w v^p)^(1/p)``."""

    weights: Mapping[int, float]
    power: float
    scale: float = 1.0

    def __call__(self, v: Real) -> tuple[float, Real]:
        """Return the mean and its slopes by the values (k,) that it has weights for."""
        weights, own = np.array(list(self.weights.values())), v[list(self.weights)]
        total = float(weights @ own**self.power)
        root = total ** (1 / self.power)
        slopes = weights * own ** (self.power - 1) * (root / total if total else 0.0)
        return self.scale * root, self.scale * slopes


class Named(NamedTuple):
    """A limit by its name, with its unit and the derivative of its row by the limit."""

    name: str
    unit: str
    by_limit: float


@dataclass(frozen=True)
class Row:
    """A function of values and slack variables: a linear part, a constant and a mean."""

    linear: Mapping[int, float] = field(default_factory=dict)
    offset: float = 0.0
    mean: Mean | None = None
    equal: bool = False  # 0, not at most 0
    limit: Named | None = None  # the limit that it holds
    size: float = 0.0  # that it is divided by, 0 of a row that needs none of its own

    @property
    def places(self) -> set[int]:
        """Places of the values that the row depends on."""
        return {*self.linear, *(self.mean.weights if self.mean else ())}

    def times(self, factor: float) -> "Row":
        """Return the row times a factor."""
        mean = self.mean and self.mean._replace(scale=factor * self.mean.scale)
        linear = {place: factor * one for place, one in self.linear.items()}
        return replace(self, linear=linear, offset=factor * self.offset, mean=mean)

    def plus(self, offset: float, linear: Mapping[int, float] | None = None) -> "Row":
        """Return the row with a constant and linear terms added."""
        return replace(self, linear={**self.linear, **(linear or {})}, offset=self.offset + offset)


class Writer:
    """Rows of a program: the limits of the problem, and wheels below their slack variables as they are needed."""

    def __init__(self, atoms: Atoms) -> None:
        self.atoms, self.sizes = atoms, list[float]()  # of slack variables
        self.rows = [row for limit in atoms.problem.constraints for row in self._of_limit(limit)]

    def slack(self, size: float = 0.0) -> int:
        """Return the place of a further slack variable, of a size or of that of its value at the start."""
        self.sizes.append(size)
        return self.atoms.count + len(self.sizes) - 1

    def objective(self, number: int) -> Row:
        """Return an objective of the problem; of several wheels with a slack variable for the worst of them."""
        problem, measure = self.atoms.problem, self.atoms.problem.measures[number]
        cases = self.atoms.of(measure)
        if measure.maximise and any(len(wheels) > 1 for wheels in cases):
            raise ValueError(f"measures must be of one wheel where more is better, got {measure}")
        if problem.worst_case or len(cases) == 1:
            places = dict.fromkeys(place for wheels in cases for place in wheels)
            return Row(self._worst(list(places), measure.sign))
        shares = np.array([case.share for case in problem.cases])
        judged = problem.scoring.in_cases(measure)[0]
        weights = dict[int, float]()
        for wheels, share in zip(cases, (shares / shares.sum()).tolist(), strict=True):
            (place,) = self._worst(wheels, 1.0)
            weights[place] = weights.get(place, 0.0) + share
        return Row(mean=Mean(weights, judged.power if judged.values else 2.0, measure.sign))

    def _worst(self, places: Sequence[int], sign: float) -> dict[int, float]:
        """Return the linear part that is the largest of some values times a sign."""
        if len(places) == 1:
            return {places[0]: sign}
        slack = self.slack()
        self.rows += [Row({place: sign, slack: -1.0}) for place in places]
        return {slack: 1.0}

    def _of_limit(self, limit: Limit) -> list[Row]:
        """Return the rows of a limit, one for each wheel in each load case."""
        named = Named(str(limit), limit.measure.unit, by_limit=-limit.scale)
        places = dict.fromkeys(place for wheels in self.atoms.of(limit.measure) for place in wheels)
        return [Row({place: limit.scale}, limit.offset, limit=named) for place in places]


class Values(NamedTuple):
    """Rows of a program at a point, over their sizes: the objective first."""

    rows: Real  # (r,)
    slopes: Real  # (r, n)


class Program:
    """The least of an objective with all other rows at most 0, or 0 if `equal`.

    Variables z (n,) are the free variables of a design, from 0 to 1 in the box, and slack variables over their
    sizes. Rows are over theirs: that of the objective is its value.
    """

    def __init__(self, writer: Writer, objective: Row, start: Real) -> None:
        self.atoms, self._own, self.slacks = writer.atoms, writer.sizes, len(writer.sizes)
        self.rows = [objective, *writer.rows]
        self.equal = np.array([row.equal for row in self.rows])
        self.free: Integer = np.flatnonzero(self.atoms.box.free)
        self._base = self.atoms.box.points(start[np.newaxis])[0]
        self._linear = np.zeros((len(self.rows), self.atoms.count + self.slacks))
        for number, row in enumerate(self.rows):
            self._linear[number, list(row.linear)] = list(row.linear.values())
        self._offset = np.array([row.offset for row in self.rows])
        self._stretch, self.sizes = np.ones(self.slacks), np.ones(len(self.rows))
        self.start = self._begun()
        self._known: tuple[bytes, Values] | None = None

    @property
    def lower(self) -> Real:
        """Lower bounds of the variables (n,), -inf of slack variables."""
        return np.append(np.zeros(self.free.size), np.full(self.slacks, -np.inf))

    @property
    def upper(self) -> Real:
        """Upper bounds of the variables (n,), inf of slack variables."""
        return np.append(np.ones(self.free.size), np.full(self.slacks, np.inf))

    def resize(self, z: Real) -> None:
        """Take the objective at a point (n,) for its size."""
        if not self.rows[0].size:
            self.sizes[0] *= abs(float(self.at(z).rows[0])) or 1.0
            self._known = None

    def design(self, z: Real) -> Real:
        """Return the design (d,) at a point (n,)."""
        return self.atoms.box.designs(self._points(z[np.newaxis]))[0]

    def at(self, z: Real) -> Values:
        """Return the rows and their slopes at a point (n,), those of the last point as they are."""
        key = z.tobytes()
        if self._known is None or self._known[0] != key:
            self._known = key, self.many(z[np.newaxis])[0]
        return self._known[1]

    def many(self, z: Real) -> list[Values]:
        """Return the rows and their slopes at points (k, n), in one evaluation."""
        points = self._points(z)
        values, slopes = self.atoms.with_slopes(points)
        slacks = z[:, self.free.size :] * self._stretch
        both = zip(values, slacks, slopes[:, :, self.free], strict=True)
        return [self._rows(np.append(v, t), dv) for v, t, dv in both]

    def _rows(self, v: Real, slopes: Real) -> Values:
        """Return rows and slopes by values and slack variables (a + s,) and slopes (a, f) of the values."""
        rows, by_value = self._linear @ v + self._offset, self._linear.copy()
        for number, row in enumerate(self.rows):
            if row.mean:
                mean, own = row.mean(v)
                rows[number] += mean
                by_value[number, list(row.mean.weights)] += own
        by_slack = by_value[:, self.atoms.count :] * self._stretch
        whole = np.hstack([by_value[:, : self.atoms.count] @ slopes, by_slack])
        return Values(rows / self.sizes, whole / self.sizes[:, np.newaxis])

    def _points(self, z: Real) -> Real:
        """Return the points (k, d) of variables (k, n)."""
        points = np.tile(self._base, (len(z), 1))
        points[:, self.free] = z[:, : self.free.size]
        return points

    def _begun(self) -> Real:
        """Return the variables (n,) at the start, with the least slack variables that hold; set all sizes."""
        v = np.append(self.atoms.values(self._base[np.newaxis])[0], np.zeros(self.slacks))
        for slack in range(self.atoms.count, v.size):
            below = np.flatnonzero(self._linear[:, slack] < 0).tolist()
            v[slack] = max(self._value(row, v) / -self._linear[row, slack] for row in below)
            self._stretch[slack - self.atoms.count] = self._own[slack - self.atoms.count] or abs(v[slack]) or 1.0
            self.sizes[below] = -self._linear[below, slack] * self._stretch[slack - self.atoms.count]
        self.sizes[0] = abs(self._value(0, v)) or 1.0
        for number, row in enumerate(self.rows):
            self.sizes[number] = row.size or self.sizes[number]
        return np.append(self._base[self.free], v[self.atoms.count :] / self._stretch)

    def _value(self, number: int, v: Real) -> float:
        """Return a row at values and slack variables (a + s,), over no size."""
        mean = self.rows[number].mean
        return float(self._linear[number] @ v + self._offset[number]) + (mean(v)[0] if mean else 0.0)

"""A ride problem as smooth values: each measure of a single wheel in a single load case, with exact slopes.

Points are designs in the unit box: variables from 0 to 1 between their bounds, logarithmic ones by logarithms.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from .. import checks
from ..quantities import Bool, Real
from ..response.load_case import LoadCase
from ..response.measures.measure import Measure
from ..response.measures.robust import Robust
from ..response.measures.vibration import WheelMeasure
from ..response.problem import RideProblem


class Box(NamedTuple):
    """The box of the variables; those that are no real numbers keep their values."""

    lower: Real  # (d,) bounds, of logarithmic variables their logarithms
    width: Real
    log: Bool
    free: Bool

    @classmethod
    def of(cls, problem: RideProblem) -> "Box":
        """Return the box of a problem; ValueError if no variable is free."""
        kinds = [problem.kinds.get(name, "") for name in problem.variables]
        log = np.array([kind == "log" for kind in kinds])
        lower, upper = np.array(problem.lower), np.array(problem.upper)
        for ends in (lower, upper):
            ends[log] = np.log(ends[log])
        free = (lower < upper) & np.array([kind in ("", "log") for kind in kinds])
        if not free.any():
            raise ValueError(
                f"kinds must leave a real variable to refine, got {checks.shown(dict(problem.kinds))}"
            )
        return cls(lower, upper - lower, log, free)

    def designs(self, points: Real) -> Real:
        """Return the designs (n, d) at points (n, d)."""
        codes = self.lower + np.clip(points, 0.0, 1.0) * self.width
        return np.where(self.log, np.exp(np.where(self.log, codes, 0.0)), codes)

    def points(self, designs: Real) -> Real:
        """Return the points (n, d) of designs (n, d)."""
        codes = np.where(self.log, np.log(np.where(self.log, designs, 1.0)), designs)
        return np.clip((codes - self.lower) / np.where(self.width > 0, self.width, 1.0), 0.0, 1.0)

    def stretch(self, designs: Real) -> Real:
        """Return the slope (n, d) of each variable by its point."""
        return self.width * np.where(self.log, designs, 1.0)


class Atoms:
    """Values and slopes of every measure and limit of a problem, by single wheels and load cases."""

    def __init__(self, problem: RideProblem) -> None:
        self.problem, self.box = problem, Box.of(problem)
        judged = [*problem.measures, *(limit.measure for limit in problem.constraints)]
        if len(problem.cases) > 1 and (robust := [one.label for one in judged if isinstance(one, Robust)]):
            raise ValueError(f"measures must be of nominal vehicles in several load cases, got {robust[0]}")
        singles = [one for each in judged for one in by_wheel(problem, each)]
        every, cases = list(dict.fromkeys(singles)), problem.cases
        self._cases, self._place, self.count = list[RideProblem](), dict[tuple[int, Measure], int](), 0
        for c, case in enumerate(cases):
            own = [one for one in every if one.of_ride or _first_alike(cases, c) == c]
            own = own if len(own) > 1 else every  # a problem has two measures at least
            self._place |= {(c, one): self.count + n for n, one in enumerate(own)}
            self.count += len(own)
            named = [replace(one, name=f"measure {n}") for n, one in enumerate(own)]
            changes = {"measures": named, "constraints": (), "kinds": {}, "nodes": int(problem.nodes)}
            self._cases.append(problem.replace(cases=[case], **changes))

    def of(self, measure: Measure) -> list[list[int]]:
        """Return the places of a measure among the values, a list of wheels for each load case.

        Load cases in which the measure is the same, of statics with the same vehicle, have the same places.
        """
        cases, wheels = self.problem.cases, by_wheel(self.problem, measure)
        first = [c if measure.of_ride else _first_alike(cases, c) for c in range(len(cases))]
        return [[self._place[c, one] for one in wheels] for c in first]

    def values(self, points: Real) -> Real:
        """Return the values (n, a) at points (n, d)."""
        designs = self.box.designs(points)
        return np.hstack([case.evaluate(designs) for case in self._cases])

    def with_slopes(self, points: Real) -> tuple[Real, Real]:
        """Return the values (n, a) and their slopes (n, a, d) over points (n, d)."""
        designs = self.box.designs(points)
        found = [case.with_jacobian(designs) for case in self._cases]
        slopes = np.concatenate([slopes for _, slopes in found], axis=1)
        stretched = np.asarray(slopes * self.box.stretch(designs)[:, np.newaxis])
        return np.hstack([values for values, _ in found]), stretched


@lru_cache(maxsize=8)
def atoms_of(problem: RideProblem) -> Atoms:
    """Return the values of a problem; those of the last problems are kept."""
    return Atoms(problem)


def by_wheel(problem: RideProblem, measure: Measure) -> Sequence[Measure]:
    """Return a measure of the worst wheel as measures of single wheels, less of each of which is better."""
    plain = replace(measure, maximise=False) if measure.maximise else measure
    if not isinstance(plain, WheelMeasure):
        return [plain]
    vehicle = problem.cases[0].vehicle
    wheels = [str(vehicle.meanings[name].where) for name in plain.responses(vehicle)]
    return [replace(plain, where=wheel, name="") for wheel in wheels] if len(wheels) > 1 else [plain]


def _first_alike(cases: Sequence[LoadCase], number: int) -> int:
    """Return the number of the first load case with the same vehicle in a curve."""
    own = cases[number]
    alike: Iterable[int] = (
        c for c, case in enumerate(cases) if (case.vehicle, case.roll_geometry) == (own.vehicle, own.roll_geometry)
    )
    return next(iter(alike))

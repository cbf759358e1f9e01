"""What a ride problem is judged by: ports of what varies, scores of measures and limits, enough nodes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from .. import checks
from ..compiled import uncollected
from ..documents import keyed
from ..quantities import Real
from ..vehicles.varied import Varied, ported, setting_of
from ..vehicles.vehicle import Struts, coefficients_by_name
from .load_case import LoadCase
from .mean_squares import Nodes
from .measures.limits import Limit
from .measures.measure import Measure, MeasureLike, measure_of
from .measures.robust import Robust
from .measures.terms import CaseMeasure
from .placed_nodes import placed
from .robust_scores import RobustScores, ScatteredScores, Statistics
from .scatter import Scatter
from .scattered import Scattered
from .scores import NODES, RESOLVED, Score, Scores
from .weightings import Weighting

_CORNERS = 64  # most corners of the box at which nodes are checked, drawn at random from more


@dataclass(frozen=True, eq=False)
class Scoring:
    """Scores of the measures and limits of a problem, for which names stand as in `RideProblem`."""

    cases: tuple[LoadCase, ...]
    bounds: Mapping[str, tuple[float, float]]
    struts: Struts
    weighting: Weighting | None
    band: tuple[float, float]
    measures: tuple[Measure, ...]
    constraints: tuple[Limit, ...]
    worst_case: bool
    scatter: Scatter | None

    @cached_property
    def scores(self) -> Scores:
        """Scores of the nominal vehicle; ValueError about measures and names of limits."""
        names, texts = [one.label for one in self.measures], list(map(str, self.constraints))
        if len(set(names)) < max(2, len(names)):
            got = checks.shown(tuple(map(str, self.measures)))
            raise ValueError(f"measures must be 2 or more with different names, got {got}")
        for given, what in ((names, "measures"), (texts, "constraints")):
            if len({*given, *self.bounds}) < len(given) + len(self.bounds):
                raise ValueError(f"{what} must have names of their own, got {checks.shown(given)}")
        if not any(one.nominal.of_ride for one in map(_measure, self.judged)):
            raise ValueError(f"measures must hold one of the ride, got {checks.shown(names)}")
        return self.scores_of([self._score(one, self.ported) for one in self.judged])

    @cached_property
    def robust(self) -> RobustScores | None:
        """Scores over the scatter; None without robust measures."""
        limited = map(_measure, self.judged)
        robust = {column: one for column, one in enumerate(limited) if isinstance(one, Robust)}
        if not robust:
            if self.scatter:
                self.scattered([], self.scatter)  # which raises ValueError about its names
            return None
        if self.scatter is None:
            raise ValueError(f"scatter must be given for {next(iter(robust.values())).label}, got none")
        scattered = self.scattered([self.judged[column] for column in robust], self.scatter)
        scores = [self.scores.scores[column] for column in robust]
        samples, signs = self.scatter.samples, scattered.signs
        weight = [one.weights(samples, sign) for one, sign in zip(robust.values(), signs, strict=True)]
        scale, offset = (np.array([getattr(one, name) for one in scores]) for name in ("scale", "offset"))
        return RobustScores(scattered, Statistics(np.array([*robust]), np.array(weight), signs, scale, offset))

    @property
    def judged(self) -> tuple[Measure | Limit, ...]:
        """Objectives, then limits."""
        return (*self.measures, *self.constraints)

    @cached_property
    def middle(self) -> dict[str, float]:
        """The middle of the box by name."""
        return {name: (low + high) / 2 for name, (low, high) in self.bounds.items()}

    @cached_property
    def fixed(self) -> dict[str, float]:
        """Coefficients that do not vary, by whole names."""
        return coefficients_by_name(self.struts, {})

    @cached_property
    def ported(self) -> tuple[LoadCase, ...]:
        """Load cases with ports on their vehicles for parameters that vary."""
        first = self.cases[0].vehicle
        vehicles = [ported(case.vehicle, tuple(self.bounds), self.fixed, first) for case in self.cases]
        if isinstance(vehicles[0], Varied) and vehicles[0].has_frequencies:
            for corner in self.corners:
                vehicles[0].with_design(corner)  # which raises ValueError where a frequency is out of reach
        return tuple(replace(case, vehicle=one) for case, one in zip(self.cases, vehicles, strict=True))

    def scores_of(self, scores: Sequence[Score]) -> Scores:
        """Return scores of designs in the load cases; ValueError where a coefficient has no value."""
        with keyed("", {"setting": "bounds and struts"}):
            settings = [setting_of(case.vehicle, self.middle, self.struts) for case in self.ported]
        return Scores(self.ported, scores, settings, tuple(self.bounds), self.band)

    def scattered(self, judged: Sequence[Measure | Limit], scatter: Scatter) -> ScatteredScores:
        """Return measures and limits of the samples of designs, as of the nominal vehicle of each."""
        scattered = Scattered.of(scatter, self.cases, tuple(self.bounds), self.fixed)
        scores = [self._score(one, scattered.cases) for one in judged]
        return ScatteredScores(scattered, scores, np.array([*self.middle.values()]), self.band)

    def in_cases(self, judged: Measure | Limit) -> tuple[CaseMeasure, ...]:
        """Return a measure or a limit in each load case."""
        return tuple(judged.nominal.in_case(case, self.weighting) for case in self.ported)

    def resolving(self, nodes: int | None) -> int:
        """Return the nodes, found if not given; ValueError where they do not resolve every resonance."""
        if nodes is not None:
            nodes = checks.at_least("nodes", nodes, 2)
        with uncollected():  # the first that is compiled in a process, or loaded: numba sets itself up
            for taken in (nodes,) if nodes else NODES:
                error = self._error(taken)
                if error < RESOLVED:
                    return taken
        several = any(case.wheels > 1 for case in self.cases) and not self.band[0]
        hint = "; under several wheels a band may have to begin above 0 Hz" if several else ""
        got = f"{taken}, which is off by {error:.1g} at its corners{hint}"
        raise ValueError(f"nodes must resolve every resonance in the box to {RESOLVED:g}, got {got}")

    def placed(self, nodes: int, accuracy: float) -> Nodes:
        """Return the nodes that are placed for this accuracy in the box, `nodes` where they are not fewer."""
        return placed(self.scores, nodes, self.corners, accuracy) or nodes

    def _score(self, one: Measure | Limit, cases: Sequence[LoadCase]) -> Score:
        """Return the score of a measure or a limit in load cases."""
        found = tuple(one.nominal.in_case(case, self.weighting) for case in cases)
        if isinstance(one, Limit):
            return Score(found, True, one.scale, one.offset)
        return Score(found, self.worst_case, one.sign)

    def _error(self, nodes: int) -> float:
        """Return the largest error of a term at corners of the box: there resonances are sharpest."""
        errors = self.scores.errors(self.corners, nodes)
        if self.robust:
            lower, upper = np.array([*self.bounds.values()]).T
            errors = [*errors, *self.robust.scattered.errors(self.corners, lower, upper, nodes)]
        return max(float(one.max(initial=0.0)) for one in errors)

    @cached_property
    def corners(self) -> Real:
        """Corners (k, d) of the box, some of many."""
        return np.random.default_rng(0).permutation(list(product(*self.bounds.values())))[:_CORNERS]


def judged_by(
    measures: Sequence[MeasureLike], constraints: Sequence[Limit | str]
) -> tuple[tuple[Measure, ...], tuple[Limit, ...]]:
    """Return measures and limits, also of texts; ValueError for others."""
    checks.listed("measures", measures)
    checks.listed("constraints", constraints)
    found = tuple(map(measure_of, measures))
    return found, tuple(one if isinstance(one, Limit) else Limit.parse(one, found) for one in constraints)


def _measure(one: Measure | Limit) -> Measure:
    """Return a measure, of a limit that which is limited."""
    return one.measure if isinstance(one, Limit) else one

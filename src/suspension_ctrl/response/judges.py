"""What judges designs: scores, each a measure over all load cases, made ready for given nodes over frequency."""

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Real
from ..vehicles.handling import Mechanics, RollGeometry
from ..vehicles.vehicle import Setting, assembled
from .load_case import LoadCase, RideCase, ride_case
from .many_struts import StrutBlock
from .measures import Measure, Term
from .one_strut import StrutLoop
from .scores import Scoring, scores_of_all, scores_of_one_strut, scores_of_struts

RESOLVED = 1e-6
"""Largest relative change of a root mean square that twice the nodes may make."""

NODES = (256, 384, 512, 768, 1024, 2048, 4096)
"""Numbers of nodes to choose from."""


class Score(NamedTuple):
    """A measure in each load case, whether the worst case counts or the mean, and what it is scaled to."""

    measures: tuple[Measure, ...]
    worst_case: bool
    scale: float = 1.0
    offset: float = 0.0


class Judge:
    """Scores of designs.

    Parameters
    ----------
    cases : sequence of LoadCase
    scores : sequence of Score
    variables : mapping of str to float
        Coefficients that vary, by name, and a value of each in the middle of its range.
    fixed : mapping
        The other coefficients that have no default.
    band : (float, float)
        Frequencies over which spectra are integrated [Hz].
    """

    def __init__(
        self,
        cases: Sequence[LoadCase],
        scores: Sequence[Score],
        variables: Mapping[str, float],
        fixed: Setting,
        band: tuple[float, float],
    ) -> None:
        self.cases, self.scores, self.variables, self.band = cases, scores, variables, band
        self.coefficients = [case.vehicle.coefficients({**fixed, **variables}) for case in cases]
        self._ready: dict[int, tuple[RideCase, ...]] = {}
        for name in {score.measures[0].handling for score in scores} - {"", "roll_damping"}:
            for case in cases:
                _geometry(case, name)

    def mean_squares(self, designs: Real, nodes: int) -> Real:
        """Return the mean squares (c, p, k) of all terms in each case for designs (p, v)."""
        return np.array([case.mean_squares(designs) for case in self.ride_cases(nodes)])

    def errors(self, designs: Real, nodes: int) -> Real:
        """Return the largest relative change (c, k) of each term's root mean square by twice the nodes."""
        coarse, fine = (np.sqrt(self.mean_squares(designs, count)) for count in (nodes, 2 * nodes))
        ratio = np.divide(coarse, fine, out=np.ones_like(fine), where=fine > 0)  # a zero is resolved
        return np.asarray(np.abs(ratio - 1).max(axis=1))

    def evaluate(self, designs: Real, nodes: int) -> Real:
        """Return the scores (p, s) of designs (p, v)."""
        scores = scores_of_all(self.mean_squares(designs, nodes), self.scoring)
        for column, score in enumerate(self.scores):
            if score.measures[0].handling:
                scores[:, column] = score.scale * self._handling(designs, score) + score.offset
        return scores

    def kernel(self, nodes: int) -> tuple[Callable[..., Real], tuple[Any, ...]] | None:
        """Return the scores (s,) of one design (v,) as a compiled function, if there is one."""
        cases = self.ride_cases(nodes)
        loops = tuple(case.loop for case in cases)
        if any(score.measures[0].handling for score in self.scores) or len({_kind(loop) for loop in loops}) > 1:
            return None
        if isinstance(loops[0], StrutLoop):
            return scores_of_one_strut, (loops, self.scoring)
        return scores_of_struts, (loops, np.array([case.channel for case in cases]), self.scoring)

    def ride_cases(self, nodes: int) -> tuple[RideCase, ...]:
        """Return the load cases ready for designs."""
        if nodes not in self._ready:
            ready = [
                ride_case(case, terms, self.variables, coefficients, self.band, nodes)
                for case, terms, coefficients in zip(self.cases, self.terms, self.coefficients, strict=True)
            ]
            most = max(case.channel.size for case in ready)  # the first term stands in where a case has fewer
            self._ready[nodes] = tuple(
                case._replace(channel=np.pad(case.channel, (0, most - case.channel.size))) for case in ready
            )
        return self._ready[nodes]

    @cached_property
    def terms(self) -> list[list[Term]]:
        """What responses with what weightings there are in each case."""
        return [
            list(
                dict.fromkeys(
                    Term(t.response, t.weighting) for score in self.scores for t in score.measures[c].terms
                )
            )
            for c in range(len(self.cases))
        ]

    @cached_property
    def scoring(self) -> Scoring:
        """How scores are made of mean squares."""
        squares = np.zeros((len(self.cases), len(self.scores), max(map(len, self.terms))))
        for c, terms in enumerate(self.terms):
            for s, score in enumerate(self.scores):
                for term in score.measures[c].terms:
                    factor = term.factor / (self._static_load(c, term) if term.relative else 1.0)
                    squares[c, s, terms.index(Term(term.response, term.weighting))] += factor**2
        shares = np.array([case.share for case in self.cases])
        first = [score.measures[0] for score in self.scores]
        return Scoring(
            squares,
            np.array([measure.worst for measure in first]),
            np.array([score.worst_case for score in self.scores]),
            shares / shares.sum(),
            np.array([score.scale for score in self.scores]),
            np.array([score.offset for score in self.scores]),
        )

    def _statics(self, c: int) -> Mechanics:
        return assembled(self.cases[c].vehicle).statics

    def _static_load(self, c: int, term: Term) -> float:
        """Return the load of the term's tyre on level ground [N], on struts in the middle of their range.

        Of a vehicle with left and right alike that is its load on any struts.
        """
        vehicle, mechanics = self.cases[c].vehicle, self._statics(c)
        loads = mechanics.static_loads(np.array([list(self.coefficients[c].values())]))[0]
        return float(loads[mechanics.tyres.index(str(vehicle.meanings[str(term.response)].where))])

    def _handling(self, designs: Real, score: Score) -> Real:
        """Return a measure of handling (p,): its mean over the cases by their shares, or the worst."""
        sign = np.sign(score.scale)
        values = np.array(
            [self._handling_in(c, designs, score.measures[c].handling) for c in range(len(self.cases))]
        )
        return sign * (sign * values).max(axis=0) if score.worst_case else self.scoring.shares @ values

    def _handling_in(self, c: int, designs: Real, name: str) -> Real:
        case, known = self.cases[c], self.coefficients[c]
        coefficients = np.tile(list(known.values()), (len(designs), 1))
        coefficients[:, [list(known).index(variable) for variable in self.variables]] = designs
        mechanics = self._statics(c)
        if name == "roll_damping":
            return mechanics.roll_damping(coefficients)
        if name == "roll_gradient":
            return mechanics.roll_gradient(coefficients, _geometry(case, name))
        return mechanics.front_load_transfer(coefficients, _geometry(case, name))


def _geometry(case: LoadCase, name: str) -> RollGeometry:
    if case.roll_geometry is None:
        raise ValueError(f"roll_geometry must be given in every load case for {name}, got None")
    return case.roll_geometry


def _kind(loop: StrutLoop | tuple[StrutBlock, ...]) -> object:
    """Return what numba tells types of loops by: the length of a tuple of blocks is part of it."""
    return StrutLoop if isinstance(loop, StrutLoop) else len(loop)

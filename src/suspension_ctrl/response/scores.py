"""Objectives and constraints of designs from the mean squares of every load case."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from math import isnan
from typing import NamedTuple, TypeVar

import numpy as np

from ..quantities import Integer, Real
from ..threads import in_blocks, numbers_in
from ..vehicles.vehicle import assembled
from .case_designs import EvaluatedCase
from .combined import fill_scores
from .kernel import Kernel
from .linearisation import check_reached
from .load_case import LoadCase
from .mapped import mean_squares_of
from .mean_squares import Nodes, cases_of
from .measures.terms import CaseMeasure, Designs, Term
from .quadrature import Rule
from .shared_plants import Shared, shared, squares_by_case

RESOLVED = 1e-6
"""Largest relative change of a root mean square that twice the nodes may make."""
NODES = (256, 384, 512, 768, 1024, 2048, 4096)
"""Numbers of nodes to choose from."""


T = TypeVar("T")


class Score(NamedTuple):
    """A measure in each load case, whether the worst case counts or the mean, its factor and its constant."""

    cases: tuple[CaseMeasure, ...]
    worst_case: bool
    scale: float = 1.0
    offset: float = 0.0

    @property
    def by_function(self) -> bool:
        """Whether a function of designs stands in place of mean squares."""
        return self.cases[0].values is not None


class Scores:
    """Scores of designs in load cases, at any number of quadrature nodes.

    A setting for each case has all coefficients, of those that vary a value in the middle of the range. A measure
    by a function of designs gets the first variables that are `seen`, by default all.
    """

    def __init__(
        self,
        cases: Sequence[LoadCase],
        scores: Sequence[Score],
        settings: Sequence[Mapping[str, float]],
        variables: Sequence[str],
        band: tuple[float, float],
        seen: int | None = None,
    ) -> None:
        self.cases, self.scores, self.settings = cases, scores, settings
        self.variables, self.band, self.seen = variables, band, seen
        shares = np.array([case.share for case in cases])
        self.shares = shares / shares.sum()
        self._kernels: dict[Nodes, Kernel] = {}
        self._shared: dict[Nodes, list[Shared]] = {}

    @cached_property
    def terms(self) -> list[tuple[Term, ...]]:
        """Integrals of each case: the distinct terms without factors."""
        by_case = zip(*(score.cases for score in self.scores), strict=True)
        return [tuple(dict.fromkeys(term.integral for one in each for term in one.terms)) for each in by_case]

    def kernel(self, nodes: Nodes) -> Kernel:
        """Return the scores as data of compiled loops; a measure by a function has no mean square there."""
        if nodes not in self._kernels:
            self._kernels[nodes] = Kernel(
                cases_of(self.cases, self.terms, self.settings, self.variables, self.band, nodes),
                self._squares,
                self.shares,
                np.array([score.cases[0].largest for score in self.scores]),
                np.array([score.worst_case for score in self.scores]),
                np.array([score.scale for score in self.scores]),
                np.array([score.offset for score in self.scores]),
            )
        return self._kernels[nodes]

    def groups(self, nodes: Nodes) -> list[Shared]:
        """Return the cases of the kernel, those that share a plant as one."""
        if nodes not in self._shared:
            self._shared[nodes] = shared(self.kernel(nodes).cases)
        return self._shared[nodes]

    @property
    def compiled(self) -> bool:
        """Whether the kernel alone gives all scores."""
        return not self.functions

    def evaluate(self, designs: Real, nodes: Nodes, threads: int = 1) -> Real:
        """Return the scores (p, s) of designs (p, v); functions of designs are called on this thread."""
        rows = np.empty((len(self.scores), len(designs)))

        def fill(part: slice) -> list[Real]:
            apart = threads > 1 and part.stop - part.start < len(designs)
            return self._fill(rows, part, designs[part], nodes, apart)

        squares, result = self.in_blocks(fill, len(designs), nodes, threads), rows.T
        if self.functions:
            by_case = [np.concatenate(each) for each in zip(*squares, strict=True)]
            self.fill_functions(result, designs, nodes, by_case, self.functions)
        return result

    def in_blocks(
        self, function: Callable[[slice], T], designs: int, nodes: Nodes, threads: int, times: int = 1
    ) -> list[T]:
        """Return the results of a function of parts of so many designs, on threads if the work is worth them.

        Each design passes through the kernel so many `times`.
        """
        passed = designs * times * numbers_in(self.kernel(nodes).cases)
        return in_blocks(function, designs, passed, threads)

    def _fill(self, rows: Real, part: slice, designs: Real, nodes: Nodes, apart: bool) -> list[Real]:
        """Fill in scores without functions of designs (p, v), a part of the columns of rows (s, n).

        They are compiled if other threads work on other parts: numpy hands Python to and fro between threads, for
        longer than it computes. Return the mean squares (p, k) of cases for functions.
        """
        kernel, found = self.kernel(nodes), rows[:, part]
        squares = squares_by_case(self.groups(nodes), designs)
        if apart:
            if not fill_scores(kernel, squares, rows, part.start):
                reached(found.T, designs)
        else:
            self.fill_roots(found, squares, designs, nodes)
        return squares if self.functions else []

    def fill_roots(self, found: Real, squares: Sequence[Real], designs: Real, nodes: Nodes) -> None:
        """Fill in scores (s, p) without functions, of designs (p, v) with mean squares (p, k) in each case."""
        kernel = self.kernel(nodes)
        if self._simple:
            which, factor = self._simple
            np.multiply(reached(squares[0], designs).T[which], factor, out=found)
            np.sqrt(found, out=found)
            if not self._plain:
                found *= kernel.scale[:, None]
                found += kernel.offset[:, None]
        else:
            found[:] = reached(kernel.scores(squares), designs).T

    def fill_functions(
        self, scores: Real, designs: Real, nodes: Nodes, mean_squares: Sequence[Real], columns: Sequence[int]
    ) -> None:
        """Fill in columns (p, s) by functions of designs (p, v) with mean squares (p, k) in each case."""
        by_case = self.in_cases(designs, nodes, mean_squares) if columns else []
        for column in columns:
            score = self.scores[column]
            scores[:, column] = score.scale * self._by_function(score, by_case) + score.offset

    @cached_property
    def functions(self) -> list[int]:
        """Columns by functions of designs."""
        return [column for column, score in enumerate(self.scores) if score.by_function]

    def in_cases(self, designs: Real, nodes: Nodes, mean_squares: Sequence[Real]) -> list[Designs]:
        """Return designs (p, v) with mean squares (p, k) in each case, as functions get them."""
        each = zip(self.evaluated, self.kernel(nodes).cases, mean_squares, strict=True)
        return [one.designs(case, designs, squares) for one, case, squares in each]

    @cached_property
    def evaluated(self) -> list[EvaluatedCase]:
        """What designs have in each load case beside mean squares."""
        both = zip(self.cases, self.settings, self.terms, strict=True)
        return [EvaluatedCase(case, own, terms, self.variables, self.band, self.seen) for case, own, terms in both]

    def by_case(self, case: int, design: Real, nodes: Nodes) -> Real:
        """Return each measure (s,) of one design (v,) in a load case, without its factor and its constant."""
        designs, kernel = design[None], self.kernel(nodes)
        mean_squares = reached(mean_squares_of(kernel.cases[case], designs), designs)
        found = self.roots(case, mean_squares[0])
        one = self.evaluated[case].designs(kernel.cases[case], designs, mean_squares)
        for s, score in enumerate(self.scores):
            if function := score.cases[case].values:
                found[s] = function(one)[0]
        return found

    def roots(self, case: int, mean_squares: Real) -> Real:
        """Return the root (s,) of the sum or the largest of mean squares (k,) of a load case's terms."""
        products = self._squares[case][:, : mean_squares.size] * mean_squares
        largest = [score.cases[case].largest for score in self.scores]
        return np.sqrt(np.where(largest, products.max(axis=1, initial=0.0), products.sum(axis=1)))

    def over_cases(self, score: int, values: Real) -> float:
        """Return a score (1) over load cases from its values (c,) in them."""
        one = self.scores[score]
        sign = np.sign(one.scale)
        if one.worst_case:
            return float(sign * (sign * values).max())
        power = one.cases[0].power if one.by_function else 2
        return float((self.shares @ values**power) ** (1 / power))

    def errors(self, designs: Real, nodes: int) -> list[Real]:
        """Return by case the largest change (k,) of each root mean square by twice the nodes."""
        return self.changes(designs, nodes, 2 * nodes)

    def changes(self, designs: Real, nodes: Nodes, others: Nodes) -> list[Real]:
        """Return by case the largest change (k,) of each root mean square by other nodes."""
        both = zip(self.kernel(nodes).cases, self.kernel(others).cases, strict=True)
        return [
            _change(*(np.sqrt(reached(mean_squares_of(case, designs), designs)) for case in pair)) for pair in both
        ]

    def integrands(self, designs: Real, nodes: int) -> Iterator[tuple[Rule, Real]]:
        """Yield for each case without networks a rule of n nodes and the summands (p k, n) of its mean squares."""
        for one, case in zip(self.evaluated, self.kernel(nodes).cases, strict=True):
            yield one.summands(case, designs, nodes)

    @cached_property
    def _simple(self) -> tuple[Integer | slice, Real] | None:
        """Index (s,) and factor (s, 1) of the mean square of each score if each has one in one case, else None."""
        squares = self._squares[0]
        if len(self.cases) > 1 or (np.count_nonzero(squares, axis=1) != 1).any():
            return None
        which, count = squares.argmax(axis=1), len(self.terms[0])
        whole = np.array_equal(which, np.arange(count))
        return slice(None) if whole else which, squares.max(axis=1, keepdims=True)

    @cached_property
    def _plain(self) -> bool:
        """Whether scores have no factor and no constant."""
        return all((score.scale, score.offset) == (1.0, 0.0) for score in self.scores)

    @cached_property
    def _squares(self) -> Real:
        """Factors (c, s, k) of the mean squares of each case in each score."""
        squares = np.zeros((len(self.cases), len(self.scores), max(map(len, self.terms))))
        for c, terms in enumerate(self.terms):
            for s, score in enumerate(self.scores):
                for term in () if score.by_function else score.cases[c].terms:
                    factor = term.factor / (self._static_load(c, term) if term.relative else 1.0)
                    squares[c, s, terms.index(term.integral)] += factor**2
        return squares

    def _static_load(self, c: int, term: Term) -> float:
        """Return the static load of the term's tyre [N]; of a symmetric vehicle it is the same on any struts."""
        vehicle = assembled(self.cases[c].vehicle)
        loads = vehicle.statics.static_loads(np.array([list(self.settings[c].values())]))[0]
        return float(loads[vehicle.tyres.index(str(vehicle.meanings[str(term.response)].where))])

    def _by_function(self, score: Score, designs: Sequence[Designs]) -> Real:
        """Return a measure by a function (p,) of designs in each case: its mean by shares, or the worst."""
        functions = [one.values for one in score.cases if one.values]
        return self.joined(score, np.array([values(one) for values, one in zip(functions, designs, strict=True)]))

    def joined(self, score: Score, by_case: Real) -> Real:
        """Return a measure by a function (p,) by its values (c, p) in each case."""
        if not score.worst_case:
            mean, power = np.zeros(by_case.shape[1]), score.cases[0].power
            for share, values in zip(self.shares, by_case, strict=True):  # in order, for one design as for many
                mean += share * values**power
            return np.asarray(mean ** (1 / power))
        sign = np.sign(score.scale)
        return np.asarray(sign * (sign * by_case).max(axis=0))


def reached(values: Real, designs: Real) -> Real:
    """Return values (p, k) of designs (p, v); ValueError that names the first without a working point."""
    if not isnan(values.min(initial=0.0)):  # which takes a tenth of the time of looking at each
        return values
    check_reached(np.asarray(~np.isnan(values).any(axis=1)), designs)
    return values


def _change(coarse: Real, fine: Real) -> Real:
    """Return the largest relative change (k,) over designs (p, k), none where both are zero."""
    ratio = np.divide(coarse, fine, out=np.ones_like(fine), where=fine > 0)
    return np.asarray(np.abs(ratio - 1).max(axis=0))

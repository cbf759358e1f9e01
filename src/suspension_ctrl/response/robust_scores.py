"""Scores of designs over a scatter: sums of the sorted values of all samples with constant weights."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..compiled import compilable
from ..compiled_verbs import call
from ..quantities import Integer, Real
from ..vehicles.formulas import Formulas, fill
from .kernel import Kernel
from .scattered import Scattered
from .scores import Score, Scores

_ROWS = 1 << 15  # samples of designs in one call


class ScatteredScores:
    """Scores of the samples of designs in load cases with scatter."""

    def __init__(
        self, scattered: Scattered, scores: Sequence[Score], middle: Real, band: tuple[float, float]
    ) -> None:
        self.scattered, self.signs = scattered, np.sign([one.scale for one in scores])
        plain = [one._replace(scale=sign, offset=0.0) for one, sign in zip(scores, self.signs, strict=True)]
        self.scores = Scores(
            scattered.cases, plain, scattered.settings(middle), scattered.names, band, seen=middle.size
        )

    def samples(self, designs: Real, nodes: int) -> Real:
        """Return the measures (p, r, s) of the samples of designs (p, d)."""
        every = self.scattered.designs(designs)
        parts = [self.scores.evaluate(every[i : i + _ROWS], nodes) for i in range(0, len(every), _ROWS)]
        values = self.signs * np.concatenate(parts)
        return np.moveaxis(values.reshape(len(designs), -1, self.signs.size), 1, 2)

    def nominal(self, designs: Real, nodes: int) -> Real:
        """Return the measures (p, r) of the nominal vehicles of designs (p, d)."""
        return np.asarray(self.signs * self.scores.evaluate(self.scattered.formulas.of(designs), nodes))

    def errors(self, corners: Real, lower: Real, upper: Real, nodes: int) -> list[Real]:
        """Return `Scores.errors` where samples reach beyond corners (c, d) of a box."""
        return self.scores.errors(self.scattered.corners(corners, lower, upper), nodes)


class Statistics(NamedTuple):
    """Sums of sorted values with constant weights, each in place of a score."""

    column: Integer  # (r,), of all scores
    weight: Real  # (r, s), of ascending values
    sign: Real  # (r,), of the scores of samples
    scale: Real  # (r,), factor of the sum
    offset: Real  # (r,), added last

    def of(self, values: Real) -> Real:
        """Return the scores (p, r) of values (p, r, s), bit by bit those of each design alone.

        Weights are those of differences from the least value: equal values have that as their sum.
        """
        ordered = np.sort(np.ascontiguousarray(values), axis=2)
        least = ordered[:, :, 0]
        total = least + ((ordered - least[:, :, None]) * self.weight).sum(axis=2)
        return np.asarray(self.scale * total + self.offset)


class RobustKernel(NamedTuple):
    """Scores of one design, some over a scatter, as data of compiled loops."""

    nominal: Kernel  # of all scores
    scattered: Kernel  # of the scores over the scatter, for a sample
    formulas: Formulas
    factors: Real  # (s, v)
    statistics: Statistics

    @compilable()
    def __call__(self, design: Real) -> Real:
        """Return the scores (m,) of one design (d,), in compiled code."""
        total = call(self.nominal, (design,))
        samples, values = self.factors.shape
        designs = np.empty((1, design.size))
        for v in range(design.size):
            designs[0, v] = design[v]
        nominal, slots, sample = np.empty((1, values)), np.empty(self.formulas.start.size), np.empty(values)
        fill(self.formulas, designs, 0, slots, nominal)
        found = np.empty((self.statistics.column.size, samples))
        for i in range(samples):
            for v in range(values):
                sample[v] = nominal[0, v] * self.factors[i, v]
            scores = call(self.scattered, (sample,))
            for r in range(found.shape[0]):
                found[r, i] = self.statistics.sign[r] * scores[r]
        for r in range(found.shape[0]):
            ordered = np.sort(found[r])
            value = ordered[0]
            for i in range(samples):
                value += self.statistics.weight[r, i] * (ordered[i] - ordered[0])
            total[self.statistics.column[r]] = self.statistics.scale[r] * value + self.statistics.offset[r]
        return total


class RobustScores:
    """Scores of a problem that are taken over its scatter."""

    def __init__(self, scattered: ScatteredScores, statistics: Statistics) -> None:
        self.scattered, self.statistics = scattered, statistics

    def put(self, scores: Real, designs: Real, nodes: int, threads: int = 1) -> Real:
        """Return the scores (p, m) of designs (p, d) with those over the scatter in their columns."""
        result, samples = scores.copy(), self.statistics.weight.shape[1]

        def fill(part: slice) -> None:
            for first in range(part.start, part.stop, step):
                some = slice(first, min(first + step, part.stop))
                found = self.statistics.of(self.scattered.samples(designs[some], nodes))
                result[some, self.statistics.column] = found

        own, step = self.scattered.scores, max(1, _ROWS // samples)
        own.in_blocks(fill, len(designs), nodes, threads if own.compiled else 1, samples)
        return result

    def kernel(self, nominal: Kernel, nodes: int) -> RobustKernel:
        """Return the scores of one design as data of compiled loops."""
        own = self.scattered
        formulas, factors = own.scattered.formulas, own.scattered.factors
        return RobustKernel(nominal, own.scores.kernel(nodes).one_by_one(), formulas, factors, self.statistics)

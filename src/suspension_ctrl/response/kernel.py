"""Scores of designs as data: numpy for many designs, compiled code for one design in the loops of a search."""

from collections.abc import Sequence
from math import sqrt
from typing import NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..compiled_verbs import call
from ..quantities import Bool, Real
from .lanes import empty
from .mean_squares import Case, one_by_one


class Kernel(NamedTuple):
    """Scores of designs as data, of c load cases."""

    cases: tuple[Case, ...]  # of one class
    squares: Real  # (c, s, k), factors of the mean squares of each case, zeros where it has fewer
    shares: Real  # (c,), sum 1
    worst_term: Bool  # (s,), whether the largest of the terms counts, or their sum
    worst_case: Bool  # (s,), whether the largest of the cases counts, or their mean
    scale: Real  # (s,), factor of the root of that
    offset: Real  # (s,), added last

    def one_by_one(self) -> "Kernel":
        """Return the kernel for compiled loops that have one design after the other."""
        return self._replace(cases=tuple(map(one_by_one, self.cases)))

    def scores(self, mean_squares: Sequence[Real]) -> Real:
        """Return the scores (p, s) by mean squares (p, k) in c cases, bit by bit those of each design alone.

        By numpy: no compilation.
        """
        total, any_worst = np.zeros((self.scale.size, len(mean_squares[0]))), self.worst_case.any()
        for c, share in enumerate(self.shares):
            value = self.squares_in(c, mean_squares[c])
            mean = total + share * value
            total = np.where(self.worst_case[:, None], np.maximum(total, value), mean) if any_worst else mean
        return np.asarray(self.scale * np.sqrt(total.T) + self.offset)

    def squares_in(self, case: int, mean_squares: Real) -> Real:
        """Return the sum or the largest of the terms of each score (s, p) by mean squares (p, k) in a case."""
        found, squares = mean_squares.T, self.squares[case]
        value = np.zeros((self.scale.size, len(mean_squares)))
        for s, k in zip(*(index.tolist() for index in squares.nonzero()), strict=True):
            combine = np.maximum if self.worst_term[s] else np.add
            combine(value[s], squares[s, k] * found[k], out=value[s])
        return value

    @compilable()
    def __call__(self, design: Real) -> Real:
        """Return the scores (s,) of one design (v,), in compiled code."""
        designs = empty((1, design.size))  # `reshape` takes long to compile
        for v in range(design.size):
            designs[0, v] = design[v]
        total = empty((self.scale.size,))
        for s in range(total.size):
            total[s] = 0.0
        for c in range(len(self.cases)):
            found = call(self.cases[c], (designs,))
            for s in range(total.size):
                value = 0.0
                for k in range(found.shape[1]):
                    term = self.squares[c, s, k] * found[0, k]
                    if not self.worst_term[s]:
                        value += term
                    else:
                        value = larger(term, value)
                if not self.worst_case[s]:
                    total[s] += self.shares[c] * value
                else:
                    total[s] = larger(value, total[s])
        for s in range(total.size):
            total[s] = self.scale[s] * sqrt(total[s]) + self.offset[s]
        return total


@uncounted(forceinline=True)
def larger(one: float, other: float) -> float:
    """Return the larger of two numbers, NaN if one of them is."""
    return one if one > other or one != one else other

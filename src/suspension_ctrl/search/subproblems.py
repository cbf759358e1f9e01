"""The population of MOEA/D-DRA, an individual per subproblem, and how an iteration begins."""

from typing import NamedTuple

import numpy as np
from deap.base import Toolbox

from ..compiled import compiled, uncounted
from ..quantities import Integer, Real
from .constraints import violation_of
from .evaluation import WORST


class Decomposed(NamedTuple):
    """A population with one individual per subproblem; iterations change its arrays in place."""

    designs: Real  # (N, d)
    values: Real  # (N, m + c), objectives, then constraints
    ideal: Real  # (m,) least value seen of each objective, of feasible designs once there is one
    vectors: Real  # (N, m) weight vectors, objective by objective in memory
    normalise: bool
    neighbours: Integer  # (N, T) nearest subproblems of each, itself first
    corners: Integer  # (m,) subproblems of one objective each
    utility: Real  # (N,)
    weights: Real  # (N, m) weight vectors, likewise, over the spans of the objectives
    known: Real  # (m,) ideal point at which a sweep knows costs, NaN: none
    everyone: Integer  # (N,)
    unchosen: Integer  # (N,) work space
    chosen: Integer  # (k,) subproblems of the iteration

    @classmethod
    def of(
        cls, designs: Real, values: Real, ideal: Real, vectors: Real, normalise: bool, neighbours: Integer,
        corners: Integer, utility: Real, chosen: int,
    ) -> "Decomposed":  # fmt: skip
        """Return the population of which so many subproblems are chosen in an iteration."""
        everyone, known = np.arange(len(designs)), np.full(ideal.size, np.nan)
        vectors = np.asfortranarray(vectors)
        return cls(
            designs, values, ideal, vectors, normalise, neighbours, corners, utility, vectors.copy("F"), known,
            everyone, everyone.copy(), everyone[:chosen].copy(),
        )  # fmt: skip

    def begin(self, rng: np.random.Generator, toolbox: Toolbox) -> None:
        """Begin an iteration by the verb of a toolbox."""
        if self.normalise:
            _scaled(self.vectors, self.values, self.ideal, self.weights, self.known)
        self.chosen[:] = toolbox.choose_subproblems(rng, self.utility, self.corners, self.chosen.size)


@uncounted(error_model="numpy", forceinline=True)
def scale_weights(vectors: Real, values: Real, ideal: Real, weights: Real, known: Real) -> None:
    """Put vectors (N, m) over the span of each objective into weights (N, m); no costs by these are known.

    That is the distance from the ideal point to the worst feasible design (any, if none), 1 where it is zero.
    """
    size, m = weights.shape
    limit, i = np.inf, 0  # of the violation
    while limit > 0.0 and i < size:
        if values[i, 0] < WORST and violation_of(values[i], m) == 0.0:
            limit = 0.0
        i += 1
    for j in range(m):
        worst = -np.inf
        for i in range(size):
            counts = (values[i, j] < WORST) & (violation_of(values[i], m) <= limit)
            worst = values[i, j] if counts & (values[i, j] > worst) else worst
        span = worst - ideal[j]
        span = span if span > 0.0 else 1.0
        for i in range(size):
            weights[i, j] = vectors[i, j] / span
        known[j] = np.nan


_scaled = compiled()(scale_weights)

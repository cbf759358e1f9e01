"""Decomposition of a multi-objective problem into scalar ones: the steps of MOEA/D-DRA on arrays.

Source: Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test
instances", IEEE Congress on Evolutionary Computation, 2009.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable
from scipy.spatial import cKDTree

from ..quantities import Integer, Real, frozen_array
from .constraints import violation_of
from .operators import draw_below

ZERO_WEIGHT = 1e-4
"""Stands for a weight of zero: every subproblem keeps every objective."""

_SAMPLE_SEED = 2009  # equal sizes give equal weights: the sample is part of the definition


@lru_cache
def weight_vectors(size: int, objectives: int) -> Real:
    """Return spread weight vectors (N, m), N >= m, of sum one, read-only: the unit vectors first.

    Each further one is the farthest from all chosen ones in a uniform sample of the simplex.
    """
    rng = np.random.default_rng(_SAMPLE_SEED)
    candidates = rng.dirichlet(np.ones(objectives), max(5000, 5 * size))
    points = np.concatenate([np.eye(objectives), candidates])
    return frozen_array(points[farthest_first(points, np.arange(objectives), size)])


def farthest_first(points: Real, start: Integer, size: int) -> Integer:
    """Return the indices (size,) of those of the points (n, m) in `start`, then always of the farthest."""
    columns = np.ascontiguousarray(points.T)
    chosen = np.empty(size, dtype=np.int64)
    nearest = np.full(len(points), np.inf)
    for i in range(size):
        chosen[i] = start[i] if i < start.size else nearest.argmax()
        squares = (columns - columns[:, chosen[i], np.newaxis]) ** 2
        np.minimum(nearest, squares.sum(axis=0), out=nearest)
        nearest[chosen[i]] = -1.0  # never again, also where only copies are left
    return chosen


@lru_cache
def neighbourhoods(size: int, objectives: int, neighbours: int) -> Integer:
    """Return the indices (N, T), read-only, of the nearest of `weight_vectors` to each, itself first."""
    weights = weight_vectors(size, objectives)
    return frozen_array(cKDTree(weights).query(weights, k=neighbours)[1], dtype=np.int64)


@njit(cache=True, inline="always")  # a call for each comparison would cost more than what it compares
def tchebycheff(objectives: Real, weight: Real, ideal: Real) -> float:
    """Return g(F | lambda) = max_j lambda_j |F_j - z_j|, equation (14), of objectives (m + c,), the first m."""
    g = 0.0
    for j in range(ideal.size):
        g = max(g, weight[j] * abs(objectives[j] - ideal[j]))
    return g


@njit(cache=True)
def choose_subproblems(
    rng: np.random.Generator, utility: Real, corners: Integer, size: int, tournament: int
) -> Integer:
    """Return the subproblems (size,) to work on: the corners, then winners of tournaments by utility.

    A tournament is held among `tournament` drawn from those not chosen yet; the first drawn wins a tie.
    """
    open_ = np.arange(utility.size)
    chosen = np.empty(size, dtype=np.int64)
    for c in range(size):
        left = utility.size - c
        best = 0
        if c < corners.size:
            while open_[best] != corners[c]:
                best += 1
        else:
            best = draw_below(rng, left)
            for _ in range(tournament - 1):
                rival = draw_below(rng, left)
                if utility[open_[rival]] > utility[open_[best]]:
                    best = rival
        chosen[c] = open_[best]
        open_[best] = open_[left - 1]
    return chosen


class MatingRange(NamedTuple):
    """Partners of a subproblem in mating and replacement: with `probability` its neighbours, otherwise all."""

    probability: float

    @register_jitable
    def function(self, rng: np.random.Generator, i: int, neighbours: Integer) -> Integer:
        """Return the partners (T,) or (N,) of subproblem i from the neighbours of each (N, T)."""
        if rng.random() < self.probability:
            return neighbours[i]
        return np.arange(neighbours.shape[0])


class ReplaceWorse(NamedTuple):
    """Replacement of at most `limit` partners of larger violation or, both feasible, of larger g(F | lambda).

    The rule with constraints is that of H. Jain, K. Deb, "An evolutionary many-objective optimization algorithm
    using reference-point based nondominated sorting approach, part II", IEEE Trans. Evol. Comput. 18(4), 2014.
    """

    limit: int

    @register_jitable
    def function(
        self,
        rng: np.random.Generator,
        child: Real,
        child_values: Real,
        partners: Integer,
        designs: Real,
        values: Real,
        weights: Real,
        ideal: Real,
    ) -> None:
        """Replace partners by a child (d,) of values (m + c,), in place, after an update of the ideal point."""
        # Partners are judged one by one: the first `limit` bettered ones of a random order equal as many drawn.
        lower_ideal(ideal, child_values, values)
        violation = violation_of(child_values, ideal.size)
        bettered = np.empty_like(partners)
        count = 0
        for p in partners:
            theirs = violation_of(values[p], ideal.size)
            better = violation < theirs
            if violation == 0.0 and theirs == 0.0:
                better = tchebycheff(child_values, weights[p], ideal) < tchebycheff(values[p], weights[p], ideal)
            if better:
                bettered[count] = p
                count += 1
        for left in range(count, max(count - self.limit, 0), -1):
            drawn = draw_below(rng, left)
            p = bettered[drawn]
            bettered[drawn] = bettered[left - 1]
            for v in range(child.size):
                designs[p, v] = child[v]
            for j in range(child_values.size):
                values[p, j] = child_values[j]


@register_jitable
def lower_ideal(ideal: Real, child: Real, values: Real) -> None:
    """Update the ideal point (m,) with a child's values (m + c,), in place, as `ideal_with` does."""
    feasible, found, i = violation_of(child, ideal.size) == 0.0, False, 0
    while not found and i < values.shape[0]:
        found = violation_of(values[i], ideal.size) == 0.0
        i += 1
    for j in range(ideal.size):
        if feasible and not found:
            ideal[j] = child[j]
        elif feasible or not found:
            ideal[j] = min(ideal[j], child[j])


@njit(cache=True)
def updated_utility(
    utility: Real, before: Real, values: Real, weights: Real, ideal: Real, threshold: float
) -> Real:
    """Return the utilities (N,) after the values (N, m + c) followed those of `before`: 1 above the threshold.

    Progress is the relative decrease of g, both taken at the present ideal point, or of an infeasible design's
    violation; without progress a utility sinks by 5 %.
    """
    updated = np.ones_like(utility)
    for i in range(utility.size):
        old, new = violation_of(before[i], ideal.size), violation_of(values[i], ideal.size)
        if old == 0.0:
            old = tchebycheff(before[i], weights[i], ideal)
            new = tchebycheff(values[i], weights[i], ideal)
        progress = max(0.0, (old - new) / old) if old > 0 else 0.0
        if progress <= threshold:
            updated[i] = (0.95 + 0.05 * progress / threshold) * utility[i]
    return updated

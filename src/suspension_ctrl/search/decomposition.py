"""Decomposition of a multi-objective problem into scalar ones: the steps of MOEA/D-DRA on arrays.

Source: Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test
instances", IEEE Congress on Evolutionary Computation, 2009.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..quantities import Real
from .constraints import violation_of
from .operators import draw_below

ZERO_WEIGHT = 1e-4
"""What stands for a weight of zero, so that no objective is left out of a subproblem altogether."""

_SAMPLE_SEED = 2009  # equal sizes give equal weights: the sample is part of the definition


@lru_cache
def weight_vectors(size: int, objectives: int) -> Real:
    """Return widely spread weight vectors.

    The unit vectors come first; then, again and again, the candidate farthest from all those chosen, out of
    a uniform sample of the simplex.

    Parameters
    ----------
    size : int
        Number of vectors N.
    objectives : int
        Number of objectives m, at most N.

    Returns
    -------
    (N, m) ndarray
        Non-negative vectors of sum one, read-only.
    """
    rng = np.random.default_rng(_SAMPLE_SEED)
    candidates = rng.dirichlet(np.ones(objectives), max(5000, 5 * size))
    points = np.concatenate([np.eye(objectives), candidates])
    weights = points[farthest_first(points, np.arange(objectives), size)]
    weights.flags.writeable = False
    return weights


def farthest_first(points: Real, start: NDArray[np.int64], size: int) -> NDArray[np.int64]:
    """Return which `size` of the points (n, m): those in `start`, then again and again the farthest."""
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
def neighbourhoods(size: int, objectives: int, neighbours: int) -> NDArray[np.int64]:
    """Return for each of `weight_vectors` the indices of the nearest ones, itself first; (N, T), read-only."""
    weights = weight_vectors(size, objectives)
    _, nearest = cKDTree(weights).query(weights, k=neighbours)
    nearest = np.ascontiguousarray(nearest, dtype=np.int64)
    nearest.flags.writeable = False
    return nearest


def corner_subproblems(weights: Real) -> NDArray[np.int64]:
    """Return the indices of the subproblems whose weights (N, m) are the unit vectors, in objective order."""
    return np.array([np.flatnonzero(weights[:, j] == 1.0)[0] for j in range(weights.shape[1])])


@njit(cache=True, inline="always")  # a call for each comparison would cost more than what it compares
def tchebycheff(objectives: Real, weight: Real, ideal: Real) -> float:
    """Return g(F | lambda) = max_j lambda_j |F_j - z_j|; all arguments (m,), equation (14).

    Whatever follows the m objectives is left out.
    """
    g = 0.0
    for j in range(ideal.size):
        g = max(g, weight[j] * abs(objectives[j] - ideal[j]))
    return g


@njit(cache=True)
def choose_subproblems(
    rng: np.random.Generator, utility: Real, corners: NDArray[np.int64], size: int, tournament: int
) -> NDArray[np.int64]:
    """Return the subproblems (size,) to work on: the corners, then winners of tournaments by utility.

    Each further one has the highest utility of `tournament` drawn from those not chosen yet; the first drawn
    wins a tie.
    """
    open_ = np.empty(utility.size, dtype=np.int64)
    for i in range(utility.size):
        open_[i] = i
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
    """Where a subproblem finds mates and its child is put: with `probability` its neighbours, otherwise all."""

    probability: float

    @register_jitable
    def function(self, rng: np.random.Generator, i: int, neighbours: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the partners (T,) or (N,) of subproblem i from the neighbours of each (N, T)."""
        if rng.random() < self.probability:
            return neighbours[i]
        everyone = np.empty(neighbours.shape[0], dtype=np.int64)
        for j in range(everyone.size):
            everyone[j] = j
        return everyone


class ReplaceWorse(NamedTuple):
    """Replacement of partners that a child betters, at most `limit` of them.

    It betters one of larger violation and, where both are feasible, one of larger g(F | lambda).

    References
    ----------
    H. Jain and K. Deb, "An evolutionary many-objective optimization algorithm using reference-point based
    nondominated sorting approach, part II", IEEE Trans. Evol. Comput. 18(4), 2014, for the rule with constraints.
    """

    limit: int

    @register_jitable
    def function(
        self,
        rng: np.random.Generator,
        child: Real,
        child_values: Real,
        partners: NDArray[np.int64],
        designs: Real,
        values: Real,
        weights: Real,
        ideal: Real,
    ) -> None:
        """Put a child (d,) with its values (m + c,) in the place of partners; everything in place.

        The ideal point takes the child's objectives in before the first comparison. To replace the first `limit`
        of partners visited in random order is to replace as many, drawn from all that the child betters: whether
        it betters one does not depend on the others.
        """
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
    """Take the values (m + c,) of a child into the ideal point (m,), in place, as `ideal_with` does."""
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
    """Return the utilities (N,) after progress from `before` (N, m + c) to `values` (N, m + c).

    Progress is the relative decrease of g, old and new value both taken at the present ideal point, or of the
    violation where a subproblem had an infeasible design: above the threshold a utility is 1, below it sinks, by
    5 % where there was none.
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

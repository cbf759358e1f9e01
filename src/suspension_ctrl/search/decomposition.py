"""Decomposition of a multi-objective problem into scalar ones: the steps of MOEA/D-DRA on arrays.

Source: Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test
instances", IEEE Congress on Evolutionary Computation, 2009.
"""

from functools import lru_cache

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from .constraints import any_feasible, lower_ideal, violation_of
from .operators import draw_below

ZERO_WEIGHT = 1e-4
"""What stands for a weight of zero, so that no objective is left out of a subproblem altogether."""

_SAMPLE_SEED = 2009  # equal sizes give equal weights: the sample is part of the definition


@lru_cache
def weight_vectors(size: int, objectives: int) -> NDArray[np.float64]:
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


@njit(cache=True)
def farthest_first(points: NDArray[np.float64], start: NDArray[np.int64], size: int) -> NDArray[np.int64]:
    """Return which `size` of the points (n, m): those in `start`, then again and again the farthest."""
    chosen = np.empty(size, dtype=np.int64)
    nearest = np.full(points.shape[0], np.inf)
    for i in range(size):
        chosen[i] = start[i] if i < start.size else np.argmax(nearest)
        for c in range(points.shape[0]):
            distance = 0.0
            for j in range(points.shape[1]):
                distance += (points[c, j] - points[chosen[i], j]) ** 2
            nearest[c] = min(nearest[c], distance)
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


def corner_subproblems(weights: NDArray[np.float64]) -> NDArray[np.int64]:
    """Return the indices of the subproblems whose weights (N, m) are the unit vectors, in objective order."""
    return np.array([np.flatnonzero(weights[:, j] == 1.0)[0] for j in range(weights.shape[1])])


@njit(cache=True, inline="always")  # a call for each comparison would cost more than what it compares
def tchebycheff(objectives: NDArray[np.float64], weight: NDArray[np.float64], ideal: NDArray[np.float64]) -> float:
    """Return g(F | lambda) = max_j lambda_j |F_j - z_j|; all arguments (m,), equation (14).

    Whatever follows the m objectives is left out.
    """
    g = 0.0
    for j in range(ideal.size):
        g = max(g, weight[j] * abs(objectives[j] - ideal[j]))
    return g


@njit(cache=True)
def choose_subproblems(
    rng: np.random.Generator,
    utility: NDArray[np.float64],
    corners: NDArray[np.int64],
    size: int,
    tournament: int,
) -> NDArray[np.int64]:
    """Return the subproblems (size,) to work on: the corners, then winners of tournaments by utility.

    Each further one has the highest utility of `tournament` drawn from those not chosen yet; the first drawn
    wins a tie.
    """
    open_ = np.arange(utility.size)
    left = utility.size
    chosen = np.empty(size, dtype=np.int64)
    for c in range(corners.size):
        chosen[c] = corners[c]
        left -= 1
        place = np.flatnonzero(open_[: left + 1] == corners[c])[0]
        open_[place] = open_[left]
    for c in range(corners.size, size):
        best = draw_below(rng, left)
        for _ in range(tournament - 1):
            rival = draw_below(rng, left)
            if utility[open_[rival]] > utility[open_[best]]:
                best = rival
        chosen[c] = open_[best]
        left -= 1
        open_[best] = open_[left]
    return chosen


@njit(cache=True)
def mating_range(
    rng: np.random.Generator, i: int, neighbours: NDArray[np.int64], probability: float
) -> NDArray[np.int64]:
    """Return where subproblem i finds mates and its child is put: its neighbours (T,) or, rarely, all (N,)."""
    if rng.random() < probability:
        return neighbours[i]
    return np.arange(neighbours.shape[0])


@njit(cache=True)
def replace_worse(
    rng: np.random.Generator,
    child: NDArray[np.float64],
    child_values: NDArray[np.float64],
    partners: NDArray[np.int64],
    designs: NDArray[np.float64],
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    ideal: NDArray[np.float64],
    limit: int,
) -> None:
    """Put a child in the place of partners that it betters, at most `limit` of them; everything in place.

    It betters one of larger violation and, where both are feasible, one of larger g(F | lambda). The ideal point
    takes the child's objectives in before the first comparison, as `lower_ideal` does. To replace the first
    `limit` that it betters of partners visited in random order is to replace as many, drawn from all that it
    betters: whether it betters one does not depend on the others.

    References
    ----------
    H. Jain and K. Deb, "An evolutionary many-objective optimization algorithm using reference-point based
    nondominated sorting approach, part II", IEEE Trans. Evol. Comput. 18(4), 2014, for the rule with constraints.
    """
    lower_ideal(ideal, child_values, any_feasible(values, ideal.size))
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
    for left in range(count, max(count - limit, 0), -1):
        drawn = draw_below(rng, left)
        p = bettered[drawn]
        bettered[drawn] = bettered[left - 1]
        designs[p] = child
        values[p] = child_values


@njit(cache=True)
def updated_utility(
    utility: NDArray[np.float64],
    before: NDArray[np.float64],
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    ideal: NDArray[np.float64],
    threshold: float,
) -> NDArray[np.float64]:
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

"""Decomposition of a multi-objective problem into scalar subproblems: the steps of MOEA/D-DRA on arrays.

Source: Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test
instances", IEEE Congress on Evolutionary Computation, 2009.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..quantities import Integer, Real, frozen_array
from .constraints import violations
from .operators import draw_below
from .spreading import ONE_SET, farthest_first

ZERO_WEIGHT = 1e-4
"""Replaces a weight of zero, so that every subproblem depends on every objective."""

_SAMPLE_SEED = 2009  # fixed: the weights depend on the size alone


@lru_cache
def weight_vectors(size: int, objectives: int) -> Real:
    """Return evenly spread weight vectors (N, m) of sum one, read-only, N >= m; the unit vectors come first.

    Each further vector is the one of a uniform sample of the simplex that is farthest from all before it.
    """
    rng = np.random.default_rng(_SAMPLE_SEED)
    candidates = rng.dirichlet(np.ones(objectives), max(5000, 5 * size))
    points = np.concatenate([np.eye(objectives), candidates])
    return frozen_array(points[farthest_first(points, np.arange(objectives), size, ONE_SET)])


def tchebycheff(values: Real, weights: Real, ideal: Real) -> Real:
    """Return g(F | lambda) = max_j lambda_j |F_j - z_j| (n,), equation (14), of values (n, m + c)."""
    columns = np.ascontiguousarray((weights * np.abs(values[:, : ideal.size] - ideal)).T)
    return np.asarray(columns.max(axis=0))  # numpy is slow along short rows


class ByTournament(NamedTuple):
    """Choice of the subproblems of an iteration: the corners, then winners of tournaments by utility."""

    tournament: int

    @compilable()
    def __call__(self, rng: np.random.Generator, utility: Real, corners: Integer, size: int) -> Integer:
        """Return the subproblems (size,), from utilities (N,) and corners (m,)."""
        chosen, unchosen = np.empty(size, dtype=np.int64), np.empty(utility.size, dtype=np.int64)
        choose(rng, utility, corners, self.tournament, unchosen, chosen)
        return chosen


@uncounted(forceinline=True)
def choose(
    rng: np.random.Generator, utility: Real, corners: Integer, tournament: int, unchosen: Integer, chosen: Integer
) -> None:
    """Fill `chosen` (k,): corners, then winners; the first drawn wins a tie. `unchosen` (N,) is work space."""
    for i in range(unchosen.size):
        unchosen[i] = i
    for c in range(chosen.size):
        left, best = unchosen.size - c, np.uint64(0)
        if c < corners.size:
            while unchosen[best] != corners[c]:
                best += np.uint64(1)
        else:
            most = -np.inf
            for _ in range(tournament):
                # Without branches, and by indices without a sign, as in `replacement.compare`.
                rival = np.uint64(draw_below(rng, left))
                found = utility[np.uint64(unchosen[rival])]
                wins = found > most
                best, most = rival if wins else best, found if wins else most
        chosen[c] = unchosen[best]
        unchosen[best] = unchosen[left - 1]


class MatingRange(NamedTuple):
    """Partners of a subproblem in mating and replacement: its neighbours with `probability`, otherwise all."""

    probability: float
    everyone: Integer  # (N,)

    @compilable()
    def __call__(self, rng: np.random.Generator, i: int, neighbours: Integer) -> Integer:
        """Return the partners (T,) or (N,) of subproblem i, from the neighbours (N, T) of all."""
        if rng.random() < self.probability:
            return neighbours[i]
        return self.everyone


class RangeInSweep(NamedTuple):
    """`MatingRange` without counts of references to arrays, which whoever calls it holds."""

    probability: float

    @uncounted(forceinline=True)
    def __call__(
        self, rng: np.random.Generator, _i: int, near: Integer, everyone: Integer, _neighbours: Integer
    ) -> Integer:
        """Return the partners of a subproblem: its neighbours `near` (T,) or all (N,)."""
        if rng.random() < self.probability:
            return near
        return everyone


def updated_utility(
    utility: Real, before: Real, values: Real, weights: Real, ideal: Real, threshold: float
) -> Real:
    """Return the utilities (N,) after a period, from values (N, m + c) at its start, `before`, and at its end.

    Progress is the relative decrease of g at the present ideal point, or of the violation of an infeasible design.
    Progress above the threshold gives a utility of 1; without progress a utility decreases by 5 %.
    """
    old, new = violations(before, ideal.size), violations(values, ideal.size)
    by_value = old == 0.0
    old = np.where(by_value, tchebycheff(before, weights, ideal), old)
    new = np.where(by_value, tchebycheff(values, weights, ideal), new)
    progress = np.maximum(0.0, np.divide(old - new, old, out=np.zeros_like(old), where=old > 0))
    return np.where(progress > threshold, 1.0, (0.95 + 0.05 * progress / threshold) * utility)

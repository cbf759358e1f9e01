"""NSGA-II's survivor selection on arrays: fronts by moocore, crowding distances as in DEAP's ``selNSGA2``.

Ties: of equal values, and of equal crowding distances, the earlier individual of the population goes first.
"""

import moocore
import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from ..quantities import Integer, Real

_FEW = 24
"""Equal values in a row up to which insertion is the quicker sort."""


def select_survivors(objectives: Real, size: int) -> tuple[Integer, Real]:
    """Return indices, ascending, of `size` survivors of objectives (n, m), and their crowding distances [-].

    Whole fronts by rank, the last by larger crowding distance: K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A
    fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE Trans. Evol. Comput. 6(2), 2002.
    """
    rank = front_ranks(objectives)
    last = int(np.searchsorted(np.cumsum(np.bincount(rank)), size))
    index = np.flatnonzero(rank <= last)
    rank = rank.take(index)
    crowding = crowding_distances(objectives.take(index, axis=0), rank)
    surplus = index.size - size
    if surplus:
        front = np.flatnonzero(rank == last)
        stays = np.ones(index.size, dtype=bool)
        stays[front[rising_order(-crowding.take(front))[-surplus:]]] = False
        index, crowding = index[stays], crowding[stays]
    return index, crowding


def front_ranks(objectives: Real) -> NDArray[np.int32]:
    """Return the fronts (n,), from 0, of objectives (n, m)."""
    order = np.argsort(objectives[:, 0])  # moocore sorts by the last objective: quick where that is done already
    rank = np.empty(order.size, dtype=np.int32)
    rank[order] = moocore.pareto_rank(objectives.take(order, axis=0)[:, ::-1])
    return rank


def crowding_distances(objectives: Real, rank: NDArray[np.int32]) -> Real:
    """Return the crowding distances (n,) within whole fronts, from objectives (n, m) and ranks (n,).

    The mean over the objectives of the gap between both neighbours over the front's range; infinite at its ends.
    """
    distance = np.zeros(rank.size)
    m, fronts = objectives.shape[1], int(rank.max()) + 1
    for value in np.ascontiguousarray(objectives.T):
        add_gaps(value, rising_order(value), rank, fronts, m, distance)
    return distance


def rising_order(values: Real) -> Integer:
    """Return ``np.argsort(values, kind="stable")``, in a quarter of its time where few values are equal."""
    order = np.argsort(values)
    return order if settle_ties(values, order) else np.argsort(values, kind="stable")


@compiled()
def settle_ties(value: Real, order: Integer) -> bool:
    """Sort equal values of a rising `order` (n,) by index, in place; False if they are too many."""
    begin = 0
    for k in range(1, order.size):
        if value[order[k]] != value[order[begin]]:
            begin = k
        if k - begin >= _FEW:
            return False
        individual, place = order[k], k
        while place > begin and order[place - 1] > individual:
            order[place] = order[place - 1]
            place -= 1
        order[place] = individual
    return True


@compiled()
def add_gaps(value: Real, order: Integer, rank: NDArray[np.int32], fronts: int, m: int, distance: Real) -> None:
    """Add to `distance` (n,) the share of one of m objectives, of `value` (n,) that rises in `order` (n,)."""
    low, high = np.empty((2, fronts))
    before, here = np.empty((2, fronts), dtype=np.int64)
    for r in range(fronts):
        low[r], high[r], before[r], here[r] = np.inf, -np.inf, -1, -1
    for i in range(rank.size):
        low[rank[i]], high[rank[i]] = min(low[rank[i]], value[i]), max(high[rank[i]], value[i])
    for i in order:
        r = rank[i]
        if here[r] < 0:
            distance[i] = np.inf
        elif before[r] >= 0 and high[r] > low[r]:
            distance[here[r]] += (value[i] - value[before[r]]) / (m * (high[r] - low[r]))
        before[r], here[r] = here[r], i
    for r in range(fronts):
        distance[here[r]] = np.inf

"""Survivor selection of NSGA-II on arrays: fronts by moocore, crowding distances as in DEAP's ``selNSGA2``.

Ties of objectives or of crowding distances are broken by the order in the population.
"""

import moocore
import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from ..quantities import Integer, Real

_FEW = 24
"""Maximum number of consecutive equal values sorted by insertion; more are sorted faster by numpy."""


def select_survivors(objectives: Real, size: int) -> tuple[Integer, Real]:
    """Return indices, ascending, of `size` survivors of objectives (n, m), and their crowding distances [-].

    Whole fronts survive by rank, and of the last front the designs of largest crowding distance: K. Deb, A.
    Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE Trans.
    Evol. Comput. 6(2), 2002.
    """
    rank = front_ranks(objectives)
    last = int(np.searchsorted(np.cumsum(np.bincount(rank)), size))
    index = np.flatnonzero(rank <= last)
    rank = rank.take(index)
    crowding = crowding_distances(objectives.take(index, axis=0), rank)
    surplus = index.size - size
    if surplus:
        front = np.flatnonzero(rank == last)
        survives = np.ones(index.size, dtype=bool)
        survives[front[rising_order(-crowding.take(front))[-surplus:]]] = False
        index, crowding = index[survives], crowding[survives]
    return index, crowding


def front_ranks(objectives: Real) -> NDArray[np.int32]:
    """Return the number of the front (n,), from 0, of each row of objectives (n, m)."""
    order = np.argsort(objectives[:, 0])  # moocore sorts by the last objective, which is quick if presorted
    rank = np.empty(order.size, dtype=np.int32)
    rank[order] = moocore.pareto_rank(objectives.take(order, axis=0)[:, ::-1])
    return rank


def crowding_distances(objectives: Real, rank: NDArray[np.int32]) -> Real:
    """Return the mean over objectives (n, m) of the gap of both neighbours in a front over its range, (n,)."""
    distance = np.zeros(rank.size)
    m, fronts = objectives.shape[1], int(rank.max()) + 1
    for value in np.ascontiguousarray(objectives.T):
        add_gaps(value, rising_order(value), rank, fronts, m, distance)
    return distance


def rising_order(values: Real) -> Integer:
    """Return ``np.argsort(values, kind="stable")``, four times as fast if few values are equal."""
    order = np.argsort(values)
    return order if settle_ties(values, order) else np.argsort(values, kind="stable")


@compiled()
def settle_ties(value: Real, order: Integer) -> bool:
    """Sort the indices of equal values in a rising `order` (n,), in place; return False if there are too many."""
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
    """Add one of m objectives, `value` (n,) rising in `order` (n,), to the crowding distances `distance` (n,)."""
    low, high = np.empty((2, fronts))
    previous, last = np.empty((2, fronts), dtype=np.int64)
    for r in range(fronts):
        low[r], high[r], previous[r], last[r] = np.inf, -np.inf, -1, -1
    for i in range(rank.size):
        low[rank[i]], high[rank[i]] = min(low[rank[i]], value[i]), max(high[rank[i]], value[i])
    for i in order:
        r = rank[i]
        if last[r] < 0:
            distance[i] = np.inf
        elif previous[r] >= 0 and high[r] > low[r]:
            distance[last[r]] += (value[i] - value[previous[r]]) / (m * (high[r] - low[r]))
        previous[r], last[r] = last[r], i
    for r in range(fronts):
        distance[last[r]] = np.inf

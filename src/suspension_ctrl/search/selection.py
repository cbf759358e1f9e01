"""NSGA-II's survivor selection on arrays: fronts by moocore, survivors exactly those of DEAP's ``selNSGA2``.

Where several points have equal claims, DEAP's answer follows from the order in which it lists a front. That
order is worked out (`deap_order`) only where it decides something.
"""

import moocore
import numpy as np
from numba import njit
from numpy.typing import NDArray

from .operators import dominates
from .sorting import sorted_by


def select_survivors(objectives: NDArray[np.float64], size: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Keep `size` individuals: whole fronts by rank, the last front by larger crowding distance.

    Parameters
    ----------
    objectives : (n, m) ndarray
        Objectives to be minimised, their ranges finite.
    size : int
        How many to keep, from 1 to n.

    Returns
    -------
    index : (size,) ndarray
        Survivors in ascending order.
    crowding : (size,) ndarray
        Their crowding distances [-], infinite at the ends of a front.

    References
    ----------
    K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm:
    NSGA-II", IEEE Trans. Evol. Comput. 6(2), 2002.
    """
    objectives = np.ascontiguousarray(objectives, dtype=float)
    listed, ordered = presorted(objectives)
    listed, rank = cut_ranks(listed, moocore.pareto_rank(ordered), size)
    index, crowding, order_decides = keep_least_crowded(objectives, rank, listed, size)
    if order_decides:
        index, crowding, _ = keep_least_crowded(objectives, rank, deap_order(objectives, rank), size)
    return index, crowding


@njit(cache=True)
def presorted(objectives: NDArray[np.float64]) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the individuals by rising first objective, and their objectives (n, m) in reverse.

    moocore sorts by the last objective, which is quick where that is done already.
    """
    listed, _ = sorted_by(objectives, np.arange(objectives.shape[0]), 0)
    ordered = np.empty_like(objectives)
    for k in range(listed.size):
        for j in range(objectives.shape[1]):
            ordered[k, j] = objectives[listed[k], -1 - j]
    return listed, ordered


@njit(cache=True)
def cut_ranks(
    listed: NDArray[np.int64], ranks: NDArray[np.int32], size: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return what `first_fronts` does, from the ranks (n,) of the individuals `listed` (n,)."""
    last = int(np.searchsorted(np.cumsum(np.bincount(ranks)), size))
    rank = np.full(listed.size, -1)
    for k in range(listed.size):
        if ranks[k] <= last:
            rank[listed[k]] = ranks[k]
    return listed[ranks <= last], rank


@njit(cache=True)
def keep_least_crowded(
    objectives: NDArray[np.float64], rank: NDArray[np.int64], listed: NDArray[np.int64], size: int
) -> tuple[NDArray[np.int64], NDArray[np.float64], bool]:
    """Keep all of the individuals `listed` (k,), except the most crowded ones of their last front.

    The first two results are those of `select_survivors`. The third says whether another order of the list
    might give another answer. Equal points are alike wherever they stand, so that is so only where different
    points of a front share their first objective, or where one that stays and a different one that goes have
    the same crowding distance.
    """
    distance, order_decides = crowding_distances(objectives, rank, listed)
    kept = np.zeros(rank.size, dtype=np.bool_)
    kept[listed] = True
    surplus = listed.size - size
    if surplus > 0:
        last = listed[rank[listed] == rank[listed].max()]
        least_to_stay = np.partition(distance[last], surplus)[surplus]
        kept[last[distance[last] < least_to_stay]] = False
        level = last[distance[last] == least_to_stay]
        too_many = int(np.count_nonzero(kept)) - size
        kept[level[level.size - too_many :]] = False
        if too_many > 0 and np.any(objectives[level] != objectives[level[0]]):
            order_decides = True
    index = np.flatnonzero(kept)
    return index, distance[index], order_decides


@njit(cache=True)
def crowding_distances(
    objectives: NDArray[np.float64], rank: NDArray[np.int64], listed: NDArray[np.int64]
) -> tuple[NDArray[np.float64], bool]:
    """Return the crowding distances (n,) of those `listed` (k,), True if their order bears on them.

    The distance is the sum over the objectives of the gap between both neighbours over m times the front's
    range. As in DEAP the list is sorted by one objective after the other, each time keeping the order it had.
    """
    m = objectives.shape[1]
    distance = np.zeros(rank.size)
    order_decides = False
    for j in range(m):
        listed, value = sorted_by(objectives, listed, j)
        add_gaps(value, rank, listed, m, distance)
        if j == 0:
            order_decides = share_first_objective(objectives, rank, listed)
    return distance, order_decides


@njit(cache=True)
def add_gaps(
    value: NDArray[np.float64],
    rank: NDArray[np.int64],
    listed: NDArray[np.int64],
    m: int,
    distance: NDArray[np.float64],
) -> None:
    """Add to `distance` (n,) the share of one of m objectives, by whose rising `value` (k,) `listed` is sorted."""
    fronts = rank.max() + 1
    first, last = np.full(fronts, -1), np.full(fronts, -1)  # places in the list
    for k in range(listed.size):
        r = rank[listed[k]]
        if first[r] < 0:
            first[r] = k
        last[r] = k
    before, here = np.full(fronts, -1), np.full(fronts, -1)
    for k in range(listed.size):
        r = rank[listed[k]]
        if before[r] >= 0:
            span = value[last[r]] - value[first[r]]
            if span > 0:
                distance[listed[here[r]]] += (value[k] - value[before[r]]) / (m * span)
        before[r], here[r] = here[r], k
    for r in range(fronts):
        distance[listed[first[r]]] = distance[listed[last[r]]] = np.inf


@njit(cache=True)
def share_first_objective(
    objectives: NDArray[np.float64], rank: NDArray[np.int64], listed: NDArray[np.int64]
) -> bool:
    """Whether any neighbours of a front in `listed` agree in the first objective but not in all."""
    before = np.full(rank.max() + 1, -1)
    for i in listed:
        b = before[rank[i]]
        if b >= 0 and 1 <= agreement(objectives, b, i) < objectives.shape[1]:
            return True
        before[rank[i]] = i
    return False


@njit(cache=True)
def agreement(objectives: NDArray[np.float64], a: int, b: int) -> int:
    """In how many of the first objectives individuals a and b agree, up to the first in which they differ."""
    for j in range(objectives.shape[1]):
        if objectives[a, j] != objectives[b, j]:
            return j
    return objectives.shape[1]


def deap_order(objectives: NDArray[np.float64], rank: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the individuals of rank >= 0, front by front, as DEAP's ``sortNondominated`` lists them.

    DEAP lists the first front as it came. An individual enters a later front when the last of those that
    dominate it is dealt with, those in the order of the front before; among several that enter then, the
    first to come stands first. Equal points stand together where the first of them stands.
    """
    _, first, group = np.unique(objectives, axis=0, return_index=True, return_inverse=True)
    arrival = first[group.ravel()]  # an individual's group of equal points, named by its first member
    heads = np.unique(arrival)
    place = np.zeros(rank.size, dtype=np.int64)  # of the heads
    before = heads[:0]
    for r in range(rank.max() + 1):
        front = heads[rank[heads] == r]
        before = front[np.lexsort((front, last_dominators(objectives, before, front)))]
        place[before] = np.arange(before.size)
    order = np.lexsort((np.arange(rank.size), place[arrival], rank))
    return order[rank[order] >= 0]


@njit(cache=True)
def last_dominators(
    objectives: NDArray[np.float64], before: NDArray[np.int64], front: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return the place in the list `before` of the last one that dominates each of the next front; -1 for none."""
    places = np.full(front.size, -1)
    for k in range(front.size):
        for place in range(before.size - 1, -1, -1):
            if dominates(objectives[before[place]], objectives[front[k]]):
                places[k] = place
                break
    return places

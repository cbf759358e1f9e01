"""NSGA-II's survivor selection on arrays: ranks by moocore, survivors exactly those of DEAP's ``selNSGA2``.

Where several points have equal claims, DEAP's answer follows from the order in which it lists a front. That
order is worked out (`deap_order`) only where it decides something.
"""

import moocore
import numpy as np
from numba import njit
from numpy.typing import NDArray

from .operators import dominates


def select_survivors(objectives: NDArray[np.float64], size: int) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Keep `size` individuals: whole fronts by rank, the last front by larger crowding distance.

    Parameters
    ----------
    objectives : (n, m) ndarray
        Objectives to be minimised.
    size : int
        How many to keep, at most n.

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
    rank = moocore.pareto_rank(objectives).astype(np.int64)
    index, crowding, order_decides = keep_least_crowded(objectives, rank, np.arange(rank.size), size)
    if order_decides:
        index, crowding, _ = keep_least_crowded(objectives, rank, deap_order(objectives, rank), size)
    return index, crowding


@njit(cache=True)
def keep_least_crowded(
    objectives: NDArray[np.float64], rank: NDArray[np.int64], order: NDArray[np.int64], size: int
) -> tuple[NDArray[np.int64], NDArray[np.float64], bool]:
    """Keep the best fronts, and of the last one the least crowded; arguments and result as in `select_survivors`.

    `order` (n,) is the order in which all individuals are listed. The third result says whether another order
    within the fronts might give another answer. Equal points are alike wherever they stand, so that is so only
    where different points of a front share their first objectives (the last two then differ, or one would
    dominate), or where one that stays and a different one that goes have the same crowding distance.
    """
    fronts = fronts_in_order(rank, order, size)
    distance = np.zeros(rank.size)
    order_decides = False
    for front in fronts:
        if add_crowding_distance(objectives, front, distance):
            order_decides = True
    kept = np.zeros(rank.size, dtype=np.bool_)
    places = size
    for front in fronts[:-1]:
        kept[front] = True
        places -= front.size
    last = fronts[-1]
    best_first = last[np.argsort(-distance[last], kind="mergesort")]
    kept[best_first[:places]] = True
    if places < last.size:
        stays = distance[best_first[places - 1]]
        if stays == distance[best_first[places]]:
            for i in best_first[distance[best_first] == stays]:
                if agreement(objectives, i, best_first[places]) < objectives.shape[1]:
                    order_decides = True
    index = np.flatnonzero(kept)
    return index, distance[index], order_decides


@njit(cache=True)
def fronts_in_order(rank: NDArray[np.int64], order: NDArray[np.int64], size: int) -> list[NDArray[np.int64]]:
    """Return the first fronts that together have at least `size` individuals, each listed in `order`."""
    counts = np.bincount(rank)
    last = int(np.searchsorted(np.cumsum(counts), size))
    fronts = [np.empty(counts[r], dtype=np.int64) for r in range(last + 1)]
    filled = np.zeros(last + 1, dtype=np.int64)
    for i in order:
        r = rank[i]
        if r <= last:
            fronts[r][filled[r]] = i
            filled[r] += 1
    return fronts


@njit(cache=True)
def add_crowding_distance(
    objectives: NDArray[np.float64], front: NDArray[np.int64], distance: NDArray[np.float64]
) -> bool:
    """Put the crowding distances of one front in `distance` (n,); True if its order bears on them.

    The distance is the sum over the objectives of the gap between both neighbours over m times the front's
    range. As in DEAP the list is sorted by one objective after the other, each time keeping the order it had.
    """
    m = objectives.shape[1]
    order_decides = False
    value = np.empty(front.size)
    for j in range(m):
        for k in range(front.size):
            value[k] = objectives[front[k], j]
        by_value = np.argsort(value, kind="mergesort")
        front, value = front[by_value], value[by_value]
        distance[front[0]] = distance[front[-1]] = np.inf
        span = value[-1] - value[0]
        if span > 0:
            for k in range(1, front.size - 1):
                distance[front[k]] += (value[k + 1] - value[k - 1]) / (m * span)
        if j < m - 2 and share_first_objectives(objectives, front, j + 1):
            order_decides = True
    return order_decides


@njit(cache=True)
def share_first_objectives(objectives: NDArray[np.float64], front: NDArray[np.int64], count: int) -> bool:
    """Whether any neighbours in the list `front` agree in the first `count` objectives but not in all."""
    for k in range(1, front.size):
        if count <= agreement(objectives, front[k - 1], front[k]) < objectives.shape[1]:
            return True
    return False


@njit(cache=True)
def agreement(objectives: NDArray[np.float64], a: int, b: int) -> int:
    """In how many of the first objectives individuals a and b agree, up to the first in which they differ."""
    for j in range(objectives.shape[1]):
        if objectives[a, j] != objectives[b, j]:
            return j
    return objectives.shape[1]


def deap_order(objectives: NDArray[np.float64], rank: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the individuals, front by front, as DEAP's ``sortNondominated`` lists them; shape (n,).

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
    return np.lexsort((np.arange(rank.size), place[arrival], rank))


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

"""NSGA-II's survivor selection on arrays: ranks by moocore, survivors exactly those of DEAP's ``selNSGA2``.

Where several points have equal claims, DEAP's answer follows from the order in which it lists a front. That
order is worked out (`deap_listing`) only where it decides something.
"""

import moocore
import numpy as np
from numpy.typing import NDArray


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
    last = int(np.partition(rank, size - 1)[size - 1])
    sure, front = np.flatnonzero(rank < last), np.flatnonzero(rank == last)
    by_index = np.arange(rank.size)
    crowding = crowding_distance(objectives, rank, by_index)
    if _order_decides(objectives, rank, crowding, front, size - sure.size):
        listing = deap_listing(objectives, rank, last)
        crowding = crowding_distance(objectives, rank, listing)
        front = front[np.argsort(listing[front])]
    best_first = front[np.argsort(-crowding[front], kind="stable")]
    index = np.sort(np.concatenate([sure, best_first[: size - sure.size]]))
    return index, crowding[index]


def crowding_distance(
    objectives: NDArray[np.float64], rank: NDArray[np.int64], listing: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the crowding distance of each individual within its front.

    Parameters
    ----------
    objectives : (n, m) ndarray
    rank : (n,) ndarray
        Front of each individual.
    listing : (n,) ndarray
        Place of each individual in its front's list. As in DEAP the list is sorted by one objective after
        the other, each time keeping the order it had, so equal values stand as the objectives before left them.

    Returns
    -------
    (n,) ndarray
        Sum over the objectives of the gap between both neighbours over m times the front's range [-].
    """
    m = objectives.shape[1]
    distance = np.zeros(rank.size)
    for j in range(m):
        order = np.lexsort((listing, *objectives.T[: j + 1], rank))
        value, front = objectives[order, j], rank[order]
        starts = np.flatnonzero(np.r_[True, front[1:] != front[:-1]])
        ends = np.r_[starts[1:], rank.size] - 1
        span = np.repeat(value[ends] - value[starts], ends - starts + 1)
        gap = np.zeros(rank.size)
        gap[1:-1] = value[2:] - value[:-2]
        distance[order] += np.divide(gap, m * span, out=np.zeros(rank.size), where=span > 0)
        distance[order[starts]] = distance[order[ends]] = np.inf
    return distance


def deap_listing(objectives: NDArray[np.float64], rank: NDArray[np.int64], last: int) -> NDArray[np.int64]:
    """Return the place at which DEAP's ``sortNondominated`` lists each individual, (n,); fronts up to `last`.

    DEAP lists the first front as it came. An individual enters a later front when the last of those that
    dominate it is dealt with, those in the order of the front before; among several that enter then, the
    first to come stands first. Equal points stand together where the first of them stands.
    """
    _, first, group = np.unique(objectives, axis=0, return_index=True, return_inverse=True)
    arrival = first[group.ravel()]  # an individual's group of equal points, named by its first member
    heads = np.unique(arrival)
    place = np.zeros(rank.size, dtype=np.int64)  # of the heads
    before = heads[:0]
    for r in range(last + 1):
        front = heads[rank[heads] == r]
        release = _last_dominator(objectives, before, front) if r else np.zeros(front.size)
        before = front[np.lexsort((front, release))]
        place[before] = np.arange(before.size)
    listing = np.empty(rank.size, dtype=np.int64)
    listing[np.lexsort((np.arange(rank.size), place[arrival], rank))] = np.arange(rank.size)
    return listing


def _last_dominator(
    objectives: NDArray[np.float64], before: NDArray[np.int64], front: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Place in the list `before` of the last one that dominates each individual of the next front."""
    dominates: NDArray[np.bool_] = np.all(objectives[before][:, np.newaxis] <= objectives[front], axis=2)
    return before.size - 1 - np.argmax(dominates[::-1], axis=0)


def _order_decides(
    objectives: NDArray[np.float64],
    rank: NDArray[np.int64],
    crowding: NDArray[np.float64],
    front: NDArray[np.int64],
    places: int,
) -> bool:
    """Whether the order within a front's list bears on the survivors or on crowding distances.

    Equal points are alike wherever they stand. So it does only where different points of a front share their
    first objectives (the last two then differ, or one would dominate), or where the crowding distance is the
    same for one that stays and a different one that goes.
    """
    for shared in range(1, objectives.shape[1] - 1):
        order = np.lexsort((*objectives.T[::-1], rank))
        pair = objectives[order]
        same = (pair[1:, :shared] == pair[:-1, :shared]).all(axis=1) & (np.diff(rank[order]) == 0)
        if (same & (pair[1:] != pair[:-1]).any(axis=1)).any():
            return True
    if places in (0, front.size):
        return False
    sorted_distance = np.sort(crowding[front])[::-1]
    tied = objectives[front[crowding[front] == sorted_distance[places]]]
    return bool(sorted_distance[places - 1] == sorted_distance[places] and (tied != tied[0]).any())

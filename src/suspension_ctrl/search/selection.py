"""Survivor selection of NSGA-II on arrays: fronts and crowding distances as in DEAP's ``selNSGA2``.

Ties of objectives or of crowding distances are broken by the order in the population.
"""

import moocore
import numpy as np
from numpy.typing import NDArray

from ..compiled import filling, uncounted
from ..quantities import Integer, Real
from .sorting import by_buckets, sorted_by


def select_survivors(objectives: Real, size: int) -> tuple[Integer, NDArray[np.int32], Real]:
    """Return indices, ascending, of `size` survivors of objectives (n, m), their fronts and crowding distances.

    Whole fronts survive by rank, and of the last front the designs of largest crowding distance: K. Deb, A.
    Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE Trans.
    Evol. Comput. 6(2), 2002.
    """
    rank, crowding = ranks_and_crowding(objectives, size)
    index, counts = np.empty(size, dtype=np.int64), np.zeros(rank.size, dtype=np.int64)
    values, room = np.empty((2, rank.size + 1))
    fill_survivors(rank, crowding, counts, values, room, index)
    return index, rank.take(index), crowding.take(index)


@filling()
def fill_survivors(
    rank: NDArray[np.int32], crowding: Real, counts: Integer, values: Real, room: Real, index: Integer
) -> None:
    """Fill in the indices (k,), ascending, of the best by fronts and crowding distances (n,).

    Of individuals of the last front at the same distance the first ones stay. `counts` (n,) is zero, `values` and
    `room` (n + 1,) are any. Conditions are joined without branches, which would be as good as random.
    """
    for i in range(rank.size):
        counts[rank[i]] += 1
    last, left = 0, index.size  # of the last front
    while left > counts[last]:
        left -= counts[last]
        last += 1
    place = 0
    for i in range(rank.size):
        values[place] = crowding[i]
        place += rank[i] == last
    limit = nth_smallest(values, room, place, place - left)
    for i in range(rank.size):
        left -= (rank[i] == last) & (crowding[i] > limit)  # at the limit in the end
    place, i = 0, 0
    while place < index.size and i < rank.size:
        tied = (rank[i] == last) & (crowding[i] == limit) & (left > 0)
        index[place] = i
        place += (rank[i] < last) | ((rank[i] == last) & (crowding[i] > limit)) | tied
        left -= tied
        i += 1


@uncounted()
def nth_smallest(values: Real, room: Real, count: int, n: int) -> float:
    """Return the number n, from 0, of the first `count` values in their order; they and `room` are overwritten."""
    while True:
        pivot, below, above = values[count // 2], 0, 0
        for i in range(count):
            value = values[i]
            values[below], room[above] = value, value
            below += value < pivot
            above += value > pivot
        if n < below:
            count = below
        elif n < count - above:
            return pivot
        else:
            n -= count - above
            count, values, room = above, room, values


def ranks_and_crowding(objectives: Real, size: int) -> tuple[NDArray[np.int32], Real]:
    """Return the front (n,), from 0, and the crowding distance (n,) of each row of objectives (n, m).

    Fronts beyond the first `size` rows may have one number. The crowding distance is the mean over objectives of
    the gap between both neighbours in a front over the range of the front.
    """
    columns = np.ascontiguousarray(objectives.T)
    orders = by_buckets(columns)
    for j, order in enumerate(orders):
        orders[j] = sorted_by(columns[j : j + 1], order)
    if len(columns) == 3:
        rank = swept_fronts(columns, orders[1], sorted_by(columns, orders[0].copy()), size)
    else:
        rank = np.empty(len(objectives), dtype=np.int32)
        rank[orders[0]] = moocore.pareto_rank(columns[::-1, orders[0]].T)  # it sorts by the last objective
    distance, fronts = np.zeros(rank.size), int(rank.max()) + 1
    add_gaps(columns, orders, rank, np.empty(fronts), np.empty((2, fronts), dtype=np.int64), distance)
    return rank, distance


def swept_fronts(columns: Real, by_second: Integer, order: Integer, size: int) -> NDArray[np.int32]:
    """Return the front (n,) of each of three objectives (3, n), one number for all beyond the first `size`.

    The order (n,) is lexicographic, `by_second` (n,) that of the second objective.
    """
    rank, level, left = np.empty((3, order.size), dtype=np.int32)
    sweep_fronts(columns, by_second, order, size, left, level, np.empty(left.size), np.empty(left.size + 1), rank)
    return rank


@filling()
def sweep_fronts(
    columns: Real,
    by_second: Integer,
    order: Integer,
    size: int,
    left: NDArray[np.int32],
    level: NDArray[np.int32],
    third: Real,
    tree: Real,
    rank: NDArray[np.int32],
) -> None:
    """Fill in the front (n,) of each individual, one number for all beyond the first `size`; the others are room.

    The second objective gives each individual its level from 1, and 0 to a copy of the individual before.
    """
    for k in range(left.size):
        i, before = by_second[k], by_second[k - 1]
        rank[i] = rank[before] if k > 0 and columns[1, i] == columns[1, before] else k + 1  # for now its level
    for k in range(left.size):
        i, before, copy = order[k], order[k - 1], k > 0
        for j in range(3):
            copy = copy and columns[j, i] == columns[j, before]
        left[k], level[k], third[k] = i, 0 if copy else rank[i], columns[2, i]
    front, rest = 0, left.size
    while left.size - rest < size and rest > 0:
        rest, front = take_front(front, rest, left, level, third, tree, rank), front + 1
    for k in range(rest):
        rank[left[k]] = front


@uncounted()
def take_front(
    front: int,
    rest: int,
    left: NDArray[np.int32],
    level: NDArray[np.int32],
    third: Real,
    tree: Real,
    rank: NDArray[np.int32],
) -> int:
    """Take a front off the first `rest` individuals `left` (n,), with level and third objective; return the rest.

    In their lexicographic order an individual is dominated only by earlier ones: by one whose second and third
    objective are no larger. A Fenwick tree (n + 1,) over the levels of the second gives the least third objective
    of these in log n steps.
    """
    for place in range(tree.size):
        tree[place] = np.nan  # no individual yet: comparisons with it are false
    kept, dominated = 0, False
    for k in range(rest):
        place, value = level[k], third[k]
        dominated = dominated and place == 0  # a copy is what the one before it is
        while place > 0:  # levels up to its own
            dominated |= tree[place] <= value
            place &= place - 1
        if dominated:
            left[kept], level[kept], third[kept] = left[k], level[k], value
            kept += 1
            continue
        rank[left[k]], place = front, level[k]
        while 0 < place < tree.size:  # sums that hold its level
            tree[place] = tree[place] if tree[place] <= value else value
            place += place & -place
    return kept


@filling()
def add_gaps(
    columns: Real, orders: Integer, rank: NDArray[np.int32], span: Real, places: Integer, distance: Real
) -> None:
    """Add the crowding distances (n,) of objectives (m, n) in fronts (n,); each objective rises in its order (n,).

    Of r fronts `span` (r,) and `places` (2, r), the last two individuals, are room.
    """
    m = columns.shape[0]
    for j in range(m):
        fill_spans(columns, orders, j, rank, places, span)
        for r in range(span.size):
            places[0, r], places[1, r] = -1, -1
        for k in range(rank.size):
            i = orders[j, k]
            r = rank[i]
            before, last = places[0, r], places[1, r]
            if last < 0:
                distance[i] = np.inf
            elif before >= 0 and span[r] > 0:
                distance[last] += (columns[j, i] - columns[j, before]) / (m * span[r])
            places[0, r], places[1, r] = last, i
        for r in range(span.size):
            distance[places[1, r]] = np.inf


@uncounted()
def fill_spans(
    columns: Real, orders: Integer, j: int, rank: NDArray[np.int32], places: Integer, span: Real
) -> None:
    """Fill in the range (r,) of objective j in each front; `places` (2, r) is room."""
    for r in range(span.size):
        places[0, r], places[1, r] = -1, -1
    missing, k = 2 * span.size, 0
    while missing > 0:  # ends are soon met
        i, last = orders[j, k], orders[j, rank.size - 1 - k]
        if places[0, rank[i]] < 0:
            places[0, rank[i]] = i
            missing -= 1
        if places[1, rank[last]] < 0:
            places[1, rank[last]] = last
            missing -= 1
        k += 1
    for r in range(span.size):
        span[r] = columns[j, places[1, r]] - columns[j, places[0, r]]

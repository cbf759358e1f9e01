"""Survivor selection of NSGA-II on arrays: fronts and crowding distances as in DEAP's ``selNSGA2``.

Ties of objectives or of crowding distances are broken by the order in the population.
"""

import moocore
import numpy as np
from numpy.typing import NDArray

from ..compiled import compilable, compiled
from ..quantities import Integer, Real

_MOVES, _BUCKETS = 8, 4
"""Per individual: most moves in sorting by insertion, numpy is faster where there are more; buckets before it."""


def select_survivors(objectives: Real, size: int) -> tuple[Integer, NDArray[np.int32], Real]:
    """Return indices, ascending, of `size` survivors of objectives (n, m), their fronts and crowding distances.

    Whole fronts survive by rank, and of the last front the designs of largest crowding distance: K. Deb, A.
    Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm: NSGA-II", IEEE Trans.
    Evol. Comput. 6(2), 2002.
    """
    rank, crowding = ranks_and_crowding(objectives, size)
    last, surplus, distances = last_front(rank, crowding, size)
    limit = np.partition(distances, surplus - 1)[surplus - 1] if surplus else -np.inf
    return survivors(rank, crowding, size, last, surplus, limit)


@compiled()
def last_front(rank: NDArray[np.int32], crowding: Real, size: int) -> tuple[int, int, Real]:
    """Return the last front that survives, its number of individuals too many, and its crowding distances (k,)."""
    counts = np.zeros(rank.size, dtype=np.int64)
    for i in range(rank.size):
        counts[rank[i]] += 1
    last, ranked = 0, counts[0]
    while ranked < size:
        last += 1
        ranked += counts[last]
    distances, place = np.empty(counts[last]), 0
    for i in range(rank.size):
        if rank[i] == last:
            distances[place] = crowding[i]
            place += 1
    return last, ranked - size, distances


@compiled()
def survivors(
    rank: NDArray[np.int32], crowding: Real, size: int, last: int, surplus: int, limit: float
) -> tuple[Integer, NDArray[np.int32], Real]:
    """Return indices, fronts and crowding distances (size,) without a surplus of the last front.

    The surplus is those of that front at a distance below the limit, then the last of those at the limit.
    """
    index, ranks, distances = np.empty(size, dtype=np.int64), np.empty(size, dtype=np.int32), np.empty(size)
    for i in range(rank.size):
        surplus -= rank[i] == last and crowding[i] < limit
    place = size - 1
    for i in range(rank.size - 1, -1, -1):
        tied = rank[i] == last and crowding[i] == limit
        if tied and surplus > 0:
            surplus -= 1
        elif rank[i] < last or (rank[i] == last and crowding[i] >= limit):
            index[place], ranks[place], distances[place] = i, rank[i], crowding[i]
            place -= 1
    return index, ranks, distances


def ranks_and_crowding(objectives: Real, size: int) -> tuple[NDArray[np.int32], Real]:
    """Return the front (n,), from 0, and the crowding distance (n,) of each row of objectives (n, m).

    Fronts beyond the first `size` rows may have one number. The crowding distance is the mean over objectives of
    the gap between both neighbours in a front over the range of the front.
    """
    columns = np.ascontiguousarray(objectives.T)
    orders = np.array([lexicographic(column[np.newaxis]) for column in columns])
    if len(columns) == 3:
        rank = swept_fronts(columns, orders[1], lexicographic(columns, orders[0]), size)
    else:
        rank = np.empty(len(objectives), dtype=np.int32)
        rank[orders[0]] = moocore.pareto_rank(columns[::-1, orders[0]].T)  # it sorts by the last objective
    distance, fronts = np.zeros(rank.size), int(rank.max()) + 1
    ends, places = np.empty((2, fronts)), np.empty((2, fronts), dtype=np.int64)
    for value, order in zip(columns, orders, strict=True):
        add_gaps(value, order, rank, len(columns), ends, places, distance)
    return rank, distance


def lexicographic(keys: Real, near: Integer | None = None) -> Integer:
    """Return ``np.lexsort(keys[::-1])`` of keys (k, n); an order `near` (n,), or evenly spread keys, save time."""
    order = by_buckets(keys[0]) if near is None else near.copy()
    if insert(keys, order):
        return order
    order = np.argsort(keys[0])
    return order if insert(keys, order) else np.lexsort(keys[::-1])


def by_buckets(values: Real) -> Integer:
    """Return an order (n,) of values by 4 n equal intervals; within one they stand as they come."""
    order, ends = np.arange(values.size), np.zeros(_BUCKETS * values.size + 1, dtype=np.int64)
    with np.errstate(invalid="ignore", over="ignore"):  # infinite values have no span
        least, span = values.min(), values.max() - values.min()
    if ends.size * np.finfo(float).tiny < span < np.inf:  # no overflow, nor NaN
        fill_buckets(values, least, (ends.size - 2) / span, np.empty(values.size, dtype=np.int64), ends, order)
    return order


@compiled()
def fill_buckets(values: Real, least: float, scale: float, bucket: Integer, ends: Integer, order: Integer) -> None:
    """Put indices of values (n,) into `order` (n,) by buckets; `ends` (4 n + 1,) is zero, `bucket` (n,) any."""
    last = ends.size - 2
    for i in range(values.size):
        b = np.int64((values[i] - least) * scale)
        bucket[i] = b if b < last else last
        ends[bucket[i] + 1] += 1
    for k in range(1, ends.size):
        ends[k] += ends[k - 1]
    for i in range(values.size):
        order[ends[bucket[i]]] = i
        ends[bucket[i]] += 1


@compiled()
def insert(keys: Real, order: Integer) -> bool:
    """Sort a nearly sorted order (n,) by keys (k, n), then by index; return False if that takes many moves."""
    moves, largest = 0, -np.inf
    for k in range(order.size):
        one, place = order[k], k
        if keys[0, one] > largest:
            largest = keys[0, one]
            continue
        while place > 0 and follows(keys, order[place - 1], one):
            order[place] = order[place - 1]
            place -= 1
        order[place] = one
        moves += k - place
        if moves > _MOVES * order.size:
            return False
    return True


@compilable()
def follows(keys: Real, a: int, b: int) -> bool:
    """Whether the individual a comes after b by keys (k, n), then by index."""
    for key in keys:
        if key[a] != key[b]:
            return bool(key[a] > key[b])
    return a > b


def swept_fronts(columns: Real, by_second: Integer, order: Integer, size: int) -> NDArray[np.int32]:
    """Return the front (n,) of each of three objectives (3, n), one number for all beyond the first `size`.

    The order (n,) is lexicographic, `by_second` (n,) that of the second objective.
    """
    level, rank = np.empty((2, order.size), dtype=np.int32)
    tree, (first, second, third) = np.empty(order.size + 1), columns
    sweep_fronts(first, second, third, by_second, order.copy(), size, tree, level, rank)
    return rank


@compiled()
def sweep_fronts(
    first: Real,
    second: Real,
    third: Real,
    by_second: Integer,
    left: Integer,
    size: int,
    tree: Real,
    level: NDArray[np.int32],
    rank: NDArray[np.int32],
) -> None:
    """Fill in the front (n,) of each individual, one number for all beyond the first `size`; the others are room.

    Fronts are taken off `left` (n,) one after another. In its lexicographic order an individual is dominated only
    by earlier ones: by one whose second objective, which `level` ranks, and third are no larger. A Fenwick tree
    (n + 1,) over the levels gives the least third objective of these in log n steps. Slices and whole arrays would
    take twice as long to compile.
    """
    for k in range(left.size):
        i, before = by_second[k], by_second[k - 1]
        level[i] = level[before] if k > 0 and second[i] == second[before] else k + 1
    front, rest = 0, left.size
    while left.size - rest < size and rest > 0:
        for place in range(tree.size):
            tree[place] = np.nan  # no individual yet: comparisons with it are false
        kept, last = 0, -1
        for k in range(rest):
            i = left[k]
            dominated, place = False, level[i]
            while place > 0:  # levels up to its own
                dominated |= tree[place] <= third[i]
                place &= place - 1
            twin = last >= 0 and first[i] == first[last] and second[i] == second[last] and third[i] == third[last]
            if dominated and not twin:
                left[kept] = i
                kept += 1
                continue
            rank[i], last, place = front, i, level[i]
            while place < tree.size:  # sums that hold its level
                tree[place] = tree[place] if tree[place] <= third[i] else third[i]
                place += place & -place
        rest, front = kept, front + 1
    for k in range(rest):
        rank[left[k]] = front


@compiled()
def add_gaps(
    value: Real,
    order: Integer,
    rank: NDArray[np.int32],
    m: int,
    ends: Real,
    places: Integer,
    distance: Real,
) -> None:
    """Add one of m objectives, `value` (n,) rising in `order` (n,), to the crowding distances `distance` (n,).

    Work space of r fronts: `ends` (2, r), least and largest value, `places` (2, r), the last two individuals.
    """
    for r in range(ends.shape[1]):
        places[0, r], places[1, r] = -1, -1
    for k in range(order.size):  # of a front the last values that are put in are its largest and its least
        i, j = order[k], order[order.size - 1 - k]
        ends[1, rank[i]], ends[0, rank[j]] = value[i], value[j]
    for k in range(order.size):
        i = order[k]
        r = rank[i]
        before, last, span = places[0, r], places[1, r], ends[1, r] - ends[0, r]
        if last < 0:
            distance[i] = np.inf
        elif before >= 0 and span > 0:
            distance[last] += (value[i] - value[before]) / (m * span)
        places[0, r], places[1, r] = last, i
    for r in range(ends.shape[1]):
        distance[places[1, r]] = np.inf

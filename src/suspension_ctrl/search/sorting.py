"""Sorting of evenly spread keys, as those of designs along a front: by buckets, then by insertion."""

import numpy as np
from numpy.typing import NDArray

from ..compiled import filling, uncounted
from ..quantities import Integer, Real

_MOVES, _BUCKETS = 8, 4
"""Per key: most moves in sorting by insertion, numpy is faster where there are more; buckets before it."""
_TINY = np.finfo(float).tiny


def lexicographic(keys: Real) -> Integer:
    """Return ``np.lexsort(keys[::-1])`` of keys (k, n); evenly spread keys save time."""
    return sorted_by(keys, by_buckets(keys[:1])[0])


def sorted_by(keys: Real, order: Integer) -> Integer:
    """Return ``np.lexsort(keys[::-1])`` of keys (k, n); a nearly sorted order (n,), lost, saves time."""
    if insert(keys, order):
        return order
    order = np.argsort(keys[0])
    return order if insert(keys, order) else np.lexsort(keys[::-1])


def by_buckets(columns: Real) -> Integer:
    """Return orders (m, n) of columns (m, n) by 4 n equal intervals; within one values stand as they come."""
    orders, bucket = np.empty(columns.shape, dtype=np.int64), np.empty(columns.shape[1], dtype=np.int32)
    fill_orders(columns, bucket, np.empty(_BUCKETS * bucket.size + 1, dtype=np.int32), orders)
    return orders


@filling()
def fill_orders(columns: Real, bucket: NDArray[np.int32], ends: NDArray[np.int32], orders: Integer) -> None:
    """Fill in orders (m, n) of columns (m, n) by buckets; `bucket` (n,) and `ends` (4 n + 1,) are room."""
    last = ends.size - 2
    for j in range(columns.shape[0]):
        least, largest = np.inf, -np.inf
        for i in range(bucket.size):
            orders[j, i] = i
            least = columns[j, i] if columns[j, i] < least else least
            largest = columns[j, i] if columns[j, i] > largest else largest
        span = largest - least
        if not last * _TINY < span < np.inf:  # it overflows, or its reciprocal does
            continue
        for k in range(ends.size):
            ends[k] = 0
        for i in range(bucket.size):
            b = np.int64((columns[j, i] - least) * (last / span))
            bucket[i] = b if 0 <= b < last else last  # NaN too
            ends[bucket[i] + 1] += 1
        for k in range(1, ends.size):
            ends[k] += ends[k - 1]
        for i in range(bucket.size):
            orders[j, ends[bucket[i]]] = i
            ends[bucket[i]] += 1


@filling()
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


@uncounted()
def follows(keys: Real, a: int, b: int) -> bool:
    """Whether the individual a comes after b by keys (k, n), then by index."""
    for key in keys:
        if key[a] != key[b]:
            return bool(key[a] > key[b])
    return a > b

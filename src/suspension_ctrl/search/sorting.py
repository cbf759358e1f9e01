"""A stable sort of individuals by one objective, in time about proportional to their number."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

_FEW = 24
"""Values in a bucket up to which insertion is the quicker sort."""


@njit(cache=True)
def sorted_by(
    objectives: NDArray[np.float64], order: NDArray[np.int64], j: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the individuals listed in `order` (k,) by rising objective j, and its values (k,).

    Equal ones stay in the order in which they were listed.

    Finite values are first put into as many buckets of equal width as there are individuals. Where they are
    spread out that is nearly the whole sort, at a third of the time of numpy's; where they crowd into few
    buckets these are sorted by merging.
    """
    value = np.empty(order.size)
    for k in range(order.size):
        value[k] = objectives[order[k], j]
    if np.all(value[1:] >= value[:-1]):
        return order.copy(), value
    low, span = value.min(), value.max() - value.min()
    if not 0 < span < np.inf:
        by_value = np.argsort(value, kind="mergesort")
        return order[by_value], value[by_value]
    bucket = np.empty(order.size, dtype=np.int64)
    for k in range(order.size):
        bucket[k] = int((value[k] - low) / span * (order.size - 1))
    value, listed, end = distributed(value, order, bucket)
    begin = 0
    for b in range(order.size):
        if end[b] - begin > _FEW:
            by_value = np.argsort(value[begin : end[b]], kind="mergesort")
            listed[begin : end[b]] = listed[begin : end[b]][by_value]
            value[begin : end[b]] = value[begin : end[b]][by_value]
        elif end[b] - begin > 1:
            sort_by_insertion(value, listed, begin, end[b])
        begin = end[b]
    return listed, value


@njit(cache=True)
def distributed(
    value: NDArray[np.float64], order: NDArray[np.int64], bucket: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """Return values and list (k,) bucket after bucket, each in the order it had, and where each bucket ends."""
    end = np.zeros(bucket.size + 1, dtype=np.int64)
    for b in bucket:
        end[b + 1] += 1
    end = np.cumsum(end)  # so far, where each begins
    values, listed = np.empty_like(value), np.empty_like(order)
    for k in range(bucket.size):
        place = end[bucket[k]]
        values[place], listed[place] = value[k], order[k]
        end[bucket[k]] += 1
    return values, listed, end


@njit(cache=True)
def sort_by_insertion(value: NDArray[np.float64], listed: NDArray[np.int64], begin: int, end: int) -> None:
    """Sort values and the list beside them (k,) from `begin` to `end` in place, equal ones as they were."""
    for k in range(begin + 1, end):
        v, i, place = value[k], listed[k], k
        while place > begin and value[place - 1] > v:
            value[place], listed[place] = value[place - 1], listed[place - 1]
            place -= 1
        value[place], listed[place] = v, i

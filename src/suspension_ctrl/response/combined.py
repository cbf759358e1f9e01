"""Scores of designs from mean squares, in compiled loops that leave Python to other threads meanwhile."""

from collections.abc import Sequence
from math import sqrt

import numpy as np

from ..compiled import compiled, uncounted
from ..quantities import Real
from .kernel import Kernel, larger


def fill_scores(kernel: Kernel, mean_squares: Sequence[Real], rows: Real, start: int) -> bool:
    """Fill in scores in columns of rows (s, n), the first at `start`, by mean squares (p, k) in c cases.

    They have the bits of `Kernel.scores`. Return whether all are numbers.
    """
    kernel, value, complete = kernel._replace(cases=()), np.empty(len(mean_squares[0])), True  # compiled once
    for c, found in enumerate(mean_squares):
        complete = add_case(kernel, c, np.ascontiguousarray(found), value, rows, start)
    return complete


@compiled(nogil=True, error_model="numpy")
def add_case(kernel: Kernel, case: int, found: Real, value: Real, rows: Real, start: int) -> bool:
    """Add the mean squares (p, k) of a case to columns of rows (s, n); with the last case they become scores.

    `value` (p,) is room for the squares of one score. Return whether all are numbers.
    """
    last, missing = case == kernel.shares.size - 1, 0
    for s in range(rows.shape[0]):
        row = rows[s, start : start + value.size]
        fill_squares(kernel, case, s, found, value)
        add_share(kernel.shares[case], case == 0, kernel.worst_case[s], value, row)
        if last:
            missing += fill_roots(kernel.scale[s], kernel.offset[s], row)
    return missing == 0


@uncounted()
def fill_squares(kernel: Kernel, case: int, s: int, found: Real, value: Real) -> None:
    """Fill in the sum or the largest (p,) of the terms of a score."""
    for i in range(value.size):
        value[i] = 0.0
    for k in range(found.shape[1]):
        factor = kernel.squares[case, s, k]
        if factor == 0.0:
            continue
        if kernel.worst_term[s]:
            for i in range(value.size):
                value[i] = larger(factor * found[i, k], value[i])
        else:
            for i in range(value.size):
                value[i] += factor * found[i, k]


@uncounted()
def add_share(share: float, is_first: bool, is_worst: bool, value: Real, row: Real) -> None:
    """Add squares (p,) times the share of their case to those of earlier cases, or keep the larger ones."""
    for i in range(row.size):
        earlier = 0.0 if is_first else row[i]
        row[i] = larger(value[i], earlier) if is_worst else earlier + share * value[i]


@uncounted()
def fill_roots(scale: float, offset: float, row: Real) -> int:
    """Replace mean squares (p,) by scores; return how many are not numbers."""
    missing = 0
    for i in range(row.size):
        row[i] = scale * sqrt(row[i]) + offset
        missing += row[i] != row[i]
    return missing

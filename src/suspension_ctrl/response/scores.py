"""From mean squares of responses in every load case to objectives and constraints."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from ..quantities import Real
from .many_struts import StrutBlock, mean_squares
from .one_strut import StrutLoop, loop_mean_squares


class Scoring(NamedTuple):
    """How s scores are made of k mean squares in each of c load cases.

    Parameters
    ----------
    squares : (c, s, k) ndarray
        What each mean square is multiplied with.
    worst_term, worst_case : (s,) ndarray of bool
        Whether the largest of the terms, and of the cases, counts; otherwise the sum of the terms, and the mean
        over the cases, of which the root is taken.
    shares : (c,) ndarray
        Share of each case in that mean.
    scale, offset : (s,) ndarray
        What the root is multiplied with, and what is then added.
    """

    squares: Real
    worst_term: Real
    worst_case: Real
    shares: Real
    scale: Real
    offset: Real


@njit(cache=True)
def add_case(mean_square: Real, case: int, scoring: Scoring, total: Real) -> None:
    """Take the mean squares (k,) of a case into the `total` (s,)."""
    for score in range(total.size):
        value = 0.0
        for k in range(mean_square.size):
            term = scoring.squares[case, score, k] * mean_square[k]
            value = max(value, term) if scoring.worst_term[score] else value + term
        if scoring.worst_case[score]:
            total[score] = max(total[score], value)
        else:
            total[score] += scoring.shares[case] * value


@njit(cache=True)
def finish(total: Real, scoring: Scoring) -> None:
    """Turn `total` (s,) into scores in place."""
    for score in range(total.size):
        total[score] = scoring.scale[score] * np.sqrt(total[score]) + scoring.offset[score]


@njit(cache=True)
def scores_of_all(mean_square: Real, scoring: Scoring) -> Real:
    """Return the scores (p, s) of designs whose mean squares are (c, p, k)."""
    scores = np.zeros((mean_square.shape[1], scoring.scale.size))
    for i in range(scores.shape[0]):
        for case in range(mean_square.shape[0]):
            add_case(mean_square[case, i], case, scoring, scores[i])
        finish(scores[i], scoring)
    return scores


@njit(cache=True)
def scores_of_one_strut(design: Real, loops: tuple[StrutLoop, ...], scoring: Scoring) -> Real:
    """Return the scores (s,) of a spring and a damper (2,)."""
    total = np.zeros(scoring.scale.size)
    for case, loop in enumerate(loops):
        add_case(loop_mean_squares(design, loop), case, scoring, total)
    finish(total, scoring)
    return total


@njit(cache=True)
def scores_of_struts(
    design: Real,
    cases: tuple[tuple[StrutBlock, ...], ...],
    channel: NDArray[np.int64],
    scoring: Scoring,
) -> Real:
    """Return the scores (s,) of a design (v,); `channel` (c, k) tells where the mean squares of a case stand."""
    total = np.zeros(scoring.scale.size)
    for case, blocks in enumerate(cases):
        found = mean_squares(design, blocks, channel[case].max() + 1)
        add_case(found[channel[case]], case, scoring, total)
    finish(total, scoring)
    return total

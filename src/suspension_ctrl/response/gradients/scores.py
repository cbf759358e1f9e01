"""Derivatives of objectives and constraints, from those of the mean squares of every load case."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ...quantities import Integer, Real
from ..mean_squares import Nodes
from ..scores import Kernel, Scores, reached
from . import functions
from .cases import with_slopes
from .wanted import TIED, Wanted


def with_jacobian(scores: Scores, designs: Real, nodes: Nodes, bounds: tuple[Real, Real]) -> tuple[Real, Real]:
    """Return the scores (p, s) of designs (p, v), and their derivatives (p, s, v) by the variables.

    Of the largest of terms or load cases it is that of the largest one, of equal ones that of the first, of a mean
    square of 0 it is 0. Measures by a function are differentiated by `functions` within the lower and upper bounds
    (v,).
    """
    kernel, (wanted, row, alone) = scores.kernel(nodes), _plan(scores, nodes)
    pairs = [with_slopes(case, each, designs) for case, each in zip(kernel.cases, wanted, strict=True)]
    squares = [reached(found, designs) for found, _ in pairs]
    values = kernel.scores(squares)
    root = (values - kernel.offset) / kernel.scale
    half = 0.5 * kernel.scale / np.where(root > 0, root, np.inf)
    jacobian = half[:, :, None] * _total(kernel, squares, [_rows(slopes, row) for _, slopes in pairs])
    if not scores.compiled:
        tangents = [np.zeros((*found.shape, designs.shape[1])) for found in squares]
        for tangent, own, (_, slopes) in zip(tangents, alone, pairs, strict=True):
            tangent[:, own] = slopes[:, slopes.shape[1] - len(own) :]
        functions.fill(scores, values, jacobian, designs, nodes, squares, tangents, bounds)
    return values, jacobian


def _rows(slopes: Real, row: Integer) -> Real:
    """Return rows (p, s, v) of derivatives, as they are where these are the first in order."""
    return slopes[:, : row.size] if (row == np.arange(row.size)).all() else slopes[:, row]


@lru_cache(maxsize=32)
def _plan(scores: Scores, nodes: Nodes) -> tuple[list[Wanted], Integer, list[list[int]]]:
    """Return what is wanted in each case, the row (s,) of each score, and mean squares alone, in the last rows."""
    combined, row = _combinations(scores.kernel(nodes))
    alone = [_of_functions(scores, c) for c in range(len(scores.cases))]
    return [_with_rows(*each) for each in zip(combined, alone, strict=True)], row, alone


def _combinations(kernel: Kernel) -> tuple[list[Wanted], Integer]:
    """Return the different combinations of mean squares in scores by case, and the one (s,) of each score."""
    keys = np.concatenate([*kernel.squares, kernel.worst_term[:, None]], axis=1)
    _, first, row = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    order = first.argsort()  # as they come: derivatives of different scores need no copy
    first, row = first[order], order.argsort()[row.ravel()]
    return [Wanted(squares[first], kernel.worst_term[first]) for squares in kernel.squares], row


def _of_functions(scores: Scores, case: int) -> list[int]:
    """Return the mean squares of a case that measures by a function ask for."""
    measures = (scores.scores[column].cases[case] for column in scores.functions)
    terms = {term.integral: None for one in measures for term in one.terms}
    return [scores.terms[case].index(term) for term in terms]


def _with_rows(wanted: Wanted, alone: Sequence[int]) -> Wanted:
    """Return what is wanted, and then some mean squares alone."""
    unit = np.eye(wanted.factor.shape[1])[list(alone)]
    factor = np.concatenate([wanted.factor, unit.reshape(len(alone), wanted.factor.shape[1])])
    return Wanted(factor, np.append(wanted.largest, np.zeros(len(alone), dtype=bool)))


def _total(kernel: Kernel, squares: list[Real], slopes: list[Real]) -> Real:
    """Return the derivatives (p, s, v) of the mean by shares, or of the worst case, by those of each case."""
    if len(squares) == 1:
        return slopes[0]
    mean = np.tensordot(kernel.shares, slopes, 1)
    if not kernel.worst_case.any():
        return np.asarray(mean)
    by_case = np.array([kernel.squares_in(c, found) for c, found in enumerate(squares)])
    worst = (by_case >= (1.0 - TIED) * by_case.max(axis=0)).argmax(axis=0).T[None, :, :, None]
    return np.where(kernel.worst_case[:, None], np.take_along_axis(np.array(slopes), worst, 0)[0], mean)

"""Derivatives of objectives and constraints, from those of the mean squares of every load case."""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from ...quantities import Bool, Integer, Real
from ..kernel import Kernel
from ..mean_squares import Nodes
from ..scores import Scores, reached
from ..shared_plants import squares_by_case
from . import functions
from .cases import with_slopes
from .shared_plants import joined, of_struts, slopes_by_case
from .wanted import TIED, Wanted


class _Plan(NamedTuple):
    """What is to be differentiated of the mean squares."""

    wanted: list[Wanted]  # by group of cases that share a plant
    row: Integer  # (s,), the combination of each score
    alone: list[list[int]]  # by case, mean squares of functions, which follow the combinations


def with_jacobian(scores: Scores, designs: Real, nodes: Nodes, bounds: tuple[Real, Real]) -> tuple[Real, Real]:
    """Return the scores (p, s) of designs (p, v), and their derivatives (p, s, v) by the variables.

    Of the largest of terms or load cases it is that of the largest one, of equal ones that of the first, of a mean
    square of 0 it is 0. Measures by a function are differentiated by `functions` within the lower and upper bounds
    (v,).
    """
    kernel, row = scores.kernel(nodes), _plan(scores, nodes).row
    squares, worst, slopes = _by_case(scores, designs, nodes)
    values = np.empty((kernel.scale.size, len(designs))).T
    scores.fill_roots(values.T, squares, designs, nodes)
    root = (values - kernel.offset) / kernel.scale
    half = 0.5 * kernel.scale / np.where(root > 0, root, np.inf)
    jacobian = _total(kernel, worst, [_rows(each, row) for each in slopes])
    jacobian *= half[:, :, None]
    if not scores.compiled:
        tangents = [np.zeros((*found.shape, designs.shape[1])) for found in squares]
        for tangent, own, each in zip(tangents, _plan(scores, nodes).alone, slopes, strict=True):
            tangent[:, own] = each[:, each.shape[1] - len(own) :]
        functions.fill(scores, values, jacobian, designs, nodes, squares, tangents, bounds)
    return values, jacobian


def _by_case(scores: Scores, designs: Real, nodes: Nodes) -> tuple[list[Real], Integer, list[Real]]:
    """Return the mean squares (p, k) by case, the worst cases (p, s), and derivatives (p, s, v) by case."""
    kernel, plan, groups = scores.kernel(nodes), _plan(scores, nodes), scores.groups(nodes)
    if of_struts(groups):
        squares = [reached(found, designs) for found in squares_by_case(groups, designs)]
        worst = _worst_cases(kernel, squares)
        counted = [_counted(kernel, plan, worst, case) for case in range(len(squares))]
        return squares, worst, slopes_by_case(groups, plan.wanted, designs, squares, counted)
    pairs = [with_slopes(case, each, designs) for (case, _), each in zip(groups, plan.wanted, strict=True)]
    squares = [reached(found, designs) for found, _ in pairs]
    return squares, _worst_cases(kernel, squares), [slopes for _, slopes in pairs]


def _rows(slopes: Real, row: Integer) -> Real:
    """Return rows (p, s, v) of derivatives, as they are where these are the first in order."""
    return slopes[:, : row.size] if (row == np.arange(row.size)).all() else slopes[:, row]


@lru_cache(maxsize=32)
def _plan(scores: Scores, nodes: Nodes) -> _Plan:
    """Return what is to be differentiated."""
    combined, row = _combinations(scores.kernel(nodes))
    alone = [_of_functions(scores, c) for c in range(len(scores.cases))]
    wanted = [_with_rows(*each) for each in zip(combined, alone, strict=True)]
    terms = [len(each) for each in scores.terms]
    groups = [[(wanted[c], terms[c]) for c in group.numbers] for group in scores.groups(nodes)]
    return _Plan([joined(group) for group in groups], row, alone)


def _combinations(kernel: Kernel) -> tuple[list[Wanted], Integer]:
    """Return the different combinations of mean squares in scores by case, and the one (s,) of each score."""
    keys = np.concatenate([*kernel.squares, kernel.worst_term[:, None]], axis=1)
    _, first, row = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    order = first.argsort()  # as they come: derivatives of different scores need no copy
    first, row = first[order], order.argsort()[row.ravel()]
    several = (np.count_nonzero(kernel.squares, axis=2) > 1).any(axis=0)  # the largest of one needs no search
    largest = (kernel.worst_term & several)[first]
    return [Wanted(squares[first], largest) for squares in kernel.squares], row


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


def _worst_cases(kernel: Kernel, squares: list[Real]) -> Integer:
    """Return the load case (p, s) of the largest squares, of equal ones the first, and the first of means."""
    if len(squares) == 1 or not kernel.worst_case.any():
        return np.zeros((len(squares[0]), kernel.scale.size), dtype=np.int64)
    by_case = np.array([kernel.squares_in(c, found) for c, found in enumerate(squares)])
    return np.asarray((by_case >= (1.0 - TIED) * by_case.max(axis=0)).argmax(axis=0).T)


def _counted(kernel: Kernel, plan: _Plan, worst: Integer, case: int) -> Bool:
    """Return which combinations (p, s) and then mean squares alone count in a load case, by the worst cases."""
    combinations = int(plan.row.max()) + 1
    counted = np.ones((len(worst), combinations + len(plan.alone[case])), dtype=bool)
    counted[:, :combinations] = False
    for score, combination in enumerate(plan.row):
        counted[:, combination] |= (worst[:, score] == case) | ~kernel.worst_case[score]
    return counted


def _total(kernel: Kernel, worst: Integer, slopes: list[Real]) -> Real:
    """Return the derivatives (p, s, v) of means by shares or of worst cases (p, s), by those of each case."""
    if len(slopes) == 1:
        return slopes[0]
    mean = np.tensordot(kernel.shares, slopes, 1)
    if not kernel.worst_case.any():
        return np.asarray(mean)
    of_worst = np.take_along_axis(np.array(slopes), worst[None, :, :, None], 0)[0]
    return np.where(kernel.worst_case[:, None], of_worst, mean)

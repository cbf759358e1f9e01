"""Derivatives of objectives and constraints, from those of the mean squares of every load case."""

from typing import NamedTuple

import numpy as np

from ...quantities import Integer, Real
from ..scores import Kernel, Scores, reached
from .cases import with_slopes
from .stencils import by_stencils
from .wanted import Wanted


class _Rows(NamedTuple):
    """What is wanted of the mean squares of each case, and the row of each score in it."""

    wanted: tuple[Wanted, ...]
    row: Integer  # (s,)


def with_jacobian(scores: Scores, designs: Real, nodes: int, bounds: tuple[Real, Real]) -> tuple[Real, Real]:
    """Return the scores (p, s) of designs (p, v), and their derivatives (p, s, v) by the variables.

    Of the largest of terms or load cases it is that of the largest one, of a mean square of 0 it is 0. Measures by
    a function are differentiated by `by_stencils` within the lower and upper bounds (v,).
    """
    kernel = scores.kernel(nodes)
    rows = _rows_of(kernel, not scores.compiled)
    pairs = [with_slopes(case, one, designs) for case, one in zip(kernel.cases, rows.wanted, strict=True)]
    squares = [reached(found, designs) for found, _ in pairs]
    values = kernel.scores(squares)
    root = (values - kernel.offset) / kernel.scale
    half = np.divide(0.5 * kernel.scale, root, out=np.zeros_like(root), where=root > 0)
    jacobian = half[:, :, None] * _total(kernel, squares, [slopes[:, rows.row] for _, slopes in pairs])
    if not scores.compiled:
        tangents = [slopes[:, rows.row.max() + 1 :] for _, slopes in pairs]
        scores.fill_functions(values, designs, nodes, squares)
        found = by_stencils(scores, designs, nodes, squares, tangents, values, bounds)
        by_function = [score.by_function for score in scores.scores]
        jacobian[:, by_function] = found[:, by_function]
    return values, jacobian


def _rows_of(kernel: Kernel, each: bool) -> _Rows:
    """Return the different combinations of mean squares in scores, then `each` alone if asked for."""
    keys = np.concatenate([*kernel.squares, kernel.worst_term[:, None]], axis=1)
    _, first, row = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    alone = np.eye(kernel.squares.shape[2] if each else 0, kernel.squares.shape[2])
    largest = np.append(kernel.worst_term[first], np.zeros(len(alone), dtype=bool))
    wanted = (Wanted(np.concatenate([squares[first], alone]), largest) for squares in kernel.squares)
    return _Rows(tuple(wanted), row.ravel())


def _total(kernel: Kernel, squares: list[Real], slopes: list[Real]) -> Real:
    """Return the derivatives (p, s, v) of the mean by shares, or of the worst case, by those of each case."""
    if len(squares) == 1:
        return slopes[0]
    mean = np.tensordot(kernel.shares, slopes, 1)
    if not kernel.worst_case.any():
        return np.asarray(mean)
    by_case = np.array([kernel.squares_in(c, found) for c, found in enumerate(squares)])
    worst = by_case.argmax(axis=0).T[None, :, :, None]
    return np.where(kernel.worst_case[:, None], np.take_along_axis(np.array(slopes), worst, 0)[0], mean)

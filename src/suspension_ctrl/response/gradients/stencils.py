"""Derivatives of measures by a function of designs: differences of fourth order along the exact tangent.

A function gets the mean squares of its terms on straight lines through a design, with their exact derivatives:
what depends on these alone is differentiated nearly to rounding. All else it gets at the designs of a stencil,
inside the bounds.
"""

from collections.abc import Sequence

import numpy as np

from ...quantities import Real
from ..mean_squares import Nodes
from ..scores import Scores

_STEP = 2e-3  # of a value: the error, h^4 f^(5)/30, is some 1e-10 of the derivative of a power
_LEAST = 1e-3  # of the range, the least value by which a step is measured
_MOST = 0.1  # of the range: four steps to one side fit in
_POINTS = np.array([[-2.0, -1.0, 1.0, 2.0], [1.0, 2.0, 3.0, 4.0], [-1.0, -2.0, -3.0, -4.0]])  # steps
_WEIGHTS = np.array([[1.0, -8.0, 8.0, -1.0], [48.0, -36.0, 16.0, -3.0], [-48.0, 36.0, -16.0, 3.0]]) / 12
_HERE = np.array([0.0, -25.0, 25.0]) / 12  # weight of the value at the design


def by_stencils(
    scores: Scores,
    columns: Sequence[int],
    designs: Real,
    nodes: Nodes,
    squares: Sequence[Real],
    tangents: Sequence[Real],
    values: Real,
    bounds: tuple[Real, Real],
) -> Real:
    """Return the derivatives (p, f, v) of the measures in some columns.

    Of each load case are given the mean squares (p, k) and their derivatives (p, k, v), of the measures the values
    (p, s) at the designs (p, v) within lower and upper bounds (v,). All designs are evaluated at once.
    """
    step, side = _steps(designs, *bounds)
    by = np.moveaxis(_POINTS[side], 2, 0) * step  # (4, p, v)
    points, (p, v) = len(by), designs.shape
    moved = np.broadcast_to(designs[:, None], (points, p, v, v)) + np.eye(v) * by[..., None]
    lines = [
        (found[:, None] + by[..., None] * tangent.swapaxes(1, 2)).reshape(-1, found.shape[1])
        for found, tangent in zip(squares, tangents, strict=True)
    ]
    found = np.zeros((by.size, values.shape[1]))
    scores.fill_functions(found, moved.reshape(-1, v), nodes, lines, columns)
    each = found[:, columns].reshape(points, p, v, len(columns))
    sums = np.einsum("ipvf,pvi->pfv", each, _WEIGHTS[side])
    return np.asarray((sums + _HERE[side][:, None] * values[:, columns, None]) / step[:, None])


def _steps(designs: Real, lower: Real, upper: Real) -> tuple[Real, np.ndarray]:
    """Return steps (p, v), and which stencil is within the bounds: 0 on both sides, 1 above, 2 below a design."""
    width = upper - lower
    step = np.minimum(_STEP * np.maximum(np.abs(designs), _LEAST * width), _MOST * width)
    step = np.where(width > 0, step, _STEP * np.where(designs == 0, 1.0, np.abs(designs)))  # of a variable held
    inside = (designs - 2 * step >= lower) & (designs + 2 * step <= upper) | (width == 0)
    return step, np.where(inside, 0, np.where(designs - lower < upper - designs, 1, 2))

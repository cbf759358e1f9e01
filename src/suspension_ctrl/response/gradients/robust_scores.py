"""Derivatives of scores over a scatter: those of the samples with the weights of their ranks."""

import numpy as np

from ...quantities import Real
from ..mapped import slopes_of
from ..robust_scores import RobustScores
from .scores import with_jacobian

_ROWS = 1 << 12  # samples of designs in one call


def over_scatter(
    robust: RobustScores, values: Real, jacobian: Real, designs: Real, nodes: int
) -> tuple[Real, Real]:
    """Return scores (p, m) and derivatives (p, m, d) with those over the scatter in their columns.

    A sorted value keeps its weight: where two samples have equal values a quantile has a kink.
    """
    values, jacobian, column = values.copy(), jacobian.copy(), robust.statistics.column
    step = max(1, _ROWS // robust.statistics.weight.shape[1])
    for first in range(0, len(designs), step):
        part = slice(first, first + step)
        values[part, column], jacobian[part, column] = _of_samples(robust, designs[part], nodes)
    return values, jacobian


def _of_samples(robust: RobustScores, designs: Real, nodes: int) -> tuple[Real, Real]:
    """Return scores (p, r) over the scatter and their derivatives (p, r, d)."""
    scattered, statistics = robust.scattered.scattered, robust.statistics
    samples, (p, d) = scattered.designs(designs), designs.shape
    bounds = samples.min(axis=0, initial=np.inf), samples.max(axis=0, initial=-np.inf)
    found, slopes = with_jacobian(robust.scattered.scores, samples, nodes, bounds)
    by_values = statistics.sign[:, None] * slopes.reshape(p, -1, *slopes.shape[1:])  # (p, s, r, v)
    by_design = (by_values * scattered.factors[:, None, :]) @ slopes_of(scattered.formulas, designs)[:, None]
    each = np.moveaxis(statistics.sign * found.reshape(p, -1, statistics.sign.size), 1, 2)  # (p, r, s)
    weight = np.empty_like(each)
    np.put_along_axis(weight, each.argsort(axis=2), np.broadcast_to(statistics.weight, each.shape), axis=2)
    jacobian = statistics.scale[:, None] * np.einsum("prs,psrd->prd", weight, by_design)
    return statistics.of(each), jacobian.reshape(p, -1, d)

"""Scores and derivatives of many designs, those over a scatter too, in blocks on threads."""

import numpy as np

from ...quantities import Real
from ..mean_squares import Nodes
from ..scoring import Scoring
from .robust_scores import over_scatter
from .scores import with_jacobian


def differentiated(
    scoring: Scoring, designs: Real, rules: Nodes, nodes: int, bounds: tuple[Real, Real], threads: int
) -> tuple[Real, Real]:
    """Return the scores (p, s) of designs (p, v) within bounds (v,) and their derivatives (p, s, v).

    Those of the nominal vehicle are by `rules`, those over a scatter by `nodes`. Functions of users are called on
    this thread alone.
    """
    scores, robust = scoring.scores, scoring.robust

    def found(part: slice) -> tuple[Real, Real]:
        plain = with_jacobian(scores, designs[part], rules, bounds)
        return over_scatter(robust, *plain, designs[part], nodes) if robust else plain

    compiled = scores.compiled and (robust is None or robust.scattered.scores.compiled)
    samples = 1 if robust is None else robust.statistics.weight.shape[1]
    parts = scores.in_blocks(found, len(designs), rules, threads if compiled else 1, samples)
    if len(parts) == 1:
        return parts[0]
    values, jacobian = map(np.concatenate, zip(*parts, strict=True))
    return values, jacobian

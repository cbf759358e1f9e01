"""Derivatives of measures by a function of designs: exact where the measure has them, else by differences."""

from collections.abc import Sequence

import numpy as np

from ...quantities import Real
from ..measures.terms import Designs
from ..scores import Score, Scores
from .stencils import by_stencils


def fill_slopes(
    scores: Scores,
    jacobian: Real,
    designs: Real,
    nodes: int,
    squares: Sequence[Real],
    tangents: Sequence[Real],
    values: Real,
    bounds: tuple[Real, Real],
) -> None:
    """Fill in the derivatives (p, s, v) of measures by functions, of designs (p, v) with values (p, s).

    Mean squares (p, k), their derivatives (p, k, v) by load case, and bounds (v,) are as of `by_stencils`.
    """
    exact = [column for column in scores.functions if is_exact(scores.scores[column])]
    others = [column for column in scores.functions if column not in exact]
    if others:
        jacobian[:, others] = by_stencils(scores, others, designs, nodes, squares, tangents, values, bounds)
    by_case = scores.in_cases(designs, nodes, squares) if exact else []
    for column in exact:
        jacobian[:, column] = _slopes(scores, scores.scores[column], by_case)


def is_exact(score: Score) -> bool:
    """Whether a measure has exact derivatives in all load cases."""
    return all(one.slopes for one in score.cases)


def _slopes(scores: Scores, score: Score, by_case: Sequence[Designs]) -> Real:
    """Return the derivatives (p, v) of a score, the mean by shares or the worst, by those in each case."""
    values = np.array([one.values(each) for one, each in zip(score.cases, by_case, strict=True) if one.values])
    slopes = np.array(
        [
            one.slopes(each)[:, scores.varying(c)]
            for c, (one, each) in enumerate(zip(score.cases, by_case, strict=True))
            if one.slopes
        ]
    )
    if score.worst_case:
        worst = (np.sign(score.scale) * values).argmax(axis=0)
        return np.asarray(score.scale * np.take_along_axis(slopes, worst[None, :, None], axis=0)[0])
    power = score.cases[0].power
    root = np.tensordot(scores.shares, values**power, 1) ** (1 / power - 1)
    summed = np.tensordot(scores.shares, values[..., None] ** (power - 1) * slopes, 1)
    return np.asarray(score.scale * root[:, None] * summed)

"""Derivatives of measures by a function of designs: exact where the measure has them, else by differences."""

from collections.abc import Sequence

import numpy as np

from ...quantities import Real
from ..mean_squares import Nodes
from ..measures.terms import Designs
from ..scores import Score, Scores
from .stencils import by_stencils


def fill(
    scores: Scores,
    values: Real,
    jacobian: Real,
    designs: Real,
    nodes: Nodes,
    squares: Sequence[Real],
    tangents: Sequence[Real],
    bounds: tuple[Real, Real],
) -> None:
    """Fill in values (p, s) and derivatives (p, s, v) of measures by functions of designs (p, v).

    Mean squares (p, k), their derivatives (p, k, v) by load case, and bounds (v,) are as of `by_stencils`.
    """
    exact = [column for column in scores.functions if _is_exact(scores.scores[column])]
    by_case = scores.in_cases(designs, nodes, squares) if exact else []
    for column in exact:
        values[:, column], jacobian[:, column] = _with_slopes(scores, scores.scores[column], by_case)
    others = [column for column in scores.functions if column not in exact]
    scores.fill_functions(values, designs, nodes, squares, others)
    if others:
        jacobian[:, others] = by_stencils(scores, others, designs, nodes, squares, tangents, values, bounds)


def _is_exact(score: Score) -> bool:
    """Whether a measure has exact derivatives in all load cases."""
    return all(one.with_slopes for one in score.cases)


def _with_slopes(scores: Scores, score: Score, by_case: Sequence[Designs]) -> tuple[Real, Real]:
    """Return a score (p,), the mean by shares or the worst, and its derivatives (p, v)."""
    functions = [one.with_slopes for one in score.cases if one.with_slopes]
    pairs = [function(designs) for function, designs in zip(functions, by_case, strict=True)]
    values = np.array([each for each, _ in pairs])
    slopes = np.array([own[:, one.places] for one, (_, own) in zip(scores.evaluated, pairs, strict=True)])
    joined = scores.joined(score, values)
    if score.worst_case:
        worst = (np.sign(score.scale) * values).argmax(axis=0)
        found = np.take_along_axis(slopes, worst[None, :, None], axis=0)[0]
    else:
        power = score.cases[0].power
        summed = np.tensordot(scores.shares, values[..., None] ** (power - 1) * slopes, 1)
        found = joined[:, None] ** (1 - power) * summed
    return score.scale * joined + score.offset, score.scale * found

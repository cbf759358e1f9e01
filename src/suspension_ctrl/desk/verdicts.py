"""Measures and limits of a design beside those of the present one."""

from collections.abc import Mapping
from math import nan
from typing import NamedTuple

import numpy as np

from ..response.problem import RideProblem
from .candidate_table import changes_of, reaching


class Judged(NamedTuple):
    """A measure of a design, or the measure of a limit in the worst load case; NaN where there is no value."""

    name: str
    unit: str
    value: float
    present: float
    change: float  # %, against the present design
    limit: str  # "met", "not met", "" of an objective


def judged(problem: RideProblem, design: Mapping[str, float], present: Mapping[str, float]) -> list[Judged]:
    """Return all objectives and limits of a design; `present` may be empty."""
    values, before = measured(problem, design), measured(problem, present) if present else {}
    units = {one.label: one.unit for one in problem.measures}
    units |= {str(one): one.measure.unit for one in problem.constraints}
    verdicts = {
        str(one): "met" if one.scale * values[str(one)] + one.offset <= 0 else "not met"
        for one in problem.constraints
    }
    return [
        Judged(name, units[name], value, was, float(changes_of(value, was)), verdicts.get(name, ""))
        for name, value in values.items()
        for was in [before.get(name, nan)]
    ]


def measured(problem: RideProblem, design: Mapping[str, float]) -> dict[str, float]:
    """Return the objectives of a design, then the measures of limits in the worst load case, by name."""
    row = np.array(list(design.values()))
    values = reaching(problem, row).evaluate(row[None])[0].tolist()
    m = len(problem.measures)
    found = {one.label: one.sign * value for one, value in zip(problem.measures, values[:m], strict=True)}
    limits = zip(problem.constraints, values[m:], strict=True)
    return found | {str(one): (value - one.offset) / one.scale for one, value in limits}

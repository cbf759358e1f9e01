"""Section 8: values with the derivatives by all variables, over values alone, of the same designs."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

import suspension_ctrl as sc
from sections import struts
from sections.timing import Prepare, take_turns

BAR = 3.0
"""Largest ratio to hold."""
STUDY, HANDLING = "full_car with limits on travel and tyre load", "full_car"
VALUES, BOTH = "values", "values and derivatives"
LIMIT, LEAST = 60.0, 0.02
"""Seconds: of a call after which there is no other, and up to which calls are repeated within one timing."""


class Row(NamedTuple):
    """A case, its vehicle, and its strut in `struts.problems` or its study."""

    case: str
    vehicle: str
    source: str


ROWS = (
    Row("quarter car", struts.QUARTER, struts.DEFAULT),
    Row("quarter car, damper on a mount", struts.QUARTER, "damper on a mount"),
    Row("quarter car, damper by a measured table", struts.QUARTER, "damper by a measured table of 13 rows"),
    Row("full car", struts.FULL, struts.DEFAULT),
    Row("full car, dampers on mounts", struts.FULL, "dampers on mounts"),
    Row("full car, dampers by measured tables", struts.FULL, "two dampers by measured tables"),
    Row("full car, 8 variables, 2 limits, 3 load cases", struts.FULL, STUDY),
    Row("the same with a limit on roll, by a function", struts.FULL, HANDLING),
    Row("semitrailer", struts.TRUCK, "springs, dampers of two axles"),
)


def problems(nodes: int) -> dict[str, sc.RideProblem]:
    """Return a problem by case."""
    study = sc.load_study("full_car").problem
    known = {(struts.FULL, HANDLING): study, **struts.problems(nodes)}
    known[struts.FULL, STUDY] = study.replace(constraints=["SWS <= 0.012", "DTL <= 1500"])
    return {row.case: known[row.vehicle, row.source] for row in ROWS}


def measure(nodes: int, designs: dict[str, int], repeats: int, cases: Sequence[str]) -> pd.DataFrame:
    """Return one row per timed call of the cases: case, what, designs, repeat, seconds, cpu_seconds."""
    entries, keys = dict[str, Prepare](), dict[str, tuple[str, str, int]]()
    known = problems(nodes)
    for row in (one for one in ROWS if one.case in cases):
        problem = known[row.case]
        count = designs[row.vehicle]
        drawn = np.random.default_rng(1).uniform(problem.lower, problem.upper, (count, len(problem.lower)))
        for what in (VALUES, BOTH):
            keys[f"{row.case}, {what}"] = row.case, what, count
            entries[f"{row.case}, {what}"] = _entry(problem, what, drawn)
    found = pd.DataFrame(take_turns(entries, repeats, LIMIT, least=LEAST))
    cases, whats, counts = zip(*found.pop("contender").map(keys), strict=True)
    return found.assign(case=cases, what=whats, designs=counts)


def _entry(problem: sc.RideProblem, what: str, drawn: np.ndarray) -> Prepare:
    """Return the call of a problem to be timed."""
    method = problem.evaluate if what == VALUES else problem.with_jacobian
    return lambda _: lambda: method(drawn)


def ratios(timings: pd.DataFrame) -> pd.DataFrame:
    """Return by case the least processor time per design [s] of values and of both, and their ratio."""
    least = (timings.cpu_seconds / timings.designs).groupby([timings.case, timings.what]).min()
    rows = [(case, least[case, VALUES], least[case, BOTH]) for case in timings.case.unique()]
    table = pd.DataFrame(rows, columns=["case", "values", "both"])
    return table.assign(ratio=table.both / table["values"])


def goals(timings: pd.DataFrame) -> list[tuple[str, float, float]]:
    """Return what is to hold: what, largest ratio, and the one measured."""
    found = ratios(timings)
    return [(f"derivatives, {case}", BAR, ratio) for case, ratio in zip(found.case, found.ratio, strict=True)]

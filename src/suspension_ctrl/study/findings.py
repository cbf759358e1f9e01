"""Results of a comparison over many seeds: medians, differences, effort to a target, verdict."""

from collections.abc import Sequence
from typing import NamedTuple

import pandas as pd

from . import inference, lenses
from .comparison import CONFIGURATION, Comparison
from .study import CUT_ARCHIVE, INDICATORS, POPULATION

SETS = {"final population": POPULATION, "archive cut to N": CUT_ARCHIVE}


class Findings(NamedTuple):
    """Tables of the finished runs and the verdict on the first two algorithms."""

    course: pd.DataFrame  # a row per run, budget and set, from `lenses.with_seconds`
    equal: pd.DataFrame  # rows at equal iterations, evaluations and time, from `lenses.at_equal`
    medians: pd.DataFrame  # a row per configuration, lens, set and algorithm
    differences: pd.DataFrame  # of every two algorithms, from `inference.pairwise`
    reached: pd.DataFrame  # evaluations and seconds to the target, from `lenses.to_reach`
    verdict: list[str]  # a paragraph per set


def findings(comparison: Comparison, table: pd.DataFrame, clock: pd.DataFrame, target: float) -> Findings | None:
    """Return the findings from `Study.table` and `timing.seconds_by_evaluations`, None if all runs raised."""
    ended = table[table.error.eq("")].drop(columns="error")
    if ended.empty:
        return None
    course = lenses.with_seconds(ended, clock)
    equal = lenses.at_equal(course, comparison.iterations, comparison.cost())
    by = ["lens", *CONFIGURATION, "set", "algorithm"]
    spent = equal.groupby(by, sort=False)[["evaluations", "seconds"]].median().reset_index()
    differences = inference.pairwise(equal, by[:-1], INDICATORS, comparison.algorithms)
    medians = spent.merge(inference.quartiles(equal, by, INDICATORS), on=by)
    verdict = _verdict(differences, comparison.algorithms[:2])
    return Findings(course, equal, medians, differences, lenses.to_reach(course, target), verdict)


def _verdict(differences: pd.DataFrame, algorithms: Sequence[str]) -> list[str]:
    if differences.empty:
        return []
    first, second = algorithms
    judged = differences[differences.value == "relative_hypervolume"]
    return [
        inference.verdict(judged[judged.set == chosen], first, second, f"Hypervolume of the {words}")
        for words, chosen in SETS.items()
    ]


def last_rows(table: pd.DataFrame) -> pd.DataFrame:
    """Return a row per run, of its final population or its error, in the columns of the timed runs."""
    ends = table[table.error.ne("") | table.set.eq(POPULATION)]
    last = ends.groupby(["population", "algorithm", "seed"], sort=False).tail(1)
    return last.drop(columns=["set", "members", "budget"]).assign(timing=False)

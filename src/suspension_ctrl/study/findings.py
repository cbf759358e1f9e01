"""Findings of a comparison over many seeds: medians at what is held equal, differences, the target, a verdict."""

from collections.abc import Sequence
from dataclasses import dataclass

import pandas as pd

from . import inference, lenses
from .comparison import Comparison
from .study import CUT_ARCHIVE, INDICATORS, POPULATION

CONFIGURATION = ("lens", "population", "iterations")
SETS = {"final population": POPULATION, "archive cut to N": CUT_ARCHIVE}


@dataclass(frozen=True)
class Findings:
    """Tables of the runs that ended.

    Parameters
    ----------
    course : DataFrame
        A row per run, budget and set, with the seconds that its evaluations take when timed.
    equal : DataFrame
        Its rows at equal iterations, evaluations and time, from `lenses.at_equal`.
    medians : DataFrame
        A row per configuration, lens, set and algorithm.
    differences : DataFrame
        Of every two algorithms, from `inference.pairwise`.
    reached : DataFrame
        Evaluations and seconds to the target, from `lenses.reached_by`.
    verdict : list of str
        The first two algorithms in words, a paragraph per set.
    """

    course: pd.DataFrame
    equal: pd.DataFrame
    medians: pd.DataFrame
    differences: pd.DataFrame
    reached: pd.DataFrame
    verdict: list[str]


def findings(comparison: Comparison, table: pd.DataFrame, clock: pd.DataFrame, target: float) -> Findings | None:
    """Return the findings of runs over many seeds, None if none of them ended.

    Parameters
    ----------
    comparison : Comparison
    table : DataFrame
        From `Study.table`, of all populations.
    clock : DataFrame
        From `timing.seconds_by_evaluations`.
    target : float
        Share of the reference front's hypervolume [-].
    """
    ended = table[table.error.eq("")].drop(columns="error")
    if ended.empty:
        return None
    course = lenses.with_seconds(ended, clock)
    equal = lenses.at_equal(course, comparison.algorithms, comparison.iterations, comparison.cost())
    by = [*CONFIGURATION, "set", "algorithm"]
    spent = equal.groupby(by, sort=False)[["evaluations", "seconds"]].median().reset_index()
    differences = inference.pairwise(equal, [*CONFIGURATION, "set"], INDICATORS, comparison.algorithms)
    return Findings(
        course,
        equal,
        spent.merge(inference.quartiles(equal, by, INDICATORS), on=by),
        differences,
        lenses.reached_by(lenses.to_reach(course, target)),
        _verdict(differences, comparison.algorithms[:2]),
    )


def _verdict(differences: pd.DataFrame, algorithms: Sequence[str]) -> list[str]:
    if differences.empty:
        return []
    first, second = algorithms
    judged = differences[differences.value == "relative_hypervolume"]
    return [
        inference.verdict(judged[judged.set == chosen], first, second, f"Hypervolume of the {words}")
        for words, chosen in SETS.items()
    ]

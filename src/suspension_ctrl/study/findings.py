"""Results of a comparison over many seeds: medians, differences, effort to a target, verdict."""

from collections.abc import Sequence
from typing import NamedTuple

import pandas as pd

from . import inference, lenses
from .comparison import CONFIGURATION, Comparison
from .judging import CUT_ARCHIVE, INDICATORS, POPULATION

SETS = {"final population": POPULATION, "archive cut to N": CUT_ARCHIVE}


class Findings(NamedTuple):
    """Tables of the finished runs and the verdict on the first two algorithms."""

    course: pd.DataFrame  # a row per run, budget and set, from `lenses.with_seconds`
    equal: pd.DataFrame  # rows at equal iterations, evaluations and time, from `lenses.at_equal`
    medians: pd.DataFrame  # a row per configuration, lens, set and algorithm
    differences: pd.DataFrame  # of every two algorithms, from `inference.pairwise`
    reached: pd.DataFrame  # evaluations and seconds to the target, from `lenses.to_reach`
    verdict: pd.DataFrame  # the algorithm that is ahead, the first or each other, by lens; empty of too few runs
    words: list[str]  # the verdict on the first two algorithms, a paragraph per set; or why there is none


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
    verdict, words = _verdict(differences, comparison.algorithms)
    return Findings(course, equal, medians, differences, lenses.to_reach(course, target), verdict, words)


def _verdict(differences: pd.DataFrame, algorithms: Sequence[str]) -> tuple[pd.DataFrame, list[str]]:
    """Return table and words of the verdict."""
    if differences.empty:
        return differences, []
    first, second, *_ = algorithms
    rows = differences[differences.value.eq("relative_hypervolume") & differences["first"].eq(first)]
    judged = inference.verdict(rows[rows.set.isin(SETS.values())])
    if judged.ahead.eq(inference.TOO_FEW).all():
        return judged.iloc[:0], [_too_few(differences)]
    about = {words: judged[judged.set == chosen] for words, chosen in SETS.items()}
    return _by_lens(judged), [
        inference.in_words(part, first, second, f"Hypervolume of the {words}") for words, part in about.items()
    ]


def _by_lens(judged: pd.DataFrame) -> pd.DataFrame:
    """Return a row per set, configuration and other algorithm, with a column per lens: who is ahead."""
    rows = ["set", *CONFIGURATION, "second"]
    table = judged.pivot_table("ahead", rows, "lens", "first", sort=False).reset_index()
    return table.rename(columns={"second": "other"}).rename_axis(columns=None)


def _too_few(differences: pd.DataFrame) -> str:
    """Return how many runs a verdict needs."""
    most, tests = differences.p_holm_least.argmin(), len(differences)
    first, second = differences[["runs_first", "runs_second"]].to_numpy()[most].tolist()
    least = inference.least_p(first, second)
    return (
        f"No verdict: {first} runs against {second} cannot differ significantly. Their least p "
        f"is {least:.2g}, and Holm's method multiplies it by the {tests} tests of pairs, configurations, lenses, "
        f"sets and indicators. It takes {inference.runs_needed(tests)} seeds."
    )


def last_rows(table: pd.DataFrame) -> pd.DataFrame:
    """Return a row per run, of its final population or its error, in the columns of the timed runs."""
    ends = table[table.error.ne("") | table.set.eq(POPULATION)]
    last = ends.groupby(["population", "algorithm", "seed"], sort=False).tail(1)
    return last.drop(columns=["set", "members", "budget"]).assign(timing=False)

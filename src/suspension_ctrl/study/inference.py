"""Rank tests, effect sizes and bootstrap intervals over repeated runs, and their verdict in words."""

from collections.abc import Sequence
from functools import cache, lru_cache
from itertools import combinations, count, product
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from ..checks import installed
from ..quantities import Integer, Real

SIGNIFICANCE, CONFIDENCE, RESAMPLES = 0.05, 0.95, 9999
EXACT = 20
"""Largest size of the smaller sample of an exact rank test."""
NO_DIFFERENCE, TOO_FEW = "no difference", "too few runs"
"""Outcomes of a verdict in place of the algorithm that is ahead."""


def quartiles(table: pd.DataFrame, by: Sequence[str], values: Sequence[str]) -> pd.DataFrame:
    """Return runs (rows), median ``<value>`` and quartiles ``<value> q1``, ``<value> q3`` of values by group."""
    groups = table.groupby(list(by), sort=False)
    columns: dict[str, Any] = {"runs": groups.size()}
    for value in values:
        columns[value] = groups[value].median()
        for name, q in (("q1", 0.25), ("q3", 0.75)):
            higher = groups[value].quantile(q, interpolation="higher")  # inf - inf has no mean
            columns[f"{value} {name}"] = groups[value].quantile(q).where(np.isfinite(higher), higher)
    return pd.DataFrame(columns).reset_index()


def a12(first: ArrayLike, second: ArrayLike) -> float:
    """Return the probability that a value of the first sample exceeds one of the second, ties count half [-].

    A. Vargha and H. D. Delaney, "A critique and improvement of the CL common language effect size statistics of
    McGraw and Wong", Journal of Educational and Behavioral Statistics 25(2), 2000.
    """
    first, second = np.asarray(first, dtype=float)[:, np.newaxis], np.asarray(second, dtype=float)
    wins = np.count_nonzero(first > second) + np.count_nonzero(first == second) / 2
    return wins / (first.size * second.size)


def size_in_words(effect: float) -> str:
    """Return Vargha and Delaney's word for an A12: negligible, small (0.56), medium (0.64), large (0.71)."""
    distance = abs(effect - 0.5) + 1e-12  # 0.71 - 0.5 is a little less than 0.21 in binary
    words = {"large": 0.21, "medium": 0.14, "small": 0.06}
    return next((word for word, least in words.items() if distance >= least), "negligible")


def holm(p_values: ArrayLike) -> Real:
    """Return the p-values (n,) of n simultaneous tests, adjusted by Holm's method."""
    with installed("study"):
        from statsmodels.stats.multitest import multipletests

    return np.asarray(multipletests(p_values, method="holm")[1])


def ratio_of_medians(first: ArrayLike, second: ArrayLike, seed: int = 0) -> tuple[float, float, float]:
    """Return the ratio of the medians of two samples and its 95 % bootstrap interval, NaN where undefined.

    The interval is that of percentiles: other methods need the jackknife, which does not hold for quantiles.
    Samples of the same sizes share their draws, and the order of a sample does not matter.
    """
    first, second = np.sort(np.asarray(first, dtype=float)), np.sort(np.asarray(second, dtype=float))
    if not ((second > 0).all() and np.isfinite([*first, *second]).all()):
        return np.nan, np.nan, np.nan
    value = float(np.median(first) / np.median(second))
    if min(first.size, second.size) < 2:
        return value, np.nan, np.nan
    above, below = _middles(first.size, second.size, seed)
    ratios = first[above].mean(axis=0) / second[below].mean(axis=0)
    low, high = np.quantile(ratios, [(1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2])
    return value, float(low), float(high)


@lru_cache(maxsize=16)
def _middles(first: int, second: int, seed: int) -> tuple[Integer, Integer]:
    """Return the places (2, RESAMPLES) of the two middle values of resamples of sorted samples of two sizes.

    The median of a resample is their mean; of an odd size they are the same.
    """
    rng = np.random.default_rng(seed)
    drawn = [np.sort(rng.integers(0, size, (RESAMPLES, size)), axis=1) for size in (first, second)]
    above, below = (places[:, [(places.shape[1] - 1) // 2, places.shape[1] // 2]].T for places in drawn)
    return above, below


def rank_test(first: ArrayLike, second: ArrayLike) -> float:
    """Return p of the two-sided Mann-Whitney test: exact for small samples without ties, else asymptotic."""
    from scipy import stats

    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    tied = np.unique([*first, *second]).size < first.size + second.size
    exact = not tied and min(first.size, second.size) <= EXACT
    return float(stats.mannwhitneyu(first, second, method="exact" if exact else "asymptotic").pvalue)


@cache
def least_p(first: int, second: int) -> float:
    """Return the least p that samples of these sizes can have: all of one sample are beyond the other."""
    return rank_test(range(first), range(first, first + second))


def runs_needed(tests: int) -> int:
    """Return the least number of runs of each algorithm that can differ, adjusted by Holm for so many tests."""
    return next(runs for runs in count(2) if tests * least_p(runs, runs) < SIGNIFICANCE)


def pairwise(
    table: pd.DataFrame, by: Sequence[str], values: Sequence[str], algorithms: Sequence[str]
) -> pd.DataFrame:
    """Return a row per value, group of runs and pair of algorithms, with their comparison.

    Columns: value, `by`, first, second, numbers of runs, both medians, their ratio with its bootstrap interval
    (ratio, ratio_low, ratio_high), p by `rank_test`, a12 of the first over the second, effect, its size in words,
    p_holm adjusted for all tests of the table, and p_holm_least, the least that so many runs can have.
    """
    rows: list[dict[str, Any]] = []
    for value, (key, group) in product(values, list(table.groupby(list(by), sort=False))):
        samples = {name: group.loc[group.algorithm == name, value].dropna() for name in algorithms}
        for first, second in combinations(samples, 2):
            if samples[first].size and samples[second].size:
                pair = {"value": value, **dict(zip(by, key, strict=True)), "first": first, "second": second}
                rows.append(pair | _compared(samples[first], samples[second]))
    compared = pd.DataFrame(rows)
    if compared.empty:
        return compared
    least = [least_p(*sizes) for sizes in zip(compared.runs_first, compared.runs_second, strict=True)]
    return compared.assign(p_holm=holm(compared["p"]), p_holm_least=np.minimum(1, len(rows) * np.array(least)))


def _compared(first: "pd.Series[float]", second: "pd.Series[float]") -> dict[str, Any]:
    numbers = {"runs_first": first.size, "runs_second": second.size}
    medians = {"median_first": first.median(), "median_second": second.median()}
    ratios = dict(zip(("ratio", "ratio_low", "ratio_high"), ratio_of_medians(first, second), strict=True))
    effect = a12(first, second)
    p = rank_test(first, second)
    return {**numbers, **medians, **ratios, "p": p, "a12": effect, "effect": size_in_words(effect)}


def verdict(compared: pd.DataFrame) -> pd.DataFrame:
    """Return rows of `pairwise` of a value to be maximised with a column ``ahead``.

    It is the name of the algorithm that is ahead, `NO_DIFFERENCE` or `TOO_FEW`.
    """
    same = (compared.p_holm >= SIGNIFICANCE) | compared.effect.eq("negligible")
    ahead = compared["first"].where(compared.a12 > 0.5, compared["second"]).mask(same, NO_DIFFERENCE)
    return compared.assign(ahead=ahead.mask(compared.p_holm_least >= SIGNIFICANCE, TOO_FEW))


def in_words(judged: pd.DataFrame, first: str, second: str, value: str) -> str:
    """Return a paragraph that compares two algorithms, from the rows of `verdict`."""
    pairs = judged[(judged["first"] == first) & (judged["second"] == second)]
    if pairs.empty:
        return f"There are no runs of both {first} and {second} to compare."
    sentences = [_sentence(str(lens), part) for lens, part in pairs.groupby("lens", sort=False)]
    return f"{value}, {first} against {second}. " + " ".join(sentences)


def _sentence(lens: str, pairs: pd.DataFrame) -> str:
    outcomes: dict[str, list[str]] = {}
    for pair in pairs.to_dict("records"):
        p = "p < 0.001" if pair["p_holm"] < 0.001 else f"p = {pair['p_holm']:.3f}"
        medians = f"medians {pair['median_first']:.4f} and {pair['median_second']:.4f}"
        numbers = f"{medians}, {p}, A12 = {pair['a12']:.2f}, {pair['effect']}"
        words = {NO_DIFFERENCE: "the runs show no difference", TOO_FEW: "there are too few runs"}
        outcome = words.get(pair["ahead"], f"{pair['ahead']} is ahead")
        where = f"N = {pair['population']} and {pair['iterations']} iterations ({numbers})"
        outcomes.setdefault(outcome, []).append(where)
    return f"At {lens} {'; '.join(f'{outcome} for {_listed(where)}' for outcome, where in outcomes.items())}."


def _listed(parts: Sequence[str]) -> str:
    return parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + " and " + parts[-1]

"""Statistics against worked examples and against straightforward second computations."""

import itertools
from collections.abc import Sequence
from math import comb

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from suspension_ctrl.study import inference as statistics

samples = st.lists(st.integers(0, 5).map(float), min_size=1, max_size=12)


@given(samples, samples)
def test_a12_counts_pairs(first, second):
    wins = sum((a > b) + 0.5 * (a == b) for a, b in itertools.product(first, second))
    assert statistics.a12(first, second) == pytest.approx(wins / (len(first) * len(second)), abs=1e-12)
    assert statistics.a12(second, first) == pytest.approx(1 - statistics.a12(first, second), abs=1e-12)


def test_a12_of_a_worked_example():
    """Of 9 pairs of (3, 4, 5) and (1, 3, 4) the first is larger in 6 and equal in 2: 7/9."""
    assert statistics.a12([3, 4, 5], [1, 3, 4]) == pytest.approx(7 / 9)


def test_sizes_have_the_names_of_vargha_and_delaney():
    """Their limits 0.56, 0.64 and 0.71, and the same on the other side of one half."""
    words = [statistics.size_in_words(effect) for effect in (0.5, 0.559, 0.56, 0.639, 0.64, 0.709, 0.71, 1.0)]
    assert words == ["negligible"] * 2 + ["small"] * 2 + ["medium"] * 2 + ["large"] * 2
    assert [statistics.size_in_words(e) for e in (0.44, 0.36, 0.29)] == ["small", "medium", "large"]


def test_holm_of_a_worked_example():
    """0.005 x 4, 0.01 x 3, 0.03 x 2, then 0.04 x 1, but no less than the one before."""
    adjusted = statistics.holm([0.01, 0.04, 0.03, 0.005])
    np.testing.assert_allclose(adjusted, [0.03, 0.06, 0.06, 0.02])


def test_bootstrap_interval_is_that_of_plain_resampling():
    """Half a standard error of the resampled quantile, from 9999 draws here and there: below 0.01."""
    rng = np.random.default_rng(0)
    first, second = rng.lognormal(0.3, 0.2, 31), rng.lognormal(0.0, 0.2, 31)
    ratio, low, high = statistics.ratio_of_medians(first, second)
    assert ratio == np.median(first) / np.median(second)
    medians = [np.median(rng.choice(x, (9999, 31)), axis=1) for x in (first, second)]
    expected = np.quantile(medians[0] / medians[1], [0.025, 0.975])
    np.testing.assert_allclose([low, high], expected, atol=0.02)
    assert (ratio, low, high) == statistics.ratio_of_medians(first, second)


@pytest.mark.parametrize("sizes", [(31, 31), (8, 31), (2, 3)])
def test_bootstrap_interval_is_that_of_scipy(sizes):
    """The same draws from samples in order; quantiles are interpolated in another form, some 1e-16."""
    rng = np.random.default_rng(2)
    first, second = (rng.lognormal(0.0, 0.3, size) for size in sizes)

    def ratio(x, y, axis=-1):
        return np.median(x, axis=axis) / np.median(y, axis=axis)

    settings = {"n_resamples": statistics.RESAMPLES, "method": "percentile", "rng": 5}
    wanted = stats.bootstrap((np.sort(first), np.sort(second)), ratio, **settings).confidence_interval
    _, *interval = statistics.ratio_of_medians(first, second, seed=5)
    np.testing.assert_allclose(interval, wanted, rtol=1e-14)


def test_there_is_no_ratio_to_nothing():
    assert np.isnan(statistics.ratio_of_medians([1.0, 2.0], [0.0, 1.0])).all()


def table() -> pd.DataFrame:
    rng = np.random.default_rng(1)
    values = {"a": rng.normal(1, 0.1, 31), "b": rng.normal(1.01, 0.1, 31), "c": rng.normal(2, 0.1, 31)}
    rows = [
        {"population": n, "algorithm": name, "seed": seed, "value": value}
        for n in (10, 20)
        for name, column in values.items()
        for seed, value in enumerate(column)
    ]
    return pd.DataFrame(rows)


def test_pairs_are_all_compared_within_their_group():
    pairs = statistics.pairwise(table(), ["population"], ["value"], ["a", "b", "c"])
    assert list(zip(pairs["population"], pairs["first"], pairs["second"], strict=True)) == [
        (n, *pair) for n in (10, 20) for pair in (("a", "b"), ("a", "c"), ("b", "c"))
    ]
    alike, apart = pairs.iloc[0], pairs.iloc[1]
    assert alike.p_holm > 0.05
    assert alike.effect in ("negligible", "small")
    assert apart.p_holm < 1e-9
    assert (apart.a12, apart.effect) == (0, "large")
    assert apart.ratio_low < apart.ratio < apart.ratio_high < 0.6
    assert (pairs.p_holm >= pairs.p).all()


def test_equal_runs_do_not_differ():
    same = pd.DataFrame({"n": 1, "algorithm": ["a"] * 5 + ["b"] * 5, "value": 2.0})
    pair = statistics.pairwise(same, ["n"], ["value"], ["a", "b"]).iloc[0]
    assert (pair.p, pair.a12, pair.effect, pair.ratio) == (1, 0.5, "negligible", 1)


def test_one_run_each_can_be_compared():
    single = pd.DataFrame({"n": 1, "algorithm": ["a", "b"], "value": [1.0, 2.0]})
    pair = statistics.pairwise(single, ["n"], ["value"], ["a", "b"]).iloc[0]
    assert pair.ratio == 0.5
    assert np.isnan(pair.ratio_low)
    assert pair.p_holm == 1


def test_the_least_p_is_of_samples_that_do_not_overlap():
    """Exact: 2 of all orders; of three against three 0.1, of samples beyond the exact test nearly nothing."""
    for first, second in ((3, 3), (4, 7), (8, 8), (20, 31)):
        assert statistics.least_p(first, second) == pytest.approx(2 / comb(first + second, first), rel=1e-9)
    assert 0 < statistics.least_p(21, 21) < 1e-7
    assert statistics.rank_test([1, 2, 3], [4, 5, 6]) == pytest.approx(0.1)


@pytest.mark.parametrize("tests", [1, 36, 144, 1440, 100_000])
def test_as_many_runs_as_needed_differ_and_one_less_do_not(tests):
    runs = statistics.runs_needed(tests)
    assert 2 * tests / comb(2 * runs, runs) < 0.05 <= 2 * tests / comb(2 * runs - 2, runs - 1)


def p_by_counting(first: Sequence[float], second: Sequence[float]) -> float:
    """Share of the ways to deal the values into two samples that differ as much, in either direction."""
    values = [*first, *second]
    ways = list(itertools.combinations(range(len(values)), len(first)))
    ranks = stats.rankdata(values)
    sums = np.array([ranks[list(way)].sum() for way in ways])
    here = ranks[: len(first)].sum()
    return min(1.0, 2 * min(np.mean(sums <= here), np.mean(sums >= here)))


@given(st.lists(st.integers(-1000, 1000), min_size=2, max_size=9, unique=True), st.data())
def test_the_rank_test_is_that_of_all_permutations_and_of_scipy(values, data):
    at = data.draw(st.integers(1, len(values) - 1))
    first, second = values[:at], values[at:]
    p = statistics.rank_test(first, second)
    assert p == pytest.approx(p_by_counting(first, second), rel=1e-12)
    assert p == stats.mannwhitneyu(first, second, method="exact").pvalue


def test_the_runs_that_are_needed_are_those_of_all_permutations():
    """Of 2 to 5 runs of each the least p of any order; as many tests as five runs can bear."""
    least = {n: min(map(p_by_counting, *halves(n))) for n in range(2, 6)}
    assert [statistics.least_p(n, n) for n in least] == pytest.approx(list(least.values()), rel=1e-12)
    for tests in range(1, int(0.05 / least[5]) + 1):
        enough = next(n for n, p in least.items() if tests * p < 0.05)
        assert statistics.runs_needed(tests) == enough


def halves(n: int) -> tuple[list[list[int]], list[list[int]]]:
    """All ways to deal 2 n ranks into two samples of n: first samples, and second ones."""
    firsts = [list(way) for way in itertools.combinations(range(2 * n), n)]
    return firsts, [sorted({*range(2 * n)}.difference(way)) for way in firsts]


def test_ties_are_left_to_the_normal_approximation():
    """SciPy's own value: an exact distribution does not hold with ties."""
    first, second = [1.0, 2.0, 2.0, 3.0], [2.0, 4.0, 5.0]
    wanted = stats.mannwhitneyu(first, second, method="asymptotic").pvalue
    assert statistics.rank_test(first, second) == wanted


def test_a_verdict_names_who_is_ahead_or_why_nobody_is():
    """Of 3 runs none, however far apart; of 31 only where effect and p say so."""
    few = table()[lambda t: t.seed < 3]
    judged = statistics.verdict(statistics.pairwise(few, ["population"], ["value"], ["a", "b", "c"]))
    assert judged.ahead.eq(statistics.TOO_FEW).all()
    assert judged.p_holm_least.eq(6 * 0.1).all()
    judged = statistics.verdict(statistics.pairwise(table(), ["population"], ["value"], ["a", "b", "c"]))
    assert judged.ahead[:3].tolist() == [statistics.NO_DIFFERENCE, "c", "c"]
    assert judged.p_holm_least.lt(1e-9).all()


def test_quartiles_by_group():
    rows = pd.DataFrame({"k": ["x"] * 5 + ["y"], "v": [1.0, 2, 3, 4, 5, 7]})
    found = statistics.quartiles(rows, ["k"], ["v"])
    assert found.to_numpy().tolist() == [["x", 5, 3, 2, 4], ["y", 1, 7, 7, 7]]


def test_infinite_values_rank_last():
    """Runs without a feasible design are infinitely far from the front: quartiles and tests take them so.

    By hand: of 1, 2, inf, inf, inf the quartiles are the second, third and fourth; of 8 pairs with 3 and 4 the
    first sample is larger in 6.
    """
    table = pd.DataFrame({"algorithm": "a", "igd_plus": [np.inf, 1.0, np.inf, 2.0, np.inf]})
    row = statistics.quartiles(table, ["algorithm"], ["igd_plus"]).iloc[0]
    assert [row["igd_plus q1"], row["igd_plus"], row["igd_plus q3"]] == [2.0, np.inf, np.inf]
    mixed = pd.DataFrame({"algorithm": list("aaaa"), "igd_plus": [1.0, np.inf, np.inf, np.inf]})
    other = pd.DataFrame({"algorithm": list("bb"), "igd_plus": [3.0, 4.0]})
    compared = statistics.pairwise(
        pd.concat([mixed, other]).assign(group=1), ["group"], ["igd_plus"], ["a", "b"]
    ).iloc[0]
    assert compared.a12 == 6 / 8
    assert compared.median_first == np.inf
    assert np.isnan(compared.ratio)
    alike = pd.DataFrame({"algorithm": list("aabb"), "igd_plus": np.inf, "group": 1})
    assert statistics.pairwise(alike, ["group"], ["igd_plus"], ["a", "b"]).p.tolist() == [1.0]

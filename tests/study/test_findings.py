"""Findings of a comparison over many seeds, from a table made by hand."""

from math import comb

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.findings import findings, last_rows
from suspension_ctrl.study.inference import TOO_FEW
from suspension_ctrl.study.judging import ARCHIVE, CUT_ARCHIVE, INDICATORS, POPULATION


@pytest.fixture
def comparison() -> Comparison:
    problem = Problem(evaluate=lambda x: np.hstack([x, 1 - x]), lower=(0.0,), upper=(1.0,), objectives=("f", "g"))
    return Comparison(problem=problem, algorithms=["nsga2", "sobol"], populations=[20], iterations=[2], seeds=8)


def table(comparison: Comparison) -> pd.DataFrame:
    """Relative hypervolume 0.9 + seed/1000 of the first algorithm, 0.1 less of the second, at 20 and at 60."""
    rows = [
        {"algorithm": name, "population": 20, "seed": seed, "budget": budget, "evaluations": budget, "set": chosen,
         "members": 5, **dict.fromkeys(INDICATORS, 0.9 + seed / 1000 - 0.1 * number), "seconds": 9.0, "error": ""}
        for number, name in enumerate(comparison.algorithms)
        for seed in range(comparison.seeds)
        for budget in (20, 60)
        for chosen in (POPULATION, ARCHIVE, CUT_ARCHIVE)
    ]  # fmt: skip
    return pd.DataFrame(rows)


def clock() -> pd.DataFrame:
    """A thousandth of a second per evaluation, of the other algorithms two."""
    paces = (("nsga2", 1e-3), ("sobol", 2e-3), ("random", 2e-3))
    rows = [(name, 20, e, e * s) for name, s in paces for e in (20, 60)]
    return pd.DataFrame(rows, columns=["algorithm", "population", "evaluations", "seconds"])


def test_findings_of_a_table_made_by_hand(comparison):
    found = findings(comparison, table(comparison), clock(), 0.905)
    medians = found.medians.set_index(["lens", "set", "algorithm"])
    assert medians.loc[("equal evaluations", POPULATION, "nsga2"), "relative_hypervolume"] == pytest.approx(0.9035)
    assert medians.loc[("equal evaluations", POPULATION, "sobol"), "seconds"] == pytest.approx(0.12)
    assert medians.loc[("equal time", POPULATION, "sobol"), "evaluations"] == 30  # 60 take it twice the time
    pair = found.differences[found.differences.value == "relative_hypervolume"].iloc[0]
    assert (pair["first"], pair["second"], pair.a12) == ("nsga2", "sobol", 1.0)
    reached = found.reached.set_index(["set", "algorithm"])
    assert reached.loc[(POPULATION, "nsga2"), "reached"] == 3  # seeds 5, 6 and 7
    assert reached.loc[(POPULATION, "sobol"), "reached"] == 0
    row = {"population": 20, "iterations": 2, "other": "sobol"}
    row |= dict.fromkeys(["equal iterations", "equal evaluations", "equal time"], "nsga2")
    assert found.verdict.to_dict("records") == [{"set": POPULATION, **row}, {"set": CUT_ARCHIVE, **row}]
    assert [words.split(",")[0] for words in found.words] == [
        "Hypervolume of the final population", "Hypervolume of the archive cut to N",
    ]  # fmt: skip
    assert "nsga2 is ahead" in found.words[0]


def test_too_few_runs_give_no_verdict_but_the_number_that_would(comparison):
    """By hand: 4 indicators, 3 lenses and 3 sets are 36 tests; the least p is 2 / (2n over n)."""
    few = table(comparison)
    few = few[few.seed < 3]
    found = findings(comparison, few, clock(), 0.905)
    assert found.verdict.empty
    assert len(found.differences) == 36
    needed = next(n for n in range(2, 99) if 36 * 2 / comb(2 * n, n) < 0.05)
    assert found.words == [
        "No verdict: 3 runs against 3 cannot differ significantly. Their least p is 0.1, and "
        "Holm's method multiplies it by the 36 tests of pairs, configurations, lenses, sets and indicators. "
        f"It takes {needed} seeds."
    ]
    assert found.medians.runs.eq(3).all()


def test_without_a_run_that_ended_there_is_nothing(comparison):
    assert findings(comparison, table(comparison).assign(error="RuntimeError"), clock(), 0.9) is None


def test_one_algorithm_has_medians_and_no_verdict(comparison):
    alone = Comparison(problem=comparison.problem, algorithms=["nsga2"], populations=[20], iterations=[2], seeds=8)
    found = findings(alone, table(alone), clock(), 0.9)
    assert (len(found.verdict), found.words) == (0, [])
    assert len(found.medians) == 3 * 3


@pytest.fixture
def three(comparison) -> Comparison:
    """A third algorithm, which is 0.2 below the first; by other indicators than hypervolume all are equal."""
    return Comparison(
        problem=comparison.problem,
        algorithms=["nsga2", "sobol", "random"],
        populations=[20],
        iterations=[2],
        seeds=8,
    )


def by_hypervolume(three: Comparison, runs: dict[str, int]) -> pd.DataFrame:
    """The table with so many runs of some algorithms, and equal values of all other indicators."""
    made = table(three).assign(**dict.fromkeys(set(INDICATORS) - {"relative_hypervolume"}, 0.5))
    return made[made.seed < made.algorithm.map(runs).fillna(8)]


def test_the_verdict_is_on_the_hypervolume_of_the_first_algorithm(three):
    """Against each other one, also where one of them has too few runs."""
    found = findings(three, by_hypervolume(three, {"random": 3}), clock(), 0.905)
    assert found.verdict.other.tolist() == ["sobol", "random"] * 2
    lenses = ["equal iterations", "equal evaluations", "equal time"]
    assert found.verdict[lenses].to_numpy().tolist() == [["nsga2"] * 3, [TOO_FEW] * 3] * 2
    assert all("nsga2 is ahead" in words and "random" not in words for words in found.words)


def test_of_too_few_runs_those_of_the_most_are_told(three):
    found = findings(three, by_hypervolume(three, {"nsga2": 3, "sobol": 3, "random": 2}), clock(), 0.905)
    assert found.words[0].startswith(
        "No verdict: 3 runs against 3 cannot differ significantly. Their least p is 0.1,"
    )


def test_the_median_of_what_was_spent_is_told(comparison):
    slow = table(comparison)
    slow.loc[slow.seed.eq(7) & slow.algorithm.eq("nsga2"), ["budget", "evaluations"]] *= 2
    found = findings(comparison, slow, clock(), 0.905).medians
    spent = found[(found.lens == "equal iterations") & (found.algorithm == "nsga2")]
    assert spent.evaluations.unique().tolist() == [60.0]


def test_a_run_that_raised_has_no_findings_and_a_row_of_its_own(comparison):
    whole = table(comparison)
    raised = whole.seed.eq(2) & whole.algorithm.eq("sobol")
    message = whole[raised].iloc[:1].assign(error="RuntimeError", set=np.nan, budget=np.nan)
    runs = pd.concat([whole[~raised], message], ignore_index=True)
    found = findings(comparison, runs, clock(), 0.905)
    assert found.medians[found.medians.algorithm == "sobol"].runs.eq(7).all()
    last = last_rows(runs)
    assert len(last) == 16
    assert last[last.error.eq("")].evaluations.eq(60).all()
    assert last[last.error.ne("")][["algorithm", "seed", "timing"]].to_numpy().tolist() == [["sobol", 2, False]]
    assert not {"set", "members", "budget"} & set(last)


def test_every_number_of_iterations_has_findings(comparison):
    both = Comparison(
        problem=comparison.problem, algorithms=comparison.algorithms, populations=[20], iterations=[1, 2], seeds=8
    )
    between = table(comparison)[lambda rows: rows.budget.eq(20)].assign(budget=40, evaluations=40)
    rows = pd.concat([table(comparison), between])
    runs = rows.sort_values(["algorithm", "seed", "set", "budget"], ignore_index=True)
    found = findings(both, runs, clock(), 0.905).medians
    spent = found[found.lens.eq("equal iterations") & found.algorithm.eq("nsga2") & found.set.eq(POPULATION)]
    assert spent[["iterations", "evaluations"]].to_numpy().tolist() == [[1, 40], [2, 60]]

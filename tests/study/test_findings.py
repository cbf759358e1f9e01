"""Findings of a comparison over many seeds, from a table made by hand."""

from math import comb

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.findings import findings
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
    """A thousandth of a second per evaluation, of the second algorithm two."""
    rows = [(name, 20, e, e * s) for name, s in (("nsga2", 1e-3), ("sobol", 2e-3)) for e in (20, 60)]
    return pd.DataFrame(rows, columns=["algorithm", "population", "evaluations", "seconds"])


def test_findings_of_a_table_made_by_hand(comparison):
    found = findings(comparison, table(comparison), clock(), 0.905)
    medians = found.medians.set_index(["lens", "set", "algorithm"])
    assert medians.loc[("equal evaluations", POPULATION, "nsga2"), "relative_hypervolume"] == pytest.approx(0.9035)
    assert medians.loc[("equal evaluations", POPULATION, "sobol"), "seconds"] == pytest.approx(0.12)
    assert medians.loc[("equal time", POPULATION, "sobol"), "evaluations"] == 20  # 60 take it twice the time
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

"""The runs that a comparison makes: which, how long, from which seeds; and the studies that judge it."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.study.comparison import Comparison, optimiser

CONFIGURATION = {"populations": [20, 30], "iterations": [2, 4], "repeats": 2, "seed": 7}


def comparison(algorithms=("nsga2", "moead-dra"), **settings) -> Comparison:
    return Comparison(problem=paper.ride_problem(), algorithms=algorithms, **CONFIGURATION | settings)


def test_plan_has_every_run_once_and_algorithms_take_turns():
    plan = comparison().timed_runs()
    names = [run.name for run in plan]
    assert (
        len(set(names)) == len(names) == 2 * 2 * 2 * 3
    )  # NSGA-II, MOEA/D at equal iterations, at equal evaluations
    assert [run.key["algorithm"] for run in plan[:6]] == ["nsga2", "moead-dra", "moead-dra"] * 2
    assert {run.seed for run in plan if run.key["repeat"] == 2} == {8}


def test_equal_evaluations_are_whole_iterations():
    """With N = 103 an iteration of MOEA/D-DRA makes 20, which do not fill up NSGA-II's 1030 exactly."""
    runs = comparison(populations=[103], iterations=[10], repeats=1).timed_runs()
    assert [run.evaluations for run in runs] == [1133, 303, 1123]


def test_timed_and_judged_runs_start_from_the_same_seed():
    one = comparison(seeds=3)
    assert {run.seed for run in one.timed_runs()} == {7, 8}
    assert {n: study.seeds for n, study in one.studies().items()} == {20: (7, 8, 9), 30: (7, 8, 9)}


def test_budgets_hold_every_state_that_is_compared():
    assert comparison(["nsga2", "sobol"], iterations=[2]).budgets(20) == [20, 29, 42, 60]
    budgets = comparison(iterations=[7]).budgets(20)
    assert {20 + 7 * 4, 20 + 7 * 20} <= set(budgets)
    assert max(budgets) == 160


@given(st.integers(15, 2000), st.lists(st.integers(1, 300), min_size=1, max_size=3))
def test_budgets_are_few_and_near(population, iterations):
    """At most a factor of 1.5 apart but for rounding, and no more than that takes but for those compared."""
    one = comparison(populations=[population], iterations=iterations)
    budgets = one.budgets(population)
    named = {run.evaluations for run in one.timed_runs()} | {population}
    assert named <= set(budgets)
    assert budgets == sorted(set(budgets))
    assert all(high <= 1.5 * low + 1.25 for low, high in pairwise(budgets))
    assert len(budgets) <= len(named) + math.log(budgets[-1] / budgets[0]) / math.log(1.5)


def test_raw_moead_takes_the_papers_units():
    assert optimiser("moead-dra-raw", 30).objective_scales == (1.0, 1.0, 1e3)
    assert not optimiser("moead-dra-raw", 30).normalise


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"algorithms": ["nsga3"]},
            "algorithms must be one of nsga2, nsga2-standard-sort, nsga2-gamultiobj, moead-dra, moead-dra-raw, "
            "random, sobol",
        ),
        ({"populations": [3]}, "population must be a whole number >= 4, got 3"),
        ({"iterations": [0]}, "iterations must be a whole number >= 1, got 0"),
        ({"repeats": 0}, "repeats must be a whole number >= 1, got 0"),
        ({"seed": -1}, "seed must be a whole number >= 0, got -1"),
    ],
)
def test_rejects_bad_plans(change, message):
    with pytest.raises(ValueError, match=f"^{message}"):
        comparison(**{"algorithms": ["nsga2"], **change})

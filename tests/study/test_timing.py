import subprocess
import sys

import numpy as np
import pandas as pd
import pytest

from functions import srn
from suspension_ctrl import InfeasibleWarning, Problem
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.paper import tables
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import timing as experiments
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.reference import grid_front

CONFIGURATION = {"populations": [20, 30], "iterations": [2, 4], "repeats": 2, "seed": 7}


@pytest.fixture(scope="module")
def problem():
    return paper.ride_problem()


@pytest.fixture(scope="module")
def comparison(problem):
    return Comparison(problem=problem, algorithms=["nsga2", "moead-dra"], **CONFIGURATION)


@pytest.fixture(scope="module")
def plan(comparison):
    return comparison.timed_runs()


@pytest.fixture(scope="module")
def store(comparison, plan):
    kept = {}
    assert list(experiments.carry_out(comparison, kept)) == plan
    return kept


@pytest.fixture(scope="module")
def runs(problem, comparison, store):
    return experiments.tidy(comparison, store, ReferenceFront.of(grid_front(problem, 40)))


def test_runs_spend_what_was_planned(plan, store):
    for planned in plan:
        assert store[planned.name].course.evaluations.iloc[-1] == planned.evaluations
    wanted = {"population": 30, "iterations": 4, "budget": "evaluations"}
    equal = [p.evaluations for p in plan if wanted.items() <= p.key.items()]
    assert equal == [150, 150]


def test_tidy_table_has_a_row_per_run(runs, plan):
    assert len(runs) == len(plan)
    keys = ["algorithm", "population", "iterations", "budget", "repeat"]
    assert not runs.duplicated(keys).any()
    assert (runs.hypervolume > 0.5).all()
    assert (runs.igd_plus > 0).all()
    nsga2 = runs[runs.algorithm == "nsga2"]
    assert nsga2.select_seconds.gt(0).all()
    assert nsga2.sweep_seconds.isna().all()
    phases = [name for name in runs.columns if name.endswith("_seconds") and name != "cpu_seconds"]
    assert (runs[phases].sum(axis=1) <= runs.seconds).all()


def test_runs_that_are_stored_are_not_made_again(comparison, plan, store):
    some = {planned.name: store[planned.name] for planned in plan[3:]}
    assert list(experiments.carry_out(comparison, some)) == plan
    assert all(some[planned.name] is store[planned.name] for planned in plan[3:])
    for planned in plan[:3]:
        np.testing.assert_array_equal(some[planned.name].final, store[planned.name].final)


def test_clock_is_the_median_of_the_longest_runs(comparison, plan, store):
    clock = experiments.seconds_by_evaluations(comparison, store).set_index(
        ["algorithm", "population", "evaluations"]
    )
    longest = [store[p.name].course for p in plan if p.key["algorithm"] == "moead-dra" and p.evaluations == 150]
    assert len(longest) == 2
    times = [course[course.evaluations == 90].seconds.item() for course in longest]
    assert clock.seconds["moead-dra", 30, 90] == np.median(times)


def test_tables_2_and_3_put_published_beside_measured(runs):
    published = paper.published_seconds().replace(
        {"population": {500: 20, 1000: 30}, "iterations": {10: 2, 20: 4}}
    )
    table2 = tables.seconds_by_repeat(runs, published, "nsga2")
    assert len(table2) == 8
    row = table2[(table2.population == 30) & (table2.iterations == 4) & (table2.repeat == 2)].iloc[0]
    assert row.published_seconds == 549.3
    assert row.microseconds_per_evaluation == pytest.approx(1e6 * row.seconds / 150)
    printed = tables.as_printed(table2)
    assert printed["repeat"].tolist() == ["1", "2", "mean", "evaluations", "µs per evaluation"]
    assert printed["N=30, 4 iterations"][1].startswith("549.3 / 0.")
    assert tables.seconds_by_repeat(runs, paper.published_seconds(), "moead-dra").published_seconds.isna().all()


def made_up_runs(rows: list[tuple]) -> pd.DataFrame:
    columns = ("algorithm", "budget", "repeat", "evaluations", "seconds", "hypervolume")
    common = {"population": 500, "iterations": 10, "igd_plus": 0.1}
    return pd.DataFrame([common | dict(zip(columns, row, strict=True)) for row in rows])


def test_table_4_compares_with_the_first_algorithm():
    """By hand, two repeats each: mean seconds 3 / 1.5 at equal iterations, 3 / 6 at equal evaluations."""
    runs = made_up_runs(
        [
            ("nsga2", "iterations", 1, 5500, 2.0, 0.9), ("nsga2", "iterations", 2, 5500, 4.0, 0.8),
            ("moead-dra", "iterations", 1, 1500, 1.0, 0.7), ("moead-dra", "iterations", 2, 1500, 2.0, 0.7),
            ("moead-dra", "evaluations", 1, 5500, 5.0, 0.7), ("moead-dra", "evaluations", 2, 5500, 7.0, 0.7),
        ]
    )  # fmt: skip
    table = tables.comparison(runs, paper.published_seconds()).set_index(["algorithm", "budget"])
    assert len(table) == 4  # NSGA-II stands in both budgets, as it spends the most
    assert table.ratio_percent["nsga2", "iterations"] == table.ratio_percent["nsga2", "evaluations"] == 100
    assert table.ratio_percent["moead-dra", "iterations"] == pytest.approx(200)
    assert table.ratio_percent["moead-dra", "evaluations"] == pytest.approx(50)
    assert table.published_ratio_percent["moead-dra", "iterations"] == pytest.approx(239, rel=2e-3)
    assert np.isnan(table.published_ratio_percent["moead-dra", "evaluations"])
    assert table.microseconds_per_evaluation["moead-dra", "iterations"] == pytest.approx(1e3)
    assert table.hypervolume["nsga2", "iterations"] == pytest.approx(0.85)


def test_table_4_with_a_baseline_that_spends_less():
    """NSGA-II's only run stands against both of the baseline's: 1 / 2 and 4 / 2 seconds."""
    runs = made_up_runs(
        [
            ("moead-dra", "iterations", 1, 1500, 1.0, 0.7),
            ("nsga2", "iterations", 1, 5500, 2.0, 0.9),
            ("moead-dra", "evaluations", 1, 5500, 4.0, 0.7),
        ]
    )
    ratio = tables.comparison(runs, paper.published_seconds()).set_index(["algorithm", "budget"]).ratio_percent
    assert ratio["nsga2", "iterations"] == pytest.approx(50)
    assert ratio["nsga2", "evaluations"] == pytest.approx(200)
    assert ratio["moead-dra", "iterations"] == ratio["moead-dra", "evaluations"] == 100


FRESH_PROCESS = """
import numpy as np
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search import constraints, decomposition, operators, selection, sorting
from suspension_ctrl.study import timing as experiments
from suspension_ctrl.study.comparison import Comparison
comparison = Comparison(
    problem=paper.ride_problem(), algorithms=["nsga2", "moead-dra"], populations=[20], iterations=[12]
)
experiments.warm_up(comparison)
modules = (decomposition, constraints, operators, selection, sorting)
functions = {name: f for module in modules for name, f in vars(module).items() if hasattr(f, "signatures")}
before = {name: list(f.signatures) for name, f in functions.items()}
list(experiments.carry_out(comparison, {}))
ties = np.array([[0.0, 1.0, 2.0], [0.0, 2.0, 1.0], [1.0, 2.0, 3.0], [2.0, 3.0, 4.0]])
selection.select_survivors(ties, 3)
print([name for name, f in functions.items() if list(f.signatures) != before[name]])
"""


def test_nothing_is_compiled_in_a_timed_run():
    """Also not what first runs after many iterations, in the runs of equal evaluations, or at a tie."""
    done = subprocess.run([sys.executable, "-c", FRESH_PROCESS], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_fronts_are_non_dominated_and_named_with_units(problem, comparison, plan, store):
    frame = experiments.front(comparison.problem, store[plan[0].name].final)
    assert list(frame.columns) == ["spring [N/m]", "damper [N s/m]", "ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    np.testing.assert_array_equal(problem.evaluate(frame.iloc[:, :2]), frame.iloc[:, 2:])
    populations = experiments.final_populations(comparison, store)
    assert set(populations.algorithm) == {"nsga2", "moead-dra"}
    assert len(populations) == 2 * (20 + 20 + 30 + 30)


def test_final_populations_tell_violations_where_there_are_constraints():
    """After the start alone some of SRN's designs are infeasible: the front and the indicators leave them out."""
    problem = srn()
    comparison = Comparison(problem=problem, algorithms=["nsga2"], populations=[20], iterations=[1], seed=5)
    store = {}
    (planned,) = experiments.carry_out(comparison, store)
    final = store[planned.name].final
    assert list(final.columns) == ["x1", "x2", "f1", "f2", "violation"]
    values = problem.evaluate(final[["x1", "x2"]].to_numpy())
    np.testing.assert_array_equal(final[["f1", "f2"]], values[:, :2])
    feasible = (values[:, 2:] <= 0).all(axis=1)
    np.testing.assert_array_equal(final.violation == 0, feasible)
    assert 0 < feasible.sum() < 20
    front = experiments.front(problem, final)
    assert 0 < len(front) <= feasible.sum()
    assert front.violation.eq(0).all()
    reference = ReferenceFront.of(grid_front(problem, 40))
    row = experiments.tidy(comparison, store, reference).iloc[0]
    assert row.hypervolume == reference.hypervolume(values[feasible, :2])
    assert row.igd_plus == reference.igd_plus(values[feasible, :2])


def test_runs_without_a_feasible_design_have_rows_too():
    problem = Problem(
        evaluate=lambda x: np.column_stack([x, 1 - x, 0 * x + 1]),
        lower=(0,), upper=(1,), objectives=("f1", "f2"), constraints=("g",),
    )  # fmt: skip
    comparison = Comparison(
        problem=problem, algorithms=["nsga2", "moead-dra"], populations=[20], iterations=[2], seed=5
    )
    experiments.warm_up(comparison)
    store = {}
    with pytest.warns(InfeasibleWarning, match=r"^no feasible design among \d+ evaluated, .* 1: g 1$"):
        planned = list(experiments.carry_out(comparison, store))
    front = ReferenceFront.of(np.array([[0.0, 1.0], [1.0, 0.0]]))
    table = experiments.tidy(comparison, store, front)
    assert table.hypervolume.eq(0).all()
    assert np.isposinf(table.igd_plus).all()
    assert experiments.front(problem, store[planned[0].name].final).empty

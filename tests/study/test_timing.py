import subprocess
import sys

import numpy as np
import pytest

from functions import srn
from suspension_ctrl import InfeasibleWarning, Problem
from suspension_ctrl.paper import experiment as paper
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
    front = ReferenceFront.of(grid_front(problem, 40))
    return experiments.judged(comparison, store, experiments.tidy(comparison, store), front)


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
    assert list(experiments.carry_out(comparison, some)) == plan[:3]
    assert list(experiments.carry_out(comparison, some)) == []
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


FRESH_PROCESS = """
import numpy as np
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search import constraints, decomposition, operators, selection
from suspension_ctrl.study import timing as experiments
from suspension_ctrl.study.comparison import Comparison
comparison = Comparison(
    problem=paper.ride_problem(), algorithms=["nsga2", "moead-dra"], populations=[20], iterations=[12]
)
experiments.warm_up(comparison)
modules = (decomposition, constraints, operators, selection)
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
    frame = experiments.front(comparison.problem, store[plan[0].name])
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
    front = experiments.front(problem, store[planned.name])
    assert 0 < len(front) <= feasible.sum()
    assert front.violation.eq(0).all()
    reference = ReferenceFront.of(grid_front(problem, 40))
    row = experiments.judged(comparison, store, experiments.tidy(comparison, store), reference).iloc[0]
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
    table = experiments.judged(comparison, store, experiments.tidy(comparison, store), front)
    assert table.hypervolume.eq(0).all()
    assert np.isposinf(table.igd_plus).all()
    assert experiments.front(problem, store[planned[0].name]).empty

"""A trace is the search that `minimise` makes, with everything kept."""

import numpy as np
import pytest

from functions import dtlz2, srn
from suspension_ctrl import MoeadDra, Nsga2, Problem, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.gamultiobj import Gamultiobj
from suspension_ctrl.search.sampling import Sampling
from suspension_ctrl.search.trace import trace, trace_so_far

OPTIMISERS = {
    "nsga2": Nsga2(population=30),
    "gamultiobj": Gamultiobj(population=30),
    "moead-dra": MoeadDra(population=30),
    "sobol": Sampling(population=30),
}
PROBLEMS = {"ride": paper.ride_problem(), "compiled": dtlz2(5, compiled=True), "plain": dtlz2(5)}
CONSTRAINED = {"compiled": srn(), "plain": srn(compiled=False)}


@pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS.keys())
@pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())
def test_states_are_the_results_of_runs_with_that_budget(problem, optimiser):
    budgets = [60, 101, 300]
    seen = trace(problem, optimiser, budgets, seed=3)
    for budget in budgets:
        run = minimise(problem, optimiser, evaluations=budget, seed=3)
        state = seen.states[budget]
        assert state.evaluations == run.evaluations
        np.testing.assert_array_equal(state.designs, run.designs)
        np.testing.assert_array_equal(state.objectives, run.objectives)


@pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS.keys())
@pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())
def test_all_that_is_evaluated_is_kept_in_order(problem, optimiser):
    seen = trace(problem, optimiser, [30, 290], seed=3)
    assert len(seen.designs) == seen.states[290].evaluations
    np.testing.assert_allclose(seen.objectives, problem.evaluate(seen.designs), rtol=1e-14)
    np.testing.assert_array_equal(seen.objectives[:30].min(axis=0), seen.states[30].ideal)
    np.testing.assert_array_equal(seen.objectives.min(axis=0), seen.states[290].ideal)
    kept = {tuple(row) for row in seen.objectives}
    assert {tuple(row) for row in seen.states[290].objectives} <= kept


@pytest.mark.parametrize("problem", CONSTRAINED.values(), ids=CONSTRAINED.keys())
@pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())
def test_constraints_are_kept_with_the_objectives(problem, optimiser):
    seen = trace(problem, optimiser, [30, 290], seed=3)
    values = problem.evaluate(seen.designs)
    np.testing.assert_array_equal(np.hstack([seen.objectives, seen.constraints]), values)
    met = (values[:, 2:] <= 0).all(axis=1)
    np.testing.assert_array_equal(seen.feasible, met)
    assert 0 < met.sum() < len(met)
    run = minimise(problem, optimiser, evaluations=290, seed=3)
    np.testing.assert_array_equal(seen.states[290].constraints, run.constraints)
    np.testing.assert_array_equal(seen.states[290].ideal, values[met, :2].min(axis=0))


def test_budgets_must_cover_the_start():
    with pytest.raises(ValueError, match=r"^budgets must be >= 30 evaluations, the start, got \[29, 60\]$"):
        trace(dtlz2(5), Nsga2(population=30), [60, 29], seed=0)


def ends_after(count: int) -> Problem:
    """DTLZ2, whose solver fails as soon as so many designs have been evaluated."""
    left = [count]

    def evaluate(designs: np.ndarray) -> np.ndarray:
        left[0] -= len(designs)
        if left[0] < 0:
            raise RuntimeError("no solution")
        return dtlz2(5).evaluate(designs)

    return Problem(evaluate=evaluate, lower=[0.0] * 5, upper=[1.0] * 5, objectives=("f1", "f2", "f3"))


@pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())
def test_an_evaluation_that_raises_ends_a_trace_and_leaves_all_before(optimiser):
    whole = trace(dtlz2(5), optimiser, [30, 60, 3000], seed=3)
    seen, error = trace_so_far(ends_after(100), optimiser, [30, 60, 3000], seed=3)
    assert str(error) == "no solution"
    assert list(seen.states) == [30, 60]
    assert 90 <= len(seen.designs) <= 100
    np.testing.assert_array_equal(seen.designs, whole.designs[: len(seen.designs)])
    np.testing.assert_array_equal(seen.objectives, whole.objectives[: len(seen.designs)])
    with pytest.raises(RuntimeError, match=r"^no solution$"):
        trace(ends_after(100), optimiser, [30, 60, 3000], seed=3)


def test_a_trace_without_any_evaluation_is_empty():
    def never(designs: np.ndarray) -> np.ndarray:
        raise SystemExit(3)

    kinds = {"x1": "integer", "x2": (1.0, 2.5)}
    for given in ({}, {"kinds": kinds}):
        problem = Problem(evaluate=never, lower=(0, 1), upper=(9, 2.5), objectives=("f1", "f2"), **given)
        seen, error = trace_so_far(problem, Nsga2(population=20), [20], seed=0)
        assert isinstance(error, SystemExit)
        assert (seen.designs.shape, seen.objectives.shape, len(seen.states)) == ((0, 2), (0, 2), 0)

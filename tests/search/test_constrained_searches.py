"""Constraints g <= 0: every optimiser keeps to them, reaches constrained fronts, and says where it finds none."""

import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

from functions import bnh, bnh_set, c2dtlz2, c2dtlz2_front, srn, srn_set
from suspension_ctrl import InfeasibleWarning, MoeadDra, Nsga2, Problem, minimise
from suspension_ctrl.search.constraints import violations
from suspension_ctrl.search.evaluation import SearchProblem
from suspension_ctrl.search.gamultiobj import Gamultiobj
from suspension_ctrl.search.indicators import ReferenceFront, non_dominated
from suspension_ctrl.search.sampling import Sampling
from suspension_ctrl.study.reference import grid_front

OPTIMISERS = {
    "nsga2": Nsga2(population=40),
    "nsga2-deap-standard": Nsga2(population=40, selection="deap-standard"),
    "moead-dra": MoeadDra(population=40, utility_period=3),
    "moead-dra-batch": MoeadDra(population=40, update="batch"),
    "nsga2-gamultiobj": Gamultiobj(population=40),
    "sobol": Sampling(population=40),
}
every_optimiser = pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())
SETS = {"bnh": (bnh(), bnh_set), "srn": (srn(), srn_set)}


def closed_form(name: str) -> ReferenceFront:
    if name == "c2dtlz2":
        return ReferenceFront.of(np.unique(c2dtlz2_front(101).round(12), axis=0))
    problem, pareto_set = SETS[name]
    return ReferenceFront.of(problem.evaluate(pareto_set(500))[:, :2])


def disc() -> Problem:
    """f = (a, b) over [-1, 1]^2, feasible in a disc of radius 0.05 about (0.5, 0.5): 0.2 % of the box."""

    def evaluate(x):
        return np.column_stack([x, ((x - 0.5) ** 2).sum(axis=1) / 0.05**2 - 1])

    return Problem(
        evaluate=evaluate, lower=(-1, -1), upper=(1, 1), objectives=("a", "b"), constraints=("outside",)
    )


def unconstrained(problem: Problem) -> Problem:
    m = len(problem.objectives)
    return replace(problem, constraints=(), kernel=None, evaluate=lambda x: problem.evaluate(x)[:, :m])


@pytest.mark.parametrize("name", SETS)
def test_closed_forms_are_the_fronts(name):
    """By a grid of 301 x 301: it comes near every point of the front, and dominates none.

    The grid's own front lies within a step or so of the true one, in scaled objectives 1/150 of the range.
    """
    problem, pareto_set = SETS[name]
    values = problem.evaluate(pareto_set(200))
    assert values[:, 2:].max() < 1e-14
    assert non_dominated(values[:, :2]).mean() > 0.99  # arcs share their ends
    front, grid = closed_form(name), grid_front(problem, 301)
    assert front.igd_plus(grid) < 0.005
    # A grid point dominates no more than the gap between two of the 1000 or 1500 points of the closed form.
    assert ReferenceFront.of(grid).epsilon(front.objectives) < 0.003


BOUNDS = {  # of IGD+, some half as much again as what either reaches on these seeds
    "bnh": (0.005, 2000),
    "srn": (0.009, 4000),
    "c2dtlz2": (0.065, 6000),
}


@pytest.mark.parametrize("name", BOUNDS)
@pytest.mark.parametrize("kind", [Nsga2, MoeadDra])
def test_constrained_fronts_are_reached(name, kind):
    """N = 100, three seeds: all of the population feasible, IGD+ to the closed form within the bound."""
    problem = {"bnh": bnh, "srn": srn, "c2dtlz2": c2dtlz2}[name]()
    bound, evaluations = BOUNDS[name]
    front = closed_form(name)
    for seed in range(3):
        run = minimise(problem, kind(population=100), evaluations=evaluations, seed=seed)
        assert run.feasible.all()
        assert front.igd_plus(run.objectives) < bound


@every_optimiser
@pytest.mark.parametrize("problem", [srn(), c2dtlz2()], ids=["srn", "c2dtlz2"])
def test_without_its_constraints_a_search_ends_outside_them(problem, optimiser):
    free = minimise(unconstrained(problem), optimiser, iterations=40, seed=0)
    bound = minimise(problem, optimiser, iterations=40, seed=0)
    m = len(problem.objectives)
    assert (violations(problem.evaluate(free.designs), m) > 0).mean() > 0.2
    assert bound.feasible.all()


@every_optimiser
def test_runs_tell_their_constraints(optimiser):
    problem = srn()
    run = minimise(problem, optimiser, iterations=3, seed=1)
    values = problem.evaluate(run.designs)
    np.testing.assert_array_equal(run.objectives, values[:, :2])
    np.testing.assert_array_equal(run.constraints, values[:, 2:])
    np.testing.assert_allclose(run.violation, np.maximum(values[:, 2:], 0).sum(axis=1), rtol=1e-15)
    np.testing.assert_array_equal(run.feasible, (values[:, 2:] <= 0).all(axis=1))
    free = minimise(unconstrained(problem), optimiser, iterations=3, seed=1)
    assert free.constraints.shape == (len(free.designs), 0)
    assert free.feasible.all()
    assert not free.violation.any()


@every_optimiser
def test_a_small_feasible_region_is_found_and_kept(optimiser):
    """The least violation never rises, and the ideal point is that of feasible designs as soon as one is seen."""
    problem, seen = disc(), []
    toolbox = optimiser.toolbox(problem)
    toolbox.register("evaluate", lambda x: seen.append(problem.evaluate(x)) or seen[-1])
    search = optimiser.search(SearchProblem(problem), toolbox, np.random.default_rng(2))
    least = []
    for state, _ in zip(search, range(60), strict=False):
        least.append(state.violation.min())
        values = np.concatenate(seen)
        met = values[:, 2] <= 0
        assert least[-1] == np.maximum(values[:, 2], 0).min()
        np.testing.assert_array_equal(state.ideal, values[met if met.any() else slice(None), :2].min(axis=0))
    assert least[0] > 0
    assert least[-1] == 0
    assert (np.diff(least) <= 0).all()
    assert (state.ideal > 0.4).all()


@every_optimiser
def test_equal_objectives_leave_the_choice_to_the_constraint(optimiser):
    """Where all objectives are equal feasible designs still drive out infeasible ones."""
    problem = Problem(
        evaluate=lambda x: np.column_stack([0 * x, 0 * x, x - 0.2]),
        lower=(0,), upper=(1,), objectives=("a", "b"), constraints=("g",),
    )  # fmt: skip
    assert minimise(problem, optimiser, iterations=40, seed=0).feasible.all()


@every_optimiser
def test_a_problem_without_a_feasible_design_says_so(optimiser):
    """g1 = 1 + a and g2 = b - 2: at best a violation of 1, all of it of the first; the search comes within 5 %."""
    problem, impossible = (
        Problem(
            evaluate=lambda x, least=least: np.column_stack([x, least + x[:, 0], x[:, 1] - 2]),
            lower=(0, 0), upper=(1, 1), objectives=("a", "b"), constraints=("g1", "g2"),
        )
        for least in (-0.5, 1.0)
    )  # fmt: skip
    said = r"^no feasible design among (\d+) evaluated, least total violation ([\d.e+-]+): g1 ([\d.e+-]+)$"
    with pytest.warns(InfeasibleWarning, match=said) as caught:
        run = minimise(impossible, optimiser, iterations=30, seed=0)
    evaluations, least, first = re.match(said, str(caught[0].message)).groups()
    assert len(caught) == 1
    assert caught[0].filename == __file__
    assert int(evaluations) == run.evaluations
    assert float(least) == float(first) == pytest.approx(run.violation.min(), rel=5e-3)
    assert 1 <= run.violation.min() < 1.05
    assert not run.feasible.any()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        minimise(problem, optimiser, iterations=2, seed=0)


def test_a_warning_names_every_constraint_that_is_broken():
    problem = Problem(
        evaluate=lambda x: np.column_stack([x, 1 - x, 0 * x + 0.125, 0 * x - 1, 0 * x + 2]),
        lower=(0,), upper=(1,), objectives=("a", "b"), constraints=("heat", "noise", "weight"),
    )  # fmt: skip
    with pytest.warns(InfeasibleWarning, match=r"least total violation 2.12: heat 0.125, weight 2$"):
        minimise(problem, Nsga2(population=8), iterations=1, seed=0)

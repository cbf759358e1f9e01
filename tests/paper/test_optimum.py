import numpy as np
import pytest
from scipy.optimize import minimize

from suspension_ctrl import MoeadDra, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.paper import optimum


@pytest.mark.parametrize(
    ("weighting", "spring", "acc"),
    # Established by a prototype: least ACC about 2.160 at about 12 kN/m with Wk, 2.0726 at about 14 kN/m with Wb
    [("Wk", 12e3, 2.160), ("Wb", 14.0e3, 2.0726)],
)
def test_least_acc_at_the_papers_travel(weighting, spring, acc):
    problem = paper.ride_problem(weighting=weighting)
    design = optimum.best_at_limit(problem, 0.0287, "ACC")
    objectives = problem.evaluate([design])[0]
    assert objectives[1] == pytest.approx(0.0287, rel=1e-9)
    assert objectives[0] == pytest.approx(acc, abs=5.1e-4)  # half a unit of the fourth digit given
    assert design[0] == pytest.approx(spring, abs=0.5e3)  # "about", to a kN/m


@pytest.mark.parametrize("objective", ["ACC", "DTL"])
def test_agrees_with_a_constrained_minimiser(objective):
    """SLSQP on both variables at once, scaled to their bounds."""
    problem = paper.ride_problem()
    column = problem.objectives.index(objective)
    scale = np.array(problem.upper)
    typical = problem.evaluate([paper.reference_design()])[0]
    found = minimize(
        lambda x: problem.evaluate([x * scale])[0, column] / typical[column],
        x0=np.array([0.4, 0.3]),
        constraints={"type": "eq", "fun": lambda x: problem.evaluate([x * scale])[0, 1] / 0.0287 - 1},
        bounds=list(zip(problem.lower / scale, problem.upper / scale, strict=True)),
        options={"ftol": 1e-12},
    )
    design = optimum.best_at_limit(problem, 0.0287, objective)
    ours, theirs = problem.evaluate([design, found.x * scale])[:, column]
    assert ours == pytest.approx(theirs, rel=1e-6)


@pytest.mark.parametrize("limit", [0.0149, 0.0287, 0.0449])
@pytest.mark.parametrize("objective", ["ACC", "DTL"])
def test_no_spring_of_a_finer_row_is_better(limit, objective):
    """Also at limits that only a corner of the box meets, where the curve ends between two springs tried."""
    problem = paper.ride_problem()
    column = problem.objectives.index(objective)
    springs = np.linspace(problem.lower[0], problem.upper[0], 3001)
    curve = [(k, optimum.damper_at_limit(problem, k, limit)) for k in springs]
    least = problem.evaluate([design for design in curve if not np.isnan(design[1])])[:, column].min()
    found = problem.evaluate([optimum.best_at_limit(problem, limit, objective)])[0]
    assert found[1] == pytest.approx(limit, rel=1e-9)
    assert found[column] <= least * (1 + 1e-12)


def test_damper_at_limit_meets_it_or_is_nan():
    problem = paper.ride_problem()
    damper = optimum.damper_at_limit(problem, 12e3, 0.0287)
    assert problem.evaluate([[12e3, damper]])[0, 1] == pytest.approx(0.0287, rel=1e-10)
    assert np.isnan(optimum.damper_at_limit(problem, 12e3, 0.09))
    assert np.isnan(optimum.damper_at_limit(problem, 12e3, 0.001))


@pytest.mark.parametrize("limit", [0.001, 1.0])
def test_unreachable_limits_are_named(limit):
    with pytest.raises(ValueError, match=rf"^sws_limit must be .* 0\.0147 to 0\.0450 m, got {limit} m$"):
        optimum.best_at_limit(paper.ride_problem(), limit, "ACC")


def test_picks_the_least_objective_of_the_set_at_the_limit():
    problem = paper.ride_problem()
    run = minimise(problem, MoeadDra(population=3000), iterations=20, seed=0)
    acc, sws, dtl = run.objectives.T
    at_limit = (sws >= 0.998 * 0.0287) & (sws <= 0.0287)
    for objective, values, column in (("ACC", acc, 0), ("DTL", dtl, 2)):
        picked = problem.evaluate([optimum.pick_at_limit(problem, run, 0.0287, objective)])[0]
        assert 0.998 * 0.0287 <= picked[1] <= 0.0287
        assert picked[column] == pytest.approx(values[at_limit].min(), rel=1e-12)
    with pytest.raises(
        ValueError, match=r"^sws_limit must be a travel within 0.2 % of which the Pareto set has a design"
    ):
        optimum.pick_at_limit(problem, run, 0.001, "ACC")


def test_no_picked_design_is_better_than_the_exact_one():
    """Within the limit; least ACC is at the limit itself, since ACC falls as travel is given away."""
    problem = paper.ride_problem()
    run = minimise(problem, MoeadDra(population=3000), iterations=20, seed=0)
    exact = optimum.best_at_limit(problem, 0.0287, "ACC")
    picked = optimum.pick_at_limit(problem, run, 0.0287, "ACC")
    exact_acc, picked_acc = problem.evaluate([exact, picked])[:, 0]
    assert exact_acc <= picked_acc < 1.02 * exact_acc


@pytest.mark.parametrize("limit", [0.02, 0.0287])
def test_least_acc_up_to_the_limit_is_the_one_at_it(limit):
    """Discomfort falls with travel in this box, so both roads end in the same place: SLSQP against the curve."""
    problem = paper.ride_problem()
    found = optimum.least_within_limit(problem, limit, "ACC", np.array([[20e3, 3000.0], [5e3, 4000.0]]))
    exact = optimum.best_at_limit(problem, limit, "ACC")
    ours, theirs = problem.evaluate([found, exact])
    np.testing.assert_allclose(ours, theirs, rtol=1e-5)
    assert ours[0] == pytest.approx(theirs[0], rel=1e-9)


@pytest.mark.parametrize("objective", ["ACC", "DTL"])
def test_nothing_near_the_best_of_a_full_car_is_better(objective):
    """Where front and rear are equal the largest of them has a kink, which stops a plain descent."""
    problem, _ = paper.chosen("jian_2022_full", "C", None)
    lower, width = np.array(problem.lower), np.subtract(problem.upper, problem.lower)
    starts = lower + np.random.default_rng(0).random((4, 6)) * width
    best = np.array(optimum.least_within_limit(problem, 0.01, objective, starts))
    steps = np.random.default_rng(1).normal(size=(2000, 6)) * np.repeat([1e-4, 1e-2], 1000)[:, np.newaxis]
    near = problem.evaluate(np.clip(best + steps * width, problem.lower, problem.upper))
    column = problem.objectives.index(objective)
    reached = problem.evaluate([best])[0]
    assert reached[1] <= 0.01 * (1 + 1e-6)
    assert near[near[:, 1] <= reached[1], column].min() > reached[column] * (1 - 1e-7)


def test_a_limit_that_nothing_meets():
    with pytest.raises(
        ValueError, match=r"^sws_limit must be a travel that a design within the bounds has, got 0.001"
    ):
        optimum.least_within_limit(paper.ride_problem(), 0.001, "ACC", np.array([[20e3, 3000.0]]))

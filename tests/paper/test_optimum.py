"""The best struts within a travel limit: SLSQP against the curve SWS = limit, and designs picked from a set."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from suspension_ctrl import ACC, DTL, Measure, MoeadDra, RideProblem, minimise
from suspension_ctrl.commands.studies import chosen_study
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.paper import optimum

STARTS = np.array([[20e3, 3000.0], [5e3, 4000.0], [12e3, 1600.0]])
SPRINGS = 200


def damper_at_limit(problem: RideProblem, spring: float, limit: float) -> float:
    """Return the damper that brings SWS to the limit, NaN where none does; travel falls as damping rises."""

    def excess(damper: float) -> float:
        return problem.evaluate([[spring, damper]])[0, 1] - limit

    low, high = problem.lower[1], problem.upper[1]
    if excess(low) < 0 or excess(high) > 0:
        return np.nan
    return brentq(excess, low, high, xtol=1e-9, rtol=1e-14)


def last_on_curve(problem: RideProblem, inside: float, toward: float, limit: float) -> float:
    """Return the spring farthest from `inside` up to `toward` for which a damper meets the limit."""
    if not np.isnan(damper_at_limit(problem, toward, limit)):
        return toward
    while (middle := (inside + toward) / 2) not in (inside, toward):
        if np.isnan(damper_at_limit(problem, middle, limit)):
            toward = middle
        else:
            inside = middle
    return inside


def best_on_curve(problem: RideProblem, limit: float, objective: Measure) -> tuple[float, float]:
    """Return the best design with SWS = limit, by its spring alone."""
    column = problem.measures.index(objective)

    def along(spring: float) -> float:
        damper = damper_at_limit(problem, spring, limit)
        return damper if np.isnan(damper) else problem.evaluate([[spring, damper]])[0, column]

    springs = np.linspace(problem.lower[0], problem.upper[0], SPRINGS)
    best = int(np.nanargmin([along(spring) for spring in springs]))
    around = (springs[max(best - 1, 0)], springs[min(best + 1, SPRINGS - 1)])
    start, end = (last_on_curve(problem, springs[best], spring, limit) for spring in around)
    inside = minimize_scalar(along, bounds=(start, end), method="bounded", options={"xatol": 1e-6}).x
    spring = min((start, springs[best], inside, end), key=along)
    return spring, damper_at_limit(problem, spring, limit)


@pytest.mark.parametrize(
    ("weighting", "spring", "acc"),
    # Established by a prototype: least ACC about 2.160 at about 12 kN/m with Wk, 2.0726 at about 14 kN/m with Wb
    [("Wk", 12e3, 2.160), ("Wb", 14.0e3, 2.0726)],
)
def test_least_acc_at_the_papers_travel(weighting, spring, acc):
    problem = paper.ride_problem(weighting=weighting)
    design = optimum.least_within_limit(problem, 0.0287, ACC(), STARTS)
    objectives = problem.evaluate([design])[0]
    assert objectives[1] == pytest.approx(0.0287, rel=1e-9)
    assert objectives[0] == pytest.approx(acc, abs=5.1e-4)  # half a unit of the fourth digit given
    assert design[0] == pytest.approx(spring, abs=0.5e3)  # "about", to a kN/m


@pytest.mark.parametrize("limit", [0.0149, 0.02, 0.0287, 0.0449])
@pytest.mark.parametrize("objective", [ACC(), DTL()])
def test_the_best_at_the_limit_is_that_of_the_curve(limit, objective):
    """Also at limits that only a corner of the box meets."""
    problem = paper.ride_problem()
    column = problem.measures.index(objective)
    found = optimum.least_within_limit(problem, limit, objective, STARTS, at_limit=True)
    ours, theirs = problem.evaluate([found, best_on_curve(problem, limit, objective)])
    assert ours[1] == pytest.approx(limit, rel=1e-9)
    assert ours[column] == pytest.approx(theirs[column], rel=1e-9)


@pytest.mark.parametrize("limit", [0.02, 0.0287])
def test_least_acc_up_to_the_limit_is_the_one_at_it(limit):
    """Discomfort falls as travel is given away; tyre load has its least inside."""
    problem = paper.ride_problem()
    best = [optimum.least_within_limit(problem, limit, ACC(), STARTS, at_limit=at) for at in (True, False)]
    at, within = problem.evaluate(best)
    np.testing.assert_allclose(within, at, rtol=1e-5)
    assert within[0] == pytest.approx(at[0], rel=1e-9)
    (inside,) = problem.evaluate([optimum.least_within_limit(problem, 0.0287, DTL(), STARTS)])
    assert inside[1] < 0.9 * 0.0287


def test_picks_the_least_objective_of_the_set_at_the_limit():
    problem = paper.ride_problem()
    run = minimise(problem, MoeadDra(population=3000), iterations=20, seed=0)
    acc, sws, dtl = run.objectives.T
    at_limit = (sws >= 0.998 * 0.0287) & (sws <= 0.0287)
    for objective, values, column in ((ACC(), acc, 0), (DTL(), dtl, 2)):
        picked = problem.evaluate([optimum.pick_at_limit(problem, run, 0.0287, objective)])[0]
        assert 0.998 * 0.0287 <= picked[1] <= 0.0287
        assert picked[column] == pytest.approx(values[at_limit].min(), rel=1e-12)
    with pytest.raises(
        ValueError, match=r"^sws_limit must be a travel within 0.2 % of which the Pareto set has a design"
    ):
        optimum.pick_at_limit(problem, run, 0.001, ACC())


def test_no_picked_design_is_better_than_the_exact_one():
    """Within the limit; least ACC is at the limit itself, since ACC falls as travel is given away."""
    problem = paper.ride_problem()
    run = minimise(problem, MoeadDra(population=3000), iterations=20, seed=0)
    exact = optimum.least_within_limit(problem, 0.0287, ACC(), STARTS)
    picked = optimum.pick_at_limit(problem, run, 0.0287, ACC())
    exact_acc, picked_acc = problem.evaluate([exact, picked])[:, 0]
    assert exact_acc <= picked_acc < 1.02 * exact_acc


@pytest.mark.parametrize("objective", [ACC(), DTL()])
def test_nothing_near_the_best_of_a_full_car_is_better(objective):
    """Where front and rear are equal the largest of them has a kink, which stops a plain descent."""
    problem = chosen_study(vehicle="jian_2022_full", road="C").problem
    lower, width = np.array(problem.lower), np.subtract(problem.upper, problem.lower)
    starts = lower + np.random.default_rng(0).random((4, 6)) * width
    best = np.array(optimum.least_within_limit(problem, 0.01, objective, starts))
    steps = np.random.default_rng(1).normal(size=(2000, 6)) * np.repeat([1e-4, 1e-2], 1000)[:, np.newaxis]
    near = problem.evaluate(np.clip(best + steps * width, problem.lower, problem.upper))
    column = problem.measures.index(objective)
    reached = problem.evaluate([best])[0]
    assert reached[1] <= 0.01 * (1 + 1e-6)
    assert near[near[:, 1] <= reached[1], column].min() > reached[column] * (1 - 1e-7)


def test_a_limit_that_nothing_meets():
    with pytest.raises(
        ValueError, match=r"^sws_limit must be a travel that a design within the bounds has, got 0.001"
    ):
        optimum.least_within_limit(paper.ride_problem(), 0.001, ACC(), np.array([[20e3, 3000.0]]))


def test_a_problem_with_kinds_has_no_slopes_to_descend():
    problem = paper.ride_problem(kinds={"spring": (10e3, 12e3)})
    with pytest.raises(ValueError, match=r"^kinds must be none where a search descends, got \{'spring': "):
        optimum.least_within_limit(problem, 0.0287, ACC(), STARTS)


def test_a_held_spring_stays_where_it_is():
    """The damper of least ACC beside it, by a fine grid of dampers."""
    held = paper.ride_problem(lower=(12e3, 1e3), upper=(12e3, 5e3))
    starts = np.array([[12e3, 1.5e3], [12e3, 3e3]])
    spring, damper = optimum.least_within_limit(held, 0.0287, ACC(), starts)
    designs = np.column_stack([np.full(40_001, 12e3), np.linspace(1e3, 5e3, 40_001)])
    acc, sws, _ = held.evaluate(designs).T
    best = designs[np.where(sws <= 0.0287, acc, np.inf).argmin()]
    assert spring == 12e3
    assert damper == pytest.approx(best[1], abs=0.2)  # two steps of the grid

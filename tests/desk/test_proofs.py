"""Candidates as exact optima: at least as good as those of the run, least measures of a grid, prices."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from suspension_ctrl import (
    Measure,
    MoeadDra,
    Nsga2,
    Peak,
    SpeedBump,
    load_problem,
    minimise,
)
from suspension_ctrl.datafiles import path as data
from suspension_ctrl.desk import proofs
from suspension_ctrl.desk.candidate_table import candidates
from suspension_ctrl.desk.descent import HELD
from suspension_ctrl.desk.proofs import can_be_refined, refined_candidates, values_of, with_ends
from suspension_ctrl.desk.refinement import least_of, refine
from suspension_ctrl.paper import experiment as paper

OWN = Measure("stiffness", "N/m", lambda designs: designs[:, 0])
LIMITED = paper.ride_problem(constraints=["SWS <= 0.025"])


@pytest.fixture(scope="module")
def run():
    return minimise(LIMITED, MoeadDra(population=200), iterations=15, seed=1)


def test_the_least_of_a_search_is_that_of_a_grid_within_several_limits():
    """Against 801 x 801 designs, steps of 36 N/m and 5 N s/m: objectives to 0.2 %."""
    problem = paper.ride_problem(constraints=["SWS <= 0.025", "DTL <= 1400"])
    axes = [np.linspace(*pair, 801) for pair in problem.bounds.values()]
    values = problem.evaluate(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2))
    least = values[(values[:, 3:] <= 0).all(axis=1), :3].min(axis=0)
    run = minimise(problem, Nsga2(population=40), iterations=10, seed=1)
    more = with_ends(problem, run)
    assert len(more.designs) == len(run.designs) + 3
    assert more.feasible[-3:].all()
    found = more.objectives[-3:]
    np.testing.assert_allclose(np.diag(found), least, rtol=2e-3)
    assert (np.diag(found) <= least * (1 + HELD)).all()
    np.testing.assert_allclose(found, problem.evaluate(more.designs[-3:])[:, :3], rtol=1e-12)


def test_the_least_of_several_load_cases_is_no_worse_than_before():
    study = load_problem(data("studies/full_car.toml"))
    run = minimise(study, Nsga2(population=40), iterations=10, seed=1)
    more = with_ends(study, run)
    assert more.feasible[len(run.designs) :].all()
    before, after = (one.objectives[one.feasible].min(axis=0) for one in (run, more))
    assert (after < before).all()


def test_refined_candidates_are_exact_and_at_least_as_good(run):
    """In all objectives, but for the least of one, which is as good in that."""
    ends = with_ends(LIMITED, run)
    before, (more, after) = candidates(LIMITED, ends), refined_candidates(LIMITED, ends)
    assert list(after.name) == list(before.name)
    assert (after["residual"] <= 1e-8).all()
    headers = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]
    for (_, old), (_, new) in zip(before.iterrows(), after.iterrows(), strict=True):
        judged = [one for one in headers if f"least {one.split()[0]}" in old["name"]] or headers
        assert (new[judged].astype(float) <= old[judged].astype(float) * (1 + HELD)).all()
    assert more.feasible[-len(after) :].all()
    np.testing.assert_array_equal(more.objectives[-len(after) :], after[headers])


def test_prices_are_in_the_first_objective_and_stand_at_those_limits_that_are_active(run):
    _, table = refined_candidates(LIMITED, with_ends(LIMITED, run))
    price = table["price of SWS <= 25 mm [m/s^2 per m]"]
    least = table.index[table.name.str.contains("least ACC")]
    assert (price[least] < 0).all()
    assert price[table.name.str.contains("least SWS")].isna().all()
    between = table[(table.name == "between") | (table.name == "knee")]
    assert (between[["price of SWS [m/s^2 per m]", "price of DTL [m/s^2 per N]"]].dropna() <= 1e-9).all(axis=None)
    assert len(between)


@pytest.mark.parametrize(("below", "held"), [(HELD / 2, "SWS <= 25.12 mm"), (1e-3, "SWS")])
def test_the_price_is_that_of_a_limit_where_a_candidate_is_on_it(run, below, held):
    """Of travels a share below the limit, which counts as on it or not; it has more digits than names show."""
    most = 0.0251234567
    problem = paper.ride_problem(constraints=[f"SWS <= {most}"])

    def excess(damper: float, spring: float) -> float:
        return problem.evaluate(np.array([[spring, damper]]))[0, 1] - most * (1 - below)

    designs = np.array([(k, brentq(excess, 1e3, 5e3, (k,), rtol=1e-14)) for k in np.linspace(11e3, 14e3, 6)])
    values = problem.evaluate(designs)
    on_curve = replace(run, designs=designs, objectives=values[:, :3], constraints=values[:, 3:])
    _, table = refined_candidates(problem, on_curve)
    between = table[~table.name.str.contains("least")]
    prices = between[["price of SWS [m/s^2 per m]", "price of SWS <= 25.12 mm [m/s^2 per m]"]].fillna(0.0)
    assert len(between) >= 2
    assert (prices.pop(f"price of {held} [m/s^2 per m]") < -80.0).all()
    assert (prices == 0.0).all(axis=None)


def test_a_spring_of_a_catalogue_keeps_its_value():
    problem = paper.ride_problem(kinds={"spring": (10e3, 12e3)})
    run = minimise(problem, Nsga2(population=20), iterations=5, seed=1)
    more, table = refined_candidates(problem, with_ends(problem, run))
    assert {*more.designs[:, 0]} == {10e3, 12e3}
    assert (table["residual"].dropna() <= 1e-8).all()


def test_what_can_be_refined():
    assert can_be_refined(LIMITED)
    assert can_be_refined(paper.ride_problem(kinds={"spring": (10e3, 12e3)}))
    bump = {"bump": SpeedBump(height=0.05, length=1.0)}
    peak = paper.ride_problem(measures=["ACC", Peak("travel", "bump")], events=bump)
    robust = paper.ride_problem(measures=["mean ACC", "SWS"], scatter={"spring": 0.05})
    for problem in (paper.ride_problem(measures=["ACC", OWN]), peak, robust):
        assert not can_be_refined(problem)
    discrete = {"spring": (10e3, 12e3), "damper": "integer"}
    assert not can_be_refined(paper.ride_problem(kinds=discrete))


def test_without_exact_ends_the_least_of_a_run_is_refined_to_that_of_the_problem(run):
    """No other measure is held there."""
    table = refined_candidates(LIMITED, run)[1]
    row = table.index[table.name.str.contains("least ACC")]
    exact = least_of(LIMITED, "ACC", np.array([[22e3, 1500.0]])).measures["ACC"]
    assert table["ACC [m/s^2]"][row].item() == pytest.approx(exact, rel=1e-8)


def test_a_candidate_that_a_descent_makes_worse_stays_as_it_is(run, monkeypatch):
    def worse(*arguments, **options):
        found = refine(*arguments, **options)
        return replace(found, measures={name: 1.001 * value for name, value in found.measures.items()})

    monkeypatch.setattr(proofs, "refine", worse)
    before, (_, after) = candidates(LIMITED, run), refined_candidates(LIMITED, run)
    held = after[after.residual.isna()]
    assert len(held) > 1
    assert {*held["ACC [m/s^2]"]} <= {*before["ACC [m/s^2]"]}


def test_only_what_is_beyond_a_limit_by_rounding_is_on_it():
    """Designs of travels 2e-9 above and a tenth below the limit, and one beyond it."""
    best = refine(LIMITED, [22e3, 1500.0], minimise="ACC")
    design = np.array(list(best.design.values()))
    designs = np.array([design * [1.0, 1 - 4e-9], design * [1.0, 1.2], design * [1.0, 0.9]])
    own, values = LIMITED.evaluate(designs), values_of(LIMITED, designs)
    assert 0 < own[0, 3] < HELD
    assert values[0, 3] == 0.0
    np.testing.assert_array_equal(values[1:], own[1:])

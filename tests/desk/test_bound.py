"""The bound of all controllers: random designs are on one side of it, and so is its edge in a picture."""

import numpy as np
import pandas as pd
import pytest

from garage import QUARTER
from suspension_ctrl import PowerLawRoad, RideProblem, attainable
from suspension_ctrl.desk.bound import LEAST, LQG, LQR, SKYHOOK, WITHIN, criterion, edge
from suspension_ctrl.desk.skyhook_problems import with_sky

MEASURES = ["ACC [m/s^2]", "SWS [m]", "DTL [N]"]


@pytest.fixture(scope="module")
def problem():
    bounds = {"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
    return RideProblem(QUARTER, PowerLawRoad(roughness=5e-6, exponent=2.5), speed=20.0, bounds=bounds)


@pytest.fixture(scope="module")
def table(problem):
    return attainable(problem, present={"spring": 22e3, "damper": 1500.0}, points=32)


def test_no_passive_design_of_100000_is_beyond_the_bound(problem, table):
    rng = np.random.default_rng(1)
    designs = rng.uniform(problem.lower, problem.upper, (100_000, 2))
    least = criterion(table, problem.evaluate(designs)).min(axis=0)
    rows = table[table.controller == LQR]
    assert (least > rows[WITHIN]).all()
    assert (least > rows[LEAST]).all()  # though that holds what is beyond the band
    assert (least / rows[WITHIN]).min() < 1.2  # so that a bound that is 20 % too high fails
    sky = with_sky(problem)
    further = rng.uniform(sky.lower, sky.upper, (10_000, 3))
    assert (criterion(table, sky.evaluate(further)).min(axis=0) > rows[WITHIN]).all()


def test_the_edge_is_below_every_controller_that_the_front_admits(problem, table):
    rows = table[MEASURES]
    front = rows[table.controller == SKYHOOK]
    for up in (0, 2):
        pair = (MEASURES[1], MEASURES[up])
        other = MEASURES[2 - up]
        inside = rows[rows[other] <= front[other].max()]
        below = edge(table, front, pair, inside[pair[0]].to_numpy())
        assert (below <= inside[pair[1]] * (1 + 1e-9)).mean() > 0.95  # beyond the band is a little more
        assert (below <= inside[pair[1]] * 1.05).all()
        assert below.max() > 0.5 * inside[pair[1]].min()


def test_criteria_and_the_edge_are_those_of_regulators_alone():
    """By hand, with a present design (2, 4, 8) and at most 8 of the third measure on the front.

    At a first measure of 1 the second has at least w2 (y/4)^2 = within - w3 - w1/4.
    """
    headers = ["a [m]", "b [m]", "c [m]"]
    rows = [(LQR, 0.5, 0.3, 0.2, 0.6), (LQR, 0.2, 0.6, 0.2, 0.4), (LQG, 0.1, 0.8, 0.1, 9.0)]
    weights = [f"{name} weight [-]" for name in "abc"]
    table = pd.DataFrame(rows, columns=["controller", *weights, WITHIN])
    table.attrs |= {"measures": headers, "present": [2.0, 4.0, 8.0]}
    front = pd.DataFrame([[1.5, 9.0, 8.0], [3.0, 5.0, 4.0]], columns=headers)
    found = edge(table, front, ("a [m]", "b [m]"), np.array([1.0, 9.0]))
    assert found[0] == pytest.approx(4 * max(np.sqrt(0.275 / 0.3), np.sqrt(0.15 / 0.6)), rel=1e-12)
    assert found[1] == 0.0
    assert criterion(table, np.array([[2.0, 8.0, 4.0]])) == pytest.approx(np.array([[1.75, 2.65]]), rel=1e-12)

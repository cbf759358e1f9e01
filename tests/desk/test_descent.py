"""Descents on programs of the paper's car: where they end, and that those within no limits end early."""

from types import SimpleNamespace

import numpy as np
import pytest

from suspension_ctrl.desk.descent import HELD, End, descended, excess_of
from suspension_ctrl.desk.refinement import program_of
from suspension_ctrl.paper import experiment as paper

PROBLEM = paper.ride_problem()


def end_of(within: dict, minimise: str = "ACC"):
    program = program_of(PROBLEM, np.array([22e3, 1500.0]), minimise, within)
    rounds, resize = [], program.resize
    program.resize = lambda z: rounds.append(z) or resize(z)
    return descended(program), rounds


def test_an_end_has_the_value_and_the_design_of_the_problem():
    end, _ = end_of({"SWS": 0.0287})
    values = PROBLEM.evaluate([end.design])[0]
    assert end.value == pytest.approx(values[0], rel=1e-12)
    assert end.feasible
    assert values[1] == pytest.approx(0.0287, rel=HELD)
    assert end.conditions.residual < 1e-8


def test_where_no_design_is_within_the_limits_a_descent_ends_early():
    """At the corner of least travel, after one round or two of the four."""
    end, rounds = end_of({"SWS": 0.001})
    assert not end.feasible
    assert len(rounds) <= 2
    np.testing.assert_allclose(end.design, PROBLEM.upper, rtol=1e-6)


@pytest.mark.parametrize(
    ("rows", "equal", "excess"),
    [([9.0, -1.0], [False, True], 1.0), ([9.0, -1.0], [False, False], 0.0), ([9.0, 0.5, -2.0], [False] * 3, 0.5)],
)
def test_the_excess_is_above_zero_or_beside_it(rows, equal, excess):
    program = SimpleNamespace(at=lambda _: SimpleNamespace(rows=np.array(rows)), equal=np.array(equal))
    assert excess_of(program, np.zeros(2)) == excess


@pytest.mark.parametrize(("row", "feasible"), [(0.9e-8, True), (1.1e-8, False)])
def test_a_limit_is_held_to_rounding(row, feasible):
    program = SimpleNamespace(at=lambda _: SimpleNamespace(rows=np.array([9.0, row])), equal=np.zeros(2, bool))
    assert End(program, np.zeros(2), None).feasible == feasible

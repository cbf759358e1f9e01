"""Descents on programs of the paper's car: where they end, and that those within no limits end early."""

import numpy as np
import pytest

from suspension_ctrl.desk.descent import HELD, descended
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

"""Active bounds and limits by their places in the range."""

import numpy as np
import pytest

from suspension_ctrl import Limit, Problem
from suspension_ctrl.desk.active import designs_by_text, limit_text, reached


def problem_of(lower, upper, **others) -> Problem:
    return Problem(
        evaluate=lambda x: np.column_stack([x[:, 0], -x[:, 0]]),
        lower=lower,
        upper=upper,
        objectives=("a", "b"),
        **others,
    )


def test_a_bound_is_active_within_a_percent_of_the_range():
    problem = problem_of((0.0, 10.0), (100.0, 10.0))
    designs = np.array([[0.9, 10.0], [1.1, 10.0], [99.1, 10.0], [98.9, 10.0]])
    found = reached(problem, designs, np.empty((4, 0)))
    assert found == [["x1 at its lower bound"], [], ["x1 at its upper bound"], []]


def test_a_present_design_may_be_beyond_a_bound():
    found = reached(problem_of((0.0,), (100.0,)), np.array([[-2.0], [102.0]]), np.empty((2, 0)))
    assert found == [["x1 beyond its lower bound"], ["x1 beyond its upper bound"]]


def test_a_design_as_near_to_a_bound_from_beyond_is_at_it():
    found = reached(problem_of((0.0,), (100.0,)), np.array([[-0.9], [100.9]]), np.empty((2, 0)))
    assert found == [["x1 at its lower bound"], ["x1 at its upper bound"]]


def test_a_logarithm_and_a_catalogue_have_ends_of_their_own():
    kinds = {"x1": "log", "x2": (20.0, 30.0, 40.0)}
    problem = problem_of((1.0, 0.0), (1000.0, 100.0), kinds=kinds)
    designs = np.array([[1.05, 20.0], [8.0, 30.0], [970.0, 40.0]])
    low, _, high = reached(problem, designs, np.empty((3, 0)))
    assert low == ["x1 at its lower bound", "x2 at its lower bound"]
    assert high == ["x1 at its upper bound", "x2 at its upper bound"]
    assert reached(problem, designs, np.empty((3, 0)))[1] == []


def test_a_limit_is_reached_or_exceeded():
    problem = problem_of((0.0,), (1.0,), constraints=("heat", "cost"))
    found = reached(problem, np.full((3, 1), 0.5), np.array([[-0.5, -0.009], [0.0, -0.02], [0.1, 0.2]]))
    assert found == [
        ["at the limit cost"],
        ["at the limit heat"],
        ["beyond the limit heat", "beyond the limit cost"],
    ]


def test_designs_are_counted_by_text():
    assert designs_by_text([["a"], [], ["b", "a"]]) == {"a": [1, 3], "b": [3]}


@pytest.mark.parametrize(
    ("limit", "text"),
    [
        ("SWS <= 0.0125", "SWS <= 12.5 mm"),
        ("roll_damping >= 0.2", "roll_damping >= 0.2"),
        ("DTL <= 1500", "DTL <= 1.5 kN"),
    ],
)
def test_a_limit_reads_in_mm_and_kn(limit, text):
    assert limit_text(Limit.parse(limit)) == text
    assert limit_text("cost") == "cost"

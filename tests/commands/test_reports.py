"""What is said of timed runs; the runs themselves are those of a small comparison."""

import pytest

from suspension_ctrl.commands.reports import uses_weighting


@pytest.mark.parametrize(
    ("measures", "used"),
    [
        (["ACC", "SWS"], True),
        (["comfort = ACC", "SWS"], True),
        (["comfort = Wk body_acceleration", "SWS"], False),  # a weighting of its own
        (["SWS", "DTL"], False),
        (["my ACC = SWS", "DTL"], False),
    ],
)
def test_weighting_is_used_by_measures_that_depend_on_it(table1_problem, measures, used):
    assert uses_weighting(table1_problem.replace(measures=measures)) is used


def test_without_a_weighting_none_is_used(table1_problem):
    assert not uses_weighting(table1_problem.replace(weighting=None))

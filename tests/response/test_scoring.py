"""What a problem is judged by: columns of measures and limits, the middle of the box, nodes that resolve it."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.scoring import judged_by


@pytest.fixture(scope="module")
def problem():
    file = sc.load_vehicle("yuen_ramli_2010")
    limits = ["SWS <= 0.03"]
    return sc.RideProblem(
        file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds, constraints=limits, nodes=256
    )


def test_scores_are_the_columns_of_the_evaluation(problem):
    designs = np.array([[2e4, 2e3], [1e4, 4e3]])
    found = problem.scoring.scores.evaluate(designs, problem.nodes)
    np.testing.assert_array_equal(found, problem.evaluate(designs))
    assert [str(one) for one in problem.scoring.judged] == ["ACC", "SWS", "DTL", "SWS <= 0.03"]


def test_the_middle_is_that_of_the_bounds(problem):
    assert problem.scoring.middle == {
        name: pytest.approx((low + high) / 2) for name, (low, high) in problem.bounds.items()
    }
    assert problem.scoring.robust is None


def test_nodes_are_found_or_checked(problem):
    assert problem.scoring.resolving(None) == 256
    assert problem.scoring.resolving(300) == 300
    with pytest.raises(ValueError, match="nodes must resolve every resonance in the box to 1e-06, got 8, which"):
        problem.scoring.resolving(8)


def test_limits_are_read_with_the_names_of_measures():
    measures, limits = judged_by(["soft = ACC", sc.DTL], ["soft <= 2", sc.Limit(sc.SWS(), 0.03)])
    assert [one.label for one in measures] == ["soft", "DTL"]
    assert limits[0].measure is measures[0]
    with pytest.raises(ValueError, match="measures must be"):
        judged_by("ACC", [])

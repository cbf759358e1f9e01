"""Descents from random designs, on a few starts."""

import numpy as np

import refined_starts
from suspension_ctrl.paper import experiment as paper


def test_starts_are_counted_by_where_they_end():
    ends = refined_starts.Ends(
        np.array([2.0, 1.0, 1.0 + 1e-9, 2.0]),
        np.array([1e-9, 1e-12, 1e-3, 1e-13]),
        np.array([0.1, 0.2, 0.3, 0.4]),
        1,
    )
    assert ends.describe() == [
        "3 of 5 with a residual below 1e-08 (largest 1e-03), 1 without a design within the limits",
        "2 at the best value 1; local: 2 (2)",
        "0.250 s (median), 0.400 s (longest) of processor time",
    ]


def test_the_papers_car_has_one_optimum():
    problem = paper.ride_problem(constraints=["SWS <= 0.0287"])
    ends = refined_starts.refined(problem, "ACC", 5)
    assert ends.failed == 0
    assert np.ptp(ends.values) < 1e-9
    assert ends.residuals.max() < 1e-8

"""Derivatives of measures of cornering, exact, over load cases and beside differences of evaluations."""

import numpy as np
import pytest

from garage import FULL, GEOMETRY, ROAD
from suspension_ctrl import LoadCase, Payload, RideProblem

MEASURES = ["ACC", "roll_gradient", "-front_load_transfer"]
BOUNDS = {"front.spring": (15e3, 30e3), "rear.spring": (15e3, 30e3), "front_antiroll": (0.0, 3e4)}
DESIGN = np.array([2e4, 2.4e4, 1e4])


def problem_of(worst_case: bool, **changes) -> RideProblem:
    laden = Payload(mass=300.0, position=(-1.0, 0.2)).on(FULL)
    cases = [
        LoadCase(vehicle=vehicle, road=ROAD, speed=20.0, share=share, roll_geometry=GEOMETRY)
        for vehicle, share in ((FULL, 3.0), (laden, 1.0))
    ]
    struts = {"front.damper": 1500.0, "rear.damper": 1700.0}
    kept = {"bounds": BOUNDS, "struts": struts, "band": (0.5, 20.0), "nodes": 256, "worst_case": worst_case}
    return RideProblem(cases=cases, measures=MEASURES, **{**kept, **changes})


@pytest.mark.parametrize("worst_case", [False, True])
def test_measures_of_cornering_beside_differences(worst_case):
    """Central differences by 1e-4 of the variables are off by some 1e-8 of the largest change of a column."""
    problem = problem_of(worst_case, constraints=["roll_gradient <= 6"])
    steps = 1e-4 * np.diag(DESIGN)
    rows = (problem.evaluate(DESIGN + steps) - problem.evaluate(DESIGN - steps))[:, 1:] / 2e-4
    found = problem.jacobian([DESIGN])[0, 1:] * DESIGN
    largest = np.abs(found).max(axis=1, keepdims=True)
    np.testing.assert_allclose(found / largest, rows.T / largest, rtol=0, atol=1e-6)


def test_with_parameters_that_vary_it_is_by_differences():
    """Of a variable tyre the derivatives by springs are the same."""
    plain = problem_of(False).jacobian([DESIGN])[0]
    tyre = FULL.front_tyre_stiffness
    bounds = {**BOUNDS, "front_tyre_stiffness": (0.9 * tyre, 1.1 * tyre)}
    varied = problem_of(False, bounds=bounds).jacobian([[*DESIGN, tyre]])[0]
    np.testing.assert_allclose(varied[:, :3] * DESIGN, plain * DESIGN, atol=1e-8 * np.abs(plain * DESIGN).max())

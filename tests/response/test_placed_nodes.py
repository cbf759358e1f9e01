"""Nodes placed for a box beside many more even ones, for designs that no rule has seen."""

from dataclasses import replace

import numpy as np
import pytest

from garage import DAMPED_QUARTER, FULL
from suspension_ctrl import Damper, Iso8608Road, LoadCase, RideProblem, Spring, parallel, series
from suspension_ctrl.response.placed_nodes import placed

ROAD, ACCURACY = Iso8608Road("C"), 1e-7
AXLES = {
    f"{axle}.{name}": ends
    for axle in ("front", "rear")
    for name, ends in (("spring", (1e4, 3e4)), ("damper", (1e3, 3e3)))
}


def quarter(**options) -> RideProblem:
    bounds = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
    return RideProblem(DAMPED_QUARTER, ROAD, speed=20.0, bounds=bounds, **options)


def designs(problem: RideProblem, count: int) -> np.ndarray:
    return np.random.default_rng(7).uniform(problem.lower, problem.upper, (count, len(problem.lower)))


@pytest.fixture(scope="module")
def cars() -> list[RideProblem]:
    """A quarter car, and a full car in two load cases with other cross-spectra of its wheels."""
    cases = [LoadCase(vehicle=FULL, road=ROAD, speed=v, share=v) for v in (12.0, 30.0)]
    own = {one.name: 1e4 for one in FULL.strut_coefficients if one.name not in AXLES}
    full = RideProblem(cases=cases, bounds=AXLES, struts=own, band=(0.5, 20.0))
    return [quarter(), full]


def test_values_are_those_of_many_more_nodes(cars):
    for problem in cars:
        x, rules = designs(problem, 500), placed(problem.scores, problem.nodes, problem.scoring.corners, ACCURACY)
        assert rules is not None
        found, expected = (problem.scores.evaluate(x, nodes) for nodes in (rules, 4 * problem.nodes))
        np.testing.assert_allclose(found, expected, rtol=ACCURACY)
        for rule in rules.rules:
            assert rule.f.size < problem.nodes / 2
            assert (rule.w > 0).all()
            assert (np.diff(rule.f) > 0).all()


def test_an_accuracy_that_is_not_reached_with_fewer_nodes_takes_the_others(cars):
    assert placed(cars[0].scores, 30, cars[0].scoring.corners, 1e-9) is None


def test_a_problem_of_an_accuracy_has_the_values_of_its_kernel_and_exact_derivatives():
    problem = quarter(accuracy=1e-8)
    x = designs(problem, 20)
    values, jacobian = problem.with_jacobian(x)
    np.testing.assert_allclose(values, quarter().evaluate(x), rtol=1e-8)
    np.testing.assert_array_equal(np.array([problem.kernel(one) for one in x]), problem.evaluate(x))
    step = 1e-5 * x  # truncation and rounding of differences: 1e-10 and 1e-11 of the values
    for v in range(2):
        moved = x.copy(), x.copy()
        for sign, one in zip((1, -1), moved, strict=True):
            one[:, v] += sign * step[:, v]
        slope = (problem.evaluate(moved[0]) - problem.evaluate(moved[1])) / 2
        off = np.abs(jacobian[:, :, v] * step[:, [v]] - slope)
        assert (off <= 1e-10 * np.abs(values)).all()


def test_vehicles_with_networks_keep_even_nodes():
    car = replace(DAMPED_QUARTER, strut=parallel(series(Spring("mount"), Spring("spring")), Damper("damper")))
    given = {"bounds": {"spring": (2e4, 4e4)}, "struts": {"mount": 2e5, "damper": 2e3}}
    problem = RideProblem(car, ROAD, speed=20.0, accuracy=1e-8, **given)
    x = designs(problem, 3)
    np.testing.assert_array_equal(problem.evaluate(x), problem.replace(accuracy=None).evaluate(x))


@pytest.mark.parametrize("accuracy", [0.0, 1e-3, "high"])
def test_other_accuracies_are_refused(accuracy):
    with pytest.raises(ValueError, match="accuracy must be a number from 1e-09 to 1e-06, got"):
        quarter(accuracy=accuracy)

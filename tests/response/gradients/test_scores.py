"""Derivatives of objectives and constraints beside complex steps, for vehicles of all kinds."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import complex_step
from garage import FULL, HALF, QUARTER, ROAD, VEHICLES, struts_of
from suspension_ctrl import Constant, LoadCase, Payload, RideProblem

ROUNDING = 1e-10
"""Of the largest change of a column by the share of a variable: some 300 products of n = 256 sums."""


def problem_of(vehicle, **changes) -> RideProblem:
    values = vehicle.coefficients(struts_of(vehicle))
    names = [name for name in values if name.split(".")[0] in ("spring", "damper", "front", "rear", "driver")]
    bounds = {name: (0.7 * values[name], 1.4 * values[name]) for name in names}
    band = (0.5, 20.0) if len(vehicle.contact_points) > 1 else (0.0, 20.0)
    return RideProblem(vehicle, ROAD, speed=20.0, bounds=bounds, band=band, **changes)


def check(problem: RideProblem, design: np.ndarray, tolerance: float = ROUNDING) -> None:
    """Compare relative changes of each column by relative changes of the variables."""
    values, found = problem.with_jacobian(design[None])
    np.testing.assert_allclose(values, problem.evaluate(design[None]), rtol=1e-12)
    expected = complex_step.jacobian(problem, design)
    scale = np.abs(expected * design).max(axis=1, keepdims=True) / design
    np.testing.assert_array_less(np.abs(found[0] - expected), tolerance * scale)


PROBLEMS = {
    name: problem_of(vehicle, constraints=["SWS <= 0.02", "ACC <= 2"]) for name, vehicle in VEHICLES.items()
}


@pytest.mark.parametrize("name", PROBLEMS)
@settings(max_examples=3)
@given(data=st.data())
def test_derivatives_of_every_vehicle(name, data):
    problem = PROBLEMS[name]
    share = data.draw(st.lists(st.floats(0, 1), min_size=len(problem.lower), max_size=len(problem.lower)))
    check(problem, np.asarray(problem.lower) + np.array(share) * np.subtract(problem.upper, problem.lower))


@pytest.mark.parametrize("worst_case", [False, True])
def test_load_cases_by_shares_or_the_worst(worst_case):
    laden = Payload(mass=300.0, position=(-1.0, 0.2)).on(FULL)
    cases = [
        LoadCase(vehicle=vehicle, road=ROAD, speed=speed, share=share)
        for vehicle, speed, share in ((FULL, 20.0, 3.0), (laden, 12.0, 1.0), (FULL, 30.0, 0.5))
    ]
    problem = problem_of(FULL, constraints=["DTL <= 1000"], worst_case=worst_case)
    kept = {"bounds": problem.bounds, "band": problem.band, "constraints": ["DTL <= 1000"]}
    several = RideProblem(cases=cases, worst_case=worst_case, measures=["ACC", "SWS rear", "DTL front"], **kept)
    check(several, 0.3 * np.asarray(several.lower) + 0.7 * np.asarray(several.upper))


def test_sums_of_terms_with_factors_and_more_is_better():
    texts = ["total (0.3, 0.2) at seat 0.4", "-DTL", "2 body_acceleration + 0.5 pitch_acceleration", "A8"]
    problem = problem_of(HALF, measures=texts)
    check(problem, 0.5 * np.asarray(problem.lower) + 0.5 * np.asarray(problem.upper))


def test_a_root_mean_square_of_zero_has_no_derivative():
    """No roll on a road shaped like a cylinder: neither infinite nor undefined."""
    problem = problem_of(FULL, measures=["ACC", "roll_acceleration"])
    problem = problem.replace(road=replace(ROAD, coherence=Constant(1.0)))
    values, jacobian = problem.with_jacobian([problem.lower])
    assert values[0, 1] == 0.0
    np.testing.assert_array_equal(jacobian[0, 1], 0.0)
    assert (jacobian[0, 0] != 0.0).any()


def test_the_same_designs_as_of_evaluate_are_refused():
    problem = PROBLEMS["quarter"]
    with pytest.raises(ValueError, match=r"^designs must lie within"):
        problem.jacobian([[0.1 * problem.lower[0], problem.lower[1]]])
    with pytest.raises(ValueError, match=r"^designs must have shape \(n, 2\)"):
        problem.jacobian([1.0, 2.0])
    assert problem.jacobian(np.empty((0, 2))).shape == (0, 5, 2)


def test_parameters_in_place_of_rates_by_the_chain_rule():
    """Masses, tyres, ratios and frequencies: coefficients are sums of products of them."""
    bounds = {
        "ride_frequency": (1.1, 1.5), "damping_ratio": (0.2, 0.5), "body_mass": (280.0, 350.0),
        "tyre_stiffness": (150e3, 220e3),
    }  # fmt: skip
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds)
    check(problem, np.array([1.25, 0.3, 310.0, 180e3]))
    bounds = {
        "spring": (1e4, 3e4),
        "damper": (1e3, 3e3),
        "installation_ratio": (0.8, 1.2),
        "wheel_mass": (30.0, 60.0),
    }
    check(RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds), np.array([2e4, 1500.0, 0.9, 42.0]))


def test_the_place_of_a_seat():
    vehicle = VEHICLES["full with seat"]
    bounds = {
        "driver.x": (0.1, 0.6),
        "driver.y": (0.2, 0.5),
        "driver.mass": (60.0, 110.0),
        "front.spring": (15e3, 30e3),
    }
    problem = RideProblem(
        vehicle, ROAD, speed=20.0, bounds=bounds, band=(0.5, 20.0), measures=["ACC driver", "SWS front", "DTL"],
        struts={"front.damper": 1500.0, "rear": (23e3, 1700.0)},
    )  # fmt: skip
    check(problem, np.array([0.35, 0.4, 85.0, 2e4]))

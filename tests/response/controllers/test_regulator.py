"""The regulator against python-control, Lyapunov equations, and a search over gains."""

import control
import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov
from scipy.optimize import minimize

from garage import HALF, QUARTER, struts_of
from suspension_ctrl import Iso8608Road, LoadCase, PowerLawRoad, Term
from suspension_ctrl.response.controllers.actuated import Actuated
from suspension_ctrl.response.controllers.regulator import regulator
from suspension_ctrl.response.controllers.road_model import RoadModel

WHITE, COLOURED = Iso8608Road("C"), PowerLawRoad(roughness=5e-6, exponent=2.5)
QUARTER_TERMS = [Term("body_acceleration"), Term("suspension_travel"), Term("tyre_load")]
SQUARES = np.array([1.0, 0.7e4, 1.2e-6])


def _made(vehicle, road, terms):
    plant = Actuated.of(vehicle, vehicle.coefficients(struts_of(vehicle)), terms)
    case = LoadCase(vehicle=vehicle, road=road, speed=20.0)
    return plant, RoadModel.of(case, (0.0, 20.0), falls=plant.load_by_rate, displaced=plant.by_road)


def _whole(plant, roads):
    """Return A, B, C, D and the noise's B of vehicle and roads together."""
    n, k = len(plant.rates.state), len(roads.a)
    a = np.block([[plant.rates.state, plant.rates.rate @ roads.rate], [np.zeros((k, n)), roads.a]])
    b = np.vstack([plant.rates.force, np.zeros((k, plant.rates.force.shape[1]))])
    c = np.hstack([plant.terms.state, plant.terms.rate @ roads.rate])
    return a, b, c, plant.terms.force, np.vstack([plant.rates.rate @ roads.direct, roads.b])


def _criterion(gains, whole, squares, effort):
    """Return the sum of weighted mean squares by a Lyapunov equation, infinite where it is unstable."""
    a, b, c, d, noise = whole
    closed = a - b @ gains
    if np.linalg.eigvals(closed).real.max() >= 0:
        return np.inf
    covariance = solve_continuous_lyapunov(closed, -noise @ noise.T)
    outputs = c - d @ gains
    terms = np.diag(outputs @ covariance @ outputs.T)
    return float(squares @ terms + effort @ np.diag(gains @ covariance @ gains.T))


CASES = {
    "quarter, white": (QUARTER, WHITE, QUARTER_TERMS, SQUARES, np.zeros(1)),
    "quarter, coloured": (QUARTER, COLOURED, QUARTER_TERMS, SQUARES, np.zeros(1)),
    "quarter, weighted": (
        QUARTER, COLOURED, [Term("body_acceleration", "Wk"), *QUARTER_TERMS[1:]], SQUARES, np.array([1e-9]),
    ),
    "half": (
        HALF, WHITE, [Term("body_acceleration"), Term("front_suspension_travel"), Term("rear_suspension_travel"),
                      Term("front_tyre_load"), Term("rear_tyre_load")],
        np.array([1.0, 1e4, 1e4, 1e-6, 1e-6]), np.array([1e-9, 1e-9]),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_gains_are_those_of_python_control(name):
    """One Riccati equation of vehicle and roads together."""
    vehicle, road, terms, squares, effort = CASES[name]
    plant, roads = _made(vehicle, road, terms)
    found = regulator(plant, roads, squares, effort)
    a, b, c, d, _ = whole = _whole(plant, roads)
    cost = d.T @ (squares[:, None] * d) + np.diag(effort)
    expected, *_ = control.lqr(a, b, c.T @ (squares[:, None] * c), cost, c.T @ (squares[:, None] * d))
    gains = np.hstack([found.feedback, found.ahead])
    # The whole Riccati equation, with states of the roads that are no better scaled, is solved to some 1e-8.
    np.testing.assert_allclose(gains, expected, rtol=1e-5, atol=1e-6 * abs(expected).max())
    assert found.least == pytest.approx(_criterion(gains, whole, squares, effort), rel=1e-6)


@pytest.mark.parametrize("name", ["quarter, coloured", "half"])
def test_no_other_gains_have_a_smaller_criterion(name):
    vehicle, road, terms, squares, effort = CASES[name]
    plant, roads = _made(vehicle, road, terms)
    found, whole = regulator(plant, roads, squares, effort), _whole(plant, roads)
    gains, rng = np.hstack([found.feedback, found.ahead]), np.random.default_rng(1)
    for size in (1e-3, 1e-2, 0.1):
        for _ in range(10):
            other = gains * (1 + size * rng.standard_normal(gains.shape))
            assert _criterion(other, whole, squares, effort) >= found.least * (1 - 1e-9)


def test_a_search_over_state_gains_ends_at_the_regulator():
    """Four gains on white velocity by Nelder and Mead from gains that are 30 % off."""
    plant, roads = _made(QUARTER, WHITE, QUARTER_TERMS)
    found, whole = regulator(plant, roads, SQUARES, np.zeros(1)), _whole(plant, roads)

    def criterion(x):
        return _criterion(found.feedback * x, whole, SQUARES, np.zeros(1))

    start = np.array([0.7, 1.3, 0.8, 1.2])
    ends = minimize(
        criterion, start, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-13, "maxiter": 600}
    )
    assert criterion(start) > 1.01 * found.least
    assert ends.fun == pytest.approx(found.least, rel=1e-9)
    np.testing.assert_allclose(ends.x, 1.0, atol=1e-3)  # where the criterion is flat: its root


def test_a_motion_that_does_not_count_is_told():
    """Without the travel a body may drift at a constant velocity."""
    plant, roads = _made(QUARTER, WHITE, [QUARTER_TERMS[0], QUARTER_TERMS[2]])
    with pytest.raises(ValueError, match=r"^measures must count all motions.*, got some that do not$"):
        regulator(plant, roads, SQUARES[[0, 2]], np.zeros(1))


def test_feedback_does_not_depend_on_the_road():
    plant, white = _made(QUARTER, WHITE, QUARTER_TERMS)
    _, coloured = _made(QUARTER, COLOURED, QUARTER_TERMS)
    first, second = (regulator(plant, roads, SQUARES, np.zeros(1)) for roads in (white, coloured))
    np.testing.assert_array_equal(first.feedback, second.feedback)
    assert second.ahead.any()

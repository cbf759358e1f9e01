"""The controller of least measure within limits: the reference car by equations written down by hand."""

import numpy as np
import pytest
from scipy.linalg import solve_continuous_are, solve_continuous_lyapunov
from scipy.optimize import root

from garage import QUARTER
from suspension_ctrl import Iso8608Road, RideProblem, load_vehicle
from suspension_ctrl.response.controllers.active_suspension import ActiveSuspension
from suspension_ctrl.response.controllers.within_limits import HELD, least_controlled

PRESENT = np.array([22e3, 1500.0])


def _by_hand():
    """Return the ratio of accelerations at equal travel and tyre load over all frequencies, white road velocity.

    States: travel, body velocity, tyre deflection, wheel velocity; input the body acceleration.
    """
    ms, mu, kt, k, c = 317.5, 45.4, 192e3, 22e3, 1500.0
    a, b, noise = np.zeros((4, 4)), np.zeros((4, 1)), np.array([[0.0], [0.0], [-1.0], [0.0]])
    a[0, [1, 3]], a[2, 3], a[3, 2] = (1.0, -1.0), 1.0, -kt / mu
    b[1], b[3] = 1.0, -ms / mu
    passive = np.array([[-k, -c, 0.0, c]]) / ms

    def squares(gains):
        covariance = solve_continuous_lyapunov(a + b @ gains, -noise @ noise.T)
        return np.array([(gains @ covariance @ gains.T)[0, 0], covariance[0, 0], covariance[2, 2]])

    own = squares(passive)

    def ratios(logarithms):
        weights = np.exp(logarithms) * own[0] / own[1:]
        p = solve_continuous_are(a, b, np.diag([weights[0], 0.0, weights[1], 0.0]), np.eye(1))
        return squares(-b.T @ p) / own

    found = root(lambda x: np.log(ratios(x)[1:]), [-2.0, 0.0])
    assert found.success
    return float(np.sqrt(ratios(found.x)[0]))


def test_the_reference_car_with_a_controller_has_0_842_of_its_acceleration():
    problem = RideProblem(
        QUARTER, Iso8608Road("C"), speed=20.0, bounds={"spring": (1e3, 30e3), "damper": (1e3, 5e3)},
        weighting=None, band=(0.0, 500.0),
    )  # fmt: skip
    active = ActiveSuspension.of(problem, PRESENT)
    own = active.measures_of(active.present)
    found = least_controlled(active, 0, own).measures / own
    np.testing.assert_allclose(found[1:], 1.0, rtol=HELD)
    by_hand = _by_hand()
    assert by_hand == pytest.approx(0.842, abs=5e-4)
    assert found[0] == pytest.approx(by_hand, rel=1e-3)  # in a band to 500 Hz


def test_the_worst_wheel_is_within_its_limit_and_others_have_room():
    file = load_vehicle("minaker_half")
    problem = RideProblem(file.vehicle, Iso8608Road("C"), speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    active = ActiveSuspension.of(problem, np.array([file.setting[name] for name in problem.variables]))
    own = active.measures_of(active.present)
    loose, tight = (least_controlled(active, 0, limits) for limits in (own, own * [1.0, 0.6, 0.8]))
    assert (tight.measures[1:] <= own[1:] * [0.6, 0.8] * (1 + HELD)).all()
    assert tight.measures[0] > loose.measures[0]
    # Multipliers of wheels share the weight of a measure: no weights of whole measures do better.
    rng = np.random.default_rng(1)
    for weights in rng.dirichlet(np.ones(3), 30):
        other = active.controlled(active.factors(weights)).measures
        if (other[1:] <= loose.measures[1:]).all():
            assert other[0] >= loose.measures[0] * (1 - 1e-3)


def test_the_worst_wheel_can_be_the_measure():
    file = load_vehicle("minaker_half")
    problem = RideProblem(file.vehicle, Iso8608Road("C"), speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    active = ActiveSuspension.of(problem, np.array([file.setting[name] for name in problem.variables]))
    own = active.measures_of(active.present)
    limits = own * [0.8, 0.7, 1.0]
    found = least_controlled(active, 2, limits)
    assert (found.measures[:2] <= limits[:2] * (1 + HELD)).all()
    loads = found.mean_squares[3:5]
    assert loads[0] == pytest.approx(loads[1], rel=1e-2)  # both wheels are worst


def test_limits_out_of_reach_are_told():
    problem = RideProblem(
        QUARTER, Iso8608Road("C"), speed=20.0, bounds={"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
    )
    active = ActiveSuspension.of(problem, PRESENT)
    own = active.measures_of(active.present)
    with pytest.raises(ValueError, match=r"^limits must be attainable by a controller, got \["):
        least_controlled(active, 0, own * [1.0, 0.05, 0.3])

"""Estimated states: gains by python-control, mean squares by Lyapunov's equation, invariant points, errors."""

import control
import numpy as np
import pytest
from scipy.linalg import solve_continuous_lyapunov

from garage import QUARTER
from suspension_ctrl import Iso8608Road, LoadCase, PowerLawRoad, RideProblem, Term
from suspension_ctrl.response.controllers.active_suspension import ActiveSuspension
from suspension_ctrl.response.controllers.actuated import Actuated
from suspension_ctrl.response.controllers.estimator import Estimator
from suspension_ctrl.response.controllers.loop import Loop
from suspension_ctrl.response.controllers.regulator import regulator
from suspension_ctrl.response.controllers.road_model import RoadModel
from suspension_ctrl.response.quadrature import frequency_nodes

TERMS = [Term("body_acceleration"), Term("suspension_travel"), Term("tyre_load")]
SENSORS = ["body_acceleration", "suspension_travel"]
SQUARES = np.array([1.0, 0.7e4, 1.2e-6])
INTENSITY, OF_FORCES = np.array([1e-4, 1e-8]), np.array([30.0])
PRESENT = np.array([22e3, 1500.0])


def _made(exponent, sensors=SENSORS):
    road = PowerLawRoad(roughness=5e-6, exponent=exponent)
    plant = Actuated.of(QUARTER, {"spring": 22e3, "damper": 1500.0}, TERMS, sensors)
    roads = RoadModel.of(
        LoadCase(vehicle=QUARTER, road=road, speed=20.0), (0.0, 20.0), falls=False, displaced=False
    )
    return plant, roads, regulator(plant, roads, SQUARES, np.zeros(1))


def test_gains_are_those_of_python_control():
    """Of a travel alone, in which no force is read at once."""
    plant, roads, _ = _made(2.0, ["suspension_travel"])
    found = Estimator.of(plant, roads, INTENSITY[1:], OF_FORCES)
    noise = np.hstack([plant.rates.rate @ roads.direct, plant.rates.force])
    sources = np.diag([1.0, *OF_FORCES])
    expected, *_ = control.lqe(plant.rates.state, noise, plant.sensors.state, sources, np.diag(INTENSITY[1:]))
    np.testing.assert_allclose(found.gain, expected, rtol=1e-6, atol=1e-9 * abs(expected).max())


@pytest.mark.parametrize("exponent", [2.0, 2.5])
def test_mean_squares_are_those_of_states_and_estimates_in_time(exponent):
    """On the road of the filter, by the covariance of states and estimates; to 2000 Hz by quadrature."""
    plant, roads, known = _made(exponent)
    one = Estimator.of(plant, roads, INTENSITY, OF_FORCES)
    gains = np.hstack([known.feedback, known.ahead])
    a = np.block([[one.a, -one.b @ gains], [one.gain @ one.c, one.a - one.b @ gains - one.gain @ one.c]])
    noise, force = np.vstack([plant.rates.rate @ roads.direct, roads.b]), one.b * np.sqrt(OF_FORCES)
    read = np.hstack([one.gain * np.sqrt(INTENSITY), one.gain @ one.d * np.sqrt(OF_FORCES)])
    sources = np.block([[noise, np.zeros((len(noise), 2)), force], [np.zeros_like(noise), read]])
    covariance = solve_continuous_lyapunov(a, -sources @ sources.T)
    terms = np.hstack([plant.terms.state, np.zeros((3, len(roads.a))), -plant.terms.force @ gains])
    expected = np.diag(terms @ covariance @ terms.T)[1:]
    f, w = frequency_nodes((0.0, 2000.0), 3000)
    loop = Loop.around(plant, roads, f, known.feedback)
    by_road, by_noise = loop.sensed(one.forces(known, loop.s))
    road = 2 * np.abs(roads.shapings[0].filter.response(loop.s) / loop.s) ** 2
    by_noise = (abs(by_noise) ** 2 @ (2 * np.concatenate([INTENSITY, OF_FORCES]))).T @ w
    found = ((abs(by_road[:, :, 0]) ** 2).T * road) @ w + by_noise
    # Travel and tyre load: that of white forces is infinite. Beyond 2000 Hz are 1e-3 of the tyre load.
    np.testing.assert_allclose(found[1:], expected, rtol=3e-3)


def test_no_estimate_moves_the_invariant_points():
    plant, roads, known = _made(2.5)
    f = np.sqrt([192e3 / 45.4, 192e3 / (317.5 + 45.4)]) / (2 * np.pi)
    loop = Loop.around(plant, roads, f, known.feedback)
    h, by_noise = loop.sensed(Estimator.of(plant, roads, INTENSITY, OF_FORCES).forces(known, loop.s))
    assert h[0, 0, 0] == pytest.approx(192e3 / 317.5, rel=1e-6)
    assert h[1, 1, 0] == pytest.approx(-(317.5 + 45.4) / 317.5, rel=1e-6)
    assert abs(by_noise).max() > 0


def test_quiet_sensors_tell_all_and_noise_costs():
    problem = RideProblem(
        QUARTER, Iso8608Road("C"), speed=20.0, bounds={"spring": (1e3, 30e3), "damper": (1e3, 5e3)}
    )
    active = ActiveSuspension.of(problem, PRESENT, [*SENSORS, "tyre_load"])
    factors = active.factors(np.full(3, 1 / 3))
    known = active.controlled(factors)
    found = []
    for size in (1e-4, 1.0, 10.0):
        noise = size * np.array([0.05, 5e-4, 100.0])
        sensed = active.sensed(known.regulator, active.estimator(noise), noise)
        found.append(factors @ sensed.mean_squares)
    assert found[0] == pytest.approx(factors @ known.mean_squares, rel=1e-3)
    assert found[0] < found[1] < found[2]


def test_sensors_must_tell_all_motions():
    """Neither the acceleration nor the tyre load tells the place of the body."""
    plant, roads, _ = _made(2.0, ["tyre_load"])
    with pytest.raises(ValueError, match=r"^sensors must tell all motions.*, got some that do not$"):
        Estimator.of(plant, roads, np.ones(1), np.zeros(1))

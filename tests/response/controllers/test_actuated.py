"""Equations relative to the roads against those of the plant, in the frequency domain."""

import numpy as np
import pytest

from garage import DAMPED_QUARTER, DRIVER, FULL, HALF, QUARTER, struts_of
from suspension_ctrl import Plant, Term, load_vehicle, weighting
from suspension_ctrl.response.controllers.actuated import Actuated, dynamics_of, wheel_struts

F = np.array([0.2, 1.3, 5.0, 17.0])
S = 2j * np.pi * F
VEHICLES = {
    "quarter": QUARTER, "damped quarter": DAMPED_QUARTER, "half": HALF, "full": FULL,
    "seat": DRIVER.on(HALF), "truck": load_vehicle("cantero_2022_truck").vehicle,
}  # fmt: skip


def _terms(vehicle):
    kinds = {name: one.kind for name, one in vehicle.meanings.items()}
    return [Term(name) for name in vehicle.responses if kinds[name] in ("acceleration", "travel", "load")]


def _by_inputs(rates, rows):
    """Return the rows by forces and by roads (k, m, q + r)."""
    inputs = np.concatenate([np.tile(rates.force, (S.size, 1, 1)), S[:, None, None] * rates.rate + rates.road], 2)
    states = np.linalg.solve(S[:, None, None] * np.eye(len(rates.state)) - rates.state, inputs)
    direct = np.concatenate([np.tile(rows.force, (S.size, 1, 1)), S[:, None, None] * rows.rate + rows.road], 2)
    return rows.state @ states + direct


@pytest.mark.parametrize("name", ["quarter", "damped quarter", "half", "full"])
def test_responses_are_those_of_the_plant(name):
    vehicle = VEHICLES[name]
    terms = _terms(vehicle)
    found = Actuated.of(vehicle, vehicle.coefficients(struts_of(vehicle)), terms)
    q, r = len(vehicle.struts), len(vehicle.tyres)
    h = np.moveaxis(vehicle.plant([term.response for term in terms])(S, squeeze=False), 2, 0)
    roads = h[:, :, :r] + S[:, None, None] * h[:, :, r : h.shape[2] - q] if h.shape[2] > q + r else h[:, :, :r]
    expected = np.concatenate([h[:, :, -q:], roads], axis=2)
    responses = expected[:, : len(terms)]
    size = abs(responses).max(axis=(0, 2))[:, None]
    np.testing.assert_allclose(_by_inputs(found.rates, found.responses) / size, responses / size, atol=1e-9)
    deflections = expected[:, len(terms) : len(terms) + q]
    np.testing.assert_allclose(_by_inputs(found.rates, found.deflections), deflections, rtol=1e-7, atol=1e-9)


def test_only_rates_act_unless_the_roads_twist_the_vehicle():
    for name in ("quarter", "damped quarter", "half"):
        vehicle = VEHICLES[name]
        plant = Actuated.of(vehicle, vehicle.coefficients(struts_of(vehicle)), _terms(vehicle))
        assert not plant.by_road
        assert plant.load_by_rate == (name == "damped quarter")
    full = Actuated.of(FULL, FULL.coefficients(struts_of(FULL)), _terms(FULL))
    assert full.by_road
    level = np.ones(4), FULL.contact_points[:, 0], FULL.contact_points[:, 1]  # heave, pitch and roll of the road
    for motion in level:
        np.testing.assert_allclose(full.responses.road @ motion, 0.0, atol=1e-9 * abs(full.responses.road).max())


@pytest.mark.parametrize("name", ["seat", "truck"])
def test_struts_that_are_not_on_wheels_stay(name):
    """A controller that acts as the struts on wheels gives back the closed vehicle."""
    vehicle = VEHICLES[name]
    setting = struts_of(vehicle) if name == "seat" else load_vehicle("cantero_2022_truck").setting
    values, terms = vehicle.coefficients(setting), _terms(vehicle)
    found = Actuated.of(vehicle, values, terms)
    ports = wheel_struts(vehicle)
    assert 0 < len(ports) <= len(vehicle.struts)
    struts = dynamics_of(vehicle, values, ports).stiffness(S)[:, ports][:, :, ports]
    q = len(ports)
    h, ends = (_by_inputs(found.rates, rows) for rows in (found.responses, found.deflections))
    tensions = np.linalg.solve(np.eye(q) - struts @ ends[:, :, :q], struts @ ends[:, :, q:])
    closed = vehicle.closed(setting, responses=[term.response for term in terms])(S, squeeze=False)
    closed = np.moveaxis(closed, 2, 0)
    r = len(vehicle.tyres)
    expected = closed[:, :, :r] + (S[:, None, None] * closed[:, :, r:] if closed.shape[2] > r else 0.0)
    size = abs(expected).max(axis=(0, 2))[:, None]
    np.testing.assert_allclose((h[:, :, :q] @ tensions + h[:, :, q:]) / size, expected / size, atol=1e-8)


def test_a_weighted_term_is_behind_its_filter():
    terms = [Term("body_acceleration", "Wk"), Term("suspension_travel"), Term("body_acceleration", "Wb")]
    found = Actuated.of(QUARTER, {"spring": 22e3, "damper": 1500.0}, terms)
    weighted, plain = (_by_inputs(found.rates, rows) for rows in (found.terms, found.responses))
    factors = np.array([weighting("Wk")(S), np.ones(S.size), weighting("Wb")(S)]).T
    np.testing.assert_allclose(weighted, factors[:, :, None] * plain, rtol=1e-8)
    np.testing.assert_array_equal(plain[:, 0], plain[:, 2])


def test_what_has_no_controller_is_told():
    values = {"spring": 22e3, "damper": 1500.0}
    with pytest.raises(
        ValueError, match=r"^weighting must be a filter such as Wk for a controller, got Wk-table$"
    ):
        Actuated.of(QUARTER, values, [Term("body_acceleration", "Wk-table")])
    with pytest.raises(ValueError, match=r"^measures must be without jerk and moments, got body_jerk$"):
        Actuated.of(QUARTER, values, [Term("body_jerk")])
    omega = 2 * np.pi * np.linspace(0.1, 30.0, 400)
    measured = Plant(QUARTER.plant().frequency_response(omega))
    with pytest.raises(
        ValueError, match=r"^vehicle must be a state space for a controller, got MeasuredResponse$"
    ):
        Actuated.of(measured, {}, [Term("body_acceleration")])
    renamed = Plant.named(
        QUARTER.plant(), inputs=["road [m]", "actuator_strut [N]"],
        outputs=["body_acceleration [m/s^2]", "", "tyre_load [N]", "actuator_deflection [m]", ""],
    )  # fmt: skip
    with pytest.raises(ValueError, match=r"^vehicle must have struts named like its tyres, got actuator$"):
        Actuated.of(renamed, {}, [Term("body_acceleration")])

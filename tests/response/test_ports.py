"""Frequency response at the ports beside python-control's plant and closed model."""

import control
import numpy as np
import pytest

from garage import VEHICLES, from_roads, struts_of
from suspension_ctrl.response.ports import Ports, dynamic_stiffness, paths
from suspension_ctrl.vehicles.feedback import gains_by_order

F = np.geomspace(0.3, 20.0, 20)


@pytest.mark.parametrize("name", ["damped quarter", "half", "damped full with seats"])
def test_closed_at_every_frequency_or_in_state_space(name):
    """Around no struts, then D by D (1 - P D)^-1; around struts at once; python-control's closed model."""
    vehicle = VEHICLES[name]
    setting = vehicle.coefficients(struts_of(vehicle))
    responses = list(vehicle.responses)
    expected = from_roads(vehicle, setting, responses, F)
    gains = gains_by_order(vehicle.strut_coefficients, setting, len(vehicle.struts))
    d = dynamic_stiffness(gains, 2 * np.pi * F)
    opened, closed = Ports.of(vehicle, F, responses).around(d), Ports.of(vehicle, F, responses, setting)
    for ports in (opened, closed):
        assert (ports.m, ports.r) == (len(responses), len(vehicle.contact_points))
        np.testing.assert_allclose(ports.h[:, : ports.m, : ports.r], expected, rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(opened.h[:, opened.m :], closed.h[:, closed.m :], rtol=1e-6, atol=1e-15)


def test_a_response_may_be_asked_for_twice():
    ports = Ports.of(VEHICLES["quarter"], F, ["tyre_load", "body_acceleration", "tyre_load"])
    np.testing.assert_array_equal(ports.h[:, 0], ports.h[:, 2])
    assert ports.h.shape == (20, 4, 2)


def test_dynamic_stiffness_is_the_sum_over_orders():
    k, c, b = np.random.default_rng(0).normal(size=(3, 2, 2))
    for omega, d in zip([0.5, 3.0], dynamic_stiffness(np.stack([k, c, b]), np.array([0.5, 3.0])), strict=True):
        np.testing.assert_allclose(d, k + 1j * omega * c - omega**2 * b, rtol=1e-14)


@pytest.mark.parametrize("name", ["quarter", "damped full with seats"])
def test_equations_solved_together_give_the_bits_of_python_control(name):
    """More frequencies than are solved at a time; without states, and at a pole, it is python-control itself."""
    plant, f = VEHICLES[name].plant(), np.linspace(0.01, 30.0, 2100)
    expected = np.moveaxis(plant.frequency_response(2 * np.pi * f, squeeze=False).frdata, 2, 0)
    tensions = slice(-len(VEHICLES[name].struts), None)  # the last inputs; rates of roads are added to the roads
    np.testing.assert_array_equal(paths(plant, f)[:, :, tensions], expected[:, :, tensions])
    gain = control.ss([], [], [], [[2.0, 3.0]])
    np.testing.assert_array_equal(paths(gain, f[:2]), [[[2.0, 3.0]]] * 2)
    undamped = control.ss([[0, 1], [-1, 0]], [[0], [1]], [[1, 0]], 0)
    with pytest.warns(RuntimeWarning, match="singular"):
        assert np.isinf(paths(undamped, np.array([1 / (2 * np.pi)])).real).all()

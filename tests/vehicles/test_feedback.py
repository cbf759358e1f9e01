"""Gains around a plant, by python-control and by frequency response."""

import control
import numpy as np
import pytest

from garage import FULL, struts_of
from suspension_ctrl import Plant
from suspension_ctrl.vehicles.feedback import MeasuredResponse, around


def test_a_gain_around_a_plant_is_the_feedback_of_python_control():
    """At gains that `lft` takes: those of the full car, in kN/m."""
    plant, gain = FULL.plant(), np.hstack(FULL.strut_gains(struts_of(FULL)))
    closed = around(plant, gain)
    q = len(gain)
    select = np.eye(plant.ninputs)[:, -q:]
    read = np.eye(plant.noutputs)[-2 * q :]
    there = control.feedback(plant, control.ss([], [], [], select @ gain @ read), sign=1)
    s = 2j * np.pi * np.geomspace(0.1, 30, 20)
    np.testing.assert_allclose(closed(s), there(s), rtol=1e-9, atol=1e-12 * np.abs(there(s)).max())


def test_a_loop_with_feedthrough_closes_as_its_frequency_response():
    """A deflection that a strut moves at once, with its rate given: state space and response agree."""
    rng = np.random.default_rng(4)
    a = rng.normal(size=(4, 4)) - 6 * np.eye(4)
    names = {"inputs": ["road", "strut"], "outputs": ["x", "deflection", "deflection_rate"]}
    system = control.ss(
        a, rng.normal(size=(4, 2)), rng.normal(size=(3, 4)), 0.1 * rng.normal(size=(3, 2)), **names
    )
    omega = np.linspace(1.0, 50.0, 60)
    table = control.frd(system(1j * omega), omega, **names)
    here, there = (Plant(one).closed((0.7, 0.3), responses=["x"]) for one in (system, table))
    np.testing.assert_allclose(here(1j * omega), there(1j * omega), rtol=1e-12)


def test_a_measured_response_is_a_cubic_spline_of_the_shape_that_python_control_gives():
    """A cubic polynomial is its own spline; one frequency has no axis of its own."""
    omega = np.linspace(1.0, 9.0, 5)
    response = MeasuredResponse([[omega**3 + 2j * omega, omega]], omega)
    np.testing.assert_allclose(response(3.3j), [[3.3**3 + 6.6j, 3.3]], rtol=1e-12)
    assert response(1j * omega[1:3]).shape == (1, 2, 2)
    with pytest.raises(ValueError, match=r"^band must lie within what was measured, 0.159155 to 1.43239 Hz, got "):
        response(9.5j)

"""Gains around a plant, by python-control and by frequency response."""

import control
import numpy as np
import pytest

from garage import DAMPED_QUARTER, FULL, struts_of
from suspension_ctrl import Plant
from suspension_ctrl.vehicles.feedback import around, gains_by_order
from suspension_ctrl.vehicles.measured_response import MeasuredResponse


def test_a_gain_around_a_plant_is_the_feedback_of_python_control():
    """At gains that `lft` takes: those of the full car, in kN/m."""
    q = len(FULL.struts)
    gains = gains_by_order(FULL.strut_coefficients, FULL.coefficients(struts_of(FULL)), q)
    plant, gain = FULL.plant(), np.hstack(gains[:2])
    closed = around(plant, gains)
    select = np.eye(plant.ninputs)[:, -q:]
    read = np.eye(plant.noutputs)[-2 * q :]
    there = control.feedback(plant, control.ss([], [], [], select @ gain @ read), sign=1)
    s = 2j * np.pi * np.geomspace(0.1, 30, 20)
    np.testing.assert_allclose(closed(s), there(s), rtol=1e-9, atol=1e-12 * np.abs(there(s)).max())


def test_a_loop_with_feedthrough_closes_as_its_frequency_response():
    """A deflection whose rate a strut moves at once, as without a mass between: response and state space agree."""
    rng = np.random.default_rng(4)
    a, b, c = rng.normal(size=(4, 4)) - 6 * np.eye(4), rng.normal(size=(4, 2)), rng.normal(size=(2, 4))
    d = np.array([[0.1, 0.2], [0.0, 0.0]])
    system = control.ss(a, b, c, d, inputs=["road", "strut"], outputs=["x", "deflection"])
    omega = np.linspace(1.0, 50.0, 60)
    table = control.frd(system(1j * omega), omega, inputs=["road", "strut"], outputs=["x", "deflection"])
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


@pytest.mark.parametrize("inertance", [0.0, 15.0, 80.0])
def test_an_inerter_in_the_strut_is_inertance_in_the_mass_matrix(inertance):
    """(-w^2 M + jw C + K) z = (kt + jw ct, 0) x, of a state space and of its frequency response at the lines."""
    car, (k, c), f = DAMPED_QUARTER, (22e3, 1500.0), np.geomspace(0.2, 30, 40)
    apart, s = np.array([[1.0, -1.0], [-1.0, 1.0]]), 2j * np.pi * f
    gains = np.array([[[k]], [[c]], [[inertance]]])
    mass = np.diag([car.wheel_mass, car.body_mass]) + inertance * apart
    tyre = car.tyre_stiffness + car.tyre_damping * s
    z = [
        np.linalg.solve(mass * w**2 + (c * w + k) * apart + np.diag([t, 0]), [t, 0])
        for w, t in zip(s, tyre, strict=True)
    ]
    wheel, body = np.transpose(z)
    expected = np.array([s**2 * body, body - wheel, tyre * (wheel - 1)])
    plant = car.plant()
    for system in (plant, plant.frequency_response(2 * np.pi * f)):
        h = around(system, gains)(s)
        np.testing.assert_allclose(h[:3, 0] + s * h[:3, 1], expected, rtol=1e-9)

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import QuarterCar

CAR = {"body_mass": 317.5, "wheel_mass": 45.4, "tyre_stiffness": 192e3}

masses = st.floats(1, 5000)
stiffnesses = st.floats(1e3, 1e6)
dampers = st.floats(10, 1e5)


def textbook(car: QuarterCar, k: float, c: float) -> control.StateSpace:
    """Equations (1) and (2) of the paper with states z1, dz1/dt, z2, dz2/dt, written out."""
    m_b, m_w, k_t = car.body_mass, car.wheel_mass, car.tyre_stiffness
    body = [k / m_b, c / m_b, -k / m_b, -c / m_b]
    a = [[0, 1, 0, 0], [-(k_t + k) / m_w, -c / m_w, k / m_w, c / m_w], [0, 0, 0, 1], body]
    return control.ss(a, [[0], [k_t / m_w], [0], [0]], [body, [-1, 0, 1, 0], [k_t, 0, 0, 0]], [[0], [0], [-k_t]])


@given(masses, masses, stiffnesses, stiffnesses, dampers)
def test_closed_loop_is_the_textbook_model(m_b, m_w, k_t, k, c):
    car = QuarterCar(body_mass=m_b, wheel_mass=m_w, tyre_stiffness=k_t)
    closed, expected = car.closed(k, c), textbook(car, k, c)
    for matrix in "ABCD":
        np.testing.assert_allclose(getattr(closed, matrix), getattr(expected, matrix), rtol=1e-14)


def test_signals_have_names():
    car = QuarterCar(**CAR)
    closed = car.closed(spring=22e3, damper=1500.0)
    assert closed.input_labels == ["road"]
    assert closed.output_labels == ["body_acceleration", "suspension_travel", "tyre_load"]
    assert car.plant().input_labels == ["road", "strut"]
    assert car.plant().output_labels[-2:] == ["deflection", "deflection_rate"]


@given(masses, masses, stiffnesses, stiffnesses, dampers, st.floats(0.01, 100))
def test_forces_equal_mass_times_acceleration(m_b, m_w, k_t, k, c, f):
    """At any frequency the strut alone moves the body, and the tyre alone both masses.

    The tolerance is the residual of a backward stable solution: some hundred units of rounding of the largest
    force that any coefficient of the equations of motion makes with the displacements at hand.
    """
    car = QuarterCar(body_mass=m_b, wheel_mass=m_w, tyre_stiffness=k_t)
    s = 2j * np.pi * f
    acceleration, travel, tyre_tension = car.closed(k, c)(s)[:, 0]
    z_w, z_b = 1 + tyre_tension / k_t, acceleration / s**2
    coefficients = k + k_t + c * abs(s) + (m_b + m_w) * abs(s) ** 2
    residual = 1e-13 * coefficients * (1 + abs(z_w) + abs(z_b))
    assert abs(m_b * acceleration + (k + c * s) * travel) < residual
    assert abs(m_b * acceleration + m_w * s**2 * z_w + tyre_tension) < residual


def test_a_vehicle_at_rest_on_a_static_step_stays_undeformed():
    gain = QuarterCar(**CAR).closed(22e3, 1500.0).dcgain()
    np.testing.assert_allclose(gain.ravel(), 0, atol=1e-9)


@pytest.mark.parametrize("name", ["body_mass", "wheel_mass", "tyre_stiffness"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf"), 10**400, "12", None])
def test_rejects_impossible_parameters(name, value):
    with pytest.raises(ValueError, match=rf"^{name} must be finite and > 0 .*got"):
        QuarterCar(**CAR | {name: value})


@pytest.mark.parametrize("strut", [{"spring": 0.0, "damper": 1.0}, {"spring": 1.0, "damper": -3.0}])
def test_rejects_impossible_struts(strut):
    with pytest.raises(ValueError, match=r"^(spring|damper) must be finite and > 0 N"):
        QuarterCar(**CAR).closed(**strut)


def test_parameters_are_frozen_and_keyword_only():
    with pytest.raises(AttributeError):
        QuarterCar(**CAR).body_mass = 1.0
    with pytest.raises(TypeError):
        QuarterCar(317.5, 45.4, 192e3)

"""Derivatives of mean forces and slopes beside complex steps through error functions."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import psi

import complex_step
import suspension_ctrl as sc
from suspension_ctrl.response.gradients.laws import digamma, fill_law_slopes, law_slopes_of
from suspension_ctrl.response.network_rows import DEVIATION, MEAN, STATES
from suspension_ctrl.response.strut_data import networks_of
from suspension_ctrl.vehicles.networks import fill_curve

LAWS = {
    "digressive": sc.DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1, rebound_over_bump=1.7),
    "bilinear": sc.BilinearDamper(bump=750.0, rebound=2250.0),
    "power": sc.PowerDamper(force=5e3, exponent=1.6),
    "friction": sc.Friction(force=40.0),
    "stop": sc.BumpStop("stop", gap=0.02, stiffness=60e3),
    "stop by a table": sc.ReboundStop("stop", gap=0.02, compression=[0.0, 0.01, 0.03], force=[0.0, 400.0, 4000.0]),
    "table": sc.TableSpring("coil", deflection=[-0.08, -0.02, 0.0, 0.08], force=[-4200.0, -500.0, 0.0, 2000.0]),
}


@pytest.mark.parametrize("name", LAWS)
@settings(max_examples=5)
@given(s=st.floats(0.5, 2.0), mean=st.floats(-1.0, 1.0), factor=st.floats(0.5, 2.0))
def test_derivatives_are_those_of_complex_steps(name, s, mean, factor):
    """To rounding: differences of numbers of size 1; of a law of the rate the mean is 0."""
    law = LAWS[name]
    car = sc.QuarterCar(
        body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(sc.Spring(), law)
    )
    setting = {key: value * factor for key, value in car.coefficients({"spring": 22e3}).items()}
    networks = networks_of(car, setting, ["spring"], np.array([1.0]), np.eye(1, dtype=bool))
    values, state = np.array(list(setting.values())), np.zeros((1, STATES))
    size = 0.15 if law.of_rate else 0.015
    state[0, DEVIATION], state[0, MEAN] = s * size, 0.0 if law.of_rate else mean * size
    curve, slopes = np.empty(networks.laws.number.shape[:3]), law_slopes_of(networks)
    fill_curve(networks.laws, 0, values, curve[0])
    fill_law_slopes(networks, curve, values, state, slopes)
    by_deviation = (slopes.force_by_deviation[0], slopes.slope_by_deviation[0])
    by_mean = (slopes.force_by_mean[0], slopes.slope_by_mean[0])
    by_value = np.array([slopes.force_by_value[0, 1:], slopes.slope_by_value[0, 1:]]).T
    assert slopes.force_by_value[0, 0] == slopes.slope_by_value[0, 0] == 0.0  # of the spring beside it

    def step(own: np.ndarray, mean: complex, s: complex) -> np.ndarray:
        return np.imag(complex_step.gaussian(law.curve, list(own), mean, s)) / complex_step.STEP

    own, m, h = values[1:].astype(complex), state[0, MEAN], 1j * complex_step.STEP
    scale = np.array([values[1:].max() * size, values[1:].max()]) + np.abs(np.array([by_deviation, by_mean])).max(
        axis=0
    )
    np.testing.assert_allclose(
        by_deviation / scale, step(own, m, state[0, DEVIATION] * (1 + h)) / scale, atol=1e-11
    )
    if not law.of_rate:
        np.testing.assert_allclose(by_mean / scale, step(own, m + h, state[0, DEVIATION]) / scale, atol=1e-11)
    for i, value in enumerate(own):
        moved = np.where(np.arange(own.size) == i, value * (1 + h), value * 0 + own)
        found, expected = by_value[i] * value.real, step(moved, m, state[0, DEVIATION])
        np.testing.assert_allclose(found / scale, expected / scale, atol=1e-11)


@given(st.floats(0.05, 50.0))
def test_digamma_is_that_of_scipy(x):
    assert digamma(x) == pytest.approx(psi(x), rel=1e-12, abs=1e-12)

"""Power series of the motion beside matrix exponentials and closed forms."""

import numpy as np
import pytest
from scipy.linalg import expm

import suspension_ctrl as sc
from garage import FULL, struts_of
from suspension_ctrl.response.motion.drivable import Drivable
from suspension_ctrl.response.motion.equilibrium import begin, find_segments
from suspension_ctrl.response.motion.expansion import accelerate, place, react, states_at
from suspension_ctrl.response.motion.system import TERMS, Course, work_of
from suspension_ctrl.response.motion.trees import numbers_of


def test_the_road_is_expanded_about_any_time():
    course = Course(np.array([0.0, 1.0]), np.array([[[0.1, -0.2, 0.3, 0.4]]]))
    z = np.zeros((2, 4, 1))
    place(course, 0, 0.5, z)
    road = np.polynomial.Polynomial([0.1, -0.2, 0.3, 0.4])
    for s in (0.0, 0.2):
        assert np.polynomial.Polynomial(z[0, :, 0])(s) == pytest.approx(road(0.5 + s), rel=1e-12)
        assert np.polynomial.Polynomial(z[1, :, 0])(s) == pytest.approx(road.deriv()(0.5 + s), rel=1e-12)


def test_the_series_of_a_linear_vehicle_is_its_matrix_exponential():
    motion = Drivable.of(FULL).motion(np.array(list(FULL.coefficients(struts_of(FULL)).values())))
    work, numbers = work_of(motion.equations, motion.tree), numbers_of(motion.program, motion.tree, motion.values)
    start = np.random.default_rng(1).standard_normal(motion.states)
    work.x[0] = start
    for order in range(TERMS):
        react(motion.equations, motion.tree, numbers, work, order)
        accelerate(motion.equations, work, order)
    found = np.zeros(motion.states)
    states_at(work, TERMS, 2e-3, found)
    np.testing.assert_allclose(found, expm(2e-3 * motion.equations.a) @ start, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("exponent", [0.5, 1.7, 2.0, 3.0])
def test_a_power_of_the_rate_has_the_series_of_that_power(exponent):
    """Of a quarter car: each order of its force beside that of a polynomial fit on a small circle."""
    strut = sc.parallel(sc.Spring(value=2e4), sc.PowerDamper(force=1500.0, exponent=exponent))
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=strut)
    motion = Drivable.of(car).motion(np.array(list(car.coefficients({}).values())))
    work, numbers = work_of(motion.equations, motion.tree), numbers_of(motion.program, motion.tree, motion.values)
    begin(numbers, work)
    find_segments(motion.equations, motion.tree, numbers, work, np.array([0.0, -0.5, 0.01, 0.3]))
    for order in range(TERMS + 1):
        react(motion.equations, motion.tree, numbers, work, order)
        accelerate(motion.equations, work, order)
    circle = 2e-3 * np.exp(2j * np.pi * np.arange(64) / 64)
    rate = np.polynomial.Polynomial(work.own[:, 0])(circle)
    expected = np.fft.fft(1500.0 * rate**exponent) / 64 / 2e-3 ** np.arange(64)
    np.testing.assert_allclose(work.curved[:9, 0], expected[:9].real, rtol=1e-6)

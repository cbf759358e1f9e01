"""Vehicles ready to be driven with any design."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, struts_of
from suspension_ctrl.response.motion.drivable import Drivable, motion_of

INERTER = sc.parallel(
    sc.Spring(value=2e4),
    sc.parallel(
        sc.TableDamper(velocity=[0.0, 1.0], force=[0.0, 1e3]), sc.Inerter(value=30.0), installation_ratio=0.5
    ),
)


def test_one_vehicle_takes_many_designs():
    drivable, setting = Drivable.of(FULL, ["body_acceleration"]), FULL.coefficients(struts_of(FULL))
    for factor in (0.5, 2.0):
        values = {name: factor * value for name, value in setting.items()}
        found, expected = drivable.motion(np.array(list(values.values()))), motion_of(FULL, values)
        np.testing.assert_array_equal(found.equations.a, expected.equations.a)
        assert len(found.responses.c) == 1


def test_an_inerter_beside_a_law_is_a_mass_by_the_square_of_its_ratio():
    """The payload's weight accelerates body and inerter until the springs hold it."""
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=INERTER)
    laden = sc.Payload(mass=50.0).on(car)
    equations = motion_of(laden, laden.coefficients({})).equations
    masses = np.diag([40.0, 350.0]) + 0.25 * 30.0 * np.array([[1.0, -1.0], [-1.0, 1.0]])
    expected = np.linalg.solve(masses, [0.0, -50.0 * 9.80665])
    assert equations.constant[1::2] == pytest.approx(expected, rel=1e-12)

"""Derivatives of roll gradient and load transfer beside complex steps by hand, and beside differences."""

from dataclasses import replace

import numpy as np
import pytest

from garage import FULL, GEOMETRY
from suspension_ctrl import Payload
from suspension_ctrl.vehicles.handling import GRAVITY
from suspension_ctrl.vehicles.lean_slopes import with_roll_slopes, with_transfer_slopes

STRUTS = {"front": (2e4, 1500.0), "rear": (2.4e4, 1700.0), "front_antiroll": 9e3, "rear_antiroll": 3e3}


def by_hand(design: np.ndarray, weights: dict[str, float]) -> np.ndarray:
    """Roll [deg/g] and front share of springs and bars (front, rear): each axle's springs on its tyres."""
    moment, stiffness, roll, axles = FULL.body_mass * GRAVITY * GEOMETRY.roll_arm, 0.0, 0.0, []
    for axle, spring, bar in (("front", *design[:2]), ("rear", *design[2:])):
        track, mass = getattr(FULL, f"{axle}_track"), getattr(FULL, f"{axle}_wheel_mass")
        k_s, k_t = spring * track**2 / 2 + bar, getattr(FULL, f"{axle}_tyre_stiffness") * track**2 / 2
        own = weights[axle] * getattr(GEOMETRY, f"{axle}_roll_centre") + 2 * mass * GRAVITY * GEOMETRY.wheel_centre
        stiffness, roll = stiffness + k_s * k_t / (k_s + k_t), roll + k_s * own / (k_s + k_t)
        axles.append((k_s, k_t, own, track))
    roll = (moment + roll) / (stiffness - moment)
    front, rear = (k_t * (k_s * roll + own) / (k_s + k_t) / track for k_s, k_t, own, track in axles)
    return np.array([np.degrees(1.0) * roll, front / (front + rear)])


def test_derivatives_are_those_of_the_formulas_by_hand():
    setting = FULL.coefficients(STRUTS)
    names = ["front.spring", "front_antiroll", "rear.spring", "rear_antiroll"]
    design, places = np.array([setting[name] for name in names]), [list(setting).index(name) for name in names]
    wheelbase = FULL.cg_to_front + FULL.cg_to_rear
    arms = {"front": FULL.cg_to_rear, "rear": FULL.cg_to_front}
    weights = {axle: FULL.body_mass * GRAVITY * arm / wheelbase for axle, arm in arms.items()}
    steps = [by_hand(design + 1e-30j * row, weights).imag / 1e-30 for row in np.eye(4)]
    given = np.array([list(setting.values())])
    found = np.array([slopes(FULL.statics, given, GEOMETRY)[1][0] for slopes in SLOPES])
    np.testing.assert_allclose(found[:, places], np.transpose(steps), rtol=1e-9)
    others = np.delete(found, places, axis=1)  # dampers
    np.testing.assert_array_equal(others, 0.0)


SLOPES = (with_roll_slopes, with_transfer_slopes)


@pytest.mark.parametrize("slopes", SLOPES)
def test_static_loads_that_depend_on_springs_beside_differences(slopes):
    """A load aside. Central differences by 1e-4 are off by 1e-8 of the derivatives by size, and by rounding."""
    statics = Payload(mass=300.0, position=(-0.7, 0.4)).on(FULL).statics
    given = np.array([list(FULL.coefficients(STRUTS).values()), list(FULL.coefficients(STRUTS).values())])
    given[1] *= 1.2
    steps = 1e-4 * given[:, None] * np.eye(given.shape[1])
    values = statics.roll_gradient if slopes is with_roll_slopes else statics.front_load_transfer
    expected = [
        (values(row + step, GEOMETRY) - values(row - step, GEOMETRY)) / 2e-4
        for row, step in zip(given, steps, strict=True)
    ]
    found = slopes(statics, given, GEOMETRY)[1] * given
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6 * np.abs(found).max())


def test_a_body_that_topples_has_no_derivative():
    car = replace(FULL, front_track=0.9, rear_track=0.9)
    given = np.array([list(car.coefficients({"front": (2e3, 1500.0), "rear": (2e3, 1500.0)}).values())])
    high = replace(GEOMETRY, roll_arm=1.0)
    np.testing.assert_array_equal(with_roll_slopes(car.statics, given, high)[1], 0.0)

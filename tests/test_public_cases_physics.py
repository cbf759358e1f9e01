"""Inputs from public programs on which the package once failed, beside those that the tests of modules hold.

Right values were found without this package, by the programs that the tests name or by numpy and scipy.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import root

import suspension_ctrl as sc
from garage import FULL, HALF, QUARTER

CASES = Path(__file__).with_name("cases")
OFF_CENTRE = [0.839216, 1.113826, 1.463380, 8.427188, 8.433388, 10.019027, 10.021885]
MIDWAY = [0.839821, 1.113066, 1.463326]


def test_the_average_over_250_mm_takes_three_steps_of_100_mm():
    """2.5 steps round up: github freevryheid/iri @59bba5b3, Sayers' program, and gislas3/quartercar @8d091d2c."""
    profile = sc.load_profile(CASES / "iri_100mm.csv")
    assert profile.distance[-1] == pytest.approx(72.0, abs=0.11)
    assert sc.international_roughness_index(profile).mean == pytest.approx(2.9123, abs=5e-5)


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_a_car_without_dampers_has_its_frequencies(axle):
    """Off centre and midway: github lucaswsn/full-car-model @693cf099, andresmendes/Full-car-model @a4ee4c87."""
    file = sc.load_vehicle("jazar_full")
    undamped = {"front": (10e3, 0.0), "rear": (13e3, 0.0), "front_antiroll": 0.0}
    table = file.vehicle.modes(undamped)
    np.testing.assert_allclose(table["frequency [Hz]"], OFF_CENTRE, rtol=0, atol=5.1e-7)
    np.testing.assert_allclose(table["damping ratio [-]"], 0.0, atol=1e-9)
    car = sc.FullCar(
        body_mass=840.0, roll_inertia=820.0, pitch_inertia=1100.0, front_wheel_mass=53.0, rear_wheel_mass=76.0,
        front_tyre_stiffness=200e3, rear_tyre_stiffness=200e3, cg_to_front=1.4, cg_to_rear=1.47,
        front_track=1.45, rear_track=1.45,
    )  # fmt: skip
    half_damped = undamped | {axle: (undamped[axle][0], 1500.0)}
    for setting in (undamped, half_damped):
        found = car.modes(setting)["frequency [Hz]"].to_numpy()
        np.testing.assert_allclose(found[:3], MIDWAY, rtol=0, atol=5.1e-7)


def test_spring_and_tyre_are_found_for_wanted_ratios_at_one_frequency():
    """A reanalysis, github lillm8/Numerical-analysis-of-quarter-car-model @fa1b3be7: body 0.71, tyre as before."""
    car = sc.QuarterCar(body_mass=475.0, wheel_mass=53.0, tyre_stiffness=135e3, tyre_damping=1200.0)
    omega = 18.0555556  # rad/s

    def over_road(spring: float, tyre: float) -> np.ndarray:
        setting = {"spring": spring, "tyre_stiffness": tyre, "damper": 310.0}
        h = car.closed(setting, responses=["body_displacement", "tyre_deflection"])(1j * omega)
        return np.abs(h[:, 0] + 1j * omega * h[:, 1])

    before = over_road(5400.0, 135e3)
    found = root(lambda x: over_road(*(1e3 * x)) / before - [0.71, 1.0], [3.0, 160.0])
    assert found.success
    np.testing.assert_allclose(1e3 * found.x, [691.5829, 182116.4403], rtol=1e-6)


@pytest.mark.parametrize("car", [QUARTER, HALF, FULL])
def test_every_vehicle_has_the_responses_that_people_ask_for(car):
    """Jerk, wheel acceleration, damper rate and strut force, github samarthgupta128/PS2 @8a5fb967."""
    names = set(car.meanings)
    places = {"QuarterCar": [""], "HalfCar": ["front_", "rear_"]}.get(
        type(car).__name__, ["front_left_", "rear_right_"]
    )
    wanted = [
        "wheel_acceleration",
        "wheel_displacement",
        "suspension_travel_rate",
        "strut_force",
        "tyre_deflection",
    ]
    assert {"body_displacement", "body_velocity", "body_jerk"} <= names
    assert {place + name for place in places for name in wanted} <= names


def test_a_table_of_a_damper_goes_on_with_its_last_slope():
    """That of github rhorvath02/VehicleDynamics @1b8c93d6, shortened, ends at 1 m/s; a row more holds it."""
    rate, force = [0.0, 0.05, 0.1, 0.3, 0.5, 1.0], [0.0, 600.0, 850.0, 1250.0, 1450.0, 1750.0]
    table = sc.TableDamper(velocity=rate, force=force)
    np.testing.assert_allclose(
        table.tension([-2.0, -1.0, 0.3, 1.5]), [-2350.0, -1750.0, 1250.0, 2050.0], rtol=1e-12
    )
    held = replace(table, velocity=[*rate, 3.0], force=[*force, 1750.0])
    np.testing.assert_allclose(held.tension([-2.0, 1.5, 4.0]), [-1750.0, 1750.0, 1750.0], rtol=1e-12)

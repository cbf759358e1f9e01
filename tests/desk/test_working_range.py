"""Motion of struts: by the formulas of Gaussian processes, statics by hand, and alike on both sides."""

from math import isnan

import numpy as np
import pytest

from garage import FULL, QUARTER, ROAD, SPEED
from suspension_ctrl import (
    BilinearDamper,
    LoadCase,
    Payload,
    Plant,
    QuarterCar,
    Spring,
    linearised,
    parallel,
    ride,
)
from suspension_ctrl.desk.working_range import motions_of
from suspension_ctrl.vehicles.assembly import GRAVITY

BAND = (0.1, 20.0)
SETTING = {"spring": 22e3, "damper": 1500.0}


def largest(deviation: float, rate: float) -> float:
    """Davenport's expected largest value of as many upward crossings as Rice counts in 10 km."""
    g = np.sqrt(2 * np.log(rate / (2 * np.pi * deviation) * 10e3 / SPEED))
    return deviation * (g + 0.5772156649015329 / g)


def test_a_quarter_car_by_hand():
    (found,) = motions_of(LoadCase(vehicle=QUARTER, road=ROAD, speed=SPEED), SETTING, BAND)
    table = ride(QUARTER, SETTING, ROAD, SPEED, band=BAND)["value"]
    assert found.static == pytest.approx(-QUARTER.body_mass * GRAVITY / 22e3, rel=1e-9)
    assert found.mean == 0
    assert found.travel == table["suspension_travel"]
    assert found.rate == table["suspension_travel_rate"]
    assert found.force == table["strut_force"]
    assert found.largest_travel == pytest.approx(largest(found.travel, found.rate), rel=1e-9)
    assert found.largest_rate > 3 * found.rate
    assert found.largest_force > 3 * found.force


def test_left_and_right_are_one_row():
    setting = FULL.coefficients({"front": (21e3, 1500.0), "rear": (23e3, 1600.0)})
    found = motions_of(LoadCase(vehicle=FULL, road=ROAD, speed=SPEED), setting, (0.3, 20.0))
    assert [one.strut for one in found] == ["front", "rear"]
    aside = Payload(mass=5.0, position=(0.0, 0.3)).on(FULL)
    found = motions_of(LoadCase(vehicle=aside, road=ROAD, speed=SPEED), setting, (0.3, 20.0))
    assert [one.strut for one in found] == ["front_left", "front_right", "rear_left", "rear_right"]
    assert 0 < abs(found[0].travel / found[1].travel - 1) < 5e-3


def test_a_damper_with_more_rebound_pulls_the_car_down():
    strut = parallel(Spring(), BilinearDamper(bump=750.0, rebound=2250.0))
    car = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    (found,) = motions_of(LoadCase(vehicle=car, road=ROAD, speed=SPEED), {"spring": 22e3}, BAND)
    mean = linearised(car, {"spring": 22e3}, ROAD, SPEED, band=BAND).mean_travel[""]
    assert found.mean == mean < -0.01


def test_a_plant_has_no_static_position():
    (found,) = motions_of(LoadCase(vehicle=Plant(QUARTER.plant()), road=ROAD, speed=SPEED), SETTING, BAND)
    there = motions_of(LoadCase(vehicle=QUARTER, road=ROAD, speed=SPEED), SETTING, BAND)[0]
    assert isnan(found.static)
    assert found[3:] == pytest.approx(there[3:], rel=1e-9)

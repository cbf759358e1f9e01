"""One design of a problem: values by name, and a vehicle file with the same ride."""

import re

import numpy as np
import pytest

from garage import ROAD, SPEED
from suspension_ctrl import (
    Damper,
    LoadCase,
    Payload,
    QuarterCar,
    RideProblem,
    Rubber,
    Spring,
    load_vehicle,
    parallel,
    ride,
    save_vehicle,
    series,
    vehicle_file,
)
from suspension_ctrl.desk.designs import closed_at, present_of, values_of

FILE = load_vehicle("minaker_half")
LADEN = Payload(mass=250.0, position=(-1.5, 0.0)).on(FILE.vehicle)
CASES = [
    LoadCase(vehicle=FILE.vehicle, road=ROAD, speed=SPEED, share=0.8),
    LoadCase(vehicle=LADEN, road=ROAD, speed=15.0, share=0.2),
]
STRUTS = {"front.damper": 1500.0, "rear": (30e3, 1800.0)}
PROBLEM = RideProblem(cases=CASES, bounds={"front.spring": (10e3, 40e3)}, struts=STRUTS, band=(0.3, 20.0))


def test_a_design_is_given_by_name_or_in_order():
    assert values_of("design", PROBLEM, [20e3]) == values_of("design", PROBLEM, {"front.spring": 20e3})
    assert present_of(PROBLEM, None) == present_of(PROBLEM, {}) == {}


@pytest.mark.parametrize("case", [1, 2])
def test_the_file_of_a_design_gives_its_ride_bit_for_bit(tmp_path, case):
    save_vehicle(tmp_path / "design.toml", vehicle_file(PROBLEM, [23456.789], case=case, name="knee"))
    again = load_vehicle(tmp_path / "design.toml")
    one = CASES[case - 1]
    setting = {**STRUTS, "front.spring": 23456.789}
    there = ride(one.vehicle, setting, ROAD, one.speed, band=(0.3, 20.0))
    here = ride(again.vehicle, again.setting, ROAD, one.speed, band=(0.3, 20.0))
    np.testing.assert_array_equal(here["value"], there["value"])
    assert (again.name, again.bounds) == ("knee", {"front.spring": (10e3, 40e3)})


def test_masses_and_frequencies_that_vary_stand_in_the_file(tmp_path):
    bounds = {"front.ride_frequency": (1.0, 2.0), "rear.damper": (1e3, 3e3), "body_mass": (500.0, 900.0)}
    struts = {"front.damper": 1500.0, "rear.spring": 30e3}
    problem = RideProblem(FILE.vehicle, ROAD, speed=SPEED, bounds=bounds, struts=struts, band=(0.3, 20.0))
    save_vehicle(tmp_path / "design.toml", vehicle_file(problem, [1.4, 2e3, 700.0]))
    again = load_vehicle(tmp_path / "design.toml")
    table = ride(again.vehicle, again.setting, ROAD, SPEED, band=(0.3, 20.0))["value"]
    np.testing.assert_allclose(table[["ACC", "SWS", "DTL"]], problem.evaluate([[1.4, 2e3, 700.0]])[0], rtol=1e-9)


def test_rubber_has_no_state_space():
    strut = parallel(Spring(), series(Damper(), Rubber("mount", storage=250e3, loss=25e3)))
    car = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    case = LoadCase(vehicle=car, road=ROAD, speed=SPEED)
    assert closed_at(case, {"spring": 22e3, "damper": 1500.0}, (0.1, 20.0)) is None


def test_the_closed_vehicle_is_that_of_python_control():
    one = CASES[1]
    closed = closed_at(one, {**STRUTS, "front.spring": 20e3}, (0.3, 20.0))
    np.testing.assert_array_equal(closed.A, LADEN.closed({**STRUTS, "front.spring": 20e3}).A)


@pytest.mark.parametrize(
    ("problem", "design", "case", "message"),
    [
        (3, [20e3], 1, "problem must be a RideProblem, got 3"),
        (PROBLEM, [20e3, 1.0], 1, "design must be finite values of front.spring, got [20000.0, 1.0]"),
        (PROBLEM, {}, 1, "design must have front.spring, got none for front.spring"),
        (PROBLEM, {"spring": 20e3}, 1, "design must have front.spring, got none for front.spring"),
        (PROBLEM, [-1.0], 1, "design: front.spring must be finite and > 0 N/m, got -1.0"),
        (PROBLEM, {"front.spring": "x"}, 1, "design must be an array of real numbers, got ['x']"),
        (PROBLEM, [20e3], 3, "case must be one of 2 load cases, got 3"),
        (PROBLEM, [20e3], 0, "case must be a whole number >= 1, got 0"),
    ],
)
def test_a_wrong_design_or_case_is_one_line(problem, design, case, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        vehicle_file(problem, design, case=case)


@pytest.mark.parametrize(("wheel_mass", "unusual"), [(45.4, False), (1500.0, True)])
@pytest.mark.filterwarnings("ignore::suspension_ctrl.vehicles.unit_slips.UnitSlipWarning")
def test_a_vehicle_of_unusual_numbers_stays_one_in_its_file(wheel_mass, unusual):
    car = QuarterCar(body_mass=317.5, wheel_mass=wheel_mass, tyre_stiffness=192e3)
    bounds = {"spring": (20e3, 24e3), "damper": (1e3, 2e3)}
    problem = RideProblem(car, ROAD, speed=SPEED, bounds=bounds, band=(0.1, 20.0))
    assert vehicle_file(problem, [22e3, 1500.0]).unusual == unusual

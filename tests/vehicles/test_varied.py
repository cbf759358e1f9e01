"""Parameters as ports: objectives against those of vehicles that are built anew with the values."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import DRIVER, FULL, HALF, QUARTER, ROAD
from suspension_ctrl import (
    BumpStop,
    DigressiveDamper,
    Inerter,
    LoadCase,
    Payload,
    RideProblem,
    RollGeometry,
    Spring,
    certify,
    load_vehicle,
    parallel,
    ride,
)
from suspension_ctrl.vehicles.cars import SPRING_AND_DAMPER
from suspension_ctrl.vehicles.mounted import Mounted
from suspension_ctrl.vehicles.varied import ported

LAW = parallel(
    Spring(), BumpStop(gap=0.03, stiffness=60e3), DigressiveDamper(low_speed=4e3, high_speed=800.0, knee=0.1)
)
INERT = parallel(*SPRING_AND_DAMPER.parts, Inerter(value=20.0))
GEOMETRY = RollGeometry(roll_arm=0.45, front_roll_centre=0.05, rear_roll_centre=0.1, wheel_centre=0.3)
FRONT, REAR = {"front.spring": 2e4, "front.damper": 1500.0}, {"rear.spring": 2.2e4, "rear.damper": 1600.0}
TYRES, MASSES = {"front_tyre_stiffness": 1.3}, {"body_mass": 1.4, "front_wheel_mass": 1.3}
MEASURES = ("ACC", "SWS", "DTL", "DLC", "lift")
LADEN = Payload(mass=120.0, position=(0.4, 0.0)).on(replace(FULL, front_strut=LAW))


def seated(x, y, mass):
    """Return the full car with a seat and a load."""
    seat = replace(DRIVER, mass=mass, position=(x, y))
    return Payload(mass=150.0, position=(-1.0, 0.3)).on(seat.on(FULL))


def anew(car, name, value):
    """Return a vehicle built with another value of a parameter."""
    if isinstance(car, Mounted):
        if name == "payload.mass":
            return replace(car.part, mass=value).on(car.vehicle)
        return replace(car, vehicle=anew(car.vehicle, name, value))
    return replace(car, **{name: value})


CARS = {
    "quarter": (QUARTER, {"spring": 2e4, "damper": 1500.0},
                {"tyre_stiffness": 1.4, "body_mass": 1.4, "wheel_mass": 1.4}, MEASURES),
    "damped quarter with inerter": (replace(QUARTER, tyre_damping=100.0, strut=INERT),
                                    {"spring": 2e4, "damper": 1500.0}, {"tyre_damping": 1.5}, MEASURES),
    "half": (HALF, FRONT | REAR, {**TYRES, **MASSES, "pitch_inertia": 1.3}, MEASURES),
    "full": (FULL, FRONT | REAR, {**TYRES, **MASSES, "roll_inertia": 1.3},
             (*MEASURES, "roll_damping", "roll_gradient", "damper_power", "largest travel 1000")),
    "laws": (LADEN, {"front.spring": 2e4} | REAR, {**TYRES, "body_mass": 1.2, "payload.mass": 1.5},
             (*MEASURES, "damper_power", "bottoming front")),
}  # fmt: skip


def problem_of(car, bounds, struts, measures, nodes=None):
    case = LoadCase(vehicle=car, road=ROAD, speed=20.0, roll_geometry=GEOMETRY)
    options = {"measures": measures, "band": (0.3, 20.0), "nodes": nodes}
    return RideProblem(cases=[case], bounds=bounds, struts=struts, **options)


@cache
def varied(name):
    """Return the problem with the parameters of a car, and all but one coefficient fixed."""
    car, setting, parameters, measures = CARS[name]
    first, *others = setting
    bounds = {first: (0.6 * setting[first], 1.5 * setting[first])}
    for parameter, ratio in parameters.items():
        value = car.variables[parameter].default
        bounds[parameter] = (value / ratio, value * ratio)
    return problem_of(car, bounds, {one: setting[one] for one in others}, measures)


@settings(max_examples=3)
@pytest.mark.parametrize("name", CARS)
@given(shares=st.lists(st.floats(0.0, 1.0), min_size=6, max_size=6))
def test_objectives_are_those_of_a_vehicle_built_anew(name, shares):
    """To 1e-10: solves on conditions up to 1e4; iterations of laws end at 1e-8 of s on both sides alike."""
    problem, car = varied(name), CARS[name][0]
    low, high = np.array(problem.lower), np.array(problem.upper)
    design = low + np.array(shares[: low.size]) * (high - low)
    first, *parameters = problem.variables
    for parameter, value in zip(parameters, design[1:].tolist(), strict=True):
        car = anew(car, parameter, value)
    x = float(design[0])
    expected = problem_of(car, {first: (x, 1.01 * x)}, problem.struts, problem.measures, int(problem.nodes))
    np.testing.assert_allclose(problem.evaluate([design])[0], expected.evaluate([[x]])[0], rtol=1e-10)


def test_a_ride_takes_parameters_in_its_setting():
    setting = {**FRONT, **REAR, "front_tyre_stiffness": 1.6e5, "body_mass": 700.0}
    table = ride(HALF, setting, ROAD, 20.0, band=(0.3, 20.0))
    car = replace(HALF, front_tyre_stiffness=1.6e5, body_mass=700.0)
    np.testing.assert_array_equal(table["value"], ride(car, FRONT | REAR, ROAD, 20.0, band=(0.3, 20.0))["value"])


@settings(max_examples=4)
@given(st.floats(-0.5, 1.0), st.floats(-0.5, 0.5), st.floats(50.0, 110.0))
def test_a_seat_moves_by_ports_of_pitch_and_roll(x, y, mass):
    """To 1e-10, as above."""
    measures = ("ACC driver", "SWS", "DTL", "DLC", "roll_acceleration")
    design = [2e4, 1.3e4, x, y, mass]
    bounds = {"front.spring": (1e4, 3e4), "driver.spring": (8e3, 2e4), "driver.x": (-0.5, 1.0),
              "driver.y": (-0.5, 0.5), "driver.mass": (50.0, 110.0)}  # fmt: skip
    struts = {"front.damper": 1500.0, **REAR}
    problem = problem_of(seated(0.2, 0.4, 80.0), bounds, struts, measures, 384)
    plain = dict(list(bounds.items())[:2])
    expected = problem_of(seated(x, y, mass), plain, struts, measures, 384)
    np.testing.assert_allclose(problem.evaluate([design])[0], expected.evaluate([design[:2]])[0], rtol=1e-10)


def test_the_ratio_of_a_strut_is_a_factor_of_its_coefficients():
    """To rounding."""
    strut = replace(SPRING_AND_DAMPER, installation_ratio=0.8)
    bounds = {"front.spring": (1e4, 5e4), "front.installation_ratio": (0.6, 1.0)}
    struts, measures = {"front.damper": 2500.0, **REAR}, ("ACC", "SWS", "DTL", "damper_power")
    problem = problem_of(replace(FULL, front_strut=strut), bounds, struts, measures, 384)
    car = replace(FULL, front_strut=replace(strut, installation_ratio=0.7))
    expected = problem_of(car, {"front.spring": (1e4, 5e4)}, struts, measures, 384)
    np.testing.assert_allclose(problem.evaluate([[3e4, 0.7]])[0], expected.evaluate([[3e4]])[0], rtol=1e-12)


def test_a_certificate_is_that_of_the_vehicle_built_anew():
    problem = problem_of(QUARTER, {"spring": (1e4, 3e4), "tyre_stiffness": (1.5e5, 2.5e5)}, {"damper": 1500.0},
                         ("ACC", "DLC"), 256)  # fmt: skip
    car = replace(QUARTER, tyre_stiffness=1.7e5)
    plain = problem_of(car, {"spring": (1e4, 3e4)}, {"damper": 1500.0}, ("ACC", "DLC"), 256)
    found, expected = (
        certify(one, design, length=400.0, seeds=range(2)).to_frame()[["linearised", "simulated"]]
        for one, design in ((problem, [2e4, 1.7e5]), (plain, [2e4]))
    )
    np.testing.assert_allclose(found, expected, rtol=1e-10)


@pytest.mark.parametrize(
    ("car", "bounds", "measures", "message"),
    [
        (DRIVER.on(FULL), {"driver.x": (0.0, 1.0)}, ("SWS driver", "ACC"),
         "driver_suspension_travel must be of a seat in a fixed place, got driver.x among the variables"),
        (replace(FULL, front_strut=LAW), {"front.installation_ratio": (0.5, 1.0)}, ("ACC", "DTL"),
         "front.installation_ratio must be of springs, dampers and inerters in parallel to vary, "
         "got a strut with others"),
        (FULL, {"front.spring": (1e4, 2e4), "front.ride_frequency": (1.0, 1.5)}, ("ACC", "DTL"),
         "setting must have front.spring or front.ride_frequency in its place, got both"),
        (FULL, {"front.installation_ratio": (0.5, 1.0), "front.ride_frequency": (1.0, 1.5)}, ("ACC", "DTL"),
         "bounds must have front.installation_ratio or frequencies in place of rates, got both"),
    ],
)  # fmt: skip
def test_rejects_what_is_not_exact(car, bounds, measures, message):
    struts = {name: value for name, value in {**FRONT, **REAR}.items() if name not in bounds}
    if "front.ride_frequency" in bounds:
        struts.pop("front.spring", None)
    if car.networks:
        del struts["front.damper"]
    with pytest.raises(ValueError, match=f"^{message}$"):
        problem_of(car, bounds, struts, measures).evaluate([[0.6] * len(bounds)])


def test_the_plant_with_the_responses_of_its_seat_is_refused_where_the_place_of_that_varies():
    """Its travel is one of the responses that are taken if none are named; others are those of the fixed seat."""
    car = DRIVER.on(FULL)
    moved = ported(car, ("driver.x",), {}, car)
    message = r"^driver_suspension_travel must be of a seat in a fixed place, got driver.x among the variables$"
    with pytest.raises(ValueError, match=message):
        moved.plant()
    assert moved.plant(["driver_acceleration"]).output_labels[0] == "driver_acceleration"


@pytest.mark.parametrize("varies", [True, False])
def test_a_tyre_follows_the_hop_frequency_in_its_place(varies):
    """Which varies, or is held while the spring varies: as of the vehicle built with that tyre, to 1e-10."""
    hop = 11.0
    bounds = {"spring": (1e4, 3e4)} | ({"wheel_hop_frequency": (9.0, 13.0)} if varies else {})
    struts = {"damper": 1500.0} | ({} if varies else {"wheel_hop_frequency": hop})
    problem = problem_of(QUARTER, bounds, struts, ("ACC", "DTL"), 256)
    tyre = (2 * np.pi * hop) ** 2 * QUARTER.wheel_mass - 2e4  # spring and tyre carry the wheel
    car = replace(QUARTER, tyre_stiffness=tyre)
    plain = problem_of(car, {"spring": (1e4, 3e4)}, {"damper": 1500.0}, ("ACC", "DTL"), 256)
    found = problem.evaluate([[2e4, hop] if varies else [2e4]])
    np.testing.assert_allclose(found, plain.evaluate([[2e4]]), rtol=1e-10)


LORRY = """
kind = "rigid-bodies"
bodies = [
    {{name = "frame", mass = "7 t", pitch_inertia_kg_m2 = 30e3}},
    {{name = "cab", mass_kg = {cab_mass}, pitch_inertia_kg_m2 = 900, position_m = [3.2, 0]}},
]
wheels = [
    {{name = "front", position_m = [2.4, 0], mass_kg = 600, tyre_stiffness_N_per_m = {front_tyre_stiffness}}},
    {{name = "rear", position_m = [-2.1, 0], mass_kg = 1100, tyre_stiffness_N_per_m = 3.6e6}},
]
suspensions = [
    {{name = "front", upper = "frame"}},
    {{name = "rear", upper = "frame"}},
    {{name = "cab_front", lower = "frame", upper = "cab", position_m = [3.9, 0], coefficients = "mount"}},
    {{name = "cab_rear", lower = "frame", upper = "cab", position_m = [2.6, 0], coefficients = "mount"}},
]

[[seats]]
name = "driver"
stands_on = "cab"
mass_kg = {mass}
spring_N_per_m = 15e3
damper_N_s_per_m = 600
position_m = [{x}, 0]

"""


def test_parameters_of_rigid_bodies_are_exact_as_well(tmp_path):
    """To 1e-10, as above; the driver's place on the cab too."""

    def lorry(**values):
        path = tmp_path / "lorry.toml"
        path.write_text(LORRY.format(**values))
        return load_vehicle(path).vehicle

    struts = {"rear": (3e5, 2e4), "mount": (8e4, 5e3)}
    bounds = {"front.spring": (1e5, 4e5), "front.damper": (1e4, 3e4)}
    given = {"front_tyre_stiffness": 1.6e6, "cab_mass": 1300.0, "driver.mass": 100.0, "driver.x": 0.4}
    car = lorry(front_tyre_stiffness=1.8e6, cab_mass=1100, mass=80, x=0.1)
    measures = ("ACC driver", "DTL", "DLC", "cab_pitch_acceleration")
    further = {name: (0.5 * value, 1.5 * value) for name, value in given.items()}
    problem = problem_of(car, {**bounds, **further}, struts, measures, 1024)
    anew = lorry(front_tyre_stiffness=1.6e6, cab_mass=1300, mass=100, x=0.4)
    expected = problem_of(anew, bounds, struts, measures, 1024).evaluate([[2e5, 2e4]])
    np.testing.assert_allclose(problem.evaluate([[2e5, 2e4, *given.values()]]), expected, rtol=1e-10)

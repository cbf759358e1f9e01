"""What all vehicles have: settings in every form, one assembly, and records equal by value."""

import pickle
import re
from dataclasses import replace
from functools import cached_property

import numpy as np
import pytest

from garage import (
    BENDING,
    DAMPED_HALF,
    DAMPED_QUARTER,
    DRIVER,
    FULL,
    HALF,
    QUARTER,
    VEHICLES,
    from_roads,
    struts_of,
)
from suspension_ctrl import Payload, Plant, QuarterCar, RollGeometry, Seat, load_vehicle
from suspension_ctrl.quantities import signal_unit
from suspension_ctrl.vehicles.feedback import gains_by_order
from suspension_ctrl.vehicles.vehicle import AssembledVehicle

PAIRS = {"front": (2e4, 1500.0), "rear": (2.2e4, 1600.0)}
SAME = [
    (QUARTER, [((22e3, 1500.0), {}), (((22e3, 1500.0),), {}), (({"spring": 22e3, "damper": 1500.0},), {}),
               ((), {"spring": 22e3, "damper": 1500.0}), (({"": (22e3, 1500.0)},), {})]),
    (HALF, [((PAIRS,), {}), ((), PAIRS),
            (({"front": (2e4, 1500.0), "rear.spring": 2.2e4, "rear.damper": 1600.0},), {}),
            ((), {"front": np.array([2e4, 1500.0]), "rear": [2.2e4, 1600.0]})]),
    (DRIVER.on(FULL), [((PAIRS,), {}), ((), PAIRS | {"driver": (12e3, 700.0)}),
                       ((PAIRS | {"driver.spring": 12e3, "front_antiroll": 0.0},), {})]),
    (DRIVER.on(QUARTER), [(({"spring": 22e3, "damper": 1500.0},), {}), (((22e3, 1500.0),), {}),
                          ((), {"spring": 22e3, "damper": 1500.0, "driver": (12e3, 700.0)})]),
]  # fmt: skip


@pytest.mark.parametrize(("car", "forms"), SAME)
def test_a_setting_is_one_mapping_keywords_or_the_pair_of_the_one_strut(car, forms):
    (arguments, keywords), *others = forms
    closed = car.closed(*arguments, **keywords)
    for arguments, keywords in others:
        np.testing.assert_array_equal(car.closed(*arguments, **keywords).A, closed.A)


def test_responses_are_asked_for_beside_the_setting():
    names = ["rear_tyre_load", ("acceleration", 0.5, 0.0)]
    closed = HALF.closed(front=(2e4, 1500.0), rear=(2.2e4, 1600.0), responses=names)
    assert closed.output_labels == ["rear_tyre_load", "acceleration_at_500_0_mm"]


@pytest.mark.parametrize(
    ("responses", "message"),
    [
        ("rear_tyre_load", "responses must be a list, got 'rear_tyre_load'"),
        (3, "responses must be a list, got 3"),
        (("acceleration", 0.5, 0.0), "response must be one of body_acceleration, pitch_acceleration, "),
        ([0.5], "response must be one of body_acceleration, pitch_acceleration, "),
        ([("velocity", 0.5, 0.0)], "response must be one of body_acceleration, pitch_acceleration, "),
    ],
)
@pytest.mark.parametrize("car", [HALF, Plant(HALF.plant(), HALF.contacts)])
def test_responses_are_a_list_of_known_ones(car, responses, message):
    for call in (car.plant, lambda responses: car.closed(PAIRS, responses=responses)):
        with pytest.raises(ValueError, match="^" + re.escape(message)):
            call(responses)


def test_modes_take_a_setting_in_every_form():
    for table in (HALF.modes(**PAIRS), HALF.modes(HALF.coefficients(PAIRS))):
        np.testing.assert_array_equal(table["frequency [Hz]"], HALF.modes(PAIRS)["frequency [Hz]"])
    assert len(QUARTER.modes((22e3, 1500.0))) == 2


KINDS = (
    "displacement", "velocity", "acceleration", "jerk", "travel", "travel_rate", "strut_force", "load",
    "tyre_deflection",
)  # fmt: skip
RATES = (
    ("displacement", "velocity"), ("velocity", "acceleration"), ("acceleration", "jerk"),
    ("travel", "travel_rate"),
)  # fmt: skip
FRONT, REAR = {"front": (2e4, 1500.0)}, {"rear": (2e4, 1500.0)}
KNOWN = "front.spring, front.damper, rear.spring, rear.damper"
FURTHER = "front_tyre_stiffness, rear_tyre_stiffness, front_tyre_damping, rear_tyre_damping, ... and 12 more"
HALF_VARIES, BY_SPRING = (
    f"{names}, {FURTHER}" for names in (KNOWN, "rear.spring, front.spring, front.damper, rear.damper")
)
QUARTER_VARIES = (
    "spring, damper, tyre_stiffness, tyre_damping, wheel_mass, body_mass, installation_ratio, "
    "ride_frequency, wheel_hop_frequency, damping_ratio"
)


@pytest.mark.parametrize(
    ("car", "arguments", "keywords", "message"),
    [
        (HALF, (FRONT,), {}, f"setting must have {KNOWN}, got none for rear.spring, rear.damper"),
        (HALF, (), FRONT, f"setting must have {KNOWN}, got none for rear.spring, rear.damper"),
        (HALF, (), {}, f"setting must have {KNOWN}, got none for {KNOWN}"),
        (HALF, (FRONT,), REAR, "setting must be one mapping or keywords, got both and rear"),
        (HALF, (3.0,), {}, "setting must be a mapping of values by name, got 3.0"),
        (HALF, ("front",), {}, "setting must be a mapping of values by name, got 'front'"),
        (HALF, ((1.0, 2.0),), {}, f"setting must be one of {BY_SPRING}, got 'spring'"),
        (HALF, (FRONT | {"rear": (2e4,)},), {},
         "setting must have two numbers, spring and damper, for rear, got (20000.0,)"),
        (HALF, (FRONT | {"front.damper": 1.0},), {},
         "setting must have each coefficient once, got front.damper twice"),
        (HALF, (FRONT | {"rear": (2e4, 0.0)},), {}, "rear.damper must be finite and > 0 N s/m, got 0.0"),
        (HALF, (FRONT | {"rear": "x"},), {}, f"setting must be one of {HALF_VARIES}, got 'rear'"),
        (HALF, (FRONT | REAR | {"middle": (1.0, 1.0)},), {},
         f"setting must be one of {BY_SPRING}, got 'middle.spring'"),
        (HALF, (FRONT | REAR | {"front_antiroll": 1e4},), {},
         f"setting must be one of front.damping_ratio, {KNOWN}, front_tyre_stiffness, rear_tyre_stiffness, "
         "front_tyre_damping, ... and 12 more, got 'front_antiroll'"),
        (FULL, (FRONT | REAR | {"front_antiroll": -1.0},), {},
         "front_antiroll must be finite and >= 0 N m/rad, got -1.0"),
        (DRIVER.on(FULL), (FRONT | REAR | {"driver.spring": 0.0},), {},
         "driver.spring must be finite and > 0 N/m, got 0.0"),
        (QUARTER, (22e3,), {}, "setting must be a mapping of values by name, got 22000.0"),
        (QUARTER, (22e3, 0.0), {}, "damper must be finite and > 0 N s/m, got 0.0"),
        (QUARTER, (), {"spring": -1.0, "damper": 1.0}, "spring must be finite and > 0 N/m, got -1.0"),
        (QUARTER, ({"spring": 1.0},), {"road": 3}, "setting must be one mapping or keywords, got both and road"),
        (QUARTER, (), {"speed": 3}, f"setting must be one of {QUARTER_VARIES}, got 'speed'"),
    ],
)  # fmt: skip
def test_rejects_settings_that_do_not_fit(car, arguments, keywords, message):
    calls = (car.closed, car.coefficients, car.modes)
    for call in calls[: 1 if len(arguments) > 1 else 2 if "damper must" in message else 3]:  # modes are undamped
        with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
            call(*arguments, **keywords)


class Counted(AssembledVehicle):
    """A half car that counts how often its masses and links are worked out."""

    def __init__(self):
        self.count = 0

    @cached_property
    def assembly(self):
        self.count += 1
        return HALF.assembly


def test_an_assembly_is_worked_out_once():
    car = Counted()
    assert (car.struts, car.tyres, car.responses) == (HALF.struts, HALF.tyres, HALF.responses)
    car.closed(PAIRS)
    car.modes(PAIRS)
    car.statics.static_loads(np.array([[2e4, 1.0, 2e4, 1.0]]))
    assert car.count == 1
    assert HALF.assembly is HALF.assembly
    assert HALF.statics is HALF.statics


RECORDS = {
    **VEHICLES,
    "seat": DRIVER,
    "payload": Payload(mass=75.0),
    "flexible body": BENDING,
    "roll geometry": RollGeometry(roll_arm=0.5, front_roll_centre=0.05, rear_roll_centre=0.1, wheel_centre=0.3),
    "file": load_vehicle("jian_2022_full"),
    "assembly": DRIVER.on(BENDING.on(FULL)).assembly,
    "coefficient": FULL.strut_coefficients[-1],
}


@pytest.mark.parametrize("name", RECORDS)
def test_vehicles_and_their_parts_are_equal_by_value_hashable_picklable_and_shown_in_a_few_lines(name):
    record = RECORDS[name]
    again = pickle.loads(pickle.dumps(record))
    assert again == record
    assert hash(again) == hash(record)
    lines = repr(record).splitlines()
    assert 1 <= len(lines) <= 6
    assert max(map(len, lines)) <= 88


def test_vehicles_of_other_numbers_differ():
    assert replace(HALF, body_mass=651.0) != HALF
    assert DAMPED_HALF != HALF
    assert DRIVER.on(HALF) != replace(DRIVER, name="other").on(HALF)


def test_what_is_cached_is_not_pickled():
    car = DRIVER.on(FULL)
    before = len(pickle.dumps(car))
    car.closed(struts_of(car))
    car.statics.static_loads(np.array([list(car.coefficients(struts_of(car)).values())]))
    assert len(pickle.dumps(car)) == before < 1500


def test_a_vehicle_is_shown_with_its_units():
    assert repr(QUARTER) == "QuarterCar(body_mass=317.5 kg, wheel_mass=45.4 kg, tyre_stiffness=192000 N/m)"
    assert repr(DRIVER) == (
        "Seat(mass=80 kg, spring=12000 N/m, damper=700 N s/m, position=(0.3, 0.4) m,\n    name='driver')"
    )


def test_inputs_are_copied_and_cannot_be_changed():
    shapes = {(0.0, 0.0): [0.1]}
    body = replace(BENDING, frequencies=[5.0], damping_ratios=[0.02], shapes=shapes)
    shapes[0.0, 0.0][0] = 7.0
    assert dict(body.shapes) == {(0.0, 0.0): (0.1,)}
    with pytest.raises(TypeError, match="item assignment"):
        body.shapes[0.0, 0.0] = (7.0,)
    with pytest.raises(TypeError, match="item assignment"):
        FULL.assembly.masses["body"] = 7.0
    with pytest.raises(ValueError, match="read-only"):
        FULL.strut_coefficients[0].gain[0, 0] = 7.0
    with pytest.raises(ValueError, match="read-only"):
        FULL.contact_points[0] = 7.0
    with pytest.raises(AttributeError):
        QUARTER.body_mass = 1.0
    with pytest.raises(TypeError):
        QuarterCar(317.5, 45.4, 192e3)


@pytest.mark.parametrize("vehicle", VEHICLES.values(), ids=VEHICLES)
def test_every_response_is_the_rate_or_the_law_of_others(vehicle):
    """Rates by s, strut forces by springs, dampers and bars; to rounding of the largest value."""
    setting, s = vehicle.coefficients(struts_of(vehicle)), 2j * np.pi * np.array([0.3, 1.1, 4.0, 11.0, 30.0])
    names = list(vehicle.meanings)
    h = from_roads(vehicle, setting, names, s.imag / (2 * np.pi))
    found = dict(zip(names, h.transpose(1, 2, 0), strict=True))  # each (r, n)
    by_kind: dict[str, dict] = {kind: {} for kind in KINDS}
    for name, (kind, where) in vehicle.meanings.items():
        by_kind[kind][where] = found[name]
    for lower, higher in RATES:
        assert by_kind[higher].keys() <= by_kind[lower].keys()
        for where, rate in by_kind[higher].items():
            np.testing.assert_allclose(rate, s * by_kind[lower][where], rtol=0, atol=1e-9 * np.abs(rate).max())
    springs, dampers = gains_by_order(vehicle.strut_coefficients, setting, len(vehicle.struts))[:2]
    travels, rates, forces = (
        np.array([*by_kind[kind].values()]) for kind in ("travel", "travel_rate", "strut_force")
    )
    law = np.einsum("ij,jrn->irn", springs, travels) + np.einsum("ij,jrn->irn", dampers, rates)
    np.testing.assert_allclose(forces, law, rtol=0, atol=1e-9 * np.abs(law).max())
    tyres = {tyre.name: tyre for tyre in vehicle.assembly.tyres}
    for where, load in by_kind["load"].items():
        law = (tyres[where].stiffness + s * tyres[where].damping) * by_kind["tyre_deflection"][where]
        np.testing.assert_allclose(load, law, rtol=0, atol=1e-9 * np.abs(load).max())


def test_forces_and_loads_move_the_masses():
    """Newton's law for body and wheel of a quarter car."""
    s = 2j * np.pi * np.array([0.5, 1.2, 5.0, 12.0])
    names = ["body_acceleration", "wheel_acceleration", "strut_force", "tyre_load"]
    body, wheel, force, load = QUARTER.closed(22e3, 1500.0, responses=names)(s)[:, 0]
    np.testing.assert_allclose(QUARTER.body_mass * body, -force, rtol=1e-9)
    np.testing.assert_allclose(QUARTER.wheel_mass * wheel, force - load, rtol=1e-9)


def test_a_jerk_needs_struts_and_no_road_that_acts_on_the_acceleration():
    with pytest.raises(ValueError, match=r"^response .*closed.*got body_jerk"):
        QUARTER.plant(["body_jerk"])
    system = QUARTER.plant(["wheel_acceleration"])
    plant = Plant(system)  # of a system, the wheel is any response
    with pytest.raises(ValueError, match=r"wheel_jerk.*wheel_acceleration, got road"):
        plant.closed((22e3, 1500.0), responses=["wheel_jerk"])


def test_a_mass_on_a_wheel_has_a_jerk_but_its_floor_has_none():
    """The road acts on the acceleration of a wheel with a damped tyre, and so on that of the floor there."""
    absorber = Seat(mass=5.0, spring=1e4, damper=100.0, name="absorber", stands_on="wheel")
    names = set(absorber.on(DAMPED_QUARTER).meanings)
    assert {"absorber_jerk", "absorber_floor_acceleration"} <= names
    assert "absorber_floor_jerk" not in names
    assert "absorber_floor_jerk" in replace(absorber, stands_on="body").on(DAMPED_QUARTER).meanings


def test_points_and_jerks_stand_beside_each_other():
    closed = HALF.closed(PAIRS, responses=["pitch_jerk", ("acceleration", 0.5, 0.0), "pitch_acceleration"])
    assert closed.output_labels == ["pitch_jerk", "acceleration_at_500_0_mm", "pitch_acceleration"]
    assert [signal_unit(name) for name in closed.output_labels] == ["rad/s^3", "m/s^2", "rad/s^2"]

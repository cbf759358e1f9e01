"""Seats, payload and flexible bodies: limits, Steiner's theorem, and equations of motion written out."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from garage import BENDING, CORNERS, DRIVER, FULL, HALF, PASSENGER, QUARTER, from_roads, struts_of
from suspension_ctrl import FlexibleBody, HalfCar, Payload, Seat

F = np.geomspace(0.1, 30, 25)


def difference(found: np.ndarray, expected: np.ndarray) -> float:
    """Largest difference as a share of the largest value of the response at that frequency."""
    return float((np.abs(found - expected) / np.abs(expected).max(axis=2, keepdims=True)).max())


@pytest.mark.parametrize("car", [QUARTER, HALF, FULL])
def test_a_light_seat_changes_nothing_of_the_car(car):
    """A mass m changes the body's equations by m/M; with 1e-9 kg on a strut to match, by 1e-11."""
    seat = Seat(mass=1e-9, spring=1e-7, damper=1e-8, position=(0.3, 0.4))
    struts = struts_of(car)
    found = from_roads(seat.on(car), struts, car.responses, F)
    assert difference(found, from_roads(car, struts, car.responses, F)) < 1e-9


@pytest.mark.parametrize("car", [QUARTER, HALF, FULL])
def test_a_stiff_seat_moves_as_its_point_of_the_body(car):
    """Its own frequency is 1000 times the highest here, so that it follows to 1e-6, and is a payload to the car.

    Its stiffness, 3e12 N/m, makes as much rounding.
    """
    mass, place = 80.0, (0.3, 0.4)
    seat = Seat(mass=mass, spring=mass * (2 * np.pi * 30e3) ** 2, damper=1.0, position=place).on(car)
    struts = struts_of(car)
    h = from_roads(seat, struts, ["seat_acceleration", ("acceleration", *place), *car.responses], F)
    assert difference(h[:, :1], h[:, 1:2]) < 1e-4
    loaded = Payload(mass=mass, position=place).on(car)
    assert difference(h[:, 2:], from_roads(loaded, struts, car.responses, F)) < 1e-4


def test_a_seat_with_its_own_values_is_one_with_these_given():
    car = DRIVER.on(FULL)
    given_too = {**struts_of(car), "driver": (12e3, 700.0)}
    np.testing.assert_array_equal(car.closed(given_too).A, car.closed(struts_of(car)).A)
    softer = car.closed({**struts_of(car), "driver": (6e3, 700.0)})
    assert np.abs(softer.A - car.closed(given_too).A).max() == pytest.approx(6e3 / 80, rel=1e-9)


def test_the_order_of_two_seats_makes_no_difference():
    one, other = PASSENGER.on(DRIVER.on(FULL)), DRIVER.on(PASSENGER.on(FULL))
    responses = [*FULL.responses, "driver_acceleration", "passenger_acceleration", "driver_suspension_travel"]
    struts = struts_of(FULL)
    assert difference(from_roads(one, struts, responses, F), from_roads(other, struts, responses, F)) < 1e-9


@settings(max_examples=30)
@given(
    st.floats(0.1, 40), st.floats(10, 120), st.floats(-1, 1), st.floats(3, 20), st.floats(0, 0.1),
    st.lists(st.floats(-0.06, 0.06), min_size=4, max_size=4), st.complex_numbers(max_magnitude=1),
)  # fmt: skip
def test_a_seat_on_a_half_car_that_bends_by_matrices_put_together_here(f, mass, x, mode, ratio, shape, rear):
    """(M s^2 + C s + K) z = forces, over heave, pitch, wheels, a mode and a seat, written out.

    The model is solved backward stably, to 1e-13 of matrices with conditions up to 1e4.
    """
    front_shape, rear_shape, seat_shape, end_shape = shape
    body = FlexibleBody(
        frequencies=[mode],
        damping_ratios=[ratio],
        shapes={(1.2, 0.0): [front_shape], (-1.5, 0.0): [rear_shape], (x, 0.2): [seat_shape], (3, 0): [end_shape]},
    )
    car = Seat(mass=mass, spring=11e3, damper=650.0, position=(x, 0.2)).on(body.on(HALF))
    struts = {"front": (19e3, 1500.0), "rear": (23e3, 1700.0)}
    responses = ["body_acceleration", "seat_acceleration", "rear_suspension_travel", "front_tyre_load"]
    found = from_roads(car, struts, [*responses, ("acceleration", 3.0, 0.0)], np.array([f]))[0] @ [1, rear]

    s, omega = 2j * np.pi * f, 2 * np.pi * mode
    front_strut, rear_strut, seat, front_tyre, rear_tyre = np.array([
        [1, -1.2, -1, 0, front_shape, 0],
        [1, 1.5, 0, -1, rear_shape, 0],
        [-1, x, 0, 0, -seat_shape, 1],
        [0, 0, 1, 0, 0, 0],
        [0, 0, 0, 1, 0, 0],
    ])  # fmt: skip
    impedance = np.diag([650, 1200, 40, 45, 1, mass]) * s**2 + np.diag(
        [0, 0, 0, 0, omega**2 + 2 * ratio * omega * s, 0]
    )
    for row, k, c in (
        (front_strut, 19e3, 1500), (rear_strut, 23e3, 1700), (seat, 11e3, 650),
        (front_tyre, 192e3, 0), (rear_tyre, 200e3, 0),
    ):  # fmt: skip
        impedance = impedance + (k + c * s) * np.outer(row, row)
    z = np.linalg.solve(impedance, 192e3 * front_tyre + 200e3 * rear * rear_tyre)
    end = z @ [1, -3.0, 0, 0, end_shape, 0]
    expected = [s**2 * z[0], s**2 * z[5], rear_strut @ z, 192e3 * (z[2] - 1), s**2 * end]
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-9 * np.abs(s**2 * z).max())


ELEMENTS, LENGTH, MASS, BENDING_STIFFNESS = 4, 4.0, 650.0, 6e5


def beam() -> tuple[np.ndarray, np.ndarray]:
    """Masses and stiffnesses of a free uniform beam in cubic elements; deflection and slope at each node."""
    length, nodes = LENGTH / ELEMENTS, ELEMENTS + 1
    mass, stiffness = np.zeros((2, 2 * nodes, 2 * nodes))
    x, w = np.polynomial.legendre.leggauss(4)
    for element in range(ELEMENTS):
        at = slice(2 * element, 2 * element + 4)
        for xi, weight in zip((x + 1) / 2, w / 2, strict=True):
            value = [1 - 3 * xi**2 + 2 * xi**3, length * (xi - 2 * xi**2 + xi**3), 3 * xi**2 - 2 * xi**3,
                     length * (xi**3 - xi**2)]  # fmt: skip
            bent = np.array([12 * xi - 6, length * (6 * xi - 4), 6 - 12 * xi, length * (6 * xi - 2)]) / length**2
            mass[at, at] += weight * length * MASS / LENGTH * np.outer(value, value)
            stiffness[at, at] += weight * length * BENDING_STIFFNESS * np.outer(bent, bent)
    return mass, stiffness


def test_all_modes_of_a_free_beam_make_the_beam():
    """A beam in finite elements on two struts, solved as it is and by its free modes: the same numbers.

    The first free frequency is the textbook's, (4.7300/L)^2 sqrt(EI/(m/L)), to the 0.2 % of four elements.
    """
    mass, stiffness = beam()
    values, modes = eigh(stiffness, mass)
    omega = np.sqrt(values[2:])
    assert omega[0] == pytest.approx((4.7300 / LENGTH) ** 2 * np.sqrt(BENDING_STIFFNESS * LENGTH / MASS), rel=2e-3)
    ratios = np.linspace(0.02, 0.05, omega.size)
    nodes = np.linspace(-LENGTH / 2, LENGTH / 2, ELEMENTS + 1)
    body = FlexibleBody(
        frequencies=omega / (2 * np.pi),
        damping_ratios=ratios,
        shapes={(x, 0.0): modes[2 * i, 2:] for i, x in enumerate(nodes)},
    )
    car = HalfCar(
        body_mass=MASS, pitch_inertia=MASS * LENGTH**2 / 12, front_wheel_mass=40.0, rear_wheel_mass=45.0,
        front_tyre_stiffness=192e3, rear_tyre_stiffness=200e3, cg_to_front=1.0, cg_to_rear=1.0,
    )  # fmt: skip
    struts = {"front": (19e3, 1500.0), "rear": (23e3, 1700.0)}
    found = from_roads(body.on(car), struts, [("acceleration", x, 0.0) for x in nodes], F)

    damping = mass @ modes[:, 2:] @ np.diag(2 * ratios * omega) @ modes[:, 2:].T @ mass
    size = len(mass) + 2
    unit = np.eye(size)
    for f, h in zip(F, found, strict=True):
        s = 2j * np.pi * f
        impedance = np.zeros((size, size), complex)
        impedance[:-2, :-2] = mass * s**2 + damping * s + stiffness
        impedance += s**2 * np.diag([0.0] * len(mass) + [40.0, 45.0])
        for strut, tyre, node, wheel in ((19e3 + 1500 * s, 192e3, 3, -2), (23e3 + 1700 * s, 200e3, 1, -1)):
            row = unit[2 * node] - unit[wheel]
            impedance += strut * np.outer(row, row) + tyre * np.outer(unit[wheel], unit[wheel])
        z = np.linalg.solve(impedance, np.column_stack([192e3 * unit[-2], 200e3 * unit[-1]]))
        expected = s**2 * z[: len(mass) : 2]
        np.testing.assert_allclose(h, expected, rtol=1e-7, atol=1e-9 * np.abs(expected).max())


def test_modes_that_nothing_moves_change_nothing():
    still = FlexibleBody(frequencies=[5.0], damping_ratios=[0.02], shapes=dict.fromkeys(CORNERS, (0.0,)))
    struts = struts_of(FULL)
    found = from_roads(still.on(FULL), struts, FULL.responses, F)
    assert difference(found, from_roads(FULL, struts, FULL.responses, F)) < 1e-9


def test_a_body_of_high_frequencies_is_rigid():
    """Stiffer by the square of 1e4 times the highest frequency: compliances of 1e-3 kg^-1/2 shapes are nothing."""
    rigid = FlexibleBody(
        frequencies=[30 * 1e4] * 2, damping_ratios=[0.01, 0.02],
        shapes={place: BENDING.shapes[place] for place in [*CORNERS, (0.3, 0.4)]},
    )  # fmt: skip
    struts = struts_of(FULL)
    responses = [*FULL.responses, "driver_acceleration"]
    found = from_roads(DRIVER.on(rigid.on(FULL)), struts, responses, F)
    assert difference(found, from_roads(DRIVER.on(FULL), struts, responses, F)) < 1e-6


def test_a_body_that_bends_does_so_where_it_matters():
    """Guards the limits above: the same shapes at 7 and 13 Hz do change the ride."""
    struts = struts_of(FULL)
    found = from_roads(BENDING.on(FULL), struts, FULL.responses, F)
    assert difference(found, from_roads(FULL, struts, FULL.responses, F)) > 0.05


SEAT = {"mass": 80.0, "spring": 1e4, "damper": 500.0}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": 0.0}, "mass must be finite and > 0 kg, got 0.0"),
        ({"spring": -1.0}, "spring must be finite and > 0 N/m, got -1.0"),
        ({"damper": None}, "damper must be finite and > 0 N s/m, got None"),
        ({"position": (1.0,)}, "position must be two finite numbers, x and y [m], got (1.0,)"),
        ({"position": (1.0, float("inf"))}, "position must be two finite numbers, x and y [m], got (1.0, inf)"),
        ({"name": "front seat"}, "name must be of letters, digits and underscores, got 'front seat'"),
        ({"name": ""}, "name must be of letters, digits and underscores, got ''"),
    ],
)
def test_rejects_bad_seats(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Seat(**SEAT | changes)


@pytest.mark.parametrize("car", [HALF, FULL])
@pytest.mark.parametrize("name", ["front", "rear", "body", "pitch", "roll", "driver"])
def test_rejects_names_of_seats_that_are_taken(car, name):
    with pytest.raises(ValueError, match=f"^name must be one that the vehicle does not have yet, got '{name}'$"):
        Seat(**SEAT, name=name).on(DRIVER.on(car))


@pytest.mark.parametrize("name", ["responses", "road", "speed"])
def test_rejects_the_names_of_keywords(name):
    with pytest.raises(ValueError, match=rf"^name must not be called responses, road, speed, got '{name}'$"):
        Seat(**SEAT, name=name)


BODY = {"frequencies": [5.0], "damping_ratios": [0.02], "shapes": dict.fromkeys(CORNERS, (0.01,))}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"frequencies": [0.0]}, "frequencies must be finite and > 0 Hz, got 0.0"),
        ({"damping_ratios": [1.5]}, "damping_ratios must be a number from 0 to 1, got 1.5"),
        ({"damping_ratios": []},
         "frequencies and damping_ratios must be of one length, 1 or more, got shapes (1,) and (0,)"),
        ({"frequencies": [], "damping_ratios": [], "shapes": {}},
         "frequencies and damping_ratios must be of one length, 1 or more, got shapes (0,) and (0,)"),
        ({"shapes": {(0.0, 0.0): (1.0, 2.0)}},
         "shapes must be 1 finite numbers at each point, got (1.0, 2.0) at (0.0, 0.0)"),
        ({"frequencies": 5.0, "damping_ratios": 0.1},
         "frequencies and damping_ratios must be of one length, 1 or more, got shapes () and ()"),
        ({"shapes": [(0.0, 0.0)]},
         "shapes must be a mapping of points to amplitudes, got [(0.0, 0.0)]"),
        ({"shapes": {"ab": (1.0,)}}, "shapes must be two finite numbers, x and y [m], got 'ab'"),
    ],
)  # fmt: skip
def test_rejects_bad_bodies(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        FlexibleBody(**BODY | changes)


def test_rejects_bodies_and_vehicles_that_do_not_fit():
    body = FlexibleBody(**BODY)
    with pytest.raises(
        ValueError, match=r"^position must be one with known mode shapes, \[\(1\.2, .*, got \(1\.2, 0"
    ):
        body.on(HALF)
    with pytest.raises(ValueError, match=r"^position must be one with known mode shapes, .*, got \(0\.3, 0\.4\)$"):
        DRIVER.on(body.on(FULL))
    with pytest.raises(ValueError, match=r"^position must be one with known mode shapes, .*, got \(0\.3, 0\.4\)$"):
        body.on(DRIVER.on(FULL))
    with pytest.raises(ValueError, match=r"^vehicle must have a rigid body, got one with modes at \[\(1\.2,"):
        body.on(body.on(FULL))
    named = Seat(**SEAT, name="bending_1", position=CORNERS[0]).on(FULL)
    with pytest.raises(ValueError, match=r"^vehicle must have nothing called bending_1, got bending_1$"):
        body.on(named)


@settings(max_examples=25)
@given(st.floats(1, 500), st.floats(-1.5, 1.2), st.floats(0.2, 20))
def test_a_loaded_half_car_is_the_one_with_its_centre_of_gravity_moved(mass, x, f):
    """By Steiner's theorem: inertia about the common centre of gravity, at m x / (m + M) from the old one."""
    total = HALF.body_mass + mass
    moved = mass * x / total
    inertia = HALF.pitch_inertia + HALF.body_mass * moved**2 + mass * (x - moved) ** 2
    lengths = {"cg_to_front": HALF.cg_to_front - moved, "cg_to_rear": HALF.cg_to_rear + moved}
    equal = replace(HALF, body_mass=total, pitch_inertia=inertia, **lengths)
    loaded, setting = Payload(mass=mass, position=(x, 0.0)).on(HALF), struts_of(HALF)
    responses = ["pitch_acceleration", "front_suspension_travel", "rear_tyre_load"]
    found = loaded.closed(setting, responses=[*responses, ("acceleration", 0.7, 0.0)])(2j * np.pi * f)
    expected = equal.closed(setting, responses=[*responses, ("acceleration", 0.7 - moved, 0.0)])(2j * np.pi * f)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-12 * np.abs(expected).max())


def test_a_payload_loads_the_tyres_by_the_lever_rule():
    loaded = Payload(mass=100.0, position=(-HALF.cg_to_rear, 0.0)).on(HALF)
    coefficients = np.array([[17e3, 1500.0, 22e3, 1500.0]])
    more = loaded.statics.static_loads(coefficients) - HALF.statics.static_loads(coefficients)
    np.testing.assert_allclose(more, [[0.0, 980.665]], atol=1e-9)


def test_on_a_quarter_car_a_payload_is_body_mass():
    loaded = Payload(mass=75.0).on(QUARTER).closed({"spring": 22e3, "damper": 1500.0})
    heavier = replace(QUARTER, body_mass=QUARTER.body_mass + 75.0).closed(22e3, 1500.0)
    np.testing.assert_allclose(loaded(20j), heavier(20j), rtol=1e-12)


@pytest.mark.parametrize(
    ("mass", "position"), [(0.0, (0.0, 0.0)), (1.0, (0.0,)), (1.0, (np.nan, 0.0)), (1.0, "ab")]
)
def test_rejects_bad_loads(mass, position):
    with pytest.raises(ValueError, match=r"^(mass|position) must be .*, got "):
        Payload(mass=mass, position=position)

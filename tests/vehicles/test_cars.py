"""Half and full cars against simpler cars, Newton's and Euler's laws, and limits."""

from dataclasses import replace

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import (
    DRIVER,
    FULL,
    HALF,
    PASSENGER,
    QUARTER,
    axle_struts,
    axles,
    from_roads,
    inertias,
    lengths,
    masses,
    struts_of,
)
from suspension_ctrl import FullCar, HalfCar, QuarterCar, Seat
from suspension_ctrl.vehicles.feedback import gains_by_order

frequencies = st.floats(0.05, 60)
bars = st.floats(0, 5e4)
any_mass, stiffnesses, any_damper = st.floats(1, 5000), st.floats(1e3, 1e6), st.floats(10, 1e5)


@settings(max_examples=40)
@given(masses, axles(), axle_struts(), frequencies)
def test_a_half_car_with_inertia_mab_is_two_quarter_cars(mass, axle, struts, f):
    """Body masses m b/(a + b) over the front and m a/(a + b) over the rear axle, that do not feel each other.

    A bound for rounding: 1e-9 of the largest response of the kind, residuals of 1e-13 on conditions up to 1e4.
    """
    a, b = axle["cg_to_front"], axle["cg_to_rear"]
    half = HalfCar(body_mass=mass, pitch_inertia=mass * a * b, **axle)
    for end, x, share, other in (("front", a, b / (a + b), "rear"), ("rear", -b, a / (a + b), "front")):
        quarter = QuarterCar(
            body_mass=mass * share,
            wheel_mass=axle[f"{end}_wheel_mass"],
            tyre_stiffness=axle[f"{end}_tyre_stiffness"],
            tyre_damping=axle[f"{end}_tyre_damping"],
        )
        responses = [("acceleration", x, 0.0), f"{end}_suspension_travel", f"{end}_tyre_load"]
        found = from_roads(half, struts, responses, np.array([f]))[0]
        expected = from_roads(
            quarter, dict(zip(("spring", "damper"), struts[end], strict=True)), quarter.responses, np.array([f])
        )[0, :, 0]
        roads = list(half.assembly.roads)
        np.testing.assert_allclose(found[:, roads.index(f"{end}_road")], expected, rtol=1e-9)
        far = found[:, roads.index(f"{other}_road")]
        assert (np.abs(far) <= 1e-9 * np.abs(expected)).all()


def test_a_symmetric_half_car_heaves_like_a_quarter_car_and_pitches_alone():
    """Front and rear alike, whatever the inertia: roads in phase move no pitch, roads out of phase no heave."""
    half = HalfCar(
        body_mass=600.0, pitch_inertia=900.0, front_wheel_mass=40.0, rear_wheel_mass=40.0,
        front_tyre_stiffness=2e5, rear_tyre_stiffness=2e5, cg_to_front=1.3, cg_to_rear=1.3,
    )  # fmt: skip
    quarter = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5)
    f = np.geomspace(0.1, 30, 20)
    strut = (2e4, 1500.0)
    h = from_roads(half, {"front": strut, "rear": strut}, half.responses, f)
    heave, pitch = (list(half.responses).index(f"{name}_acceleration") for name in ("body", "pitch"))
    one = from_roads(quarter, {"spring": 2e4, "damper": 1500.0}, ["body_acceleration"], f)[:, 0, 0]
    np.testing.assert_allclose(h[:, heave].sum(axis=1), one, rtol=1e-10)
    assert (np.abs(h[:, pitch].sum(axis=1)) < 1e-10 * np.abs(h[:, pitch, 0])).all()
    assert (np.abs(h[:, heave] @ [1, -1]) < 1e-10 * np.abs(h[:, heave, 0])).all()


@settings(max_examples=30)
@given(masses, inertias, inertias, axles(), lengths, lengths, axle_struts(), bars, bars, frequencies)
def test_a_full_car_is_its_half_car_on_roads_in_phase_and_only_rolls_out_of_phase(
    mass, roll, pitch, axle, front_track, rear_track, struts, front_bar, rear_bar, f
):
    """Half the body's mass and inertia on each side; anti-roll bars are at rest while left and right are alike."""
    full = FullCar(
        body_mass=mass,
        roll_inertia=roll,
        pitch_inertia=pitch,
        front_track=front_track,
        rear_track=rear_track,
        **axle,
    )
    half = HalfCar(body_mass=mass / 2, pitch_inertia=pitch / 2, **axle)
    responses = ["body_acceleration", "pitch_acceleration", ("acceleration", 0.6, 0.0)]
    kinds = [f"{end}{kind}" for kind in ("_suspension_travel", "_tyre_load") for end in ("front", "rear")]
    left, right = (
        [kind.replace("front", f"front_{side}").replace("rear", f"rear_{side}") for kind in kinds]
        for side in ("left", "right")
    )
    expected = from_roads(half, struts, [*responses, *kinds], np.array([f]))[0]
    bars = {"front_antiroll": front_bar, "rear_antiroll": rear_bar}
    asked = [*responses, "roll_acceleration", *left, *right]
    h = from_roads(full, {**struts, **bars}, asked, np.array([f]))[0]
    in_phase = h @ np.repeat(np.eye(2), 2, axis=0)  # roads are front left, front right, rear left, rear right
    scale = np.abs(expected).max(axis=1, keepdims=True)
    assert (np.abs(in_phase[:3] - expected[:3]) <= 1e-9 * scale[:3]).all()
    assert (np.abs(in_phase[4:8] - expected[3:]) <= 1e-9 * scale[3:]).all()
    assert (np.abs(in_phase[8:] - expected[3:]) <= 1e-9 * scale[3:]).all()
    out_of_phase = h @ [[1, 0], [-1, 0], [0, 1], [0, -1]]
    assert (np.abs(out_of_phase[:3]) <= 1e-9 * scale[:3]).all()
    assert (np.abs(in_phase[3]) <= 1e-9 * np.abs(h[3]).max()).all()
    assert (np.abs(out_of_phase[4:8] + out_of_phase[8:]) <= 1e-9 * np.abs(out_of_phase[4:8]).max()).all()


CORNERS = ("front_left", "front_right", "rear_left", "rear_right")


def corners(value, axle, tracks, struts, roads, s):
    """Forces of struts and anti-roll bars, their places and the displacements of wheels, by corner."""
    pull, at, wheels = {}, {}, {}
    for corner, road in roads.items():
        end, side = corner.split("_")
        (track, bar), (k, c) = tracks[end], struts[end]
        x, y = axle["cg_to_front"] if end == "front" else -axle["cg_to_rear"], track / 2
        at[corner] = (x, y if side == "left" else -y)
        sides = (side, "right" if side == "left" else "left")
        travel, other = (value[f"{end}_{one}_suspension_travel"] for one in sides)
        pull[corner] = (k + c * s) * travel + bar / track**2 * (travel - other)
        stiffness = axle[f"{end}_tyre_stiffness"] + s * axle[f"{end}_tyre_damping"]
        wheels[corner] = road + value[f"{corner}_tyre_load"] / stiffness
    return pull, at, wheels


@settings(max_examples=60)
@given(
    masses, inertias, inertias, axles(), lengths, lengths, axle_struts(), bars, bars, frequencies,
    st.lists(st.complex_numbers(max_magnitude=1, allow_subnormal=False), min_size=4, max_size=4),
    st.floats(10, 120), st.floats(-1, 1), st.floats(-0.6, 0.6),
)  # fmt: skip
def test_forces_and_moments_move_a_full_car_with_a_seat(
    mass,
    roll,
    pitch,
    axle,
    front_track,
    rear_track,
    struts,
    front_bar,
    rear_bar,
    f,
    roads,
    occupant,
    seat_x,
    seat_y,
):
    """Newton's and Euler's laws by what the responses say, on any roads.

    Tolerance as in `test_vehicles`: a thousand units of rounding of the largest force that any coefficient makes
    with the displacements at hand, and as much times the lengths for moments.
    """
    full = FullCar(
        body_mass=mass,
        roll_inertia=roll,
        pitch_inertia=pitch,
        front_track=front_track,
        rear_track=rear_track,
        **axle,
    )
    seat = Seat(mass=occupant, spring=1e4, damper=500.0, position=(seat_x, seat_y))
    car, s = seat.on(full), 2j * np.pi * f
    given_struts = {**struts, "front_antiroll": front_bar, "rear_antiroll": rear_bar}
    h = from_roads(car, given_struts, car.responses, np.array([f]))[0] @ np.array(roads)
    value = dict(zip(car.responses, h, strict=True))
    heave, rolled, pitched, sitting = (
        value[f"{z}_acceleration"] / s**2 for z in ("body", "roll", "pitch", "seat")
    )
    tracks = {"front": (front_track, front_bar), "rear": (rear_track, rear_bar)}
    pull, at, wheels = corners(value, axle, tracks, struts, dict(zip(CORNERS, roads, strict=True)), s)
    scale = 1 + np.abs(roads).max() + sum(map(abs, wheels.values()))
    scale += abs(heave) + 3 * abs(rolled) + 3 * abs(pitched) + abs(sitting)
    coefficients = (
        4e5 + 500 * abs(s) + sum(k + c * abs(s) for k, c in struts.values())
        + (front_bar + rear_bar) / min(front_track, rear_track) ** 2 + (mass + pitch + roll) * abs(s) ** 2
    )  # fmt: skip
    residual = 1e-12 * coefficients * scale
    cushion = (1e4 + 500 * s) * value["seat_suspension_travel"]
    assert abs(mass * s**2 * heave + sum(pull.values()) - cushion) < residual
    assert abs(occupant * s**2 * sitting + cushion) < residual
    assert (
        abs(pitch * s**2 * pitched - sum(x * pull[c] for c, (x, _) in at.items()) + seat_x * cushion)
        < 3 * residual
    )
    assert (
        abs(roll * s**2 * rolled + sum(y * pull[c] for c, (_, y) in at.items()) - seat_y * cushion) < 3 * residual
    )
    for corner, (x, y) in at.items():
        end = corner.split("_")[0]
        force = pull[corner] - value[f"{corner}_tyre_load"]
        assert abs(axle[f"{end}_wheel_mass"] * s**2 * wheels[corner] - force) < residual
        extension = heave - x * pitched + y * rolled - wheels[corner]
        assert abs(value[f"{corner}_suspension_travel"] - extension) < 1e-9 * scale
    assert (
        abs(value["seat_suspension_travel"] - (sitting - heave + seat_x * pitched - seat_y * rolled))
        < 1e-9 * scale
    )


@settings(max_examples=20)
@given(masses, axles(), axle_struts(), frequencies, st.floats(-2, 2))
def test_the_acceleration_of_a_point_is_that_of_a_rigid_body(mass, axle, struts, f, x):
    half = HalfCar(body_mass=mass, pitch_inertia=900.0, **axle)
    responses = [("acceleration", x, 3.0), "body_acceleration", "pitch_acceleration"]
    point, heave, pitch = from_roads(half, struts, responses, np.array([f]))[0]
    np.testing.assert_allclose(point, heave - x * pitch, rtol=1e-12, atol=1e-12 * np.abs(heave).max())


def test_an_anti_roll_bar_is_measured_in_moment_by_angle():
    """Left strut longer by t/2 times a small angle, right one shorter: moment k by radian about the middle."""
    values = FULL.coefficients({"front": (1.0, 1.0), "rear": (1.0, 1.0), "front_antiroll": 3e4})
    stiffness = gains_by_order(FULL.strut_coefficients, values, 4)[0]
    lever = np.array([0.75, -0.75, 0.0, 0.0])
    np.testing.assert_allclose(lever @ stiffness @ lever, 3e4 + 2 * 0.75**2, rtol=1e-14)
    np.testing.assert_allclose(stiffness[0], [1 + 3e4 / 1.5**2, -3e4 / 1.5**2, 0, 0], rtol=1e-14)
    np.testing.assert_array_equal(stiffness[2:], np.eye(4)[2:])


def test_signals_have_names():
    car = DRIVER.on(FULL)
    plant = car.plant([("acceleration", 1.2, -0.4), "driver_acceleration"])
    assert plant.input_labels == [
        *("front_left_road", "front_right_road", "rear_left_road", "rear_right_road"),
        *("front_left_strut", "front_right_strut", "rear_left_strut", "rear_right_strut", "driver_strut"),
    ]
    assert plant.output_labels[:3] == [
        "acceleration_at_1200_-400_mm", "driver_acceleration", "front_left_deflection",
    ]  # fmt: skip
    assert plant.output_labels[-1] == "driver_deflection_rate"
    damped = HalfCar(
        body_mass=650.0, pitch_inertia=1200.0, front_wheel_mass=40.0, rear_wheel_mass=40.0,
        front_tyre_stiffness=2e5, rear_tyre_stiffness=2e5, cg_to_front=1.2, cg_to_rear=1.5, rear_tyre_damping=50.0,
    )  # fmt: skip
    closed = damped.closed(struts_of(damped))
    assert closed.input_labels == ["front_road", "rear_road", "front_road_rate", "rear_road_rate"]
    assert tuple(closed.output_labels) == damped.responses
    assert closed.state_labels[:2] == ["body_displacement", "body_velocity"]
    assert FULL.contact_points.tolist() == [[1.2, 0.75], [1.2, -0.75], [-1.5, 0.73], [-1.5, -0.73]]
    assert FULL.struts == ("front_left", "front_right", "rear_left", "rear_right")


@pytest.mark.parametrize("car", [QUARTER, HALF, FULL, PASSENGER.on(DRIVER.on(FULL))])
def test_a_vehicle_on_level_ground_raised_by_a_step_stays_undeformed(car):
    gain = car.closed(struts_of(car)).dcgain().reshape(len(car.responses), -1)
    np.testing.assert_allclose(gain.sum(axis=1), 0, atol=1e-7)


@pytest.mark.parametrize("name", ["pitch_inertia", "cg_to_rear", "front_track", "rear_wheel_mass"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), None])
def test_rejects_impossible_parameters(name, value):
    known = {field: getattr(FULL, field) for field in FULL.__dataclass_fields__}
    with pytest.raises(ValueError, match=rf"^{name} must be finite and > 0 (kg|m|kg m\^2), got"):
        FullCar(**known | {name: value})
    with pytest.raises(ValueError, match=r"^rear_tyre_damping must be finite and >= 0 N s/m, got -1"):
        FullCar(**known | {"rear_tyre_damping": -1})


def textbook(car: QuarterCar, k: float, c: float) -> control.StateSpace:
    """Equations (1) and (2) of the paper with states z1, dz1/dt, z2, dz2/dt, written out."""
    m_b, m_w, k_t = car.body_mass, car.wheel_mass, car.tyre_stiffness
    body = [k / m_b, c / m_b, -k / m_b, -c / m_b]
    a = [[0, 1, 0, 0], [-(k_t + k) / m_w, -c / m_w, k / m_w, c / m_w], [0, 0, 0, 1], body]
    return control.ss(a, [[0], [k_t / m_w], [0], [0]], [body, [-1, 0, 1, 0], [k_t, 0, 0, 0]], [[0], [0], [-k_t]])


@given(any_mass, any_mass, stiffnesses, stiffnesses, any_damper)
def test_closed_loop_is_the_textbook_model(m_b, m_w, k_t, k, c):
    car = QuarterCar(body_mass=m_b, wheel_mass=m_w, tyre_stiffness=k_t)
    closed, expected = car.closed(k, c), textbook(car, k, c)
    for matrix in "ABCD":
        np.testing.assert_allclose(getattr(closed, matrix), getattr(expected, matrix), rtol=1e-14)


def test_signals_of_a_quarter_car_have_names():
    car = QUARTER
    closed = car.closed(spring=22e3, damper=1500.0)
    assert closed.input_labels == ["road"]
    assert closed.output_labels == ["body_acceleration", "suspension_travel", "tyre_load"]
    assert car.plant().input_labels == ["road", "strut"]
    assert car.plant().output_labels[-2:] == ["deflection", "deflection_rate"]


@given(any_mass, any_mass, stiffnesses, stiffnesses, any_damper, st.floats(0.01, 100))
def test_forces_equal_mass_times_acceleration(m_b, m_w, k_t, k, c, f):
    """At any frequency the strut alone moves the body, and the tyre alone both masses.

    The tolerance is the residual of a backward stable solution: some hundred units of rounding of the largest
    force that any coefficient of the equations of motion makes with the displacements at hand.
    """
    car = QuarterCar(body_mass=m_b, wheel_mass=m_w, tyre_stiffness=k_t)
    s = 2j * np.pi * f
    acceleration, travel, tyre_tension = car.closed(k, c)(s)[:, 0]
    z_w, z_b = 1 + tyre_tension / k_t, acceleration / s**2
    coefficients = k + k_t + c * abs(s) + (m_b + m_w) * abs(s) ** 2
    residual = 1e-13 * coefficients * (1 + abs(z_w) + abs(z_b))
    assert abs(m_b * acceleration + (k + c * s) * travel) < residual
    assert abs(m_b * acceleration + m_w * s**2 * z_w + tyre_tension) < residual


def test_a_vehicle_at_rest_on_a_static_step_stays_undeformed():
    gain = QUARTER.closed(22e3, 1500.0).dcgain()
    np.testing.assert_allclose(gain.ravel(), 0, atol=1e-9)


@pytest.mark.parametrize("name", ["body_mass", "wheel_mass", "tyre_stiffness"])
@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf"), 10**400, "12", None])
def test_rejects_impossible_quarter_cars(name, value):
    with pytest.raises(ValueError, match=rf"^{name} must be finite and > 0 .*got"):
        replace(QUARTER, **{name: value})

"""Rigid bodies beside cars, printed natural frequencies, stiff springs in place of joints, and files."""

import re
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

import suspension_ctrl as sc
from garage import DAMPED_FULL, FULL, HALF, ROAD, axle_struts, axles, inertias, masses
from suspension_ctrl import FullCar, RigidBodies
from suspension_ctrl.vehicles.body_parts import (
    AntiRollBar,
    BodyPoint,
    Joint,
    RigidBody,
    Support,
    Suspension,
    Wheel,
)
from suspension_ctrl.vehicles.vehicle import AssembledVehicle

GRAVITY = 9.80665


def as_bodies(car: FullCar) -> RigidBodies:
    """The full car part by part."""
    axle = {"front": (car.cg_to_front, car.front_track), "rear": (-car.cg_to_rear, car.rear_track)}
    side = {"left": 0.5, "right": -0.5}
    return RigidBodies(
        bodies=[RigidBody(mass=car.body_mass, pitch_inertia=car.pitch_inertia, roll_inertia=car.roll_inertia)],
        wheels=[
            Wheel(
                name=f"{a}_{s}", position=(x, y * t), mass=getattr(car, f"{a}_wheel_mass"),
                tyre_stiffness=getattr(car, f"{a}_tyre_stiffness"), tyre_damping=getattr(car, f"{a}_tyre_damping"),
            )
            for a, (x, t) in axle.items() for s, y in side.items()
        ],
        suspensions=[Suspension(name=f"{a}_{s}", coefficients=a) for a in axle for s in side],
        anti_roll_bars=[AntiRollBar(name=f"{a}_antiroll", struts=(f"{a}_left", f"{a}_right")) for a in axle],
    )  # fmt: skip


def frequencies(vehicle: AssembledVehicle, setting: dict) -> np.ndarray:
    """Natural frequencies [Hz] by the matrices of the vehicle."""
    values = np.array([list(vehicle.coefficients(setting).values())])
    squares = eigh(vehicle.statics.stiffness_of(values)[0], vehicle.assembly.mass_matrix, eigvals_only=True)
    return np.sqrt(squares) / (2 * np.pi)


def truck() -> RigidBodies:
    """VEqMon2D's validation vehicle: tractor, trailer on a joint, and a third body; axles 2 to 6 on two beams."""
    groups = [("a", 1.0, "body", 1, 0, [0.0]), ("b", -3.0, "body", 2, 2, [1.0, -1.0]),
              ("c", -10.0, "trailer", 3, 3, [1.2, 0.0, -1.2]), ("d", -14.5, "third", 1, 0, [0.0]),
              ("e", -19.5, "third", 1, 0, [0.0])]  # fmt: skip
    tyres = {"a": 1.75e6}
    return RigidBodies(
        bodies=[
            RigidBody(mass=5e3, pitch_inertia=4e3),
            RigidBody(name="trailer", mass=30e3, pitch_inertia=20e3, position=(-8.0, 0.0)),
            RigidBody(name="third", mass=20e3, pitch_inertia=10e3, position=(-17.0, 0.0)),
            *(
                RigidBody(
                    name=f"group_{g}", mass=750.0 * m, pitch_inertia=100.0 * i if i else None, position=(x, 0.0)
                )
                for g, x, _, m, i, _ in groups
            ),
        ],
        wheels=[
            Wheel(
                name=f"axle_{g}{k}", position=(x + e, 0.0), carrier=f"group_{g}",
                tyre_stiffness=tyres.get(g, 3.5e6), tyre_damping=1e4,
            )
            for g, x, _, _, _, places in groups for k, e in enumerate(places)
        ],
        suspensions=[
            Suspension(name=g, lower=f"group_{g}", upper=body, position=(x, 0.0)) for g, x, body, *_ in groups
        ],
        joints=[Joint(lower="body", upper="trailer", position=(-2.0, 0.0))],
    )  # fmt: skip


TRUCK = {"a": (0.5e6, 1e3), "b": (2e6, 2e3), "c": (3e6, 3e3), "d": (1e6, 1e3), "e": (1e6, 1e3)}


def test_printed_frequencies_of_a_truck_with_two_trailers():
    """D. Cantero, "VEqMon2D", SoftwareX 19 (2022) 101103, script A02, by Abaqus."""
    printed = [1.4010, 1.5923, 1.9731, 4.8321, 7.3248, 8.8112, 12.351, 12.367, 12.661, 13.422, 29.174, 29.775]
    found = frequencies(truck(), TRUCK)
    for one, other in zip(found, printed, strict=True):
        assert f"{one:.5g}" == f"{other:.5g}"


@settings(max_examples=10)
@given(masses, axles(), inertias, inertias, st.floats(1.2, 2.0), axle_struts(), st.floats(0, 3e4))
def test_a_full_car_is_the_same_part_by_part(mass, axle, pitch, roll, track, struts, bar):
    car = FullCar(
        body_mass=mass, pitch_inertia=pitch, roll_inertia=roll, front_track=track, rear_track=1.1 * track, **axle
    )
    bodies, setting = as_bodies(car), struts | {"front_antiroll": bar}
    one, other = car.closed(setting), bodies.closed(setting)
    assert one.output_labels == other.output_labels
    assert one.input_labels == other.input_labels
    assert one.state_labels == other.state_labels
    for name in "ABCD":
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), rtol=1e-12)
    values = np.array([list(car.coefficients(setting).values())])
    np.testing.assert_allclose(bodies.statics.static_loads(values), car.statics.static_loads(values), rtol=1e-12)


def test_ride_and_motion_of_a_full_car_part_by_part():
    setting = {"front": (2e4, 1500.0), "rear": (2.2e4, 1700.0), "front_antiroll": 9e3}
    bodies = as_bodies(DAMPED_FULL)
    one, other = (sc.ride(car, setting, ROAD, 20.0, band=(0.1, 20.0)) for car in (DAMPED_FULL, bodies))
    np.testing.assert_allclose(other["value"], one["value"], rtol=1e-12)
    bump = sc.SpeedBump(height=0.05, length=2.0)
    one, other = (sc.simulate(car, setting, bump, 10.0) for car in (DAMPED_FULL, bodies))
    assert ((one - other).abs().max() <= 1e-12 * one.abs().max()).all()


places = st.floats(-6.0, -0.5)


def articulated(pin: float, trailer: float, axle: float, joints: list[Joint], **more) -> RigidBodies:
    """A tractor and a trailer, joined at a pin [m]."""
    corners = {"front": 1.4, "rear": -2.2, "trailer": axle}
    return RigidBodies(
        bodies=[
            RigidBody(mass=6e3, pitch_inertia=14e3, roll_inertia=5e3, position=(0.0, 0.05)),
            RigidBody(name="trailer", mass=15e3, pitch_inertia=9e4, roll_inertia=2e4, position=(trailer, 0.0)),
        ],
        wheels=[
            Wheel(name=f"{name}_{side}", position=(x, y), mass=400.0, tyre_stiffness=1.5e6)
            for name, x in corners.items() for side, y in {"left": 1.0, "right": -1.0}.items()
        ],
        suspensions=[
            Suspension(
                name=f"{name}_{side}", coefficients=name, upper="trailer" if name == "trailer" else "body"
            )
            for name in corners for side in ("left", "right")
        ],
        joints=joints,
        points=[
            BodyPoint(name="driver", position=(1.0, 0.5)),
            BodyPoint(name="load", body="trailer", position=(axle, 0.0)),
        ],
        **more,
    )  # fmt: skip


ARTICULATED = {"front": (4e5, 15e3), "rear": (8e5, 25e3), "trailer": (9e5, 3e4)}


@settings(max_examples=10)
@given(places, st.floats(-9.0, -4.0), st.floats(-12.0, -8.0), st.booleans())
def test_matrices_are_symmetric_and_static_loads_carry_the_weight(pin, trailer, axle, roll):
    vehicle = articulated(
        pin, trailer, axle, [Joint(lower="body", upper="trailer", position=(pin, 0.0), roll=roll)]
    )
    values = np.array([list(vehicle.coefficients(ARTICULATED).values())])
    stiffness, mass = vehicle.statics.stiffness_of(values)[0], vehicle.assembly.mass_matrix
    assert mass.shape == (12 - 1 - roll,) * 2
    for matrix in (stiffness, mass):
        np.testing.assert_allclose(matrix, matrix.T, rtol=1e-12, atol=1e-9 * abs(matrix).max())
        assert np.linalg.eigvalsh(matrix)[0] > 0
    loads = vehicle.statics.static_loads(values)[0]
    assert loads.sum() == pytest.approx(GRAVITY * (21e3 + 6 * 400.0), rel=1e-12)
    x, y = vehicle.contact_points.T  # moments about the origin, of forces in balance with the weights
    assert loads @ x == pytest.approx(GRAVITY * (15e3 * trailer + 400.0 * x.sum()), rel=1e-9)
    assert loads @ y == pytest.approx(GRAVITY * 6e3 * 0.05, rel=1e-9, abs=1e-6)


@pytest.mark.parametrize("roll", [False, True])
def test_a_joint_is_the_limit_of_a_stiff_spring(roll):
    """At 2 m to both sides of a fifth wheel the springs hold the roll too; the error falls with the stiffness."""
    joint = [Joint(lower="body", upper="trailer", position=(-1.8, 0.0), roll=roll)]
    exact = frequencies(articulated(-1.8, -7.0, -10.0, joint), ARTICULATED)
    errors = []
    for stiffness in (1e10, 1e11):
        sides = (2.0, -2.0) if roll else (0.0,)
        supports = [Support(lower="body", upper="trailer", position=(-1.8, y), stiffness=stiffness) for y in sides]
        held = frequencies(articulated(-1.8, -7.0, -10.0, [], supports=supports), ARTICULATED)
        errors.append(np.abs(held[: exact.size] / exact - 1).max())
    assert errors[0] < 3e-3
    assert errors[1] == pytest.approx(errors[0] / 10, rel=0.05)


def test_a_pin_without_force_cuts_the_truck():
    """A balanced trailer hangs on a massless pin that its weight does not load: two vehicles by themselves."""
    pin = -3.0
    joint = Joint(lower="body", upper="beam", position=(pin, 0.0))
    both = RigidBodies(
        bodies=[RigidBody(mass=1e3, pitch_inertia=1.5e3), RigidBody(name="beam", mass=0.0)],
        wheels=[
            Wheel(name=name, position=(x, 0.0), mass=50.0, tyre_stiffness=2e5)
            for name, x in {"a": 1.2, "b": -1.4}.items()
        ],
        suspensions=[Suspension(name="a"), Suspension(name="b")],
        joints=[joint],
    )  # fmt: skip
    alone = sc.HalfCar(
        body_mass=1e3, pitch_inertia=1.5e3, front_wheel_mass=50.0, rear_wheel_mass=50.0,
        front_tyre_stiffness=2e5, rear_tyre_stiffness=2e5, cg_to_front=1.2, cg_to_rear=1.4,
    )  # fmt: skip
    found = frequencies(both, {"a": (2e4, 1e3), "b": (2.2e4, 1e3)})
    np.testing.assert_allclose(found, frequencies(alone, {"front": (2e4, 1e3), "rear": (2.2e4, 1e3)}), rtol=1e-12)


def test_a_massless_walking_beam_shares_the_load():
    """A beam with arms of 0.6 and 0.7 m: tyre loads go as the other arm, and the spring carries both."""
    beam = RigidBodies(
        bodies=[
            RigidBody(mass=5e3),
            RigidBody(name="beam", mass=0.0, pitch_inertia=0.0, position=(0.0, 0.0)),
        ],
        wheels=[
            Wheel(name="first", position=(0.6, 0.0), mass=500.0, tyre_stiffness=1e6),
            Wheel(name="second", position=(-0.7, 0.0), mass=500.0, tyre_stiffness=1e6),
        ],
        suspensions=[Suspension(name="tandem", lower="beam")],
        joints=[
            Joint(lower="beam", upper="first_wheel", position=(0.6, 0.0)),
            Joint(lower="beam", upper="second_wheel", position=(-0.7, 0.0)),
        ],
    )
    assert beam.assembly.coordinates == ("body", "first_wheel", "second_wheel")
    loads = beam.statics.static_loads(np.array([[5e5, 1e4]]))[0]
    expected = GRAVITY * (500.0 + 5e3 * np.array([0.7, 0.6]) / 1.3)
    np.testing.assert_allclose(loads, expected, rtol=1e-12)
    k, a, b = 5e5, 0.7 / 1.3, 0.6 / 1.3
    p = np.array([1.0, -a, -b])
    stiffness = k * np.outer(p, p) + np.diag([0.0, 1e6, 1e6])
    squares = eigh(stiffness, np.diag([5e3, 500.0, 500.0]), eigvals_only=True)
    np.testing.assert_allclose(frequencies(beam, {"tandem": (5e5, 1e4)}), np.sqrt(squares) / 2 / np.pi, rtol=1e-9)


def test_off_centre_full_car():
    """Jazar's full car (Vehicle Dynamics, 2008) as in two public programs, its centre of gravity not midway.

    Frequencies worked out by numpy and scipy apart from this package.
    """
    printed = {
        (0.7, 0.75): [0.839216, 1.113826, 1.463380, 8.427188, 8.433388, 10.019027, 10.021885],
        (0.55, 0.9): [0.813566, 1.146764, 1.466138, 8.427166, 8.433503, 10.019015, 10.021942],
    }
    for (left, right), expected in printed.items():
        corners = {"front": (1.4, 53.0), "rear": (-1.47, 76.0)}
        car = RigidBodies(
            bodies=[RigidBody(mass=840.0, roll_inertia=820.0, pitch_inertia=1100.0)],
            wheels=[
                Wheel(name=f"{axle}_{side}", position=(x, y), mass=m, tyre_stiffness=2e5)
                for axle, (x, m) in corners.items() for side, y in {"left": left, "right": -right}.items()
            ],
            suspensions=[
                Suspension(name=f"{axle}_{side}", coefficients=axle)
                for axle in corners for side in ("left", "right")
            ],
        )  # fmt: skip
        found = frequencies(car, {"front": (1e4, 1.0), "rear": (1.3e4, 1.0)})
        np.testing.assert_allclose(found, expected, atol=5.1e-7)


def test_three_axles():
    """Places of github.com/herbertmartinsgomes/Road-Profile-Generation-by-ISO-8608; frequencies by scipy alone."""
    rows = {"one": (5.18, 6e5, 600.0, 2e6), "two": (-0.62, 9e5, 900.0, 4e6), "three": (-1.97, 9e5, 900.0, 4e6)}
    half = RigidBodies(
        bodies=[RigidBody(mass=18e3, pitch_inertia=90e3)],
        wheels=[Wheel(name=n, position=(x, 0.0), mass=m, tyre_stiffness=t) for n, (x, _, m, t) in rows.items()],
        suspensions=[Suspension(name=n) for n in rows],
    )
    found = frequencies(half, {name: (k, 1.0) for name, (_, k, *_) in rows.items()})
    np.testing.assert_allclose(found, [1.62776, 2.09053, 10.53818, 11.74492, 11.77099], atol=5.1e-6)


def test_a_seat_on_a_seat():
    """A head on a seat on the body; frequencies of four masses in a row by scipy alone."""
    car = sc.QuarterCar(body_mass=317.0, wheel_mass=45.0, tyre_stiffness=2e5)
    seat = sc.Seat(mass=50.0, spring=16e3, damper=800.0).on(car)
    head = sc.Seat(mass=30.0, spring=20e3, damper=500.0, name="head", stands_on="seat").on(seat)
    found = frequencies(head, {"spring": 2e4, "damper": 1500.0})
    np.testing.assert_allclose(found, [1.04384, 2.43065, 5.55473, 11.13489], atol=5.1e-6)


def solid_axles() -> RigidBodies:
    """A van with a solid rear axle, springs inside the track, and a cab seat of its own."""
    return RigidBodies(
        bodies=[
            RigidBody(mass=1800.0, pitch_inertia=4e3, roll_inertia=900.0),
            RigidBody(name="rear_axle", mass=140.0, roll_inertia=50.0, position=(-1.7, 0.0)),
        ],
        wheels=[
            Wheel(name="front_left", position=(1.3, 0.8), mass=45.0, tyre_stiffness=2.4e5),
            Wheel(name="front_right", position=(1.3, -0.8), mass=45.0, tyre_stiffness=2.4e5),
            Wheel(name="rear_left", position=(-1.7, 0.8), carrier="rear_axle", tyre_stiffness=2.6e5),
            Wheel(name="rear_right", position=(-1.7, -0.8), carrier="rear_axle", tyre_stiffness=2.6e5),
        ],
        suspensions=[
            Suspension(name="front_left", coefficients="front"),
            Suspension(name="front_right", coefficients="front"),
            Suspension(name="rear_left", coefficients="rear", position=(-1.7, 0.5)),
            Suspension(name="rear_right", coefficients="rear", position=(-1.7, -0.5)),
        ],
        anti_roll_bars=[AntiRollBar(name="rear_antiroll", struts=("rear_left", "rear_right"))],
    )


def test_springs_inside_the_track_of_a_solid_axle():
    """Roll stiffness of the axle's springs and its bar between them: k s^2/2 + bar; the tyres' k t^2/2."""
    van = solid_axles()
    values = np.array(
        [list(van.coefficients({"front": (3e4, 2e3), "rear": (4e4, 2e3), "rear_antiroll": 5e3}).values())]
    )
    k = van.statics.stiffness_of(values)[0]
    at = {name: i for i, name in enumerate(van.assembly.coordinates)}
    assert k[at["roll"], at["rear_axle_roll"]] == pytest.approx(-(4e4 * 1.0**2 / 2 + 5e3), rel=1e-12)
    assert k[at["rear_axle_roll"]][at["rear_axle_roll"]] == pytest.approx(
        4e4 / 2 + 5e3 + 2.6e5 * 1.6**2 / 2, rel=1e-12
    )
    assert van.coefficients({"front": (3e4, 2e3), "rear": (4e4, 2e3)})["rear_antiroll"] == 0.0


def test_a_vehicle_of_bodies_in_a_file(tmp_path):
    law = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=2e4, rebound=3e4))
    vehicle = articulated(
        -1.8, -7.0, -10.0, [Joint(lower="body", upper="trailer", position=(-1.8, 0.0), roll=True)]
    )
    first, *others = vehicle.suspensions
    vehicle = replace(vehicle, suspensions=[replace(first, strut=law), *others])
    vehicle = sc.Seat(mass=90.0, spring=2e4, damper=900.0, position=(1.0, 0.4)).on(vehicle)
    vehicle = sc.Payload(mass=4e3, position=(-1.0, 0.0), stands_on="trailer").on(vehicle)
    setting = {
        "front.spring": 4e5,
        "rear.spring": 8e5,
        "rear.damper": 2.5e4,
        "trailer.spring": 9e5,
        "trailer.damper": 3e4,
    }
    file = sc.VehicleFile(vehicle=vehicle, setting=setting, bounds={"rear.damper": (1e4, 5e4)}, name="Truck")
    sc.save_vehicle(tmp_path / "truck.toml", file)
    read = sc.load_vehicle(tmp_path / "truck.toml")
    assert read.vehicle == vehicle
    np.testing.assert_array_equal(read.vehicle.assembly.mass_matrix, vehicle.assembly.mass_matrix)
    assert (read.setting, read.bounds) == (file.setting, file.bounds)


def body(**more) -> dict:
    return {
        "bodies": [RigidBody(mass=1e3, pitch_inertia=1e3)],
        "wheels": [Wheel(name="a", mass=50.0, tyre_stiffness=2e5)],
        "suspensions": [Suspension(name="a")],
        **more,
    }


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: RigidBodies(**body(bodies=3)), "bodies must be a list of RigidBody, got 3"),
        (lambda: RigidBodies(**body(wheels=[])), "wheels must be one or more, got none"),
        (lambda: RigidBodies(**body(suspensions=[Suspension(name="b")])),
         "suspensions[1].lower must be given where no wheel has the name of the strut, got none"),
        (lambda: RigidBodies(**body(suspensions=[Suspension(name="a", upper="cab")])),
         "suspensions[1].upper must be one of body, a_wheel, ground, got 'cab'"),
        (lambda: RigidBodies(**body(points=[BodyPoint(name="a_wheel")])),
         "bodies, wheels and points must have names of their own, got 'a_wheel' twice"),
        (lambda: RigidBodies(**body(joints=[Joint(lower="body", upper="body")])),
         "joints must each hold a movement that is free, got (0.0, 0.0) and (0.0, 0.0)"),
        (lambda: RigidBodies(**body(joints=[Joint(lower="body", upper="a_wheel", roll=True)])),
         "joints[1].roll must be of two bodies that roll, got body, a_wheel"),
        (lambda: RigidBodies(**body(bodies=[RigidBody(mass=1e3), RigidBody(name="beam", mass=0.0)])),
         "bodies must have mass and inertia where no joint moves them, got 0 of beam"),
        (lambda: RigidBodies(**body(anti_roll_bars=[AntiRollBar(name="bar", struts=("a", "b"))])),
         "anti_roll_bars[1].struts must be one of a, got 'b'"),
        (lambda: sc.Seat(mass=60.0, spring=1e4, damper=500.0, stands_on="cab").on(HALF),
         "stands_on must be one of body, front_wheel, rear_wheel, got 'cab'"),
        (lambda: sc.Payload(mass=60.0, stands_on="cab").on(FULL).assembly,
         "stands_on must be one of body, front_left_wheel, front_right_wheel, rear_left_wheel, rear_right_wheel, "
         "got 'cab'"),
    ],
)  # fmt: skip
def test_rejects_parts_that_do_not_fit(make, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        make()


def test_struts_of_different_axles_that_share_a_force_law_have_working_points_of_their_own():
    """Sharing a curve between front and rear is the same as giving it to both."""
    law = sc.parallel(sc.Spring(), sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1))
    bodies = [RigidBody(mass=650.0, pitch_inertia=1200.0)]
    wheels = [
        Wheel(name=name, position=(x, 0.0), mass=40.0, tyre_stiffness=2e5)
        for name, x in {"front": 1.2, "rear": -1.5}.items()
    ]
    shared = RigidBodies(
        bodies=bodies,
        wheels=wheels,
        suspensions=[
            Suspension(name="front", coefficients="both", strut=law),
            Suspension(name="rear", coefficients="both"),
        ],
    )
    apart = replace(shared, suspensions=[Suspension(name=name, strut=law) for name in ("front", "rear")])
    rides = [
        sc.ride(vehicle, setting, ROAD, 20.0, band=(0.1, 20.0))["value"]
        for vehicle, setting in (
            (shared, {"both.spring": 2e4}),
            (apart, {"front.spring": 2e4, "rear.spring": 2e4}),
        )
    ]
    np.testing.assert_allclose(rides[0], rides[1], rtol=1e-8)


def test_a_truck_with_a_force_law_payload_and_seat_rides_and_drives():
    """A bilinear damper of equal slopes is a linear one: ride and motion agree, with a load on the trailer."""
    joint = [Joint(lower="body", upper="trailer", position=(-1.8, 0.0), roll=True)]
    linear = articulated(-1.8, -7.0, -10.0, joint)
    law = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=15e3, rebound=15e3))
    first, *others = linear.suspensions
    curved = replace(linear, suspensions=[replace(first, strut=law), *others])
    rest = {"rear": (8e5, 25e3), "trailer": (9e5, 3e4)}
    found = []
    for vehicle, setting in ((linear, {"front": (4e5, 15e3), **rest}), (curved, {"front.spring": 4e5, **rest})):
        seat = sc.Seat(mass=90.0, spring=2e4, damper=900.0, name="sitting", position=(1.0, 0.4)).on(vehicle)
        laden = sc.Payload(mass=2e3, position=(-1.0, 0.0), stands_on="trailer").on(seat)
        ride = sc.ride(laden, setting, ROAD, 20.0, band=(0.1, 20.0), measures=["ACC driver", "ACC sitting"])
        history = sc.simulate(laden, setting, sc.SpeedBump(height=0.05, length=2.0), 10.0)
        load = history["load_acceleration [m/s^2]"] - history["load_acceleration [m/s^2]"].iloc[0]
        time = np.linspace(0.0, 3.0, 301)
        found.append((ride["value"], np.interp(time, history["time [s]"], load)))
    np.testing.assert_allclose(found[1][0], found[0][0], rtol=1e-6)
    np.testing.assert_allclose(found[1][1], found[0][1], atol=2e-3 * np.abs(found[0][1]).max())


def test_peaks_of_a_truck_are_those_of_driving():
    """Within 0.1 %, as of any vehicle; tractor and trailer each over the bump in turn."""
    vehicle = articulated(
        -1.8, -7.0, -10.0, [Joint(lower="body", upper="trailer", position=(-1.8, 0.0), roll=True)]
    )
    bump, names = sc.SpeedBump(height=0.05, length=2.0), ["driver_acceleration", "load_acceleration"]
    measures = [f"peak {name} bump" for name in names]
    table = sc.ride(vehicle, ARTICULATED, ROAD, 10.0, measures=measures, events={"bump": bump})
    driven = sc.simulate(vehicle, ARTICULATED, bump, 10.0)
    for measure, name in zip(measures, names, strict=True):
        assert table["value"][measure] == pytest.approx(driven[f"{name} [m/s^2]"].abs().max(), rel=1e-3)


def test_travel_of_all_struts_counts_tandems_and_leaves_out_cabs_and_seats():
    """Struts on the beams of a tandem and a tridem, which have no wheel's name; a mount of a cab has its own."""
    file = sc.load_vehicle("cantero_2022_truck")
    assert file.vehicle.wheel_struts == file.vehicle.struts
    table = sc.ride(file.vehicle, file.setting, ROAD, 20.0, band=(0.1, 20.0), measures=["SWS", "SWS tandem"])
    travels = {name: table["value"][f"{name}_suspension_travel"] for name in file.vehicle.struts}
    assert table["value"]["SWS"] == pytest.approx(max(travels.values()), rel=1e-12)
    assert table["value"]["SWS tandem"] == pytest.approx(travels["tandem"], rel=1e-12)
    cab = sc.load_vehicle("trucksim_cab_over").vehicle
    with_seat = sc.Seat(mass=60.0, spring=1e4, damper=500.0, stands_on="front_axle").on(cab)
    assert with_seat.wheel_struts == tuple(name for name in cab.struts if not name.startswith("cab"))


def test_a_body_on_its_tyres_is_sprung_and_a_strut_on_a_road_is_that_of_a_wheel():
    """A tractor without springs, a cab on a mount, and a foot on its strut."""
    tractor = RigidBodies(
        bodies=[RigidBody(mass=3e3, pitch_inertia=3e3), RigidBody(name="cab", mass=300.0)],
        wheels=[
            Wheel(name="rear", position=(-1.0, 0.0), carrier="body", tyre_stiffness=4e5),
            Wheel(name="foot", position=(1.5, 0.0)),
        ],
        suspensions=[
            Suspension(name="mount", lower="body", upper="cab"),
            Suspension(name="spring", lower="foot_road", position=(1.5, 0.0)),
        ],
    )
    assert tractor.wheel_struts == ("spring",)
    assert tractor.assembly.sprung_mass == 3300.0


def test_travel_of_a_soft_tridem_is_the_largest():
    file = sc.load_vehicle("cantero_2022_truck")
    soft = {**file.setting, "tridem.spring": 2e5, "tridem.damper": 1e3}
    table = sc.ride(file.vehicle, soft, ROAD, 20.0, band=(0.1, 20.0), measures=["SWS"])["value"]
    assert table["SWS"] == pytest.approx(table["tridem_suspension_travel"], rel=1e-12)


def test_a_seat_in_a_cab_has_the_floor_of_the_cab_below_it():
    """Its acceleration over that of a point of the cab, both weighted with Wk."""
    file = sc.load_vehicle("trucksim_cab_over")
    points = [BodyPoint(name="below", body="cab", position=(0.5 + 0.3, 0.4))]
    seat = sc.Seat(mass=90.0, spring=2e4, damper=900.0, position=(0.3, 0.4), name="driver", stands_on="cab").on(
        replace(file.vehicle, points=points)
    )
    names = ["SEAT driver", "Wk driver_acceleration", "Wk below_acceleration"]
    factor, above, below = sc.ride(seat, file.setting, ROAD, 20.0, band=(0.1, 20.0), measures=names)["value"][:3]
    assert factor == pytest.approx(above / below, rel=1e-9)

"""Modes against printed frequencies, closed forms and python-control, and what they are called."""

from dataclasses import replace
from itertools import combinations

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from garage import BENDING, DRIVER, FULL, HALF, PASSENGER, QUARTER, ROAD, axle_struts, axles, masses, struts_of
from suspension_ctrl import (
    BilinearDamper,
    Damper,
    HalfCar,
    Inerter,
    QuarterCar,
    RigidBodies,
    Spring,
    load_vehicle,
    parallel,
    series,
)
from suspension_ctrl.vehicles.body_parts import RigidBody, Suspension, Wheel
from suspension_ctrl.vehicles.vehicle import Vehicle

FREQUENCY, DAMPED, RATIO = "frequency [Hz]", "damped frequency [Hz]", "damping ratio [-]"


def undamped(car: Vehicle, **springs: float) -> np.ndarray:
    """Frequencies [rad/s] of a vehicle with next to no damping."""
    table = car.modes({name: (spring, 1e-6) for name, spring in springs.items()})
    return 2 * np.pi * table[FREQUENCY].to_numpy()


def test_printed_frequencies_of_a_half_vehicle():
    """D. Cantero, "VEqMon2D", SoftwareX 19 (2022) 101103, validation of vehicle body 3, by Abaqus to five digits.

    The dampers are left out there, and here.
    """
    half = HalfCar(
        body_mass=20e3, pitch_inertia=10e3, front_wheel_mass=750.0, rear_wheel_mass=750.0,
        front_tyre_stiffness=3.5e6, rear_tyre_stiffness=3.5e6, cg_to_front=2.5, cg_to_rear=2.5,
    )  # fmt: skip
    np.testing.assert_allclose(
        undamped(half, front=1e6, rear=1e6) / (2 * np.pi), [1.4010, 4.8321, 12.351, 12.661], rtol=5e-5
    )


def test_printed_frequencies_of_bounce_and_pitch():
    """S. S. Rao, "Mechanical Vibrations", example of an automobile on springs alone: five digits.

    Wheels and tyres are none; 1 kg on 1e11 N/m makes 2e-7 of the springs' stiffness.
    """
    half = HalfCar(
        body_mass=1000.0, pitch_inertia=1000.0 * 0.9**2, front_wheel_mass=1.0, rear_wheel_mass=1.0,
        front_tyre_stiffness=1e11, rear_tyre_stiffness=1e11, cg_to_front=1.0, cg_to_rear=1.5,
    )  # fmt: skip
    table = half.modes({"front": (18e3, 1e-6), "rear": (22e3, 1e-6)})
    np.testing.assert_allclose(2 * np.pi * table[FREQUENCY][:2], [5.8593, 9.4341], rtol=1e-5)
    assert table["name"][:2].tolist() == ["heave", "pitch"]


def test_printed_frequencies_of_a_quarter_car():
    """D. C. Barton and J. D. Fieldhouse, "Automotive Chassis Engineering" (Springer), p. 209.

    They round the coefficients of the characteristic equation on the way, which leaves 0.1 %, and the result to
    half of its last digit.
    """
    table = QUARTER.modes({"spring": 22e3, "damper": 1e-6})
    np.testing.assert_allclose(2 * np.pi * table[FREQUENCY], [7.87, 68.73], rtol=1e-3, atol=0.005)
    assert table["name"].tolist() == ["heave", "wheel hop"]


@settings(max_examples=15)
@given(masses, axles(), axle_struts())
def test_frequencies_are_those_of_masses_and_springs(mass, axle, struts):
    half = HalfCar(body_mass=mass, pitch_inertia=1000.0, **axle)
    table, assembly = half.modes(struts), half.assembly
    values = np.array([list(half.coefficients(struts).values())])
    squares = eigh(half.statics.stiffness_of(values)[0], assembly.mass_matrix, eigvals_only=True)
    np.testing.assert_allclose(2 * np.pi * table[FREQUENCY], np.sqrt(squares), rtol=1e-9)
    without = half.modes({name: (spring, 0.0) for name, (spring, _) in struts.items()})
    np.testing.assert_allclose(without[FREQUENCY], table[FREQUENCY], rtol=1e-9)
    assert table["name"].is_unique


@settings(max_examples=15)
@given(masses, axles(), axle_struts())
def test_damped_frequencies_and_ratios_are_those_of_python_control(mass, axle, struts):
    """All poles appear once: a ratio below 1 with its damped frequency, or two real poles."""
    half = HalfCar(body_mass=mass, pitch_inertia=1000.0, **axle)
    _, ratio, poles = control.damp(half.closed(struts), doprint=False)
    table = half.modes(struts)
    swinging = table[table[DAMPED] > 0]
    upper = poles.imag > 0
    assert len(swinging) == np.count_nonzero(upper)
    np.testing.assert_allclose(2 * np.pi * np.sort(swinging[DAMPED]), np.sort(poles.imag[upper]), rtol=1e-7)
    np.testing.assert_allclose(np.sort(swinging[RATIO]), np.sort(ratio[upper]), rtol=1e-7)
    assert (table[RATIO][table[DAMPED] == 0] >= 1).all()
    assert len(table) == len(half.assembly.coordinates)


@pytest.mark.parametrize(
    ("front", "rear"),
    [((51.9e3, 7319.0), (19.3e3, 10159.0)), ((42.6e3, 9552.0), (15.5e3, 9727.0)), ((1e4, 1e4), (1e4, 2e4))],
)
def test_real_poles_of_two_modes_that_met_are_pairs_again(front, rear):
    """Dampers of several times the usual size: pairs of conjugates, and some pairing of all real poles."""
    half = HalfCar(
        body_mass=324.0, pitch_inertia=1199.0, front_wheel_mass=38.4, rear_wheel_mass=22.5,
        front_tyre_stiffness=2e5, rear_tyre_stiffness=228e3, cg_to_front=1.2, cg_to_rear=1.5,
    )  # fmt: skip
    struts = {"front": front, "rear": rear}
    table, poles = half.modes(struts), half.closed(struts).poles()
    swinging, upper = table[DAMPED] > 0, poles[poles.imag > 0]
    np.testing.assert_allclose(2 * np.pi * np.sort(table[DAMPED][swinging]), np.sort(upper.imag), rtol=1e-7)
    np.testing.assert_allclose(np.sort(table[RATIO][swinging]), np.sort(-upper.real / abs(upper)), rtol=1e-7)
    found, real = np.sort(table[RATIO][~swinging]), -poles.real[poles.imag == 0]
    pairings = [
        np.sort([(real[list(two)].sum()) / 2 / np.prod(real[list(two)]) ** 0.5 for two in pairs])
        for pairs in combinations(combinations(range(real.size), 2), real.size // 2)
        if len({i for two in pairs for i in two}) == real.size
    ]
    assert real.size >= 4
    assert any(np.allclose(found, one, rtol=1e-7) for one in pairings)


def test_modes_of_proportional_damping_keep_their_frequencies():
    """C = b K: ratios are b w/2, damped frequencies w (1 - ratio^2)^0.5, and beyond 1 two real poles."""
    b = 0.02
    car = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, tyre_damping=b * 2e5)
    for share in (0.5, 1.0):
        car = replace(car, tyre_damping=share * b * 2e5)
        table = car.modes((2e4, share * b * 2e4))
        omega = 2 * np.pi * table[FREQUENCY].to_numpy()
        ratio = share * b * omega / 2
        np.testing.assert_allclose(table[RATIO], ratio, rtol=1e-6)
        expected = omega * np.sqrt(np.maximum(1 - ratio**2, 0.0)) / (2 * np.pi)
        np.testing.assert_allclose(table[DAMPED], expected, rtol=1e-6, atol=1e-9)
        assert table["name"].tolist() == ["heave", "wheel hop"]


def test_printed_frequencies_of_a_saloon():
    """Numbers of github.com/dawsonc/commonroad-vehicle-models at 7be717a5, parameter set 2; by scipy alone."""
    file = load_vehicle("bmw_320i_full")
    expected = [1.4201, 1.4357, 2.3023, 11.8960, 11.9922, 12.0581, 12.3069]
    np.testing.assert_allclose(file.vehicle.modes(file.setting)[FREQUENCY], expected, atol=5.1e-5)
    car = load_vehicle("yuen_ramli_2010")
    np.testing.assert_allclose(car.vehicle.modes(car.setting)[FREQUENCY], [1.2539, 10.9353], atol=5.1e-5)


@settings(max_examples=25)
@given(masses, axles(), axle_struts(), st.sampled_from([0, 1, 2, 3]))
def test_shapes_solve_the_equations_of_free_motion(mass, axle, struts, which):
    """The largest amplitude is 1, and pole and shape leave no force: (M s^2 + C s + K) shape = 0."""
    half = HalfCar(body_mass=mass, pitch_inertia=1000.0, **axle)
    closed = half.closed(struts)
    shapes = half.modes(struts)[["body", "front_wheel", "rear_wheel", "pitch"]].to_numpy()
    shape = shapes[which % len(shapes)]
    assert np.abs(shape).max() == pytest.approx(1, rel=1e-12)
    errors = []
    for pole in closed.poles():
        state = np.ravel(np.column_stack([shape, pole * shape]))
        errors.append(np.abs(closed.A @ state - pole * state).max() / abs(pole) / np.abs(state).max())
    assert min(errors) < 1e-9


@settings(max_examples=20)
@given(masses, st.floats(5e3, 8e4))
def test_stiff_tyres_leave_the_body_on_its_springs(mass, spring):
    """sqrt(k/m) of heave and sqrt(k (a^2 + b^2)/J) of pitch where k a = k b; tyres 1e7 times as stiff."""
    half = HalfCar(
        body_mass=mass, pitch_inertia=1300.0, front_wheel_mass=30.0, rear_wheel_mass=30.0,
        front_tyre_stiffness=1e7 * spring, rear_tyre_stiffness=1e7 * spring, cg_to_front=1.4, cg_to_rear=1.4,
    )  # fmt: skip
    table = half.modes({"front": (spring, 1.0), "rear": (spring, 1.0)}).set_index("name")
    omega = 2 * np.pi * table[FREQUENCY]
    assert omega["heave"] == pytest.approx(np.sqrt(2 * spring / mass), rel=1e-6)
    assert omega["pitch"] == pytest.approx(np.sqrt(2 * spring * 1.4**2 / 1300.0), rel=1e-6)


def test_names():
    def names(car: Vehicle) -> list[str]:
        return sorted(car.modes(struts_of(car) | {"front": (2e4, 300.0), "rear": (2e4, 300.0)})["name"])

    body = ["heave", "pitch", "roll"]
    wheels = [f"{end} wheel {which}" for end in ("front", "rear") for which in ("hop", "tramp")]
    assert names(HALF) == ["front wheel hop", "heave", "pitch", "rear wheel hop"]
    assert names(FULL) == sorted([*body, *wheels])
    assert names(PASSENGER.on(DRIVER.on(FULL))) == sorted(
        ["heave", "pitch", "roll", "driver", "passenger", *wheels]
    )
    assert names(BENDING.on(FULL)) == sorted([*body, "bending 1", "bending 2", *wheels])


def test_a_tramping_axle_has_its_wheels_against_each_other():
    """An anti-roll bar stiffens tramp and leaves hop alone."""
    free, held = (
        FULL.modes({"front": (2e4, 300.0), "rear": (2e4, 300.0), "front_antiroll": bar}).set_index("name")
        for bar in (0.0, 3e4)
    )
    tramp, hop = (held.loc[f"front wheel {which}"] for which in ("tramp", "hop"))
    assert (tramp["front_left_wheel"] * np.conj(tramp["front_right_wheel"])).real < 0
    assert (hop["front_left_wheel"] * np.conj(hop["front_right_wheel"])).real > 0
    assert held[FREQUENCY]["front wheel hop"] == pytest.approx(free[FREQUENCY]["front wheel hop"], rel=1e-9)
    assert held[FREQUENCY]["front wheel tramp"] > 1.02 * free[FREQUENCY]["front wheel tramp"]


def test_an_overdamped_mode_keeps_its_row():
    """Heave on 2 kN/m and 5 kN s/m has two real poles: 0 Hz, and the ratio of their sum and product."""
    table = QUARTER.modes({"spring": 2e3, "damper": 5e3}).set_index("name")
    real = [pole.real for pole in QUARTER.closed(2e3, 5e3).poles() if pole.imag == 0]
    assert table[DAMPED]["heave"] == 0
    slow, fast = max(real), sorted(real)[0]
    assert table[RATIO]["heave"] == pytest.approx(-(slow + fast) / (2 * np.sqrt(slow * fast)), rel=1e-9)
    assert table[FREQUENCY]["heave"] == pytest.approx(QUARTER.modes((2e3, 0.0))[FREQUENCY][0], rel=1e-9)


def test_modes_of_several_bodies_have_names_of_their_own():
    bodies = [
        RigidBody(mass=6e3, pitch_inertia=1e4),
        RigidBody(name="cab", mass=1e3, pitch_inertia=8e2, position=(2.0, 0.0)),
    ]
    truck = RigidBodies(
        bodies=bodies,
        wheels=[
            Wheel(name=name, position=(x, 0.0), mass=600.0, tyre_stiffness=2e6)
            for name, x in {"a": 1.5, "b": -2.5}.items()
        ],
        suspensions=[
            *(Suspension(name=name) for name in "ab"),
            *(
                Suspension(name=name, lower="body", upper="cab", position=(x, 0.0), coefficients="mount")
                for name, x in {"front_mount": 3.0, "rear_mount": 1.0}.items()
            ),
        ],
    )  # fmt: skip
    table = truck.modes({"a": (4e5, 1e4), "b": (6e5, 2e4), "mount": (5e4, 2e3)})
    assert sorted(table["name"]) == ["a wheel hop", "b wheel hop", "cab heave", "cab pitch", "heave", "pitch"]


def test_an_inerter_in_series_has_a_mode_of_its_own():
    """Two masses and the inerter between spring and end: three frequencies of K and M written out."""
    strut = parallel(Spring(), Damper(), series(Inerter(), Spring("mount")))
    car = replace(QUARTER, strut=strut)
    k, c, b = 22e3, 2.5e5, 30.0
    stiffness = np.array([[k + 192e3, -k, 0.0], [-k, k, 0.0], [0.0, 0.0, 0.0]])
    row = np.array([0.0, 1.0, -1.0])  # the mount, from the body to the end between
    stiffness += c * np.outer(row, row)
    inert = np.array([1.0, 0.0, -1.0])
    mass = np.diag([45.4, 317.5, 0.0]) + b * np.outer(inert, inert)
    expected = np.sqrt(eigh(stiffness, mass, eigvals_only=True)) / (2 * np.pi)
    table = car.modes({"spring": k, "damper": 1500.0, "inerter": b, "mount": c})
    np.testing.assert_allclose(table[FREQUENCY], expected, rtol=1e-9)
    assert table["name"].is_unique


def test_a_vehicle_with_force_laws_has_modes_linearised_on_a_road():
    """A bilinear damper of equal slopes is linear; the refusal names the call."""
    law = replace(QUARTER, strut=parallel(Spring(), BilinearDamper(bump=1500.0, rebound=1500.0)))
    instead = r"as of vehicle.linearised\(setting, road, speed\), with a Zener element for rubber, got damper"
    for ask in (law.modes, law.closed):
        with pytest.raises(ValueError, match=f"^strut must be of springs, dampers and inerters alone, {instead}$"):
            ask({"spring": 22e3})
    found = law.linearised({"spring": 22e3}, ROAD, 20.0).modes()
    expected = QUARTER.modes({"spring": 22e3, "damper": 1500.0})
    assert found["name"].equals(expected["name"])
    np.testing.assert_allclose(found.iloc[:, 1:], expected.iloc[:, 1:], rtol=1e-6)


@pytest.mark.parametrize("damper", [2e3, 8e3, 20e3, 1e6])
def test_a_mode_meets_the_real_pole_of_a_damper_on_a_mount(damper):
    """They leave the real axis together, though it is of no mode; a damper of 1 MN s/m holds the mount fast."""
    body = {"body_mass": 400.0, "wheel_mass": 45.0, "tyre_stiffness": 220e3}
    mounted = QuarterCar(**body, strut=parallel(Spring(), series(Damper(), Spring("mount", 350e3))))
    values = {"spring": 10e3, "damper": damper}
    found, poles = mounted.modes(values), mounted.closed((10e3, damper)).poles()
    for f in found[DAMPED]:
        assert np.abs(np.abs(poles.imag) - 2 * np.pi * f).min() < 1e-6 * np.abs(poles).max()
    if damper == 1e6:
        expected = QuarterCar(**body).modes({"spring": 360e3, "damper": 0.0})
        np.testing.assert_allclose(found[DAMPED], expected[DAMPED], rtol=1e-3)

"""Modes against printed frequencies, closed forms and python-control, and what they are called."""

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage import BENDING, DRIVER, FULL, HALF, PASSENGER, QUARTER, axle_struts, axles, masses, struts_of
from suspension_ctrl import HalfCar
from suspension_ctrl.vehicles.vehicle import Vehicle

FREQUENCY, RATIO = "frequency [Hz]", "damping ratio [-]"


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


@settings(max_examples=25)
@given(masses, axles(), axle_struts())
def test_frequencies_and_damping_are_those_of_python_control(mass, axle, struts):
    half = HalfCar(body_mass=mass, pitch_inertia=1000.0, **axle)
    omega, ratio, poles = control.damp(half.closed(struts), doprint=False)
    table = half.modes(struts)
    assert len(table) == np.count_nonzero(poles.imag >= 0)
    np.testing.assert_allclose(2 * np.pi * table[FREQUENCY], np.sort(omega[poles.imag >= 0]), rtol=1e-9)
    np.testing.assert_allclose(np.sort(table[RATIO]), np.sort(ratio[poles.imag >= 0]), rtol=1e-9)
    assert table[FREQUENCY].is_monotonic_increasing


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


def test_what_does_not_swing_is_a_row_for_each_real_pole():
    """Heave on 2 kN/m and 5 kN s/m has two real poles and no frequency of its own."""
    table = QUARTER.modes({"spring": 2e3, "damper": 5e3})
    real = table[table[RATIO] == 1]
    poles = QUARTER.closed(2e3, 5e3).poles()
    expected = np.sort(-poles[poles.imag == 0].real) / (2 * np.pi)
    assert len(expected) >= 2
    np.testing.assert_allclose(real[FREQUENCY], expected, rtol=1e-9)

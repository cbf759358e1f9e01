"""Peaks by the padded event beside simulation, frequency responses and other designs in the same call."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from garage import DRIVER, FULL, HALF, QUARTER, struts_of
from suspension_ctrl.response.peaks import peaks

BUMP = sc.SpeedBump(height=0.05, length=2.0)
CASES = {
    "bump": (QUARTER, BUMP, 10.0, ["body_acceleration", "suspension_travel", "tyre_load", "body_jerk"]),
    "damped tyre": (replace(QUARTER, tyre_damping=150.0), BUMP, 4.0, ["body_acceleration", "tyre_load"]),
    "table": (QUARTER, sc.TrapezoidalBump(height=0.08, length=3.0, ramp=0.9), 8.0, ["strut_force", "tyre_load"]),
    "cleat": (HALF, sc.Cleat(height=0.02, length=0.025), 6.0, ["front_wheel_acceleration", "rear_strut_force"]),
    "step": (QUARTER, sc.Step(height=0.05), 10.0, ["body_displacement", "tyre_load"]),
    "ramp": (HALF, sc.Ramp(height=0.1, length=2.0), 5.0, ["pitch_velocity", "body_velocity"]),
    "waves": (DRIVER.on(HALF), sc.Sine(height=0.02, length=4.0, waves=3.0), 12.0, ["driver_acceleration"]),
    "sweep": (QUARTER, sc.Chirp(height=0.02, longest=9.0, shortest=1.0, waves=8.5), 12.0, ["suspension_travel"]),
    "pothole": (FULL, sc.Pothole(depth=0.06, length=0.5, side="left"), 12.0,
                ["front_left_tyre_load", "roll_velocity"]),
    "plank": (DRIVER.on(FULL), sc.Plank(height=0.03, length=0.3), 10.0, ["rear_right_suspension_travel_rate"]),
    "rig": (FULL, sc.RigChirp(motion="warp", amplitude=5e-3, lowest=0.5, highest=12.0, waves=12.0), 0.0,
            ["roll_acceleration", "front_left_suspension_travel"]),
}  # fmt: skip


def of_setting(vehicle, setting) -> np.ndarray:
    return np.array([list(vehicle.coefficients(setting).values())])


@pytest.mark.filterwarnings("ignore::suspension_ctrl.response.lift_off.LiftOffWarning")  # by the pothole
@pytest.mark.parametrize("name", CASES)
def test_peaks_are_those_of_simulation(name):
    """To 0.1 %."""
    vehicle, event, speed, responses = CASES[name]
    highest, lowest = peaks(vehicle, of_setting(vehicle, struts_of(vehicle)), event, speed, responses)
    history = sc.simulate(vehicle, struts_of(vehicle), event, speed, responses=responses)
    values = history[history.columns[-len(responses) :]].to_numpy()
    largest = np.abs(values).max(axis=0)
    assert (np.abs(highest[0] - values.max(axis=0)) < 1e-3 * largest).all()
    assert (np.abs(lowest[0] - values.min(axis=0)) < 1e-3 * largest).all()


def test_the_peak_of_steady_waves_is_the_frequency_response():
    names, f = ["body_acceleration", "tyre_load", "body_jerk"], 1.9
    rig = sc.RigSine(motion="heave", amplitude=0.01, frequency=f)
    highest, lowest = peaks(QUARTER, of_setting(QUARTER, (22e3, 1500.0)), rig, 0.0, names)
    expected = 0.01 * np.abs(QUARTER.closed(22e3, 1500.0, responses=names)(2j * np.pi * f)[:, 0])
    np.testing.assert_allclose(highest[0], expected, rtol=1e-3)
    np.testing.assert_allclose(-lowest[0], expected, rtol=1e-3)


@settings(max_examples=20, deadline=None)
@given(st.floats(8e3, 40e3), st.floats(400.0, 6e3))
def test_a_design_is_alone_in_any_population(spring, damper):
    """Bit by bit; slow decay takes a longer road behind the event for that design alone."""
    others = np.array([[15e3, 300.0], [30e3, 9e3], [22e3, 1500.0]])
    names = ["body_acceleration", "suspension_travel"]
    alone = peaks(QUARTER, np.array([[spring, damper]]), BUMP, 10.0, names)
    among = peaks(QUARTER, np.vstack([others, [[spring, damper]], others]), BUMP, 10.0, names)
    for one, all_ in zip(alone, among, strict=True):
        np.testing.assert_array_equal(one[0], all_[3])


def test_twice_the_height_is_twice_the_peak_and_a_pothole_a_plank_upside_down():
    designs, names = np.array([[22e3, 1500.0], [15e3, 900.0]]), ["tyre_load", "body_acceleration"]
    plank, deep = ({"height": h, "length": 0.4} for h in (0.02, 0.04))
    high, low = peaks(QUARTER, designs, sc.Plank(**plank), 8.0, names)
    higher, lower = peaks(QUARTER, designs, sc.Plank(**deep), 8.0, names)
    np.testing.assert_allclose([higher, lower], [2 * high, 2 * low], rtol=1e-9)
    below, above = peaks(QUARTER, designs, sc.Pothole(depth=0.02, length=0.4), 8.0, names)
    np.testing.assert_allclose([below, above], [-low, -high], rtol=1e-9)


def test_networks_have_peaks():
    strut = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount")))
    car = replace(QUARTER, strut=strut)
    names = ["body_acceleration", "suspension_travel"]
    found = peaks(car, of_setting(car, {"spring": 22e3, "damper": 1500.0, "mount": 150e3}), BUMP, 10.0, names)
    history = sc.simulate(car.closed(spring=22e3, damper=1500.0, mount=150e3, responses=names), BUMP, 10.0)
    for column, highest, lowest in zip(history.columns[2:], found[0][0], found[1][0], strict=True):
        assert highest == pytest.approx(history[column].max(), rel=1e-3)
        assert lowest == pytest.approx(history[column].min(), rel=1e-3)


def test_a_vehicle_that_never_comes_to_rest_is_named():
    with pytest.raises(ValueError, match=r"^response .*72 s.*'damper': 1.0"):
        peaks(QUARTER, np.array([[22e3, 1.0]]), BUMP, 10.0, ["body_acceleration"])

"""Driving over events beside profiles of the same shape, frequency responses, Runge and Kutta, other programs."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import suspension_ctrl as sc
from garage import DRIVER, FULL, HALF, QUARTER, struts_of

BUMP = sc.SpeedBump(height=0.05, length=2.0)


def test_a_car_over_a_raised_cosine_is_that_of_other_programs():
    """250 kg, 20 kg, 20 kN/m, 900 N s/m, tyre 140 kN/m, 50 mm by 2 m at 10 m/s: values of a coursework to 1e-4.

    github jubjamie/Half-Car-Model-Dynamics @5962518a; accelerations to 0.001 m/s^2, travels to 0.01 mm.
    """
    car = sc.QuarterCar(body_mass=250.0, wheel_mass=20.0, tyre_stiffness=140e3)
    history = sc.simulate(car, (20e3, 900.0), BUMP, 10.0)
    acceleration, travel = history["body_acceleration [m/s^2]"], 1e3 * history["suspension_travel [m]"]
    assert [acceleration.max(), acceleration.min()] == pytest.approx([4.685, -4.323], abs=1e-3)
    assert [travel.min(), travel.max()] == pytest.approx([-38.68, 31.93], abs=0.01)


@pytest.mark.parametrize("car", [QUARTER, replace(QUARTER, tyre_damping=150.0), DRIVER.on(HALF), FULL])
def test_an_event_is_a_profile_of_its_shape(car):
    """With 1 mm between points of the profile to 1e-3 of the largest response."""
    distance, tracks = np.arange(-5.0, 12.0, 1e-3), tuple(np.unique(car.contact_points[:, 1]).tolist())
    height = np.tile(BUMP.height_at(distance)[:, None], len(tracks))
    setting = struts_of(car)
    found = sc.simulate(car, setting, BUMP, 10.0)
    expected = sc.simulate(car, setting, sc.Profile(distance, height, tracks), 10.0)
    at = found["distance [m]"].to_numpy()
    inside = (at > -0.2) & (at < expected["distance [m]"].iloc[-1])
    for name in found.columns[2:]:
        other = np.interp(at[inside], expected["distance [m]"], expected[name])
        largest = max(np.abs(other).max(), 1e-9)  # roll is zero
        np.testing.assert_allclose(found[name][inside], other, rtol=0, atol=1e-3 * largest)


def test_a_steady_sine_is_the_frequency_response():
    frequency, speed, length = 1.7, 11.9, 7.0
    closed = FULL.closed(struts_of(FULL))
    x = FULL.contact_points[:, 0]
    late = np.exp(-2j * np.pi * frequency * (x.max() - x) / speed)
    at_road = {
        sc.Sine(height=0.01, length=length): late,
        sc.RigSine(motion="roll", amplitude=0.01, frequency=frequency): np.sign(FULL.contact_points[:, 1]),
    }
    for event, by_wheel in at_road.items():
        history = sc.simulate(FULL, struts_of(FULL), event, speed).drop(columns=["distance [m]"], errors="ignore")
        if isinstance(event, sc.RigSine):  # tracks differ between the axles
            by_wheel = by_wheel * np.abs(FULL.contact_points[:, 1]) / np.abs(FULL.contact_points[:, 1]).max()
        amplitude = 0.01 * np.abs(closed(2j * np.pi * frequency) @ by_wheel)
        for column, one in zip(history.columns[1:], amplitude, strict=True):
            assert np.ptp(history[column]) / 2 == pytest.approx(one, rel=3e-4, abs=1e-4 * amplitude.max()), column


def test_a_sweep_on_the_rig_is_that_of_runge_and_kutta():
    sweep = sc.RigChirp(motion="pitch", amplitude=0.004, lowest=0.5, highest=15.0, waves=15.5)
    history = sc.simulate(HALF, struts_of(HALF), sweep)
    assert "distance [m]" not in history
    closed, time = HALF.closed(struts_of(HALF)), history["time [s]"].to_numpy()

    def rate(t, x):
        return closed.A @ x + closed.B @ sweep.elevation(np.array([t]), HALF.contact_points, 0.0)[0]

    states = solve_ivp(rate, (0, time[-1]), np.zeros(closed.nstates), t_eval=time, rtol=1e-9, atol=1e-12).y
    expected = closed.C @ states + closed.D @ sweep.elevation(time, HALF.contact_points, 0.0).T
    for column, one in zip(history.columns[1:], expected, strict=True):
        np.testing.assert_allclose(history[column], one, rtol=0, atol=3e-4 * np.abs(one).max())


def test_a_vehicle_settles_at_the_level_of_a_step():
    names = ["body_displacement", "suspension_travel", "body_jerk"]
    history = sc.simulate(QUARTER, (22e3, 1500.0), sc.Step(height=0.04), 10.0, responses=names)
    assert list(history.columns[2:]) == ["body_displacement [m]", "suspension_travel [m]", "body_jerk [m/s^3]"]
    last = history.iloc[-1]
    assert last["body_displacement [m]"] == pytest.approx(0.04, rel=2e-3)
    assert abs(last["suspension_travel [m]"]) < 2e-3 * history["suspension_travel [m]"].abs().max()


def test_jerk_in_time_is_the_rate_of_the_acceleration():
    names = ["body_acceleration", "body_jerk"]
    history = sc.simulate(QUARTER, (22e3, 1500.0), BUMP, 8.0, responses=names)
    time, acceleration, jerk = (history[name].to_numpy() for name in history.columns[[0, 2, 3]])
    np.testing.assert_allclose(np.gradient(acceleration, time), jerk, rtol=0, atol=3e-3 * np.abs(jerk).max())


def test_an_obstacle_needs_a_speed():
    with pytest.raises(ValueError, match=r"^speed .*got 0"):
        sc.simulate(QUARTER, (22e3, 1500.0), BUMP)


RATES, FORCES = [0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 3.0], [0.0, 600.0, 850.0, 1250.0, 1450.0, 1750.0, 1750.0]
STRUTS = {
    "linear": (sc.Damper(value=900.0), (4.685, -4.323, -38.68, 31.93)),
    "bilinear": (sc.BilinearDamper(bump=600.0, rebound=1200.0), (4.106, -4.792, -40.00, 25.93)),
    "table": (sc.TableDamper(velocity=RATES, force=FORCES), (7.825, -8.889, -28.45, 35.78)),
    "stop": (
        sc.parallel(sc.Damper(value=900.0), sc.BumpStop(gap=0.02, stiffness=200e3)),
        (8.720, -6.362, -27.64, 49.44),
    ),
}


@pytest.mark.parametrize("name", STRUTS)
def test_a_car_with_force_laws_over_a_raised_cosine_is_that_of_scipy(name):
    """The same car; by scipy, the table with a constant force above 1 m/s: accelerations and travels to a digit.

    Laws of jubjamie/Half-Car-Model-Dynamics @5962518a, rhorvath02/VehicleDynamics @1b8c93d6 and drake#19236.
    """
    damper, expected = STRUTS[name]
    strut = sc.parallel(sc.Spring(value=20e3), damper)
    car = sc.QuarterCar(body_mass=250.0, wheel_mass=20.0, tyre_stiffness=140e3, strut=strut)
    history = sc.simulate(car, {}, BUMP, 10.0)
    acceleration, travel = history["body_acceleration [m/s^2]"], 1e3 * history["suspension_travel [m]"]
    assert [acceleration.max(), acceleration.min()] == pytest.approx(expected[:2], abs=1e-3)
    assert [travel.min(), travel.max()] == pytest.approx(expected[2:], abs=0.01)


def test_speed_may_change_over_an_event():
    """From 5 to 15 m/s in 6 s, the bump of 40 mm and 1.5 m after 20 m: by scipy, to a digit."""
    at_bump = np.sqrt(5.0**2 + 2 * 10.0 / 6.0 * 20.0)
    speed = [(0.0, at_bump), (6.0 - (at_bump - 5.0) / (10.0 / 6.0), 15.0)]
    history = sc.simulate(QUARTER, (22e3, 1500.0), sc.SpeedBump(height=0.04, length=1.5), speed)
    acceleration = history["body_acceleration [m/s^2]"]
    assert [acceleration.max(), acceleration.min()] == pytest.approx([5.701, -6.099], abs=2e-3)


def test_speed_may_change_along_a_profile():
    """The same bump by points 50 mm apart: straight pieces take 0.5 % of it away."""
    x = 0.05 * np.arange(1300)
    bump = sc.Profile(x, sc.SpeedBump(height=0.04, length=1.5).height_at(x - 20.0)[:, None])
    history = sc.simulate(QUARTER, (22e3, 1500.0), bump, [(0, 5), (6, 15)])
    acceleration = history["body_acceleration [m/s^2]"]
    assert [acceleration.max(), acceleration.min()] == pytest.approx([5.701, -6.099], rel=7e-3)
    other = sc.simulate(QUARTER.closed(22e3, 1500.0), bump, [(0, 5), (6, 15)])
    np.testing.assert_allclose(other, history, atol=1e-6 * np.abs(history).max().max())


BAD_SPEEDS = {
    "a number, or rows of time": ([5.0, 15.0], [[1.0, 5.0], [2.0, 6.0]], [[0.0, np.nan]]),
    "at ascending times": ([[0.0, 5.0], [0.0, 6.0]], [[0.0, -5.0], [1.0, 6.0]], [[0.0, 5.0], [1.0, 0.0]]),
}


@pytest.mark.parametrize(("key", "speed"), [(key, speed) for key, many in BAD_SPEEDS.items() for speed in many])
def test_speeds_that_cannot_be_driven_are_refused(key, speed):
    with pytest.raises(ValueError, match=rf"^speed must be {key}"):
        sc.simulate(QUARTER, (22e3, 1500.0), BUMP, speed)


def test_a_rig_and_a_steady_state_have_one_speed():
    rig = sc.RigSine(motion="heave", amplitude=0.01, frequency=1.0)
    for event in (rig, sc.Sine(height=0.01, length=5.0)):
        with pytest.raises(ValueError, match=r"^speed must be a number for a steady state or a rig"):
            sc.simulate(QUARTER, (22e3, 1500.0), event, [(0, 5), (6, 15)])


def test_a_start_is_that_of_a_profile():
    with pytest.raises(ValueError, match=r"^start must be None for a steady state and over an event"):
        sc.simulate(QUARTER, (22e3, 1500.0), BUMP, 10.0, start=0.1)


def test_a_jerk_with_force_laws_is_the_slope_of_the_acceleration():
    car = replace(QUARTER, strut=sc.parallel(sc.Spring(), sc.PowerDamper(force=1500.0, exponent=1.0)))
    names = ["body_jerk", "suspension_travel", "body_acceleration"]
    found = sc.simulate(car, {"spring": 22e3}, BUMP, 10.0, responses=names)
    expected = sc.simulate(QUARTER, (22e3, 1500.0), BUMP, 10.0, responses=names)
    assert list(found) == list(expected)
    at = found["time [s]"] < 1.0
    jerk = np.interp(found["time [s]"], expected["time [s]"], expected["body_jerk [m/s^3]"])
    np.testing.assert_allclose(found["body_jerk [m/s^3]"][at], jerk[at], atol=5e-3 * np.abs(jerk).max())

"""Peaks of vehicles with force laws beside simulation, `scipy`, linear struts and other designs."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import suspension_ctrl as sc
from garage import DAMPED_FULL, DRIVER, FULL, HALF, QUARTER, struts_of
from suspension_ctrl.response.driven_peaks import at_rest, driven_peaks
from suspension_ctrl.response.peaks import peaks

BUMP = sc.SpeedBump(height=0.05, length=2.0)
KNEE = sc.DigressiveDamper(low_speed=3000.0, high_speed=800.0, knee=0.15, rebound_over_bump=1.6)
STOPS = [sc.BumpStop(gap=0.02, stiffness=150e3), sc.ReboundStop(gap=0.015, stiffness=100e3)]
AXLE = sc.parallel(sc.Spring(value=21e3), KNEE, *STOPS)
STRAIGHT = sc.parallel(sc.Spring(), sc.TableDamper(velocity=[-1.0, 0.0, 1.0], force=[-1600.0, 0.0, 1600.0]))
MOUNTED = sc.parallel(sc.Spring(value=21e3), sc.series(KNEE, sc.Spring("mount", 200e3)), sc.Friction(force=150.0))


def with_axles(car, strut):
    """Return the car on struts of this kind."""
    names = ("strut",) if isinstance(car, sc.QuarterCar) else ("front_strut", "rear_strut")
    return replace(car, **dict.fromkeys(names, strut))


LAWS = {
    "stops": (with_axles(QUARTER, AXLE), BUMP, 10.0,
              ["body_acceleration", "suspension_travel", "tyre_load", "strut_force"]),
    "mounted": (with_axles(HALF, MOUNTED), sc.TrapezoidalBump(height=0.06, length=3.0, ramp=0.9), 8.0,
                ["pitch_acceleration", "front_suspension_travel", "rear_tyre_load"]),
    "full car": (with_axles(DAMPED_FULL, AXLE), BUMP, 6.0,
                 ["body_acceleration", "front_left_suspension_travel", "rear_right_tyre_load"]),
    "one side": (DRIVER.on(with_axles(FULL, AXLE)), sc.Plank(height=0.02, length=0.3, side="left"), 10.0,
                 ["driver_acceleration", "roll_acceleration", "front_left_suspension_travel"]),
    "step": (with_axles(QUARTER, AXLE), sc.Step(height=0.04), 10.0, ["body_displacement", "suspension_travel"]),
    "rig": (with_axles(HALF, AXLE),
            sc.RigChirp(motion="heave", amplitude=5e-3, lowest=1.0, highest=12.0, waves=12.0), 0.0,
            ["body_acceleration", "rear_suspension_travel"]),
}  # fmt: skip


def values_of(vehicle) -> np.ndarray:
    return np.array([list(vehicle.coefficients(struts_of(vehicle)).values())])


@pytest.mark.filterwarnings("ignore::suspension_ctrl.response.lift_off.LiftOffWarning")  # by the chirp
@pytest.mark.parametrize("name", LAWS)
def test_peaks_are_those_of_simulation(name):
    """To 0.1 %; simulation errs by 3e-8 a step, with rows at most 1 ms apart."""
    vehicle, event, speed, responses = LAWS[name]
    highest, lowest = peaks(vehicle, values_of(vehicle), event, speed, responses)
    history = sc.simulate(vehicle, struts_of(vehicle), event, speed, responses=responses)
    values = history[history.columns[-len(responses) :]].to_numpy()
    largest = np.abs(values).max(axis=0)
    assert (np.abs(highest[0] - values.max(axis=0)) < 1e-3 * largest).all()
    assert (np.abs(lowest[0] - values.min(axis=0)) < 1e-3 * largest).all()


def test_peaks_are_those_of_scipy():
    """To 0.1 %; the equations are written out here, the stops are struck."""
    m_b, m_w, k_t = QUARTER.body_mass, QUARTER.wheel_mass, QUARTER.tyre_stiffness

    def force(d: float, v: float) -> float:
        side = 1.6 if v > 0 else 1.0
        size = 3000.0 * min(abs(v), 0.15) + 800.0 * max(abs(v) - 0.15, 0.0)
        return 21e3 * d + side * np.sign(v) * size + 150e3 * min(d + 0.02, 0.0) + 100e3 * max(d - 0.015, 0.0)

    def load(t: float, z: np.ndarray) -> float:
        return k_t * (z[0] - (0.05 * np.sin(np.pi * 5 * t) ** 2 if t < 0.2 else 0.0))

    def motion(t: float, z: np.ndarray) -> list[float]:
        strut = force(z[2] - z[0], z[3] - z[1])
        return [z[1], (strut - load(t, z)) / m_w, z[3], -strut / m_b]

    time = np.linspace(0.0, 2.0, 8001)
    z = solve_ivp(motion, (0, 2), np.zeros(4), rtol=1e-9, atol=1e-11, t_eval=time, max_step=1e-3).y
    strut = np.array([force(d, v) for d, v in zip(z[2] - z[0], z[3] - z[1], strict=True)])
    expected = {"body_acceleration": -strut / m_b, "suspension_travel": z[2] - z[0], "strut_force": strut}
    assert (z[2] - z[0]).min() < -0.02
    assert (z[2] - z[0]).max() > 0.015
    vehicle = LAWS["stops"][0]
    highest, lowest = peaks(vehicle, values_of(vehicle), BUMP, 10.0, list(expected))
    for column, values in enumerate(expected.values()):
        assert highest[0, column] == pytest.approx(values.max(), rel=1e-3)
        assert lowest[0, column] == pytest.approx(values.min(), rel=1e-3)


def same_struts(vehicle) -> np.ndarray:
    """Return springs of 21 kN/m, dampers of 1600 N s/m and once the table of that slope."""
    values = {"spring": 21e3, "damper": 1600.0, "scale": 1.0}
    return np.array([[values.get(one.name.split(".")[-1], 0.0) for one in vehicle.strut_coefficients]])


@pytest.mark.parametrize(("car", "event"), [(QUARTER, BUMP), (FULL, sc.Step(height=0.05)), (DAMPED_FULL, BUMP)])
def test_straight_laws_have_the_peaks_of_linear_struts(car, event):
    """To 0.1 %, with a payload too: peaks count from rest."""
    car = sc.Payload(mass=120.0, position=(0.0, 0.0)).on(car)
    straight = replace(car, vehicle=with_axles(car.vehicle, STRAIGHT))
    names = [
        name for name in car.meanings if not (name.endswith("jerk") or "roll" in name)
    ]  # no roll but rounding
    expected, found = (peaks(one, same_struts(one), event, 8.0, names) for one in (car, straight))
    largest = np.maximum(*np.abs(expected))[0]
    for one, other in zip(found, expected, strict=True):
        assert (np.abs(one - other)[0] <= 1e-3 * largest).all()


def test_a_design_is_alone_in_any_population():
    """Bit by bit, whatever road behind the event the others need."""
    car = with_axles(QUARTER, sc.parallel(sc.Spring(), sc.BilinearDamper()))
    designs = np.array([[22e3, 800.0, 2000.0], [15e3, 150.0, 250.0], [30e3, 3e3, 9e3]])
    names = ["body_acceleration", "suspension_travel", "body_jerk"]
    together = peaks(car, designs, BUMP, 10.0, names)
    for p, design in enumerate(designs):
        for one, all_ in zip(peaks(car, design[None], BUMP, 10.0, names), together, strict=True):
            np.testing.assert_array_equal(one[0], all_[p])


def test_steady_waves_have_the_peaks_of_the_steady_state():
    """Of a simulated period, to 0.1 %: rebound pulls the body down."""
    car = with_axles(QUARTER, sc.parallel(sc.Spring(value=21e3), sc.BilinearDamper(bump=800.0, rebound=2400.0)))
    rig = sc.RigSine(motion="heave", amplitude=0.01, frequency=2.0)
    highest, lowest = peaks(car, values_of(car), rig, 0.0, ["suspension_travel"])
    travel = sc.simulate(car, {}, rig, responses=["suspension_travel"])["suspension_travel [m]"]
    assert [highest[0, 0], lowest[0, 0]] == pytest.approx([travel.max(), travel.min()], rel=1e-3)
    assert highest[0, 0] < -lowest[0, 0]


def test_a_jerk_is_the_largest_slope_between_rows():
    """Of an acceleration without kinks it is that of the linear car to 3 %."""
    car = with_axles(QUARTER, STRAIGHT)
    expected = peaks(QUARTER, np.array([[21e3, 1600.0]]), BUMP, 10.0, ["body_jerk"])
    found = peaks(car, np.array([[21e3, 1.0]]), BUMP, 10.0, ["body_jerk"])
    np.testing.assert_allclose(found, expected, rtol=0.03)


def test_a_vehicle_that_never_comes_to_rest_is_told():
    car = with_axles(QUARTER, sc.parallel(sc.Spring(), sc.BilinearDamper()))
    *_, rested = driven_peaks(car, np.array([[22e3, 1500.0, 1500.0], [22e3, 0.2, 0.2]]), BUMP, 10.0, ["tyre_load"])
    assert rested.tolist() == [True, False]
    with pytest.raises(ValueError, match=r"^response .*72 s.*'damper.bump': 0.2"):
        peaks(car, np.array([[22e3, 0.2, 0.2]]), BUMP, 10.0, ["body_acceleration"])


def test_struts_without_a_response_in_time_are_named():
    rubber = sc.Rubber("mount", storage=200e3, loss=20e3)
    car = with_axles(QUARTER, sc.parallel(sc.Spring(value=21e3), sc.series(KNEE, rubber)))
    with pytest.raises(ValueError, match=r"^struts .*response in time.*mount"):
        peaks(car, values_of(car), BUMP, 10.0, ["body_acceleration"])


@pytest.mark.parametrize("inerter", [0.0, 30.0])
def test_a_laden_vehicle_stands_still_on_level_ground(inerter):
    """The weight of a payload compresses springs and tyres; with an inerter beside the law too nothing moves."""
    beside = [sc.Inerter(value=inerter)] if inerter else []
    strut = sc.parallel(sc.Spring(), sc.TableDamper(velocity=[0.0, 1.0], force=[0.0, 1e3]), *beside)
    car = sc.HalfCar(
        body_mass=950.0, pitch_inertia=1500.0, front_wheel_mass=38.0, rear_wheel_mass=42.0,
        front_tyre_stiffness=210e3, rear_tyre_stiffness=220e3, cg_to_front=1.3, cg_to_rear=1.6,
        front_strut=strut, rear_strut=strut,
    )  # fmt: skip
    laden = sc.Payload(mass=250.0, position=(-1.0, 0.0)).on(car)
    moving = ["body_acceleration", "pitch_acceleration", "rear_wheel_acceleration", ("acceleration", 1.0, 0.0)]
    setting = {"front.spring": 25e3, "rear.spring": 30e3}
    rest = at_rest(laden, setting, [*moving, "rear_suspension_travel", "rear_tyre_load"], False)
    load = 250.0 * 9.80665 * 2.3 / 2.9  # of the rear axle
    np.testing.assert_allclose(rest, [0.0, 0.0, 0.0, 0.0, -load / 30e3, -load], rtol=1e-9, atol=1e-9)
    history = sc.simulate(laden, setting, sc.Step(height=0.04), 5.0)
    assert abs(history["body_acceleration [m/s^2]"].iloc[0]) < 1e-9
    assert not at_rest(car, setting, moving, False).any()

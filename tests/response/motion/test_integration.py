"""Integrated responses of linear vehicles beside the exact ones, and their steady state."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import suspension_ctrl as sc
from garage import DAMPED_FULL, FULL, HALF, QUARTER, struts_of
from suspension_ctrl.response.motion.courses import Passage
from suspension_ctrl.response.motion.drivable import motion_of
from suspension_ctrl.response.motion.integration import responses_in_time

ROAD = sc.Iso8608Road("A")
NETWORK = sc.parallel(
    sc.Spring(value=2e4),
    sc.series(sc.Damper(value=1500.0), sc.Spring("mount", 2e5), installation_ratio=0.9),
    sc.series(sc.Inerter(value=20.0), sc.parallel(sc.Damper("bush", 2e3), sc.Spring("bush_spring", 3e4))),
    sc.series(sc.Spring("one", 1e4), sc.Spring("two", 3e4)),
)
VEHICLES = {
    "quarter": QUARTER,
    "half": HALF,
    "full": FULL,
    "full, damped tyres": DAMPED_FULL,
    "network": replace(QUARTER, strut=NETWORK),
    "networks": replace(FULL, front_strut=NETWORK, rear_strut=NETWORK),
}


def profile_for(vehicle, length: float) -> sc.Profile:
    return ROAD.profile(length, 0.1, 1, tuple(np.unique(vehicle.contact_points[:, 1]).tolist()))


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("name", VEHICLES)
def test_linear_vehicles_are_driven_exactly_to_1e_6(name, periodic):
    """On a road so smooth that no tyre lifts off; before the first point the exact road is level."""
    vehicle = VEHICLES[name]
    profile, setting = profile_for(vehicle, 51.2), struts_of(vehicle)
    expected = sc.simulate(vehicle, setting, profile, 20.0, periodic=periodic)
    found = sc.simulate(vehicle, setting, profile, 20.0, periodic=periodic, lift_off=True)
    assert list(found) == list(expected)
    size = np.abs(expected).max()
    error = (np.abs(found - expected) / size).iloc[slice(None) if periodic else slice(1, -1)].max()
    assert error.max() < (1e-4 if periodic else 1e-6)


def test_a_start_on_a_level_road_is_exact_too():
    """30 mm above the road: values of another program, github Zach-K408/spring_damper_optimization @e3084bc8."""
    car = sc.QuarterCar(body_mass=500.0, wheel_mass=30.0, tyre_stiffness=200e3)
    road = sc.Profile(0.005 * np.arange(8000), np.full((8000, 1), -0.03))
    history = sc.simulate(car, (9e3, 980.0), road, 10.0, start=0.0)
    acceleration, travel = history["body_acceleration [m/s^2]"], 1e3 * history["suspension_travel [m]"]
    assert [acceleration.min(), acceleration.max()] == pytest.approx([-3.876, 1.525], abs=1e-3)
    assert [travel.min(), travel.max()] == pytest.approx([-15.91, 42.58], abs=0.01)
    on_road = sc.simulate(replace(car, wheel_mass=200.0), (9e3, 980.0), road, 10.0, start=-0.02)
    lifting = sc.simulate(replace(car, wheel_mass=200.0), (9e3, 980.0), road, 10.0, start=-0.02, lift_off=True)
    np.testing.assert_allclose(lifting, on_road, rtol=0, atol=1e-6 * np.abs(on_road).max().max())


def test_a_steady_state_recurs_with_force_laws_too():
    """Driven on from its end, the car repeats itself; mean travel is that of a bilinear damper."""
    strut = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=750.0, rebound=2250.0))
    car, profile = replace(QUARTER, strut=strut), profile_for(QUARTER, 204.8)
    one = sc.simulate(car, {"spring": 22e3}, profile, 20.0, periodic=True)
    twice = sc.Profile(0.1 * np.arange(4096), np.vstack([profile.height] * 2))
    other = sc.simulate(car, {"spring": 22e3}, twice, 20.0).iloc[2048:4096]
    for name in list(one)[2:]:
        np.testing.assert_allclose(other[name], one[name], rtol=0, atol=1e-4 * np.abs(one[name]).max())
    assert one["suspension_travel [m]"].mean() < 0


def test_struts_that_hold_nothing_are_refused():
    car = replace(QUARTER, strut=sc.TableDamper(velocity=[0.0, 1.0], force=[0.0, 1e3]))
    laden = sc.Payload(mass=10.0).on(car)
    with pytest.raises(ValueError, match=r"^struts must have a spring that carries the vehicle, got none$"):
        sc.simulate(laden, {}, profile_for(car, 51.2), 20.0)


curves = st.lists(st.floats(50.0, 2e4), min_size=3, max_size=8)
SPEED_KNOTS = np.array([-2.0, -0.6, -0.3, -0.1, -0.03, 0.0, 0.02, 0.1, 0.25, 0.5, 1.0, 3.0])


def car_with_tables(slopes: list[float], stop: float) -> sc.HalfCar:
    """Tables with these slopes [N s/m] in turn, a bump stop [N/m], and friction in front."""
    cycle = np.resize(slopes, SPEED_KNOTS.size - 1)
    force = np.concatenate([[0.0], np.cumsum(cycle * np.diff(SPEED_KNOTS))])
    table = sc.TableDamper(velocity=SPEED_KNOTS.tolist(), force=(force - force[5]).tolist())
    stop_ = sc.BumpStop(gap=0.01, stiffness=stop)
    front = sc.parallel(sc.Spring(value=2e4), table, stop_, sc.Friction(force=60.0))
    rear = sc.parallel(sc.Spring(value=2e4), sc.series(table, sc.Spring("mount", 3e5)), stop_)
    return replace(HALF, front_strut=front, rear_strut=rear)


@settings(max_examples=15, deadline=None)
@given(slopes=curves, stop=st.floats(1e4, 4e5), seed=st.integers(0, 99), road=st.sampled_from("ACE"))
def test_errors_follow_the_tolerance_for_any_tables(slopes, stop, seed, road):
    """By the largest value of each response: 12 tolerances at most in 560 cars and roads, 100 are allowed."""
    car, profile = car_with_tables(slopes, stop), sc.Iso8608Road(road).profile(40.0, 0.1, seed)
    motion = motion_of(car, car.coefficients({}))
    passage = Passage.over_profile(profile, car.contact_points, np.array([[0.0, 20.0]]), periodic=False)
    exact = responses_in_time(motion, passage.course, passage.time, tolerance=1e-12)
    for tolerance in (1e-3, 1e-4, 1e-6, 1e-8):
        found = responses_in_time(motion, passage.course, passage.time, tolerance=tolerance)
        error = (np.abs(found - exact) / np.abs(exact).max(axis=0)).max()
        assert error < 100 * tolerance

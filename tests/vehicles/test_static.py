"""The static position by weights over springs, by name."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, HALF, QUARTER
from suspension_ctrl.vehicles import body_parts

GRAVITY = 9.80665


def test_a_quarter_car_sinks_by_its_weights_over_the_springs():
    table = QUARTER.static((22e3, 1500.0))
    body, wheel = 317.5 * GRAVITY, 45.4 * GRAVITY
    expected = {
        "wheel_load": body + wheel,
        "tyre_deflection": -(body + wheel) / 192e3,
        "deflection": -body / 22e3,
        "wheel_displacement": -(body + wheel) / 192e3,
        "body_displacement": -(body + wheel) / 192e3 - body / 22e3,
    }
    assert table["value"].to_dict() == pytest.approx(expected, rel=1e-12)
    assert table["unit"].to_dict() == {name: "N" if name == "wheel_load" else "m" for name in expected}


def test_wheel_loads_are_those_of_the_levers():
    value = HALF.static(front=(2e4, 1e3), rear=(2e4, 1e3))["value"]
    assert value["front_wheel_load"] == pytest.approx(GRAVITY * (650.0 * 1.5 / 2.7 + 40.0), rel=1e-12)
    assert value["rear_wheel_load"] == pytest.approx(GRAVITY * (650.0 * 1.2 / 2.7 + 45.0), rel=1e-12)


def test_a_payload_lowers_the_ride_height():
    """The changes of the wheel loads are in balance with the load, moments too."""
    setting = {"front": (2e4, 1e3), "rear": (2e4, 1e3)}
    laden = sc.Payload(mass=100.0, position=(0.2, 0.1)).on(FULL)
    before, after = FULL.static(setting)["value"], laden.static(setting)["value"]
    change = after - before
    loads = change[[name for name in change.index if name.endswith("wheel_load")]]
    assert loads.sum() == pytest.approx(100.0 * GRAVITY, rel=1e-9)
    places = FULL.contact_points
    np.testing.assert_allclose(loads.to_numpy() @ places, 100.0 * GRAVITY * np.array([0.2, 0.1]), rtol=1e-9)
    assert change["body_displacement"] < 0
    assert change["roll_displacement"] < 0 < change["pitch_displacement"]  # to the left and forward: down there
    assert after.index.tolist() == before.index.tolist()


@pytest.mark.parametrize("mass", [30.0, 300.0])
def test_a_payload_moves_a_bilinear_spring_along_its_curve(mass):
    """Softer by half beyond 10 mm of compression, for 20 kN/m: down to there a load of 200 N."""
    spring = sc.TableSpring(deflection=[-0.11, -0.01, 0.01], force=[-1200.0, -200.0, 200.0])
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=sc.parallel(spring, sc.Damper(value=1e3))
    )
    value, weight = sc.Payload(mass=mass).on(car).static({})["value"], mass * GRAVITY
    beyond = max(weight - 200.0, 0.0)
    compression = 300.0 * GRAVITY / 20e3 + (weight - beyond) / 20e3 + beyond / 10e3
    assert value["deflection"] == pytest.approx(-compression, rel=1e-9)
    assert value["wheel_load"] == pytest.approx((340.0 + mass) * GRAVITY, rel=1e-9)
    assert value["tyre_deflection"] == pytest.approx(-(340.0 + mass) * GRAVITY / 2e5, rel=1e-9)


TOP = sc.TableSpring("top", deflection=[-0.01, 0.0, 0.01], force=[-3e3, 0.0, 1e3])
STOPS = sc.parallel(
    sc.Spring(value=2e4, installation_ratio=0.9),
    sc.series(TOP, sc.Damper(value=1.5e3)),
    sc.series(sc.BumpStop(gap=0.01, stiffness=2e5), sc.Spring("mount", 3e5)),
    sc.ReboundStop(gap=0.002, stiffness=1e5),
)  # fmt: skip


@pytest.mark.parametrize(("mass", "place"), [(60.0, (0.3, 0.2)), (400.0, (-1.0, 0.5)), (900.0, (-2.5, 0.0))])
def test_the_static_position_is_that_from_which_driving_begins(mass, place):
    """With stops at both ends: of the light corner in extension, of the heavy one in compression."""
    car = replace(FULL, front_strut=STOPS, rear_strut=STOPS)
    laden = sc.Payload(mass=mass, position=place).on(car)
    change = laden.static({})["value"] - car.static({})["value"]
    responses = [name for name in laden.meanings if name.endswith(("displacement", "travel", "tyre_load"))]
    bump = sc.SpeedBump(height=1e-4, length=1.0)  # behind a level stretch
    start = sc.simulate(laden, {}, bump, 10.0, responses=responses).iloc[0]
    for column, value in start.items():
        name = column.split(" ")[0].replace("suspension_travel", "deflection")
        if name.endswith("tyre_load"):
            assert -change[name.replace("tyre_load", "wheel_load")] == pytest.approx(value, rel=1e-6)
        elif name in change:
            assert change[name] == pytest.approx(value, rel=1e-6, abs=1e-9)


def test_a_strut_with_a_law_on_the_road_bears_its_wheel_load():
    """One mass on a strut without a tyre: the load is all that weighs."""
    strut = sc.parallel(sc.Spring(value=2e4), sc.Damper(value=1e3), sc.BumpStop(gap=0.01, stiffness=2e5))
    car = sc.RigidBodies(
        bodies=[body_parts.RigidBody(mass=300.0)],
        wheels=[body_parts.Wheel(name="foot")],
        suspensions=[body_parts.Suspension(name="foot", lower="foot_road", strut=strut)],
    )
    value = sc.Payload(mass=100.0).on(car).static({})["value"]
    assert value["foot_wheel_load"] == pytest.approx(400.0 * GRAVITY, rel=1e-9)
    depth = 0.01 + (100.0 * GRAVITY - 200.0) / 2.2e5
    assert value["foot_deflection"] == pytest.approx(-300.0 * GRAVITY / 2e4 - depth, rel=1e-9)


@pytest.mark.parametrize("compression", [1e-9, 1e-4, 0.005])
def test_a_stop_out_of_reach_in_series_holds_nothing(compression):
    """In its gap no force at all, where a sum of the slopes of its curve leaves 1e-17 of rounding."""
    stop = sc.series(sc.BumpStop(gap=0.0054, stiffness=9346.0), sc.Spring("mount", 1e5))
    values = {one.name: one.default for one in stop.coefficients}
    assert stop.static_tension(values, -compression) == 0
    assert stop.static_tension(values, 0.01) == 0
    depth = 0.1 - 0.0054  # of stop and mount in series
    assert stop.static_tension(values, -0.1) == pytest.approx(-depth / (1 / 9346.0 + 1e-5), rel=1e-9)


def test_symmetric_loads_leave_no_roll():
    value = FULL.static({"front": (2e4, 1e3), "rear": (2e4, 1e3)})["value"]
    assert value["roll_displacement"] == 0


def test_a_plant_has_no_static_position():
    with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links for static loads"):
        sc.Plant(QUARTER.plant()).static({"spring": 1.0, "damper": 1.0})

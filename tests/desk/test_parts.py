"""Parts of struts: names, kinds, pieces, ratios and values."""

import pytest

from garage import FULL
from suspension_ctrl import BumpStop, Damper, DigressiveDamper, QuarterCar, Spring, load_vehicle, parallel, series
from suspension_ctrl.desk.parts import parts_of

SETTING = {"front": (21e3, 1500.0), "rear": (23e3, 1600.0), "front_antiroll": 12e3}


def test_a_full_car_has_two_of_each_and_a_bar_by_axle():
    parts = {one.name: one for one in parts_of(FULL, FULL.coefficients(SETTING))}
    assert list(parts) == [
        "front.spring",
        "front.damper",
        "rear.spring",
        "rear.damper",
        "front_antiroll",
        "rear_antiroll",
    ]
    assert (parts["front.spring"].kind, parts["front.spring"].pieces) == ("spring", 2)
    assert parts["rear.damper"].values == (("rear.damper", 1600.0, "N s/m"),)
    bar = parts["front_antiroll"]
    assert (bar.kind, bar.pieces, bar.ratio) == ("anti-roll bar", 1, None)


def test_ratios_multiply_and_parts_in_series_have_none():
    inner = parallel(Spring(installation_ratio=0.9), DigressiveDamper(low_speed=4e3, high_speed=900.0, knee=0.1))
    strut = parallel(inner, series(Damper("second", 800.0), Spring("mount", 2e5)), installation_ratio=0.8)
    car = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=strut)
    parts = {one.name: one for one in parts_of(car, car.coefficients({"spring": 30e3}))}
    assert parts["spring"].ratio == pytest.approx(0.72)
    assert parts["damper"].ratio == pytest.approx(0.8)
    assert parts["second"].ratio is parts["mount"].ratio is None
    assert parts["damper"].kind == "digressive damper"
    assert [one.name for one in parts["damper"].values] == [
        f"damper.{name}" for name in ("low_speed", "high_speed", "knee", "rebound_over_bump")
    ]


def test_a_strut_of_one_element_has_its_ratio():
    strut = Spring(installation_ratio=0.8)
    car = QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, strut=strut)
    (spring,) = parts_of(car, {"spring": 20e3})
    assert (spring.pieces, spring.ratio) == (1, pytest.approx(0.8))


def test_tables_and_stops_are_parts_with_their_laws():
    car = load_vehicle("volvo_xc90_full")
    parts = {one.name: one for one in parts_of(car.vehicle, car.vehicle.coefficients(car.setting))}
    assert parts["front.damper"].kind == "table damper"
    assert isinstance(parts["rear.bump_stop"].law, BumpStop)
    assert parts["rear.bump_stop"].pieces == 2

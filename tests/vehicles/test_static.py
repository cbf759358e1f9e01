"""The static position by weights over springs, by name."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import FULL, HALF, QUARTER

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
    assert after.index.tolist() == before.index.tolist()


def test_a_plant_has_no_static_position():
    with pytest.raises(ValueError, match=r"^vehicle must be one of masses and links for static loads"):
        sc.Plant(QUARTER.plant()).static({"spring": 1.0, "damper": 1.0})

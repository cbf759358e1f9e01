"""Spring rates and wheel rates of elements."""

from dataclasses import replace

import pytest

import suspension_ctrl as sc
from garage import DRIVER, FULL, QUARTER
from suspension_ctrl.vehicles.rates import rates_of


def rates(vehicle, setting=None) -> dict[str, list[float]]:
    table = rates_of(vehicle, vehicle.coefficients(setting))
    assert list(table) == ["name", "spring rate [N/m]", "wheel rate [N/m]"]
    return table.set_index("name").T.to_dict("list")


def test_the_wheel_rate_is_the_spring_rate_times_the_square_of_the_ratio():
    """Also of an element within another: the ratios multiply; the force at the wheel says so too."""
    mount = sc.series(sc.Damper(), sc.Spring("mount", 200e3, installation_ratio=0.5), installation_ratio=0.9)
    car = replace(QUARTER, strut=sc.parallel(sc.Spring(installation_ratio=0.8), mount, installation_ratio=0.7))
    setting = {"spring": 60e3, "damper": 1500.0}
    assert rates(car, setting) == {
        "spring": pytest.approx([60e3, 60e3 * (0.8 * 0.7) ** 2]),
        "mount": pytest.approx([200e3, 200e3 * (0.5 * 0.9 * 0.7) ** 2]),
    }
    alone = replace(
        QUARTER, strut=sc.parallel(sc.Spring(installation_ratio=0.8), sc.Damper(), installation_ratio=0.7)
    )
    force = alone.closed(setting, responses=["strut_force", "suspension_travel"])(1e-3j)[:, 0]
    assert rates(alone, setting)["spring"][1] == pytest.approx((force[0] / force[1]).real, rel=1e-6)


def test_axles_and_seats_have_rates_and_a_bar_has_none():
    setting = {"front": (20e3, 1500.0), "rear": (24e3, 1500.0), "front_antiroll": 5e3}
    assert rates(DRIVER.on(FULL), setting) == {
        "front.spring": [20e3, 20e3], "rear.spring": [24e3, 24e3], "driver.spring": [12e3, 12e3],
    }  # fmt: skip


def test_a_force_law_has_its_slope_and_a_stop_out_of_reach_none():
    table = sc.TableSpring(deflection=[-0.1, 0.0, 0.1], force=[-2500.0, 0.0, 2000.0], installation_ratio=0.9)
    car = replace(QUARTER, strut=sc.parallel(table, sc.Damper(value=1500.0), sc.BumpStop(gap=0.05, stiffness=1e5)))
    (name, (spring, wheel)), *others = rates(car).items()
    assert not others
    assert name == "spring"
    assert 20e3 <= spring <= 25e3
    assert wheel == pytest.approx(0.81 * spring)
    linear = car.linearised({}, sc.Iso8608Road("C"), 20.0)
    assert rates(linear)["spring"][0] == pytest.approx(linear.laws["spring"].equivalent)

"""Ride frequencies and damping ratios in place of rates, against closed forms of the quarter car."""

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage import DRIVER, FULL, HALF, QUARTER, ROAD
from suspension_ctrl import (
    BilinearDamper,
    Damper,
    Friction,
    Payload,
    RideProblem,
    RigidBodies,
    Spring,
    load_vehicle,
    parallel,
    series,
)
from suspension_ctrl.vehicles.body_parts import RigidBody, Suspension, Wheel
from suspension_ctrl.vehicles.frequencies import corners_of, derived_of

ride_frequencies, ratios, hops = st.floats(0.6, 1.5), st.floats(0.05, 1.5), st.floats(10.5, 15.0)


@given(ride_frequencies, ratios)
def test_spring_and_tyre_in_series_carry_the_body_at_the_ride_frequency(f, ratio):
    """To rounding."""
    values = QUARTER.coefficients({"ride_frequency": f, "damping_ratio": ratio})
    spring, damper = values["spring"], values["damper"]
    both = 1 / (1 / spring + 1 / QUARTER.tyre_stiffness)
    assert sqrt(both / QUARTER.body_mass) / (2 * pi) == pytest.approx(f, rel=1e-12)
    assert damper == pytest.approx(2 * ratio * sqrt(spring * QUARTER.body_mass), rel=1e-12)


@given(ride_frequencies, hops)
def test_the_wheel_hops_between_spring_and_tyre(f, hop):
    """To rounding: the tyre by itself, and with the spring of a ride frequency by a root."""
    car, values = QUARTER.at({"wheel_hop_frequency": hop, "ride_frequency": f, "damper": 1500.0})
    total, tyre = QUARTER.wheel_mass * (2 * pi * hop) ** 2, car.variables["tyre_stiffness"].default
    assert values["spring"] + tyre == pytest.approx(total, rel=1e-12)
    assert 1 / (1 / values["spring"] + 1 / tyre) == pytest.approx(QUARTER.body_mass * (2 * pi * f) ** 2, rel=1e-10)
    car, _ = QUARTER.at({"wheel_hop_frequency": hop, "spring": 2e4, "damper": 1500.0})
    assert car.variables["tyre_stiffness"].default == pytest.approx(total - 2e4, rel=1e-12)


def test_the_body_of_a_heavy_wheelless_car_bounces_at_the_ride_frequency():
    """Of modes without dampers, towards wheels of no mass: to the ratio of the masses."""
    car = replace(QUARTER, wheel_mass=1e-3)
    table = car.modes({"ride_frequency": 1.3, "damper": 1e-6})
    assert table["frequency [Hz]"].min() == pytest.approx(1.3, rel=1e-5)


def test_corners_of_a_half_car_carry_their_share_of_the_body():
    corners = corners_of(HALF.assembly)
    a, b = HALF.cg_to_front, HALF.cg_to_rear
    assert corners["front"].mass == pytest.approx(HALF.body_mass * b / (a + b), rel=1e-12)
    assert corners["rear"].mass == pytest.approx(HALF.body_mass * a / (a + b), rel=1e-12)


def test_corners_of_a_full_car_carry_the_mean_of_left_and_right():
    """A driver to the left by his distances from the axles."""
    a, b, x = FULL.cg_to_front, FULL.cg_to_rear, DRIVER.position[0]
    front = (FULL.body_mass * b + DRIVER.mass * (b + x)) / (a + b)
    assert corners_of(DRIVER.on(FULL).assembly)["front"].mass == pytest.approx(front / 2, rel=1e-12)


@pytest.mark.parametrize(
    ("strut", "names"),
    [
        (parallel(Spring(), Damper(), installation_ratio=0.7),
         ["ride_frequency", "wheel_hop_frequency", "damping_ratio"]),
        (parallel(Spring(), BilinearDamper(bump=1e3, rebound=2e3)), ["ride_frequency", "wheel_hop_frequency"]),
        (parallel(Spring(), series(Damper(), Spring("mount"))), []),
        (parallel(Spring(), Spring("helper"), Damper()), []),
        (parallel(Spring(), Damper(), Friction(force=50.0)), ["ride_frequency", "wheel_hop_frequency"]),
        (parallel(Spring("ride_frequency"), Damper()), ["wheel_hop_frequency", "damping_ratio"]),
    ],
)  # fmt: skip
def test_only_one_spring_has_a_frequency_and_one_damper_a_ratio(strut, names):
    car = replace(QUARTER, strut=strut)
    assert list(derived_of(car.assembly)) == names
    if len(names) == 3:  # at the wheel by the square of the ratio
        values = car.coefficients({"ride_frequency": 1.2, "damping_ratio": 0.3})
        plain = QUARTER.coefficients({"ride_frequency": 1.2, "damping_ratio": 0.3})
        assert values["spring"] * 0.7**2 == pytest.approx(plain["spring"], rel=1e-12)
        assert values["damper"] * 0.7**2 == pytest.approx(plain["damper"], rel=1e-12)


def test_the_tyre_of_a_hop_frequency_gets_what_the_spring_leaves_at_the_wheel():
    """M_w (2 pi f)^2 less the spring times the square of its installation ratio."""
    car = replace(QUARTER, strut=parallel(Spring(), Damper(), installation_ratio=0.7))
    changed, _ = car.at({"wheel_hop_frequency": 11.0, "spring": 2e4, "damper": 1500.0})
    expected = car.wheel_mass * (2 * pi * 11.0) ** 2 - 0.7**2 * 2e4
    assert changed.variables["tyre_stiffness"].default == pytest.approx(expected, rel=1e-12)


def test_payload_stands_on_its_corners():
    a, b = HALF.cg_to_front, HALF.cg_to_rear
    laden = corners_of(Payload(mass=100.0, position=(0.3, 0.0)).on(HALF).assembly)
    empty = corners_of(HALF.assembly)
    assert laden["front"].mass - empty["front"].mass == pytest.approx(100.0 * (b + 0.3) / (a + b), rel=1e-9)


def test_three_axles_and_shared_springs_and_solid_axles_have_no_such_frequencies():
    """Loads on three axles depend on the springs; a spring of two axles has two frequencies; an axle rolls."""
    wheels = {"a": 1.5, "b": -1.0, "c": -2.0}

    def lorry(names, **shared):
        return RigidBodies(
            bodies=[RigidBody(mass=6e3, pitch_inertia=9e3)],
            wheels=[Wheel(name=n, position=(wheels[n], 0.0), mass=300.0, tyre_stiffness=1e6) for n in names],
            suspensions=[Suspension(name=n, **shared) for n in names],
        )

    assert derived_of(lorry("abc").assembly) == {}
    assert "a.ride_frequency" in derived_of(lorry("ab").assembly)
    assert derived_of(lorry("ab", coefficients="both").assembly) == {}
    axle = derived_of(load_vehicle("trucksim_cab_over").vehicle.assembly)
    assert not any(name.endswith("wheel_hop_frequency") for name in axle)


def test_searches_vary_frequencies_and_masses_together():
    """Objectives are those of the springs and dampers by the closed forms; to 1e-10 as of other parameters."""
    bounds = {"ride_frequency": (1.0, 1.6), "damping_ratio": (0.2, 0.5), "wheel_hop_frequency": (10.5, 12.0),
              "body_mass": (250.0, 400.0)}  # fmt: skip
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds)
    f, ratio, hop, mass = design = [1.3, 0.3, 11.0, 300.0]
    rate, total = mass * (2 * pi * f) ** 2, QUARTER.wheel_mass * (2 * pi * hop) ** 2
    tyre = (total + sqrt(total**2 - 4 * total * rate)) / 2
    spring = rate * tyre / (tyre - rate)
    car = replace(QUARTER, body_mass=mass, tyre_stiffness=tyre)
    expected = RideProblem(car, ROAD, speed=20.0, bounds={"spring": (1e4, 1e5), "damper": (500.0, 5e3)})
    at = [[spring, 2 * ratio * sqrt(spring * mass)]]
    np.testing.assert_allclose(problem.evaluate([design]), expected.evaluate(at), rtol=1e-10)
    assert problem.units["ride_frequency"] == "Hz"


def test_a_wheel_of_another_mass_hops_at_the_same_frequency():
    """To 1e-10 as above: the tyre is M_w (2 pi f)^2 less the spring."""
    bounds = {"wheel_hop_frequency": (10.5, 12.0), "wheel_mass": (30.0, 50.0)}
    struts = {"spring": 2e4, "damper": 1500.0}
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds, struts=struts)
    car = replace(QUARTER, wheel_mass=35.0, tyre_stiffness=35.0 * (2 * pi * 11.0) ** 2 - 2e4)
    expected = RideProblem(car, ROAD, speed=20.0, bounds={"spring": (1e4, 4e4)}, struts={"damper": 1500.0})
    np.testing.assert_allclose(problem.evaluate([[11.0, 35.0]]), expected.evaluate([[2e4]]), rtol=1e-10)


def test_frequencies_are_those_of_the_first_load_case():
    """A laden car keeps the springs of the empty one."""
    laden = Payload(mass=100.0).on(HALF)
    bounds = {"front.ride_frequency": (1.0, 1.6)}
    struts = {"front.damper": 1500.0, "rear": (2e4, 1500.0)}
    first = RideProblem(HALF, ROAD, speed=20.0, bounds=bounds, struts=struts, band=(0.3, 20.0))
    cases = [first.cases[0], replace(first.cases[0], vehicle=laden)]
    found = first.replace(cases=cases).evaluate([[1.2]])
    spring = HALF.coefficients({"front.ride_frequency": 1.2, **struts})["front.spring"]
    expected = first.replace(cases=cases, bounds={"front.spring": (1e4, 4e4)}).evaluate([[spring]])
    np.testing.assert_allclose(found, expected, rtol=1e-10)


@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ({"ride_frequency": 9.0, "damping_ratio": 0.3},
         r"ride_frequency must be within reach of springs and tyres, spring above zero, got -[\d.e+]+ for it"),
        ({"ride_frequency": 0.0, "damping_ratio": 0.3}, "ride_frequency must be finite and > 0 Hz, got 0.0"),
        ({"damping_ratio": 0.3}, "setting must have spring, got none"),
    ],
)  # fmt: skip
def test_rejects_frequencies_out_of_reach(setting, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        QUARTER.closed(setting)


def test_a_box_with_a_corner_out_of_reach_is_rejected():
    bounds = {"ride_frequency": (1.0, 9.0), "damping_ratio": (0.2, 0.5)}
    message = r"ride_frequency must be within reach of springs and tyres, spring above zero, got -[\d.e+]+ for it"
    with pytest.raises(ValueError, match=f"^{message}$"):
        RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds)

"""Samples of designs: what scatters, about which values, and the corners that they reach."""

import re
from dataclasses import replace

import numpy as np
import pytest

from garage import DRIVER, FULL, HALF, QUARTER, ROAD
from suspension_ctrl import Damper, LoadCase, Payload, Plant, Scatter, Spring, parallel, ride
from suspension_ctrl.response.scattered import Scattered

STRUTS = {"front.spring": 2e4, "front.damper": 1500.0, "rear.spring": 2.2e4, "rear.damper": 1600.0}


def cases(*vehicles):
    return [LoadCase(vehicle=one, road=ROAD, speed=20.0) for one in vehicles]


def scattered(scatter, vehicles, variables, fixed):
    return Scattered.of(scatter, cases(*vehicles), variables, fixed)


def test_variables_come_first_and_only_what_scatters_after_them():
    scatter = Scatter({"spring": 0.05, "tyre_stiffness": 0.1}, samples=16)
    fixed = {name: value for name, value in STRUTS.items() if name != "front.damper"}
    found = scattered(scatter, [HALF], ["front.damper"], fixed)
    tyres = ("front_tyre_stiffness", "rear_tyre_stiffness")
    assert found.names == ("front.damper", "front.spring", "rear.spring", *tyres)
    designs = found.designs(np.array([[1500.0], [1200.0]]))
    assert designs.shape == (32, 5)
    np.testing.assert_array_equal(designs[:, 0], np.repeat([1500.0, 1200.0], 16))
    np.testing.assert_array_equal(designs[:16, 1:], [2e4, 2.2e4, 1.0, 1.0] * found.factors[:, 1:])
    np.testing.assert_array_equal(designs[:16, 1:], designs[16:, 1:])  # common to all designs


def test_parameters_scatter_about_the_values_of_each_load_case():
    """Against vehicles that are built anew: an empty one, and one with 300 kg of load that scatter too."""
    laden = Payload(mass=300.0, position=(-1.0, 0.0)).on(replace(FULL, front_tyre_stiffness=210e3))
    scatter = Scatter({"payload.mass": 0.5, "front_tyre_stiffness": 0.1, "body_mass": 0.02}, samples=4)
    found = scattered(scatter, [FULL, laden], list(STRUTS), {})
    factors = dict(zip(found.names, found.factors[2].tolist(), strict=True))
    design = found.designs(np.array([list(STRUTS.values())]))[2]
    for case, original in zip(found.cases, (FULL, laden), strict=True):
        vehicle, setting = case.vehicle.with_design(design)
        car = replace(
            getattr(original, "vehicle", original),
            body_mass=FULL.body_mass * factors["body_mass"],
            front_tyre_stiffness=(FULL if original is FULL else laden.vehicle).front_tyre_stiffness
            * factors["front_tyre_stiffness"],
        )
        if original is laden:
            car = Payload(mass=300.0 * factors["payload.mass"], position=(-1.0, 0.0)).on(car)
        values = ride(vehicle, setting, ROAD, speed=20.0, band=(0.3, 20.0))["value"]
        expected = ride(car, STRUTS, ROAD, speed=20.0, band=(0.3, 20.0))["value"]
        np.testing.assert_allclose(values, expected, rtol=1e-9)


def test_a_spring_chosen_by_its_frequency_scatters_about_its_nominal_rate():
    """The mass of a vehicle scatters after its springs were chosen: they do not follow it."""
    scatter = Scatter({"spring": 0.05, "body_mass": 0.1}, samples=8)
    found = scattered(scatter, [QUARTER], ["ride_frequency", "damper"], {})
    assert found.names == ("spring", "damper", "body_mass")
    rate = QUARTER.at({"ride_frequency": 1.3, "damper": 1500.0})[1]["spring"]
    designs = found.designs(np.array([[1.3, 1500.0]]))
    np.testing.assert_allclose(designs[:, 0], rate * found.factors[:, 0], rtol=1e-12)
    held = scattered(scatter, [QUARTER], ["damper"], {"ride_frequency": 1.3})
    assert held.names == ("damper", "spring", "body_mass")
    np.testing.assert_allclose(held.designs(np.array([[1500.0]]))[:, 1], rate * held.factors[:, 1], rtol=1e-12)


def test_corners_reach_beyond_the_bounds():
    scatter = Scatter({"spring": 0.05, "damper": (-0.25, 0.0), "tyre_stiffness": 0.1}, samples=1)
    found = scattered(scatter, [QUARTER], ["spring", "damper"], {})
    lower, upper = np.array([1e4, 1e3]), np.array([3e4, 4e3])
    corners = found.corners(np.array([[1e4, 1e3], [3e4, 1e3], [3e4, 4e3]]), lower, upper)
    expected = {(spring, damper, tyre) for spring, damper in ((9.5e3, 750.0), (3.15e4, 750.0), (3.15e4, 4e3))
                for tyre in (0.9, 1.1)}  # fmt: skip
    assert {tuple(row) for row in corners.round(9).tolist()} == expected


def test_a_plant_has_coefficients_alone():
    vehicle = Plant(QUARTER.plant(), contacts={"": (0.0, 0.0)}, struts=("",))
    found = scattered(Scatter({"damper": 0.1}, samples=4), [vehicle], ["spring"], {"damper": 1500.0})
    assert found.names == ("spring", "damper")
    np.testing.assert_allclose(found.designs(np.array([[2e4]]))[:, 1], 1500.0 * found.factors[:, 1])


@pytest.mark.parametrize(
    ("names", "message"),
    [
        ({"sprang": 0.1}, "scatter must be one of "),
        ({"driver.x": 0.1}, "scatter must be one of "),
        ({"rear_antiroll": 0.1}, "scatter must be one of "),
    ],
)
def test_a_name_that_the_vehicle_lacks_a_place_and_a_value_of_zero_are_refused(names, message):
    car = DRIVER.on(FULL)
    setting = {**STRUTS, "driver.spring": 12e3, "driver.damper": 700.0}
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        scattered(Scatter(names), [car], list(STRUTS), setting)


def test_a_coefficient_that_differs_between_load_cases_is_refused():
    several = [replace(QUARTER, strut=parallel(Spring(value=value), Damper())) for value in (2e4, 3e4)]
    with pytest.raises(ValueError, match=r"^scatter must be one of damper, tyre_stiffness, .*, got 'spring'$"):
        scattered(Scatter({"spring": 0.1}), several, ["damper"], {})

"""Measures of a design beside the present one: those of the problem, with the sign and the unit of the measure."""

from math import isnan

import pytest

from garage import QUARTER, ROAD, SPEED
from suspension_ctrl import Limit, Measure, RideProblem, ride
from suspension_ctrl.desk.verdicts import judged

SOFTNESS = Measure("softness", "mm/N", lambda designs: 1e3 / designs[:, 0], maximise=True)
PROBLEM = RideProblem(
    QUARTER, ROAD, speed=SPEED, bounds={"spring": (10e3, 30e3), "damper": (500.0, 5e3)},
    measures=["ACC", SOFTNESS],
    constraints=["SWS <= 0.03", Limit(Measure("softest", "mm/N", SOFTNESS.function), minimum=0.05)],
)  # fmt: skip
DESIGN, PRESENT = {"spring": 12e3, "damper": 1600.0}, {"spring": 40e3, "damper": 1500.0}


def test_values_are_those_of_the_ride_also_outside_of_the_bounds():
    found = {one.name: one for one in judged(PROBLEM, DESIGN, PRESENT)}
    here, before = (ride(QUARTER, one, ROAD, SPEED)["value"] for one in (DESIGN, PRESENT))
    assert found["ACC"].value == pytest.approx(here["ACC"], rel=1e-6)
    assert found["ACC"].present == pytest.approx(before["ACC"], rel=1e-6)
    assert found["ACC"].change == pytest.approx(100 * (here["ACC"] / before["ACC"] - 1), rel=1e-4)
    assert found["SWS <= 0.03"].value == pytest.approx(here["SWS"], rel=1e-6)
    assert (found["SWS <= 0.03"].unit, found["SWS <= 0.03"].limit) == ("m", "met")


def test_more_of_a_maximised_measure_has_its_own_sign():
    found = {one.name: one for one in judged(PROBLEM, DESIGN, PRESENT)}
    assert found["softness"].value == pytest.approx(1 / 12)
    assert found["softness"].present == pytest.approx(1 / 40)
    assert found["softest >= 0.05"].value == pytest.approx(1 / 12)
    assert judged(PROBLEM, PRESENT, {})[3].limit == "not met"
    assert judged(PROBLEM, {"spring": 20e3, "damper": 1500.0}, {})[3].limit == "met"  # exactly


def test_without_a_present_design_there_is_no_change():
    assert all(isnan(one.present) and isnan(one.change) for one in judged(PROBLEM, DESIGN, {}))

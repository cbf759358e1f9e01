"""Without a band given, that in which the roads are known holds; what a message allows is accepted."""

import re

import numpy as np
import pytest

from suspension_ctrl import (
    Iso8608Road,
    LoadCase,
    MeasuredRoad,
    QuarterCar,
    RideProblem,
    linearised,
    load_problem,
    ride,
    save_problem,
    time_in_zones,
)
from suspension_ctrl.response.bands import BAND, OwnBand, band_of

CAR = QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
DESIGN = (22e3, 1500.0)
MEASURED = MeasuredRoad([0.0312345678, 0.1, 2.3456789], [1e-4, 1e-5, 1e-8])
BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 3e3)}


def test_without_a_band_that_of_the_roads_holds():
    assert band_of(None, []) == band_of(None, [(Iso8608Road("C"), 20.0)]) == BAND
    assert band_of(None, [(MEASURED, 10.0)]) == pytest.approx((0.312345678, 20.0))
    assert band_of(None, [(MEASURED, 5.0), (MEASURED, 8.0)]) == pytest.approx((8 * 0.0312345678, 5 * 2.3456789))
    assert band_of((1, 2), [(MEASURED, 5.0)]) == (1.0, 2.0)


def test_roads_that_share_no_band_need_one():
    short = MeasuredRoad([3.0, 4.0], [1e-4, 1e-5])
    with pytest.raises(ValueError, match=r"^band must be given where roads are not known below 20 Hz, got none$"):
        band_of(None, [(short, 20.0)])


def test_a_ride_on_a_measured_road_needs_no_band():
    low, high = MEASURED.band
    table = ride(CAR, DESIGN, MEASURED, 8.0)
    np.testing.assert_array_equal(table.value, ride(CAR, DESIGN, MEASURED, 8.0, band=(8 * low, 8 * high)).value)
    assert not linearised(CAR, DESIGN, MEASURED, 8.0).laws
    assert len(time_in_zones(CAR, DESIGN, MEASURED, 8.0, [0.0])) == 2


def test_a_problem_finds_its_band_anew(tmp_path):
    problem = RideProblem(CAR, MEASURED, speed=8.0, bounds=BOUNDS)
    assert isinstance(problem.band, OwnBand)
    assert problem.band == pytest.approx((8 * 0.0312345678, 8 * 2.3456789))
    assert problem.replace(speed=5.0).band == pytest.approx((5 * 0.0312345678, 5 * 2.3456789))
    assert problem.replace(road=Iso8608Road("C")).band == BAND
    given = problem.replace(band=(1.0, 10.0))
    assert given.replace(speed=5.0).band == (1.0, 10.0)
    for one in (problem, given):
        save_problem(tmp_path / "p.toml", one)
        assert load_problem(tmp_path / "p.toml").band == one.band
    cases = [LoadCase(vehicle=CAR, road=MEASURED, speed=v) for v in (5.0, 8.0)]
    assert RideProblem(cases=cases, bounds=BOUNDS).band == pytest.approx((8 * 0.0312345678, 5 * 2.3456789))


@pytest.mark.parametrize("speed", [3.7, 8.0, 11.1, 20.0])
def test_what_the_message_allows_is_accepted_when_typed(speed):
    with pytest.raises(ValueError, match=r"^f must lie from ") as error:
        ride(CAR, DESIGN, MEASURED, speed, band=(0.0, 100.0))
    low, high = map(float, re.search(r"from (\S+) to (\S+) Hz", str(error.value)).groups())
    assert ride(CAR, DESIGN, MEASURED, speed, band=(low, high)).value.notna().all()
    for f, end in zip((low, high), MEASURED.band, strict=True):
        assert f == pytest.approx(end * speed, rel=1e-4)
        assert MEASURED.psd([f], speed) > 0

"""Measures of vibration on each vehicle, by hand from python-control's responses."""

import numpy as np
import pytest

from garage import BENDING, DRIVER, FULL, HALF, PASSENGER, QUARTER, ROAD, SPEED, mean_squares, on_road, struts_of
from suspension_ctrl import ACC, DLC, DTL, SWS, Measure, RideProblem, RootSumSquare, Seat, Term, weighting
from suspension_ctrl.vehicles.assembly import GRAVITY
from suspension_ctrl.vehicles.vehicle import Vehicle

BAND, NODES = (0.1, 20.0), 256
CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
SEATED = PASSENGER.on(DRIVER.on(FULL))


def mean_square(vehicle: Vehicle, response: object, weighting: str | None = None) -> float:
    return mean_squares(vehicle, struts_of(vehicle), [(response, weighting)], BAND, NODES)[0]


def root(vehicle: Vehicle, *responses: object, weighting: str | None = None) -> float:
    """Root mean square of the worst of some responses."""
    return np.sqrt(max(mean_square(vehicle, response, weighting) for response in responses))


def judged(vehicle: Vehicle, measure: str | Measure, **changes) -> tuple[float, str]:
    """Value and unit of a measure at the usual struts, which are the middle of a narrow box."""
    values = vehicle.coefficients(struts_of(vehicle))
    varied = next(iter(values))
    bounds = {varied: (0.9 * values[varied], 1.1 * values[varied])}
    fixed = {name: value for name, value in values.items() if name != varied}
    p = RideProblem(
        vehicle, ROAD, speed=SPEED, band=BAND, nodes=NODES, bounds=bounds, struts=fixed,
        measures=("body_acceleration", measure), **changes,
    )  # fmt: skip
    return p.evaluate([[values[varied]]])[0, 1], p.units[p.objectives[1]]


CASES = [
    (QUARTER, "ACC", lambda v: root(v, "body_acceleration", weighting="Wk"), "m/s^2"),
    (QUARTER, "SWS", lambda v: root(v, "suspension_travel"), "m"),
    (QUARTER, "DTL", lambda v: root(v, "tyre_load"), "N"),
    (QUARTER, "DLC", lambda v: root(v, "tyre_load") / ((317.5 + 45.4) * GRAVITY), "-"),
    (HALF, "ACC (1.2, -0.4)", lambda v: root(v, ("acceleration", 1.2, -0.4), weighting="Wk"), "m/s^2"),
    (HALF, "SWS", lambda v: root(v, "front_suspension_travel", "rear_suspension_travel"), "m"),
    (HALF, "SWS rear", lambda v: root(v, "rear_suspension_travel"), "m"),
    (HALF, "DTL front", lambda v: root(v, "front_tyre_load"), "N"),
    (HALF, "DLC rear", lambda v: root(v, "rear_tyre_load") / ((650 * 1.2 / 2.7 + 45) * GRAVITY), "-"),
    (DRIVER.on(HALF), "ACC driver", lambda v: root(v, "driver_acceleration", weighting="Wk"), "m/s^2"),
    (DRIVER.on(HALF), "SWS driver", lambda v: root(v, "driver_suspension_travel"), "m"),
    (DRIVER.on(HALF), "SWS", lambda v: root(v, "front_suspension_travel", "rear_suspension_travel"), "m"),
    (SEATED, "SWS", lambda v: root(v, *(f"{c}_suspension_travel" for c in CORNERS)), "m"),
    (SEATED, "SWS rear", lambda v: root(v, "rear_left_suspension_travel", "rear_right_suspension_travel"), "m"),
    (SEATED, "DTL", lambda v: root(v, *(f"{corner}_tyre_load" for corner in CORNERS)), "N"),
    (SEATED, "DTL front_right", lambda v: root(v, "front_right_tyre_load"), "N"),
    (SEATED, "worst = DTL front", lambda v: root(v, "front_left_tyre_load", "front_right_tyre_load"), "N"),
    (SEATED, "ACC passenger", lambda v: root(v, "passenger_acceleration", weighting="Wk"), "m/s^2"),
    (SEATED, "roll_acceleration", lambda v: root(v, "roll_acceleration"), "rad/s^2"),
    (SEATED, "2e-1 passenger_suspension_travel", lambda v: 0.2 * root(v, "passenger_suspension_travel"), "m"),
    (BENDING.on(FULL), "Wb acceleration (1.2, 0.0)", lambda v: root(v, ("acceleration", 1.2, 0.0), weighting="Wb"),
     "m/s^2"),
]  # fmt: skip


@pytest.mark.parametrize(("vehicle", "text", "expected", "unit"), CASES)
def test_a_text_means_the_responses_it_names(vehicle, text, expected, unit):
    value, found = judged(vehicle, text)
    assert value == pytest.approx(expected(vehicle), rel=1e-9)
    assert found == unit


def test_points_may_be_written_in_any_way():
    for text in ("ACC (-1,+.5e0)", "ACC  ( -1.0 , 0.5 )"):
        assert Measure.parse(text).in_case(on_road(HALF), "Wk").terms == (Term(("acceleration", -1.0, 0.5), "Wk"),)


def test_the_dynamic_load_coefficient_is_over_each_tyre_s_own_load():
    """The worst share, not the worst load over some load; static loads on struts in the middle of the box."""
    static = SEATED.statics.static_loads(np.array([list(SEATED.coefficients(struts_of(SEATED)).values())]))[0]
    shares = [root(SEATED, f"{corner}_tyre_load") / load for corner, load in zip(CORNERS, static, strict=True)]
    assert judged(SEATED, "DLC")[0] == pytest.approx(max(shares), rel=1e-9)
    assert judged(SEATED, "DLC front_left")[0] == pytest.approx(shares[0], rel=1e-9)


def test_a_root_sum_of_squares():
    """The vibration total value of ISO 2631-1, 6.5, with the factors of 8.2.2.1 for rotations."""
    text = "comfort = Wk driver_acceleration + 0.63 We roll_acceleration + 0.4 We pitch_acceleration"
    squares = [
        mean_square(SEATED, "driver_acceleration", "Wk"),
        0.63**2 * mean_square(SEATED, "roll_acceleration", "We"),
        0.4**2 * mean_square(SEATED, "pitch_acceleration", "We"),
    ]
    rotations = [Term("roll_acceleration", "We", 0.63), Term("pitch_acceleration", "We", 0.4)]
    written = RootSumSquare([Term("driver_acceleration", "Wk"), *rotations], name="comfort")
    assert Measure.parse(text) == written
    value, unit = judged(SEATED, written)
    assert value == pytest.approx(np.sqrt(sum(squares)), rel=1e-9)
    assert unit == "m/s^2"


def test_a_point_may_be_a_term_of_a_sum():
    text = "Wk acceleration (1.0, 0.5) + 2 acceleration(-1, -0.5)"
    squares = [
        mean_square(FULL, ("acceleration", 1.0, 0.5), "Wk"),
        4 * mean_square(FULL, ("acceleration", -1.0, -0.5)),
    ]
    assert judged(FULL, text)[0] == pytest.approx(np.sqrt(sum(squares)), rel=1e-9)


def test_the_same_response_may_count_with_several_weightings_and_twice():
    text = "Wk body_acceleration + Wd body_acceleration + 2 Wk body_acceleration"
    wk, wd = (mean_square(QUARTER, "body_acceleration", weighting) for weighting in ("Wk", "Wd"))
    assert judged(QUARTER, text)[0] == pytest.approx(np.sqrt(5 * wk + wd), rel=1e-9)


def test_a_minus_turns_a_measure_round():
    assert judged(HALF, "-DTL front")[0] == -judged(HALF, "DTL front")[0]


def test_acc_takes_the_problem_s_weighting():
    for name in ("Wb", None):
        value, _ = judged(QUARTER, "ACC", weighting=name)
        assert value == pytest.approx(root(QUARTER, "body_acceleration", weighting=name), rel=1e-9)


def test_an_axle_is_its_wheels_whatever_seats_are_called():
    car = Seat(mass=80.0, spring=12e3, damper=700.0, position=(0.3, 0.4), name="front_seat").on(FULL)
    assert [term.response for term in SWS("front").in_case(on_road(car), None).terms] == [
        "front_left_suspension_travel", "front_right_suspension_travel",
    ]  # fmt: skip
    assert [term.response for term in SWS("front_seat").in_case(on_road(car), None).terms] == [
        "front_seat_suspension_travel"
    ]


def test_a_term_takes_a_weighting_of_ones_own():
    own = RootSumSquare([Term("body_acceleration", weighting("Wd"))], name="own")
    assert judged(QUARTER, own)[0] == pytest.approx(judged(QUARTER, "Wd body_acceleration")[0], rel=1e-12)


@pytest.mark.parametrize(
    ("measure", "text"),
    [
        (ACC("driver"), "ACC driver"),
        (ACC((1.2, -0.4)), "ACC (1.2, -0.4)"),
        (SWS("rear"), "SWS rear"),
        (DLC("front", maximise=True), "-DLC front"),
        (DTL, "DTL"),
    ],
)
def test_an_object_is_judged_as_its_text(measure, text):
    assert judged(SEATED, measure) == judged(SEATED, text)


@pytest.mark.parametrize("terms", [[], ["SWS"], [Term("tyre_load", moment=2)], [Term("tyre_load", relative=True)]])
def test_a_sum_is_of_terms_that_have_a_text(terms):
    with pytest.raises(ValueError, match=r"^terms must be a list of Term without moment, got "):
        RootSumSquare(terms)


@pytest.mark.parametrize("point", [(1.0,), (np.nan, 0.0), (0.0, 1e7)])
def test_a_point_is_two_numbers_up_to_1e6(point):
    with pytest.raises(ValueError, match=r"^(a point must be two finite numbers|y of a point must be )"):
        ACC(point)


def test_tyres_have_no_load_at_a_point():
    with pytest.raises(ValueError, match=r"^DTL must be of one of front_left, .* got \(0.0, 1.0\)$"):
        DTL((0.0, 1.0)).in_case(on_road(FULL), None)

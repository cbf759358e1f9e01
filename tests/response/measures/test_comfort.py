"""Total value and SEAT factor on each vehicle, by hand from python-control's responses."""

from dataclasses import replace

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import DRIVER, FULL, HALF, PASSENGER, QUARTER, ROAD, SPEED, mean_squares, struts_of
from suspension_ctrl import SEAT, Limit, Measure, Plant, RideProblem, TotalValue
from suspension_ctrl.response.certifying import certify

BAND, NODES = (0.1, 20.0), 512
SEATED = PASSENGER.on(DRIVER.on(FULL))
FLOOR = ("acceleration", 0.3, 0.4)  # below the driver


def value(vehicle, *measures) -> list[float]:
    table = sc.ride(vehicle, struts_of(vehicle), ROAD, SPEED, band=BAND, measures=measures)
    return table["value"].iloc[: len(measures)].to_list()


def total(vehicle, *terms) -> float:
    """Root sum of squares of responses with weightings and factors."""
    squares = mean_squares(vehicle, struts_of(vehicle), [term[:2] for term in terms], BAND, NODES)
    return float(np.sqrt(np.array([term[2] for term in terms]) ** 2 @ squares))


SEAT_AXES = [
    ("driver_acceleration", "Wk", 1.0),
    ("roll_acceleration", "We", 0.63),
    ("pitch_acceleration", "We", 0.4),
]
CASES = [
    (QUARTER, {
        "total": [
            ("body_acceleration", "Wk", 1.0), ("body_acceleration", "Wd", 0.4), ("body_acceleration", "Wk", 0.4),
        ],
        "total at feet 0.3": [("body_acceleration", "Wk", 0.4)],
    }),
    (HALF, {
        "total (1, 0) at seat 0.5": [
            (("acceleration", 1.0, 0.0), "Wk", 1.0), ("pitch_acceleration", "Wd", 0.5),
            ("pitch_acceleration", "We", 0.4),
        ],
    }),
    (SEATED, {
        "total driver at seat": SEAT_AXES,
        "total driver": [*SEAT_AXES, ("driver_acceleration", "Wd", 0.4), (FLOOR, "Wk", 0.4)],
        "total driver at feet -0.2 back 0.6 seat 30cm": [
            *SEAT_AXES, ("pitch_acceleration", "Wd", 0.3), ("roll_acceleration", "Wd", 0.3),
            ("driver_acceleration", "Wd", 0.4), ("pitch_acceleration", "Wc", 0.8 * 0.6),
            ("roll_acceleration", "Wd", 0.5 * 0.6),
            (FLOOR, "Wk", 0.4), ("pitch_acceleration", "Wk", 0.25 * 0.2), ("roll_acceleration", "Wk", 0.25 * 0.2),
        ],
    }),
]  # fmt: skip


@pytest.mark.parametrize(("vehicle", "totals"), CASES)
def test_total_value_has_the_factors_of_the_standard(vehicle, totals):
    expected = [total(vehicle, *terms) for terms in totals.values()]
    np.testing.assert_allclose(value(vehicle, *totals), expected, rtol=1e-7)


def test_horizontal_acceleration_is_that_of_a_point_of_a_turning_body():
    """A point at height h moves by h sin(pitch) forward; about rest its acceleration is h times that of pitch."""
    t, h, step = np.arange(0.0, 2.0, 1e-4), 0.7, 1e-4
    pitch = 1e-3 * np.sin(5 * t)
    forward = np.gradient(np.gradient(h * np.sin(pitch), step), step)[5:-5]
    np.testing.assert_allclose(forward, h * -25 * pitch[5:-5], rtol=1e-3, atol=1e-6)


def test_a_seat_isolates_by_its_factor():
    floors = {"driver": FLOOR, "passenger": ("acceleration", -0.9, -0.35)}
    expected = [
        total(SEATED, (f"{n}_acceleration", "Wk", 1.0)) / total(SEATED, (f, "Wk", 1.0)) for n, f in floors.items()
    ]
    assert value(SEATED, "SEAT driver", SEAT("passenger")) == pytest.approx(expected, rel=1e-7)


@pytest.mark.filterwarnings("ignore::suspension_ctrl.vehicles.unit_slips.UnitSlipWarning")
def test_a_stiff_seat_has_the_factor_one():
    stiff = sc.Seat(mass=1.0, spring=1e7, damper=1e3, name="box").on(QUARTER)
    assert value(stiff, "SEAT box") == pytest.approx([1.0], rel=1e-3)


def test_the_factor_is_a_limit_of_a_problem_and_confirmed_in_time():
    seated = DRIVER.on(QUARTER)
    bounds = {"spring": (15e3, 25e3), "damper": (1e3, 2e3)}
    problem = RideProblem(
        seated, ROAD, speed=SPEED, bounds=bounds, band=BAND, measures=["SEAT driver", "total driver"],
        constraints=[Limit(SEAT("driver"), 0.5)],
    )  # fmt: skip
    seat, _, over = problem.evaluate([[2e4, 1500.0]])[0]
    assert over == pytest.approx(seat / 0.5 - 1, rel=1e-12)
    table = certify(problem, [2e4, 1500.0], length=2000.0, seeds=range(4)).to_frame().loc["1"]
    assert table["simulated"]["SEAT driver"] == pytest.approx(seat, rel=0.02)
    assert table["low"]["total driver"] <= table["linearised"]["total driver"] <= table["high"]["total driver"]


@pytest.mark.parametrize(
    ("text", "measure"),
    [
        ("total", TotalValue()),
        ("total driver", TotalValue("driver")),
        ("total at seat", TotalValue(points={"seat": None})),
        ("total seat at seat 30cm feet", TotalValue("seat", {"feet": None, "seat": 0.3})),
        ("total (1, 2) at back -0.5", TotalValue((1, 2), {"back": -0.5})),
        ("SEAT driver", SEAT("driver")),
    ],
)
def test_texts_and_objects_are_the_same(text, measure):
    assert replace(Measure.parse(text), name="") == measure
    assert Measure.parse(str(measure)) == measure


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Measure.parse("total at"), "total must be followed by a place and points with heights, as in "),
        (
            lambda: Measure.parse("total driver at head"),
            "total must be followed by a place and points .* got 'driver",
        ),
        (lambda: TotalValue("driver", {"head": 0.3}), "points must be one of seat, back, feet, got 'head'"),
        (lambda: TotalValue("driver", 0.3), "points must be a mapping of seat, back, feet to heights .* got 0.3"),
        (
            lambda: TotalValue(points={"seat": 1e4}),
            "height of seat must be a number from -1000.0 to 1000.0, got 10000",
        ),
        (lambda: value(SEATED, "total guest"), "total must be of one of body, driver, passenger or a point"),
        (lambda: value(SEATED, "SEAT guest"), "SEAT must be of one of driver, passenger, got 'guest'"),
        (lambda: value(FULL, "SEAT"), "SEAT must be of one of seats, of which the vehicle has none, got ''"),
        (lambda: value(SEATED, "SEAT front_left"), "SEAT must be of one of driver, passenger, got 'front_left'"),
    ],
)
def test_what_is_not_there_is_named_in_one_line(make, message):
    with pytest.raises(ValueError, match=rf"^{message}[^\n]*$"):
        make()


CAB, SETTING = sc.load_vehicle("trucksim_cab_over").vehicle, sc.load_vehicle("trucksim_cab_over").setting
PLACE = (-0.1, 0.6)  # of the driver from the cab's centre of gravity [m]
IN_CAB = replace(DRIVER, position=PLACE, stands_on="cab").on(CAB)


def test_a_seat_in_a_cab_stands_on_its_floor_and_turns_with_it():
    """The floor is a point of the cab, turns are the cab's; a head on the driver has the driver for a floor."""
    point = sc.vehicles.body_parts.BodyPoint(name="below", body="cab", position=(0.5 + PLACE[0], PLACE[1]))
    known = replace(DRIVER, position=PLACE, stands_on="cab").on(replace(CAB, points=[point]))
    head = sc.Seat(mass=6.0, spring=9e3, damper=60.0, name="head", stands_on="driver").on(IN_CAB)

    def found(vehicle, *measures) -> list[float]:
        table = sc.ride(vehicle, SETTING, ROAD, SPEED, band=BAND, measures=measures)
        return table["value"].iloc[: len(measures)].to_list()

    turning = "0.63 We cab_roll_acceleration + 0.4 We cab_pitch_acceleration"
    seat, below, total, feet = found(
        known, "Wk driver_acceleration", "Wk below_acceleration", f"Wk driver_acceleration + {turning}",
        "0.4 Wk below_acceleration + 0.05 Wk cab_pitch_acceleration + 0.05 Wk cab_roll_acceleration",
    )  # fmt: skip
    assert found(IN_CAB, "SEAT driver", "total driver at seat", "total driver at feet -0.2") == pytest.approx(
        [seat / below, total, feet], rel=1e-7
    )
    up, driver, whole, *turns = found(
        head, "ACC head", "ACC driver", f"Wk head_acceleration + {turning}", "Wd cab_roll_acceleration",
        "Wd cab_pitch_acceleration",
    )  # fmt: skip
    assert found(head, "SEAT head", "total head at seat") == pytest.approx([up / driver, whole], rel=1e-7)
    assert found(head, "A8 head at 20") == pytest.approx([1.4 * 20 * max(turns)], rel=1e-7)


def test_a_seat_that_moves_has_no_fixed_floor():
    message = r"^driver_floor_acceleration must be of a seat in a fixed place, got driver.x among the variables$"
    with pytest.raises(ValueError, match=message):
        RideProblem(
            DRIVER.on(FULL), ROAD, speed=SPEED, bounds={"driver.x": (-0.5, 0.9)}, struts=struts_of(FULL),
            band=BAND, measures=["ACC", "SEAT driver"],
        )  # fmt: skip


def test_the_floor_of_a_plant_is_a_response_of_its_own():
    """With it measures are those of the vehicle; without it all but those of the seat alone are refused."""
    seated, contacts = DRIVER.on(QUARTER), {"": (0.0, 0.0)}
    names = ["body_acceleration", "driver_acceleration", "driver_floor_acceleration"]
    plant, bare = (Plant(seated.plant(names[:n]), contacts=contacts, struts=("", "driver")) for n in (3, 2))
    setting = seated.coefficients(struts_of(seated))
    table = sc.ride(plant, setting, ROAD, SPEED, band=BAND, measures=["SEAT driver", "total driver"])
    assert table["value"].iloc[:2].to_list() == pytest.approx(
        value(seated, "SEAT driver", "total driver"), rel=1e-9
    )
    case = sc.LoadCase(vehicle=bare, road=ROAD, speed=SPEED)
    assert [term.response for term in TotalValue("driver", {"seat": 0.3}).in_case(case, None).terms] == [
        "driver_acceleration"
    ]
    for measure, message in (
        (SEAT("driver"), "SEAT must be of one of seats, of which the vehicle has none, got 'driver'"),
        (
            TotalValue("driver"),
            "response below the feet must be one of body_acceleration, .*driver_jerk, got 'dri",
        ),
    ):
        with pytest.raises(ValueError, match=rf"^{message}"):
            measure.in_case(case, None)

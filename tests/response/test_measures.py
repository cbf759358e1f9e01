"""Measures and limits by their text: what each means on each vehicle, by hand from python-control's responses."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage import BENDING, DRIVER, FULL, HALF, PASSENGER, QUARTER, ROAD, SPEED, mean_squares, struts_of
from suspension_ctrl import LoadCase, Measure, RideProblem, RollGeometry, Seat, response_psds, ride
from suspension_ctrl.response.measures import Term, case_limit, case_measure, name_of
from suspension_ctrl.vehicles.assembly import GRAVITY
from suspension_ctrl.vehicles.vehicle import Vehicle

BAND, NODES = (0.1, 20.0), 256
CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
SEATED = PASSENGER.on(DRIVER.on(FULL))


GEOMETRY = RollGeometry(roll_arm=0.5, front_roll_centre=0.05, rear_roll_centre=0.12, wheel_centre=0.31)


def on_road(vehicle: Vehicle) -> LoadCase:
    return LoadCase(vehicle=vehicle, road=ROAD, speed=SPEED, roll_geometry=GEOMETRY)


def mean_square(vehicle: Vehicle, response: object, weighting: str | None = None) -> float:
    return mean_squares(vehicle, struts_of(vehicle), [(response, weighting)], BAND, NODES)[0]


def root(vehicle: Vehicle, *responses: object, weighting: str | None = None) -> float:
    """Root mean square of the worst of some responses."""
    return np.sqrt(max(mean_square(vehicle, response, weighting) for response in responses))


def judged(vehicle: Vehicle, text: str, **changes) -> tuple[float, str]:
    """Value and unit of a measure at the usual struts, which are the middle of a narrow box."""
    values = vehicle.coefficients(struts_of(vehicle))
    varied = next(iter(values))
    bounds = {varied: (0.9 * values[varied], 1.1 * values[varied])}
    fixed = {name: value for name, value in values.items() if name != varied}
    p = RideProblem(
        vehicle, ROAD, speed=SPEED, band=BAND, nodes=NODES, bounds=bounds, struts=fixed,
        measures=("body_acceleration", text), **changes,
    )  # fmt: skip
    return p.evaluate([[values[varied]]])[0, 1], p.units[name_of(text)]


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
        assert case_measure(text, on_road(HALF), "Wk").terms == (Term(("acceleration", -1.0, 0.5), "Wk"),)


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
    value, unit = judged(SEATED, text)
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
    for weighting in ("Wb", None):
        value, _ = judged(QUARTER, "ACC", weighting=weighting)
        assert value == pytest.approx(root(QUARTER, "body_acceleration", weighting=weighting), rel=1e-9)


def test_an_axle_is_its_wheels_whatever_seats_are_called():
    car = Seat(mass=80.0, spring=12e3, damper=700.0, position=(0.3, 0.4), name="front_seat").on(FULL)
    assert [term.response for term in case_measure("SWS front", on_road(car), None).terms] == [
        "front_left_suspension_travel", "front_right_suspension_travel",
    ]  # fmt: skip
    assert [term.response for term in case_measure("SWS front_seat", on_road(car), None).terms] == [
        "front_seat_suspension_travel"
    ]


def test_names():
    assert [name_of(text) for text in (" ACC  driver ", "my comfort= Wk x + y", "a = b")] == [
        "ACC driver", "my comfort", "a",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("vehicle", "text", "message"),
    [
        (HALF, "", "measure must be a text such as 'SWS front' or 'name = SWS front', got ''"),
        (HALF, "= SWS", "measure must be a text such as 'SWS front' or 'name = SWS front', got '= SWS'"),
        (HALF, 3, "measure must be a text such as 'SWS front' or 'name = SWS front', got 3"),
        (HALF, "SWS left", "SWS must be of one of front, rear, got 'left'"),
        (HALF, "DTL driver", "DTL must be of one of front, rear, got 'driver'"),
        (QUARTER, "SWS front", "SWS must be of one of all wheels, got 'front'"),
        (DRIVER.on(HALF), "DLC driver", "DLC must be of one of front, rear, got 'driver'"),
        (DRIVER.on(QUARTER), "SWS passenger", "SWS must be of one of driver, got 'passenger'"),
        (DRIVER.on(HALF), "ACC rear", "ACC must be of one of body, driver or a point (x, y), got 'rear'"),
        (HALF, "ACC pitch", "ACC must be of one of body or a point (x, y), got 'pitch'"),
        (HALF, "ACC (1, 2", "ACC must be of one of body or a point (x, y), got '(1, 2'"),
        (HALF, "Wz body_acceleration", "weighting must be one of Wk, Wd, Wf, Wc, We, Wj, Wb, Wk-table, Wb"),
        (HALF, "roll_acceleration", "response must be one of body_acceleration, pitch_acceleration, "),
        (HALF, "SWS + DTL", "SWS must be of one of front, rear, got '+ DTL'"),
        (HALF, "comfort = Wk body_acceleration + ", "measure must be ACC, SWS, DTL, DLC, or terms like"),
        (HALF, "a b c d",
         "measure must be ACC, SWS, DTL, DLC, or terms like '0.4 We pitch_acceleration', got 'a b c d'"),
        (HALF, "roll_gradient", "roll_gradient must be of a vehicle that rolls, got one with body, front_wheel, "),
        (QUARTER, "-roll_damping", "roll_damping must be of a vehicle that rolls, got one with wheel, body"),
    ],
)  # fmt: skip
def test_rejects_texts_that_mean_nothing(vehicle, text, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        case_measure(text, on_road(vehicle), "Wk")
    assert "\n" not in str(caught.value)


@given(st.text(alphabet="ACSWDTLk_=+-.()0129e, frontlacei", max_size=40))
def test_any_text_is_a_measure_or_a_value_error_of_one_line(text):
    try:
        found = case_measure(text, on_road(HALF), "Wk")
    except ValueError as caught:
        message = str(caught)
    else:
        message = "" if found.terms or found.values else "\n"
    assert "\n" not in message


@pytest.mark.parametrize(
    ("text", "value", "g"),
    [
        ("SWS <= 0.03", 0.024, 0.024 / 0.03 - 1),
        ("SWS front<=3e-2", 0.036, 0.2),
        ("roll_gradient <= 5", 6.0, 0.2),
        ("roll_damping >= 0.2", 0.15, 1 - 0.15 / 0.2),
        ("roll_gradient >= -4", -5.0, 0.25),
        ("roll_gradient <= 0", 0.5, 0.5),
    ],
)
def test_a_limit_is_met_where_g_is_at_most_zero(text, value, g):
    found = case_limit(text, on_road(FULL), "Wk")
    assert found.scale * value + found.offset == pytest.approx(g, rel=1e-12)


LIKE = "constraint must be like 'SWS <= 0.03' or 'roll_damping >= 0.2', got "


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("SWS", LIKE + "'SWS'"),
        ("SWS <= much", LIKE + "'SWS <= much'"),
        ("SWS <= nan", LIKE + "'SWS <= nan'"),
        ("SWS <= inf", LIKE + "'SWS <= inf'"),
        ("SWS < 0.03", LIKE + "'SWS < 0.03'"),
        (0.03, LIKE + "0.03"),
        ("SWS >= 0.01", "constraint on a measure of the ride must be <= a limit above zero, got 'SWS >= 0.01'"),
        ("SWS <= 0", "constraint on a measure of the ride must be <= a limit above zero, got 'SWS <= 0'"),
        (
            "-roll_damping <= -0.2",
            "constraint must limit a measure without - in front, got '-roll_damping <= -0.2'",
        ),
        ("SWS seat <= 0.03", "SWS must be of one of front_left, front_right, rear_left, rear_right, got 'seat'"),
        (" <= 0.03", "measure must be a text such as 'SWS front' or 'name = SWS front', got ' '"),
    ],
)
def test_rejects_limits_that_are_none(text, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        case_limit(text, on_road(FULL), "Wk")


def test_measures_of_handling_are_those_of_the_mechanics():
    names = ("roll_gradient", "front_load_transfer", "-roll_damping")
    bounds = {"front_antiroll": (0.0, 3e4), "rear.damper": (1e3, 3e3)}
    fixed = {"front": (2e4, 1500.0), "rear.spring": 2e4}
    p = RideProblem(
        cases=[on_road(FULL)], measures=("ACC", *names),
        bounds=bounds, struts=fixed, band=BAND, nodes=NODES,
    )  # fmt: skip
    assert p.kernel is None
    assert [p.units[name] for name in names] == ["deg/g", "-", "-"]
    found = p.evaluate([[1e4, 1500.0], [2e4, 2500.0]])
    mechanics = FULL.statics
    for row, (bar, damper) in zip(found, ((1e4, 1500.0), (2e4, 2500.0)), strict=True):
        values = np.array([list(FULL.coefficients(
            {"front": (2e4, 1500.0), "rear": (2e4, damper), "front_antiroll": bar}).values())])  # fmt: skip
        expected = [
            mechanics.roll_gradient(values, GEOMETRY)[0],
            mechanics.front_load_transfer(values, GEOMETRY)[0],
            -mechanics.roll_damping(values)[0],
        ]
        np.testing.assert_allclose(row[1:], expected, rtol=1e-12)


def own_problem(measures: tuple, **changes) -> RideProblem:
    return RideProblem(
        DRIVER.on(FULL), ROAD, speed=SPEED, band=BAND, nodes=NODES, measures=measures,
        struts={"rear": (2e4, 1500.0)}, **changes,
        bounds={"front.spring": (1.8e4, 2.2e4), "front.damper": (1.2e3, 1.8e3)},
    )  # fmt: skip


DESIGNS = np.array([[1.9e4, 1.3e3], [2.1e4, 1.7e3]])


def area(frequency: np.ndarray, spectra: dict) -> float:
    return float(np.sqrt(np.trapezoid(spectra["driver_acceleration"], frequency)))


def test_a_measure_of_ones_own_takes_spectra():
    """The root of the area under a spectrum is the root mean square, to the steps of the sum."""
    found = own_problem(("driver_acceleration", Measure("mine", "m/s^2", area))).evaluate(DESIGNS)
    np.testing.assert_allclose(found[:, 1], found[:, 0], rtol=2e-3)


def test_spectra_of_a_measure_are_those_of_the_closed_model():
    seen = []
    problem = own_problem(("ACC", Measure("mine", "-", lambda f, spectra: seen.append((f, spectra)) or 1.0)))
    problem.evaluate(DESIGNS)
    for design, (f, spectra) in zip(DESIGNS, seen, strict=True):
        setting = {**problem.struts, **dict(zip(problem.variables, design, strict=True))}
        cross = ROAD.cross_spectrum(f, SPEED, problem.vehicle.contact_points)
        expected = response_psds(problem.vehicle.closed(setting), f, cross)
        assert spectra.keys() == expected.keys()
        for name, psd in spectra.items():
            np.testing.assert_allclose(psd, expected[name], rtol=1e-9, atol=1e-12 * expected[name].max())


def test_a_measure_of_ones_own_takes_designs():
    """It may be limited by its name, from either side; then no compiled function stands for all."""
    cost = Measure("cost", "EUR", lambda designs: designs @ [1e-3, 1e-2])
    problem = own_problem(("ACC", cost), constraints=("cost <= 35", "cost >= 34", "SWS <= 0.03"))
    found = problem.evaluate(DESIGNS)
    np.testing.assert_allclose(found[:, 1], [32.0, 38.0], rtol=1e-12)
    np.testing.assert_allclose(found[:, 2:4], [[32 / 35 - 1, 1 - 32 / 34], [38 / 35 - 1, 1 - 38 / 34]], rtol=1e-12)
    assert (problem.units["cost"], problem.objectives, problem.kernel) == ("EUR", ("ACC", "cost"), None)


def test_a_measure_of_ones_own_over_load_cases_is_their_mean_or_the_worst():
    cases = [LoadCase(vehicle=FULL, road=ROAD, speed=v, share=share) for v, share in ((10.0, 3.0), (20.0, 1.0))]
    own = Measure("mine", "m/s^2", lambda f, spectra: np.sqrt(spectra["body_acceleration"].max()))
    one = {"struts": {"rear": (2e4, 1500.0), "front.damper": 1500.0}, "bounds": {"front.spring": (1.8e4, 2.2e4)}}
    options = {"measures": ("ACC", own), "band": BAND, "nodes": NODES, **one}
    slow, fast = (RideProblem(cases=[case], **options).evaluate([[2e4]])[0, 1] for case in cases)
    for worst, expected in ((False, (3 * slow + fast) / 4), (True, fast)):
        found = RideProblem(cases=cases, worst_case=worst, **options).evaluate([[2e4]])[0, 1]
        assert found == pytest.approx(expected, rel=1e-12)


def test_all_measures_may_be_ones_own():
    measures = (Measure("mine", "m/s^2", area), Measure("cost", "EUR", lambda designs: designs[:, 0]))
    found = own_problem(measures).evaluate(DESIGNS)
    np.testing.assert_allclose(found[:, 0], own_problem(("ACC", measures[0])).evaluate(DESIGNS)[:, 1], rtol=1e-9)
    np.testing.assert_array_equal(found[:, 1], DESIGNS[:, 0])


def test_the_ride_takes_a_measure_of_ones_own():
    table = ride(
        DRIVER.on(FULL), struts_of(FULL), ROAD, SPEED, band=BAND, measures=[Measure("mine", "m/s^2", area)]
    )
    assert table.value["mine"] == pytest.approx(table.value["driver_acceleration"], rel=2e-3)
    assert table.unit["mine"] == "m/s^2"


@pytest.mark.parametrize("function", [lambda: 1.0, lambda a, b, c: 1.0, 3.0])
def test_a_measure_of_ones_own_takes_designs_or_spectra(function):
    with pytest.raises(ValueError, match=r"^function must take designs, or frequency and spectra, got "):
        Measure("mine", "-", function)


@pytest.mark.parametrize("value", [np.nan, [1.0, 2.0, 3.0]])
def test_a_measure_of_ones_own_returns_a_finite_number(value):
    with pytest.raises(ValueError, match=r"^measure mine must return a finite number for each design, got "):
        own_problem(("ACC", Measure("mine", "-", lambda designs: value))).evaluate(DESIGNS)

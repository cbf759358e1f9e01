"""Measures by texts and as objects, and those of a user's own."""

import pickle
import re
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage import DRIVER, FULL, HALF, QUARTER, ROAD, SPEED, on_road, struts_of
from suspension_ctrl import (
    ACC,
    DLC,
    DTL,
    SWS,
    FrontLoadTransfer,
    LoadCase,
    Measure,
    RideProblem,
    RollDamping,
    RollGradient,
    RootSumSquare,
    Term,
    response_psds,
    ride,
)
from suspension_ctrl.response.measures.measure import measure_of
from suspension_ctrl.response.measures.terms import CaseMeasure

BAND, NODES = (0.1, 20.0), 256

names = st.one_of(st.just(""), st.text("abc XYZ_09<>-+(),.", max_size=12))
coordinates = st.floats(-1e6, 1e6).map(lambda x: x + 0.0)  # no -0.0, which equals 0.0
words = st.sampled_from(["front", "rear_left", "driver", "left", "x1"])
points = st.tuples(coordinates, coordinates)
terms = st.builds(
    Term,
    st.one_of(words.map("{}_acceleration".format), st.tuples(st.just("acceleration"), coordinates, coordinates)),
    st.sampled_from([None, "Wk", "We", "Wb-table"]),
    st.floats(0, 1e6, exclude_min=True),
)
OPTIONS = {"name": names, "maximise": st.booleans()}
written = st.one_of(
    st.builds(ACC, st.one_of(st.just(""), words, points), **OPTIONS),
    *(st.builds(kind, st.one_of(st.just(""), words), **OPTIONS) for kind in (SWS, DTL, DLC)),
    *(st.builds(kind, **OPTIONS) for kind in (RollDamping, RollGradient, FrontLoadTransfer)),
    st.builds(RootSumSquare, st.lists(terms, min_size=1, max_size=4), **OPTIONS),
)


@given(written)
def test_a_measure_is_read_from_its_text(measure):
    assert Measure.parse(str(measure)) == measure
    assert measure_of(str(measure)).label == measure.label
    assert pickle.loads(pickle.dumps(measure)) == measure


def test_a_measure_is_called_as_it_is_written():
    texts = (" ACC  driver ", "my comfort= Wk x_acceleration + y", "a = b", "- DTL", "ACC (1.20, 0.0)", "2e-1 x")
    called = ["ACC driver", "my comfort", "a", "- DTL", "ACC (1.20, 0.0)", "2e-1 x"]
    assert [Measure.parse(text).label for text in texts] == called
    assert [str(Measure.parse(text)) for text in texts[3:]] == [
        "- DTL = -DTL", "ACC (1.20, 0.0) = ACC (1.2, 0)", "2e-1 x = 0.2 x",
    ]  # fmt: skip
    assert [ACC().label, ACC(name=" my  comfort ").label, DTL("rear", maximise=True).label] == [
        "ACC", "my comfort", "-DTL rear",
    ]  # fmt: skip


def test_a_measure_is_shown_with_its_unit():
    assert repr(ACC("driver", name="comfort")) == "<comfort = ACC driver [m/s^2]>"
    assert repr(Measure("cost", "EUR", lambda designs: designs[:, 0])) == "<cost [EUR]>"
    assert [kind().unit for kind in (SWS, DTL, DLC, RollGradient)] == ["m", "N", "-", "deg/g"]


def test_measures_are_frozen_values():
    measure = SWS("front")
    with pytest.raises(FrozenInstanceError):
        measure.where = "rear"
    assert replace(measure, where="rear") == SWS("rear") != measure
    assert len({SWS("front"), measure, DTL("front"), SWS("front", maximise=True)}) == 3
    assert isinstance(measure, Measure)


def test_a_class_stands_for_its_default_measure():
    assert measure_of(DTL) == DTL()
    with pytest.raises(TypeError, match=r"^RollDamping takes name and maximise alone, got \('front',\)$"):
        RollDamping("front")


@pytest.mark.parametrize("name", ["a = b", 3])
def test_a_name_is_a_text_without_an_equals_sign(name):
    with pytest.raises(ValueError, match=r"^name of a measure must be a text without =, got "):
        ACC(name=name)


def test_a_measure_of_ones_own_has_a_name():
    with pytest.raises(ValueError, match=r"^name of a measure must be a text without =, got ''$"):
        Measure(" ", "-", lambda designs: designs[:, 0])


def test_a_subclass_alone_is_a_further_measure():
    """It has a text, stands among others, and its mean square is an integral like all others."""

    class Jerk(ACC, word="jerk", unit="m/s^3"):
        def in_case(self, case, weighting, /):
            return CaseMeasure((Term(self.response(case.vehicle), weighting, moment=2),))

    try:
        options = {"speed": SPEED, "band": BAND, "bounds": {"spring": (1.8e4, 2.2e4), "damper": (1e3, 2e3)}}
        problem = RideProblem(
            QUARTER, ROAD, measures=["jerk", Jerk(name="rate"), "ACC"], weighting=None, **options
        )
        rate = Measure(
            "rate", "m/s^3",
            lambda f, psd: np.sqrt(((2 * np.pi * f) ** 2 * psd["body_acceleration"]).mean() * (BAND[1] - BAND[0])),
        )  # fmt: skip
        by_spectrum = problem.replace(measures=[rate, "ACC"]).evaluate(DESIGNS)
        found = problem.evaluate(DESIGNS)
        np.testing.assert_allclose(found[:, :2], by_spectrum[:, :1] * [1.0, 1.0], rtol=2e-3)  # of 1000 middles
        assert (problem.objectives, problem.units["jerk"]) == (("jerk", "rate", "ACC"), "m/s^3")
        assert problem.kernel is not None
    finally:
        del Measure.words["jerk"]


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
        (HALF, "Wz body_acceleration", "weighting must be one of Wk, Wd, Wf, Wc, We, Wj, Wb, Wm, Wh, Wk-table"),
        (HALF, "roll_acceleration", "response must be one of body_acceleration, "),
        (HALF, "SWS + DTL", "SWS must be of one of front, rear, got '+ DTL'"),
        (HALF, "comfort = Wk body_acceleration + ", "measure must be "),
        (HALF, "a b c d",
         "measure must be "),
        (HALF, "roll_gradient", "roll_gradient must be of a vehicle that rolls, got one with body, front_wheel, "),
        (QUARTER, "-roll_damping", "roll_damping must be of a vehicle that rolls, got one with wheel, body"),
    ],
)  # fmt: skip
def test_rejects_texts_that_mean_nothing(vehicle, text, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        Measure.parse(text).in_case(on_road(vehicle), "Wk")
    assert "\n" not in str(caught.value)


@given(st.text(alphabet="ACSWDTLk_=+-.()0129e, frontlacei", max_size=40))
def test_any_text_is_a_measure_or_a_value_error_of_one_line(text):
    try:
        found = Measure.parse(text).in_case(on_road(HALF), "Wk")
    except ValueError as caught:
        message = str(caught)
    else:
        message = "" if found.terms or found.values else "\n"
    assert "\n" not in message


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

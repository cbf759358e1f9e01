"""Limits by texts and as objects."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garage import FULL, QUARTER, ROAD, on_road
from suspension_ctrl import ACC, DTL, SWS, Bottoming, Lift, Limit, Measure, RideProblem, RollDamping, RollGradient

COST = Measure("cost", "EUR", lambda designs: designs @ [1e-3, 1e-2])
BOUNDS = {"spring": (1.8e4, 2.2e4), "damper": (1e3, 2e3)}


@given(
    st.sampled_from([SWS("front"), ACC((1.2, -0.4)), RollDamping(name="roll"), COST]),
    st.sampled_from(["maximum", "minimum"]),
    st.floats(-1e300, 1e300),
)
def test_a_limit_is_read_from_its_text(measure, side, value):
    limit = Limit(measure, **{side: value})
    assert Limit.parse(str(limit), [COST]) == limit


@pytest.mark.parametrize(
    ("text", "limit"),
    [
        ("SWS <= 12mm", Limit(SWS(), 0.012)),
        ("DTL front <= 1.5 kN", Limit(DTL("front"), 1500.0)),
        ("bottoming front 60mm <= 1 /km", Limit(Bottoming("front", gap=0.06, name="bottoming front 60mm"), 1.0)),
        ("bottoming front <= 1 /km", Limit(Bottoming("front"), 1.0)),
        ("bottoming front <= 1/km", Limit(Bottoming("front"), 1.0)),
        ("bottoming front <= 0.002 /m", Limit(Bottoming("front"), 2.0)),
        ("lift rear <= 0.01 %", Limit(Lift("rear"), 1e-4)),
        ("lift rear <= 1e-4", Limit(Lift("rear"), 1e-4)),
        ("roll_gradient <= 6 deg/g", Limit(RollGradient(), 6.0)),
        ("cost >= 20 EUR", Limit(COST, minimum=20.0)),
    ],
)
def test_a_number_may_have_a_unit(text, limit):
    assert Limit.parse(text, [COST]) == limit


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("SWS <= 12 kg", "limit of SWS must be in m or a unit like it, got '12kg' in kg"),
        ("lift <= 3 mm", "limit of lift must be a number without unit, got '3mm' in mm"),
        ("SWS <= 12 furlong", "limit of SWS must be in units of kg, m, s, .*, got 'furlong'"),
        ("SWS <= 1e-999999999 mm", "limit of SWS must be .*"),
    ],
)
def test_a_unit_that_does_not_fit_is_one_line(text, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        Limit.parse(text)


def test_a_limit_is_shown_with_its_unit():
    assert repr(Limit(SWS("front"), 0.03)) == "<SWS front <= 0.03 m>"
    assert repr(Limit(RollDamping(), minimum=2)) == "<roll_damping >= 2 ->"


def test_limits_of_a_problem_are_objects_or_texts():
    """A measure of the problem may be called by its name."""
    comfort = ACC(name="comfort")
    texts = ("SWS <= 0.03", "comfort <= 1.5", "cost >= 20")
    objects = (Limit(SWS, 0.03), Limit(comfort, 1.5), Limit(COST, minimum=20.0))
    options = {"bounds": BOUNDS, "measures": [comfort, SWS, COST]}
    by_text, by_object = (
        RideProblem(QUARTER, ROAD, speed=20.0, constraints=each, **options) for each in (texts, objects)
    )
    assert by_text == by_object
    assert by_text.constraints == objects
    acc, sws, cost, *g = by_text.evaluate([[2e4, 1500.0]])[0]
    np.testing.assert_allclose(g, [sws / 0.03 - 1, acc / 1.5 - 1, 1 - cost / 20], rtol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "limit must have a maximum or a minimum, got None and None"),
        ({"maximum": 2.0, "minimum": 1.0}, "limit must have a maximum or a minimum, got 2.0 and 1.0"),
        ({"maximum": np.nan}, "maximum must be a number from -1e+300 to 1e+300, got nan"),
        ({"minimum": "1"}, "minimum must be a number from -1e+300 to 1e+300, got '1'"),
    ],
)
def test_a_limit_is_a_maximum_or_a_minimum(arguments, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Limit(DTL(), **arguments)


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
    found = Limit.parse(text)
    found.in_case(on_road(FULL), "Wk")
    assert found.scale * value + found.offset == pytest.approx(g, rel=1e-12)


LIKE = "constraint must be like 'SWS <= 30mm' or 'roll_damping >= 0.2', got "


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
        Limit.parse(text).in_case(on_road(FULL), "Wk")

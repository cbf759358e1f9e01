import pytest
import typer

from suspension_ctrl.commands import options


def test_lists_hold_each_once_in_order():
    assert options.whole_numbers("sizes", "3, 1,3") == [3, 1]
    assert options.names("b, a,b") == ["b", "a"]
    assert options.numbers("design", "22kN/m, 1.5e3", ["N/m", "N s/m"]) == (22e3, 1500.0)
    units = {"front.spring": "N/m"}
    assert options.by_name("setting", "front.spring=10 kN/m, damper=2,", units) == {
        "front.spring": 1e4,
        "damper": 2.0,
    }
    assert options.by_name("setting", "", units) == {}


@pytest.mark.parametrize(
    ("text", "band"),
    [("0.5, 2e1", (0.5, 20.0)), ("0.5Hz..", (0.5, 20.0)), ("..80", (0.0, 80.0)), ("1..2", (1.0, 2.0)),
     ("0.5..10Hz", (0.5, 10.0))],
)  # fmt: skip
def test_a_band_is_two_frequencies_or_ends_where_the_papers_ends(text, band):
    assert options.band(text) == band


def test_settings_are_those_given():
    assert options.settings(None, None) == {}
    assert options.settings("Wb", "1,2") == {"weighting": "Wb", "band": (1.0, 2.0)}


@pytest.mark.parametrize("text", ["1", "1,2,3", "1,x", "", ",", "1,2kg", "1..2..3"])
def test_a_list_of_another_length_or_kind_is_refused(text):
    with pytest.raises(ValueError, match=r"^band must be .*, got "):
        options.band(text)


@pytest.mark.parametrize("text", ["spring", "spring=", "spring=x", "spring=2kg"])
def test_a_setting_is_numbers_by_name(text):
    with pytest.raises(ValueError, match=r"^setting (spring )?must be .*, got "):
        options.by_name("setting", text, {"spring": "N/m"})


def test_a_number_of_an_option_may_have_a_unit():
    assert [options.in_unit("m/s")(text) for text in ("20", "72km/h", "72 km/h")] == [20.0, 20.0, 20.0]


@pytest.mark.parametrize(
    ("parser", "text"),
    [(options.in_unit("m/s"), "fast"), (options.in_unit("m/s"), "20kg"), (options.whole_number, "1.5")],
)
def test_numbers_are_named_with_their_value(parser, text):
    with pytest.raises(typer.BadParameter, match=f"^must be .*, got '{text}'"):
        parser(text)

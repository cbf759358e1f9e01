import pytest
import typer

from suspension_ctrl.commands import options


def test_lists_hold_each_once_in_order():
    assert options.whole_numbers("sizes", "3, 1,3") == [3, 1]
    assert options.names("b, a,b") == ["b", "a"]
    assert options.numbers("band", "0.5, 2e1", 2) == (0.5, 20.0)
    assert options.by_name("setting", "front.spring=1e4, damper=2,") == {"front.spring": 1e4, "damper": 2.0}
    assert options.by_name("setting", "") == {}


def test_settings_are_those_given():
    assert options.settings(None, None) == {}
    assert options.settings("Wb", "1,2") == {"weighting": "Wb", "band": (1.0, 2.0)}


@pytest.mark.parametrize("text", ["1", "1,2,3", "1,x", "", ","])
def test_a_list_of_another_length_is_refused(text):
    with pytest.raises(ValueError, match=r"^band must be 2 numbers separated by commas, got "):
        options.numbers("band", text, 2)


@pytest.mark.parametrize(("parser", "text"), [(options.number, "fast"), (options.whole_number, "1.5")])
def test_numbers_are_named_with_their_value(parser, text):
    with pytest.raises(typer.BadParameter, match=text):
        parser(text)

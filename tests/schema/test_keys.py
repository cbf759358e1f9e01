"""Keys of the fields of dataclasses."""

from suspension_ctrl.schema.keys import BAD, bad, keys_of
from wheels import Wheel


def test_a_field_has_a_key_with_its_unit_or_the_key_of_its_metadata():
    keys = list(keys_of(Wheel))
    assert keys[:5] == ["mass_kg", "place_m", "called", "camber_rad", "lift_m"]


def test_a_field_without_a_default_is_required():
    assert [one.name for one in keys_of(Wheel).values() if one.required] == ["mass", "place", "name"]


def test_a_wrong_number_is_replaced_by_1_and_another_wrong_value_marked():
    keys = keys_of(Wheel)
    assert [keys[key].stand_in for key in ("mass_kg", "slip", "place_m", "called")] == [1.0, 1.0, BAD, BAD]


def test_a_mark_is_found_in_tuples_of_any_depth():
    assert bad((1, (BAD,)))
    assert bad(1, BAD)
    assert not bad(1, (2, (3,)), None)

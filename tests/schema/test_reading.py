"""Dataclasses read from tables of files: values, units, all mistakes."""

import re

import numpy as np
import pytest

from suspension_ctrl.documents import Mistakes, Table
from suspension_ctrl.schema.keys import BAD, KIND, bad, keys_of
from suspension_ctrl.schema.reading import kind_of, read, read_record
from wheels import FULL, GOOD, NUMBER, WHEEL, Track, Tyre, Wheel, accepted, refused


def test_a_dataclass_is_made_by_the_names_units_and_types_of_its_fields():
    assert accepted(FULL) == WHEEL
    assert accepted(GOOD) == Wheel(20.0, (1.0, 0.5), "left")


def test_a_key_without_its_unit_takes_texts_with_units():
    texts = {"mass": "0.02 t", "place": ["1000mm", "50 cm"], "called": "left", "camber": "0.1rad"}
    assert accepted(texts) == Wheel(20.0, (1.0, 0.5), "left", 0.1)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass_kg": -1}, "mass_kg must be finite and > 0 kg, got -1.0"),
        ({"mass_kg": "1"}, f"mass_kg must be {NUMBER}, got '1'"),
        ({"mass_kg": True}, f"mass_kg must be {NUMBER}, got True"),
        ({"mass_kg": 1e13}, f"mass_kg must be {NUMBER}, got 10000000000000.0"),
        ({"mass_kg": float("nan")}, f"mass_kg must be {NUMBER}, got nan"),
        ({"camber_rad": -0.1}, "camber_rad must be finite and >= 0 rad, got -0.1"),
        ({"camber": "6 m"}, "camber must be in rad or a unit like it, got '6 m' in m"),
        ({"camber": "-6deg"}, "camber must be finite and >= 0 rad, got -0.10471975511965977"),
        ({"camber": "6"}, "camber must be a number with a unit like rad, got '6'"),
        ({"camber": 6}, "camber must be a text with a unit like '1 rad', or camber_rad a number, got 6"),
        ({"camber_rad": 0.1, "camber": "6deg"}, "camber must be given once, got camber and camber_rad"),
        ({"lift_m": 2}, "lift_m must be a number from -1 to 1, got 2.0"),
        ({"place_m": [1]}, "place_m must be an array of two numbers, got [1]"),
        ({"place_m": 1}, "place_m must be an array of two numbers, got 1"),
        ({"place_m": [1, "2m"]}, f"place_m[2] must be {NUMBER}, got '2m'"),
        ({"spokes": []}, "spokes must be an array of up to 100 numbers, got []"),
        ({"spokes": [1] * 101}, "spokes must be an array of up to 100 numbers, got [1, 1, 1, 1, 1, 1, ...]"),
        ({"called": " "}, "called must be a text, got ' '"),
        ({"called": 3}, "called must be a text, got 3"),
        ({"called": "spare"}, "called must be of a wheel in use, got 'spare'"),
        ({"words": "a"}, "words must be an array of texts, got 'a'"),
        ({"words": ["a", 1]}, "words must be an array of texts, got ['a', 1]"),
        ({"driven": 1}, "driven must be true or false, got 1"),
        ({"tyre": 3}, "tyre must be a table, got 3"),
        ({"tyre": {}}, "tyre.stiffness_N_per_m must be given, got none"),
        ({"tyres": [{}] * 4}, "tyres must be an array of up to 3 tables, got [{}, {}, {}, {}]"),
        ({"tyres": [{"stiffness_N_per_m": 1}, 3]}, "tyres[2] must be a table, got 3"),
        ({"ground": {"kind": "grass"}}, "ground.kind must be one of tyre, track, got 'grass'"),
        ({"ground": {}}, "ground.kind must be one of tyre, track, got None"),
        ({"ground": {"kind": "track"}}, "ground.links must be given, got none"),
        ({"weights": []}, "weights must be an array of tables, one at least, each for a place of its own, got []"),
        (
            {"weights": [{"place_m": [0, 1], "share_percent": [1]}] * 2},
            "weights must be an array of tables, one at least, each for a place of its own, got "
            "[(0.0, 1.0), (0.0, 1.0)]",
        ),
        ({"weights": [{"place_m": [0, 1]}]}, "weights[1].share_percent must be given, got none"),
    ],
)
def test_a_wrong_value_is_one_line(changes, message):
    assert refused(GOOD | changes) == [f"wheel.{message}"]


@pytest.mark.parametrize(
    ("key", "message"),
    [
        ("camber_deg", "camber_deg must be a known key, got 1: did you mean camber_rad?"),
        ("cambr_rad", "cambr_rad must be a known key, got 1: did you mean camber_rad?"),
        ("tire", "tire must be a known key, got 1: did you mean tyre?"),
        ("colour", f"colour must be one of the keys {', '.join(list(keys_of(Wheel))[:8])}, ... and 6 more, got 1"),
    ],
)
def test_a_key_that_is_not_known_is_named_with_the_nearest(key, message):
    mistakes = Mistakes()
    assert read_record(Wheel, Table("", GOOD | {key: 1}), mistakes) == Wheel(20.0, (1.0, 0.5), "left")
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        mistakes.settle()


def test_a_misspelt_key_is_not_missed_as_well():
    assert refused({"mas_kg": 3, "place_m": [0, 0]}) == [
        "wheel.mas_kg must be a known key, got 3: did you mean mass_kg?",
        "wheel.called must be given, got none",
    ]


def test_all_mistakes_of_a_table_are_listed():
    table = {
        "mass_kg": -1, "place_m": [0], "lift_m": 3, "tyre": {"stiffness_N_per_m": 0, "name": 3}, "words": 1,
        "ground": {"kind": "tyre", "stiffness": "2e5 N"},
    }  # fmt: skip
    assert refused(table) == [
        "wheel.mass_kg must be finite and > 0 kg, got -1.0",
        "wheel.place_m must be an array of two numbers, got [0]",
        "wheel.lift_m must be a number from -1 to 1, got 3.0",
        "wheel.tyre.stiffness_N_per_m must be finite and > 0 N/m, got 0.0",
        "wheel.tyre.name must be one of the keys stiffness_N_per_m, got 3",
        "wheel.words must be an array of texts, got 1",
        "wheel.ground.stiffness must be in N/m or a unit like it, got '2e5 N' in N",
        "wheel.called must be given, got none",
    ]


def test_a_wrong_number_is_1_until_all_is_read_and_another_value_is_bad():
    mistakes = Mistakes()
    values = read(Table("", {"mass_kg": "x", "called": 3}), keys_of(Wheel), mistakes)
    assert values["mass"] == 1.0
    assert bad(values["name"], values["place"])
    assert not bad(values["mass"])
    assert len(mistakes) == 3


def test_a_kind_names_a_dataclass():
    mistakes = Mistakes()
    table = Table("", {"kind": "tyre", "stiffness_N_per_m": 3})
    assert kind_of({"tyre": Tyre}, table, mistakes) is Tyre
    assert read_record(Tyre, table, mistakes, KIND) == Tyre(3.0)
    assert kind_of({"track": Track}, table, mistakes) is BAD
    assert len(mistakes) == 1


def test_keys_and_values_are_printable_and_short():
    (said,) = refused(GOOD | {"called": "spare", "\x1b[31m" + "k" * 99: "\u202e" + "v" * 99}, "x.")
    assert said.isprintable()
    assert said.startswith(rf"x.\x1b[31m{'k' * 32} must be one of the keys mass_kg, ")
    assert len(said.partition(", got ")[2]) <= 40


def test_arrays_of_numbers_may_be_long_where_a_field_says_so():
    wheel = accepted(GOOD | {"curve_m": list(range(200))})
    np.testing.assert_array_equal(wheel.curve, np.arange(200))
    assert refused(GOOD | {"curve_m": [1] * 201})[0].startswith(
        "wheel.curve_m must be an array of up to 200 numbers"
    )

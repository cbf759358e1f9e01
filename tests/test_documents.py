"""TOML tables: values by keys with units, and one line about a key that is wrong."""

import re
from dataclasses import dataclass, field

import pytest

from suspension_ctrl.documents import Table, keyed, made, naming, read_toml, under
from suspension_ctrl.quantities import Checked, unit


@dataclass(frozen=True, eq=False, repr=False)
class Wheel(Checked):
    mass: float = field(metadata=unit("kg"))
    place: tuple[float, float] = field(metadata=unit("m"))
    name: str = field(metadata={"key": "called"})
    camber: float = field(default=0.0, metadata=unit("rad"))
    slip: float | None = None
    spokes: tuple[float, ...] = ()
    other: object = None


GOOD = {"mass_kg": 20, "place_m": [1, 0.5], "called": "left"}


def test_a_dataclass_is_made_by_the_names_and_units_of_its_fields():
    table = Table("wheel.", GOOD | {"camber_rad": 0.1, "slip": 2, "spokes": [1, 2], "beside": 3})
    wheel = made(table, Wheel, beside=["beside"], other="given")
    assert wheel == Wheel(20.0, (1.0, 0.5), "left", 0.1, 2.0, (1.0, 2.0), "given")
    assert made(Table("", GOOD), Wheel) == Wheel(20.0, (1.0, 0.5), "left")


NUMBER = "a number from 1e-12 to 1e+12 in size or 0"
KEYS = "mass_kg, place_m, called, camber_rad, slip, spokes"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass_kg": -1}, "wheel.mass_kg must be finite and > 0 kg, got -1.0"),
        ({"mass_kg": "1"}, f"wheel.mass_kg must be {NUMBER}, got '1'"),
        ({"mass_kg": True}, f"wheel.mass_kg must be {NUMBER}, got True"),
        ({"mass_kg": 1e13}, f"wheel.mass_kg must be {NUMBER}, got 10000000000000.0"),
        ({"place_m": [1]}, "wheel.place_m must be an array of two numbers, got [1.0]"),
        ({"place_m": 1}, f"wheel.place_m must be an array of up to 100, each {NUMBER}, got 1"),
        ({"place_m": []}, f"wheel.place_m must be an array of up to 100, each {NUMBER}, got []"),
        ({"called": " "}, "wheel.called must be a text, got ' '"),
        ({"camber_rad": -0.1}, "wheel.camber_rad must be finite and >= 0 rad, got -0.1"),
        ({"mass_t": 1}, "wheel.mass_t must be mass_kg, got 1"),
        ({"colour": 1}, f"wheel.colour must be one of the keys {KEYS}, got 1"),
    ],
)
def test_a_wrong_key_is_one_line(changes, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        made(Table("wheel.", GOOD | changes), Wheel)


def test_a_key_that_is_needed_is_missed():
    with pytest.raises(ValueError, match=f"^called must be given, got none: keys are {KEYS}$"):
        made(Table("", {"mass_kg": 1, "place_m": [0, 0]}), Wheel)


def test_tables_in_tables():
    table = Table("", {"a": {"b": {"c": 1}, "d": 2}, "e": [{"f": 3}], "on": True})
    assert table.table("a").name == "a."
    assert table.table("none").content == {}
    assert table.table("a").flat().content == {"b.c": 1, "d": 2}
    assert [one.name for one in table.tables("e")] == ["e[1]."]
    assert table.tables("none") == []
    assert table.boolean("on") is True
    assert Table("x.", {"kind": "b"}).choice("kind", {"a": 1, "b": 2}) == 2


@pytest.mark.parametrize(
    ("read", "message"),
    [
        (lambda table: table.table("number"), "x.number must be a table, got 3"),
        (lambda table: table.tables("number"), "x.number must be an array of up to 100 tables, got 3"),
        (lambda table: table.tables("numbers"), "x.numbers[1] must be a table, got 1"),
        (lambda table: table.boolean("number"), "x.number must be true or false, got 3"),
        (lambda table: table.choice("number", {"a": 1, "b": 2}), "x.number must be one of a, b, got 3"),
        (lambda table: table.choice("none", {"a": 1, "b": 2}), "x.none must be one of a, b, got None"),
    ],
)
def test_values_of_another_kind_are_one_line(read, message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        read(Table("x.", {"number": 3, "numbers": [1]}))


def test_arrays_have_an_end():
    table = Table("", {"tables": [{}] * 3, "numbers": [1.0] * 101})
    assert len(table.tables("tables", most=3)) == 3
    with pytest.raises(ValueError, match=r"^tables must be an array of up to 2 tables, got \[\{\}, \{\}, \{\}\]$"):
        table.tables("tables", most=2)
    with pytest.raises(
        ValueError, match=f"^numbers must be an array of up to 100, each {re.escape(NUMBER)}, got "
    ):
        table.numbers("numbers")


def test_errors_name_the_file_and_the_key(tmp_path):
    path = tmp_path / "a.toml"
    refused = pytest.raises(ValueError, match=r"> 0 kg$")
    with refused as error, naming(path), under("cases[2]"), keyed("seats[1].", {"mass_kg": "mass"}):
        raise ValueError("mass must be\n> 0 kg")
    assert str(error.value) == f"{path}: cases[2]: seats[1].mass_kg must be > 0 kg"


def test_a_file_is_toml_in_utf_8_with_or_without_a_mark(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbfx = 1")
    assert read_toml(path).content == {"x": 1}
    path.write_bytes(b"x = ")
    with pytest.raises(
        ValueError, match=r"^the file must be TOML in UTF-8, got Invalid value \(at end of document\)$"
    ):
        read_toml(path)


@pytest.mark.parametrize(
    ("content", "got"),
    [
        ("root:x:0:0", "Expected '=' after a key in a key/value pair (at line 1, column 5)"),
        ("x = 'secret\x01'", "Found invalid character (at line 1, column 12)"),
        ("x = {secret = 1, secret = 2}", "Duplicate inline table key (at line 1, column 28)"),
        ("[secret]\n[secret]", "Cannot declare (at line 2, column 8)"),
        ("secret = {}\n[secret.x]", "Cannot declare (at line 2, column 10)"),
        (f"x = 1{'0' * 5000}", "Exceeds the limit (4300 digits) for integer string conversion"),
        (f"x{'.x' * 501} = 1", "a line of 501 dots, 500 are the most"),
        (b"secret\xff", "another encoding"),
    ],
)
def test_an_error_about_a_file_that_is_no_toml_quotes_nothing_of_it(tmp_path, content, got):
    path = tmp_path / "a.toml"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(ValueError, match="^the file must be TOML in UTF-8, got " + re.escape(got)) as error:
        read_toml(path)
    assert "secret" not in str(error.value)


@pytest.mark.parametrize(
    "error", [RecursionError("x"), OverflowError(34, "x"), MemoryError(), ZeroDivisionError("x")]
)
def test_tables_and_numbers_that_go_too_far_are_one_line(error):
    kind = type(error).__name__
    far = f"^a.toml: the file must have tables of moderate depth and numbers of moderate size, got a {kind}$"
    with pytest.raises(ValueError, match=far), naming("a.toml"):
        raise error


def test_deep_tables_are_one_line(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text(f"x = {'[' * 5000}")
    with pytest.raises(ValueError, match=r"got a RecursionError$"), naming(path):
        read_toml(path)


def test_keys_values_and_paths_are_printable_and_values_short():
    table = Table("x.", {"\x1b[31m" + "k" * 99: "\u202e" + "v" * 99})
    with pytest.raises(ValueError, match=r"^[^\n]*$") as error, naming("\x1b]0;.toml"):
        table.check_keys({"a": "a"})
    said = str(error.value)
    assert said.isprintable()
    assert said.startswith(rf"\x1b]0;.toml: x.\x1b[31m{'k' * 32} must be one of the keys a, got '\u202e")
    assert len(said.partition(", got ")[2]) <= 40

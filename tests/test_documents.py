"""Files of TOML: an error names file, line and key, several mistakes are a line each, no more is quoted."""

import re

import pytest

from suspension_ctrl.documents import (
    FileError,
    Folder,
    Mistakes,
    Table,
    document,
    keyed,
    line_numbers,
    lines_of,
    naming,
)


def test_an_error_of_a_document_names_the_file_the_line_and_the_key(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("x = 1\n[a]\nb = 2\n")
    with pytest.raises(FileError, match=rf"^{re.escape(str(path))}:3: a.b must be 1$"), document(path):
        raise ValueError("a.b must be 1")
    with document(path) as table:
        assert table == Table("", {"x": 1, "a": {"b": 2}}, Folder(tmp_path))


def test_several_mistakes_are_one_error_of_a_line_each(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("x = 1\ny = 2\n")
    mistakes = Mistakes()
    with mistakes.noted():
        raise ValueError("y must be\n3")
    with mistakes.noted("x: "), naming("b.csv"):
        raise ValueError("row 1 must be 4")
    with mistakes.noted("x: "):
        raise FileError("one\ntwo")
    mistakes.note("none of these")
    assert len(mistakes) == 5
    with pytest.raises(FileError) as error, document(path):
        mistakes.settle()
    assert lines_of(error.value) == [
        f"{path}:2: y must be 3",
        f"{path}:1: x: b.csv: row 1 must be 4",
        f"{path}:1: x: one",
        f"{path}:1: x: two",
        f"{path}: none of these",
    ]


def test_without_mistakes_nothing_is_raised():
    mistakes = Mistakes()
    mistakes.settle()
    assert len(mistakes) == 0


def test_the_same_mistake_is_noted_once():
    mistakes = Mistakes()
    for _ in range(3):
        mistakes.note("x must be 1")
    assert len(mistakes) == 1


def test_an_error_lists_twenty_mistakes_and_the_number_of_the_others():
    with pytest.raises(FileError) as error, naming("a.toml"):
        raise FileError("\n".join(f"x{i} must be 1" for i in range(25)))
    lines = lines_of(error.value)
    assert lines[19] == "a.toml: x19 must be 1"
    assert lines[20:] == ["a.toml: 5 further mistakes"]


TEXT = """
title = "a"
[[seats]]
name = 'x'
"mass_kg" = 3
[[seats]]
source = \"\"\"
name = "no key"
[nor.a.table]
\"\"\"
name = "y" # name = 3
[struts]
front.spring_N_per_m = 1
[struts . rear]
spring_N_per_m=2
[[cases]]
[[cases.payload]]
[[cases]]
[cases.roll_geometry]
[[cases.payload]]
mass_kg = 3
[[cases.payload]]
  mass_kg = 4
"""


@pytest.mark.parametrize(
    ("key", "line"),
    [
        ("title", 2), ("seats[1]", 3), ("seats[1].name", 4), ("seats[1].mass_kg", 5), ("seats[2].source", 7),
        ("seats[2].name", 11), ("struts.front.spring_N_per_m", 13), ("struts.rear", 14),
        ("struts.rear.spring_N_per_m", 15), ("cases[1].payload[1]", 17), ("cases[2]", 18),
        ("cases[2].roll_geometry", 19), ("cases[2].payload[1].mass_kg", 21), ("cases[2].payload[2].mass_kg", 23),
    ],
)  # fmt: skip
def test_lines_of_keys_and_tables(key, line):
    assert line_numbers(TEXT)[key] == line


@pytest.mark.parametrize(
    ("message", "place"),
    [
        ("title must", ":2"),
        ("seats[1].mass_kg must", ":5"),
        ("seats[2].mass_kg must be given", ":6"),
        ("measures[3]: ACC must", ""),
        ("title[3]: ACC must", ":2"),
        ("cases[1].vehicle: a.toml:3: x must", ":16"),
        ("the file must", ""),
        ("", ""),
    ],
)
def test_an_error_has_the_line_of_its_key_or_of_the_table_around_it(message, place):
    with pytest.raises(FileError, match=f"^a{place}: {re.escape(message)}$"), naming("a", line_numbers(TEXT)):
        raise ValueError(message)


def test_the_key_stands_in_place_of_the_name_of_a_field():
    for message, named in (("mass must be 1", "seats[1].mass_kg must be 1"), ("it must", "seats[1]: it must")):
        with pytest.raises(ValueError, match=f"^{re.escape(named)}$"), keyed("seats[1].", {"mass": "mass_kg"}):
            raise ValueError(message)


def test_a_flat_table_has_dotted_keys():
    assert Table("x.", {"a": {"b": 1}, "c": {}, "d": 2}).flat() == Table("x.", {"a.b": 1, "c": {}, "d": 2})


def test_a_file_is_toml_in_utf_8_with_or_without_a_mark(tmp_path):
    path = tmp_path / "a.toml"
    path.write_bytes(b"\xef\xbb\xbfx = 1")
    with document(path) as table:
        assert table.content == {"x": 1}
    path.write_bytes(b"x = ")
    needed = r": the file must be TOML in UTF-8, got Invalid value \(at end of document\)$"
    with pytest.raises(ValueError, match=needed), document(path):
        pass


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
    needed = ": the file must be TOML in UTF-8, got " + re.escape(got)
    with pytest.raises(ValueError, match=needed) as error, document(path):
        pass
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
    with pytest.raises(ValueError, match=r"got a RecursionError$"), document(path):
        pass


def test_files_and_their_sizes_are_looked_at_first(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("#" * 1_000_001)
    with (
        pytest.raises(ValueError, match=r"a.toml: the file must be a regular one of at most 1 MB"),
        document(path),
    ):
        pass
    with (
        pytest.raises(ValueError, match=r"must be a regular one of at most 1 MB, got another"),
        document(tmp_path),
    ):
        pass


def test_paths_and_mistakes_are_printable_lines():
    with pytest.raises(ValueError, match=r"^[^\n]*$") as error, naming("\x1b]0;\n.toml"):
        raise ValueError("x\u202e must be 1")
    assert str(error.value) == r"\x1b]0;\n.toml: x\u202e must be 1"

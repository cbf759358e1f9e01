"""Layouts of CSV files: spellings of one table, and numbers that pandas and Python read alike."""

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.tables.layouts import HEAD, Layout

SIGNS = [
    ("\t", "."),
    ("\t", ","),
    (";", "."),
    (";", ","),
    (",", "."),
    ("|", "."),
    ("|", ","),
    (" ", "."),
    (" ", ","),
]


def layout_of(text: str) -> Layout:
    return Layout.of(text.splitlines(keepends=True))


def read(text: str, columns=None) -> np.ndarray:
    layout = layout_of(text)
    return layout.values(io.StringIO(text, newline=""), layout.places(columns))


@pytest.mark.parametrize(
    ("text", "names", "separator", "decimal", "comment"),
    [
        ("x,y\n1,2\n", ["x", "y"], ",", ".", "#"),
        ("# a\n\nx;y\n0,5;1\n", ["x", "y"], ";", ",", "#"),
        ("% a, b; c\nx\ty\n1.5\t2\n", ["x", "y"], "\t", ".", "%"),
        ("! a, b\nx|y\n0,5|2\n", ["x", "y"], "|", ",", "!"),
        ("  % a\nx,y\n1,2\n", ["x", "y"], ",", ".", "%"),
        ("1 2\n3 4\n", [], " ", ".", "#"),
        ("0,5   2\n3 4\n", [], " ", ",", "#"),
        ("0 0 # start\n3 4\n", [], " ", ".", "#"),
        ("HV [%],# of runs\n1,2\n", ["HV [%]", "# of runs"], ",", ".", "#"),
        ("x,y,\n1,2,\n", ["x", "y"], ",", ".", "#"),
        ('"x, m";y\n1;2\n', ["x, m", "y"], ";", ".", "#"),
        ("x\n1\n2\n", ["x"], ",", ".", "#"),
        ("x;y\n", ["x", "y"], ";", ".", "#"),
    ],
)
def test_the_first_lines_tell_the_layout(text, names, separator, decimal, comment):
    layout = layout_of(text)
    assert (layout.names, layout.separator, layout.decimal, layout.comment) == (names, separator, decimal, comment)
    assert layout.width == max(len(names), len(names) or 2)


@given(
    st.sampled_from(SIGNS),
    st.lists(st.lists(st.floats(-1e9, 1e9), min_size=3, max_size=3), min_size=1, max_size=5),
    st.booleans(),
    st.booleans(),
    st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_a_table_is_read_to_the_last_bit_however_it_is_spelt(signs, rows, header, closed, end):
    separator, decimal = signs
    last = separator if closed and separator != " " else ""
    lines = [separator.join(repr(x).replace(".", decimal) for x in row) + last for row in rows]
    text = end.join([*([separator.join("abc")] if header else []), *lines, ""])
    layout = Layout.of(io.StringIO(text, newline="").readlines())
    values = layout.values(io.StringIO(text, newline=""), layout.places(None))
    np.testing.assert_array_equal(values, rows)
    assert layout.names == (["a", "b", "c"] if header else [])


def test_the_decimal_sign_may_come_late():
    assert read("x;y\n1;2\n3;4,5\n").tolist() == [[1, 2], [3, 4.5]]


def test_columns_are_chosen_by_name_beside_texts():
    text = "name,b,a\nfirst,1,2\nsecond,3,4\n"
    assert read(text, ["a", "b"]).tolist() == [[2, 1], [4, 3]]


def test_comments_end_rows_and_stand_between_them():
    for sign in "#%!":
        text = f"  {sign} none\nx,y\n1,2 {sign} one\n{sign} two, three\n \n3,4\n"
        assert read(text).tolist() == [[1, 2], [3, 4]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("x,y\nTrue,1\nFalse,0\n", "'x' must be a number up to 1e+09, got 'True' in row 1"),
        ("x,y\n1,1_0\n", "'y' must be a number up to 1e+09, got '1_0' in row 1"),
        ("x,y\n1,0x10\n", "'y' must be a number up to 1e+09, got '0x10' in row 1"),
        ("x;y\n1,5;2\n1;2.5\n", "'y' must be a number up to 1e+09, got '2.5' in row 2"),
        ("x;y\n1.234,5;2\n", "'x' must be a number up to 1e+09, got '1.234,5' in row 1"),
        ("1 2\n3 x\n", "column 2 must be a number up to 1e+09, got 'x' in row 2"),
        ("x,y\n1,2,\n3,4,5\n", "row 2 must have 2 cells, got 3"),
        ("x,y\n1,2,3\n", "row 1 must have 2 cells as in ['x', 'y'], got 3"),
        ("x,y\n1\n", "row 1 must have 2 cells as in ['x', 'y'], got 1"),
        ("x y z\n1 2\n", "row 1 must have 3 cells as in ['x', 'y', 'z'], got 2"),
        ("x,y\n1,\x1b[31m\n", r"'y' must be a number up to 1e+09, got '\x1b[31m' in row 1"),
        (f"x,y\n1,{'z' * 99}\n", f"'y' must be a number up to 1e+09, got '{'z' * 17}...{'z' * 18}' in row 1"),
        ("", "the file must begin with the names of its columns, got nothing"),
        ("# x\n  # y\n", "the file must begin with the names of its columns, got nothing"),
        ("1," * HEAD, f"the file must have lines of {HEAD} characters at most, got a longer one"),
    ],
)  # fmt: skip
def test_the_first_mistake_is_one_line(text, message):
    with pytest.raises(ValueError, match=r"^") as error:
        read(text)
    assert str(error.value) == message


def test_a_column_that_is_absent_is_named():
    with pytest.raises(ValueError, match=r"^columns must include 'z', got \['x', 'y'\]$"):
        read("x,y\n1,2\n", ["x", "z"])


def test_a_mistake_far_down_is_named_by_its_row():
    """Rows are read 100,000 at a time."""
    rows = [f"{i},{i / 8}" for i in range(250_000)]
    np.testing.assert_array_equal(read("\n".join(["x,y", *rows])), [[i, i / 8] for i in range(250_000)])
    rows[240_000] = "# no row\n5,x"
    with pytest.raises(ValueError, match=r"^'y' must be a number up to 1e\+09, got 'x' in row 240001$"):
        read("\n".join(["x,y", *rows]))
    rows[240_000] = "5"
    with pytest.raises(ValueError, match=r"^row 240001 must have 2 cells, got 1$"):
        read("\n".join(["x,y", *rows]))

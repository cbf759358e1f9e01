"""Tables of texts at any width: no number and no name is cut, columns stand side by side or in blocks."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.commands.text_tables import Column, lines_of, sides_in_one

NAMES = Column("name", ["front_left_suspension_travel", "front_right_suspension_travel"], right=False)
VALUES = Column("natural frequency [N s/m]", ["1.25", "-3"], right=True)
NOTES = Column("note", ["", "diverges towards 0 Hz: begin the band above"], right=False)


def lines(columns, room: int, keys: int = 1) -> list[str]:
    return list(lines_of(columns, keys, room, "-"))


def test_a_table_that_fits_stands_in_one_block():
    assert lines([Column("a", ["x", "yz"], False), Column("b [m]", ["1.5", "-10"], True)], 20) == [
        "a   b [m]",
        "---------",
        "x     1.5",
        "yz    -10",
    ]


def test_headers_and_texts_are_wrapped_between_words_and_units_are_not():
    assert lines([NAMES, VALUES, NOTES], 74) == [
        "                               natural frequency",
        "name                                     [N s/m]  note",
        "-" * 72,
        "front_left_suspension_travel                1.25",
        "front_right_suspension_travel                 -3  diverges towards 0 Hz:",
        "                                                  begin the band above",
    ]


def test_columns_that_do_not_fit_stand_in_blocks_without_empty_rows():
    assert lines([NAMES, VALUES, NOTES], 50) == [
        "                               natural frequency",
        "name                                     [N s/m]",
        "-" * 48,
        "front_left_suspension_travel                1.25",
        "front_right_suspension_travel                 -3",
        "",
        "name                           note",
        "-" * 49,
        "front_right_suspension_travel  diverges towards 0",
        "                               Hz: begin the band",
        "                               above",
    ]


def test_a_name_is_broken_after_an_underscore_where_nothing_else_helps():
    assert lines([NAMES, VALUES], 26)[-6:] == [
        "front_left_        1.25",
        "suspension_",
        "travel",
        "front_right_         -3",
        "suspension_",
        "travel",
    ]


TEXTS = st.lists(st.text("ab_. ", max_size=40), min_size=3, max_size=3)
NUMBERS = st.lists(st.floats(-1e6, 1e6).map("{:.5g}".format), min_size=3, max_size=3)


@given(TEXTS, st.lists(NUMBERS, min_size=1, max_size=12), st.integers(30, 120))
def test_nothing_is_cut_and_no_line_is_too_wide(names, numbers, room):
    columns = [Column("name", names, right=False)]
    columns += [Column(f"a column {n} [N s/m]", cells, right=True) for n, cells in enumerate(numbers)]
    found = lines(columns, room)
    assert max(map(len, found)) <= room
    words = " ".join(found).split()
    for cells in numbers:
        for cell in cells:
            assert cell in words
    joined = "".join("".join(found).split())
    assert all(word in joined for name in names for word in name.split() if len(word) < 8)


@pytest.mark.parametrize("room", [40, 80])
def test_an_empty_table_is_its_header(room):
    assert lines([Column("name", [], False), Column("value", [], True)], room)[0].split() == ["name", "value"]


def test_left_and_right_are_one_row_where_all_their_cells_are_equal():
    names = [f"{axle}_{side}_tyre_load" for axle in ("front", "rear") for side in ("left", "right")]
    table = [Column("name", ["body", *names], False), Column("value", ["1", "2.50", "2.50", "3", "4"], True)]
    found = sides_in_one(table)
    assert found[0].cells == ["body", "front_tyre_load (left and right)", *names[2:]]
    assert found[1].cells == ["1", "2.50", "3", "4"]
    assert (
        sides_in_one([Column("name", ["left", "right"], False), Column("v", ["1", "1"], True)])[1].cells
        == ["1"] * 2
    )
    twice = [Column("name", ["a_left", "a_left"], False), Column("v", ["1", "1"], True)]
    assert sides_in_one(twice) == twice

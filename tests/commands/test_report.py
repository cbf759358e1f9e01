"""The report of a command as text and as a document."""

import json

import numpy as np
import pandas as pd

from suspension_ctrl.commands.report import Report, Table

RIDE = pd.DataFrame({"name": ["SWS", "DTL"], "value": [0.0287, 1365.255], "unit": ["m", "N"]})


def text(report: Report, room: int = 80, *, plain: bool = True) -> list[str]:
    return [line for line, _ in report.text(room, plain=plain)]


def test_a_readable_table_is_printed_in_mm_and_kn_and_recorded_in_si_units():
    report = Report(items=[Table("Ride", RIDE, {}, 1, True)])
    assert [line.split() for line in text(report)[3:5]] == [["SWS", "28.7", "mm"], ["DTL", "1.365", "kN"]]
    records = json.loads(report.document())["tables"][0]["records"]
    assert records == [
        {"name": "SWS", "value": 0.0287, "unit": "m"},
        {"name": "DTL", "value": 1365.255, "unit": "N"},
    ]


def test_plain_lines_have_ascii_signs_alone():
    frame = pd.DataFrame({"time [µs]": [1.5], "a [m/s²]": [2.5]})
    report = Report(items=["Area in m² ± 1 µm", Table("µ", frame, {}, 1, False)])
    assert "".join(text(report)).isascii()
    assert not "".join(text(report, plain=False)).isascii()
    assert text(report)[0] == ""  # after the table that was last
    assert text(Report(items=report.items))[0] == "Area in m^2 +- 1 um"


def test_titles_are_marked_and_paragraphs_wrapped():
    lines = list(Report(items=["word " * 30, Table("Title", RIDE, {}, 1, False)]).text(40, plain=True))
    assert [line for line, title in lines if title] == ["Title"]
    assert max(len(line) for line, _ in lines) <= 40


def test_a_document_has_no_nan_and_names_columns_once():
    frame = pd.DataFrame({"ACC [m/s^2]": [np.nan], "ACC [%]": [np.inf], "n": [np.int64(3)], "held": [True]})
    table = json.loads(Report(items=[Table("t", frame, {}, 1, False)]).document())["tables"][0]
    assert table["records"] == [{"ACC [m/s^2]": None, "ACC [%]": None, "n": 3, "held": True}]
    assert table["units"] == {"ACC [m/s^2]": "m/s^2", "ACC [%]": "%"}
    assert json.loads(Report().document()) == {"folder": None, "paragraphs": [], "tables": []}


LOADS = pd.DataFrame(
    {"name": ["front_left_load", "front_right_load", "rear"], "value": [1500.0, 1500.0, 3.25], "n": [1, 1, 20]}
)


def rows_of(table: Table, *, plain: bool = True) -> list[list[str]]:
    return [line.split() for line in table.lines(80, plain=plain)]


def test_left_and_right_are_one_row_where_the_table_says_so_and_two_in_the_document():
    table = Table("Loads", LOADS, {}, 1, False, sides=True)
    assert rows_of(table)[2] == ["front_load", "(left", "and", "right)", "1500", "1"]
    assert len(rows_of(table)) == len(rows_of(table._replace(sides=False))) - 1 == 4
    assert [row["name"] for row in table.record()["records"]] == LOADS["name"].tolist()


def test_decimals_are_those_given_or_each_number_has_its_own_where_units_differ():
    """Of one unit the decimals of a column are those of its largest number."""
    close = LOADS.assign(value=[12.5, 12.5, 3.25])
    for table, decimals, cells in (
        (close, {"value": 3}, ["12.500", "12.500", "3.250"]),
        (close, {}, ["12.50", "12.50", "3.25"]),
        (close.assign(unit="m"), {}, ["12.5", "12.5", "3.25"]),
    ):
        assert [row[1] for row in rows_of(Table("", table, decimals, 1, False))[2:]] == cells


def test_numbers_stand_to_the_right_also_whole_ones_under_a_rule_of_the_form():
    lines = list(Table("", LOADS, {}, 1, False).lines(80, plain=False))
    assert [len(line) for line in lines] == [len(lines[1])] * 5  # all end under the last digit
    assert set(lines[1]) == {"─"}
    assert set(list(Table("", LOADS, {}, 1, False).lines(80, plain=True))[1]) == {"-"}


def test_tables_and_paragraphs_stand_apart_and_names_are_printed_as_text():
    """An empty line before and after a table, but not at the top; an empty paragraph is an empty line."""
    table = Table("T", RIDE.assign(name=["\x1b[31mS", "D"]), {}, 1, False)
    lines = text(Report(items=["one", "", table, "two", table]))
    assert [n for n, line in enumerate(lines) if not line] == [1, 2, 8, 10]
    assert lines[3] == lines[11] == "T"
    assert not any("\x1b" in line for line in lines)
    assert text(Report(items=[table]))[0] == "T"

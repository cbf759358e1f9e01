"""Certificates as text, frame and page."""

import pickle
from dataclasses import replace

import numpy as np

from suspension_ctrl.response.certificates import Certificate, Certified

ROWS = (
    Certified("1", "ACC", "m/s^2", 2.26, 2.273, 2.183, 2.363, 2.248),
    Certified("1", "Wk driver_acceleration + 0.63 We roll_acceleration", "m/s^2", 3.0, 2.0, 1.9, 2.1, 2.0),
    Certified("1", "price", "-", 5.0, np.nan, np.nan, np.nan, np.nan, "not of a drive"),
    Certified("all", "ACC", "m/s^2", 2.26, 2.273, 2.183, 2.363, 2.248),
)
LIMITS = ("ACC <= 3 m/s^2: met, 2.273 in the worst load case",)
DESIGN = {f"front.damper.coefficient_{i}": 1234.5 * i for i in range(12)}
CERTIFICATE = Certificate(
    title="3 random roads", design=DESIGN, cases=("share 1: a road that is long to describe " * 4,), rows=ROWS,
    limits=LIMITS, length=1000.0, seeds=(0, 1, 2),
)  # fmt: skip


def test_the_text_has_80_columns_and_marks_what_is_outside():
    lines = repr(CERTIFICATE).splitlines()
    assert max(map(len, lines)) <= 80
    assert lines[0] == "3 random roads"
    at = next(n for n, line in enumerate(lines) if line.startswith("Wk driver"))
    assert lines[at] == "Wk driver_acceleration + 0.63 We roll_acceleration"  # too long for a row with its numbers
    assert lines[at + 1].split() == ["m/s^2", "3*", "2", "1.9", "2.1", "2"]
    assert next(line for line in lines if line.startswith("ACC ")).split()[2] == "2.26"
    assert next(line for line in lines if line.startswith("price")).split() == ["price", "-", "5"]
    assert lines[-3:] == [*LIMITS, "* outside the 95 % interval of the simulated mean", "price: not of a drive"]
    assert "All load cases" in lines
    assert sum("long to describe" in line for line in lines) == 3


def test_numbers_keep_a_gap_between_columns():
    row = Certified("1", "mean travel front_right", "m", -2.54126e-07, -4.66612e-06, -1.23456e-05, -0.001073, 1e-7)
    lines = repr(replace(CERTIFICATE, rows=(row,))).splitlines()
    numbers = "-2.54e-07* -4.67e-06 -1.23e-05 -0.001073 1e-07"
    assert " ".join(lines[-4].split()) == f"mean travel front_right m {numbers}"


def test_the_frame_has_all_numbers_by_case_and_measure():
    table = CERTIFICATE.to_frame()
    assert table.index.names == ["case", "measure"]
    assert table.loc[("1", "ACC"), "simulated"] == 2.273
    assert table.outside.tolist() == [False, True, False, False]
    assert table.note.tolist() == ["", "", "not of a drive", ""]


def test_the_page_escapes_names():
    row = ROWS[0]._replace(measure="<b>")
    html = Certificate(
        title="a < b", design={}, cases=("one",), rows=(row,), limits=(), length=1.0, seeds=(0, 1)
    )._repr_html_()
    assert "&lt;b&gt;" in html
    assert "a &lt; b" in html
    assert "<b>" not in html


def test_it_is_a_record():
    assert pickle.loads(pickle.dumps(CERTIFICATE)).title == CERTIFICATE.title

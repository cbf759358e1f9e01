"""Candidates beside the present design at the top of a page."""

import pandas as pd

from suspension_ctrl import Problem
from suspension_ctrl.desk.explorer.choice_table import Cell, choice_table

PROBLEM = Problem(
    evaluate=lambda designs: designs, lower=(0.0, 0.0), upper=(9.0, 9.0), objectives=("ride", "grip"),
    variables=("spring", "damper"),
)  # fmt: skip
TABLE = pd.DataFrame(
    [("present design", 1.0, 1.0, 2.0, 4.0, ""), ("knee", 1.0, 1.0, 1.5, 4.001, "at the limit")],
    columns=["name", "spring", "damper", "ride", "grip", "active"],
)


def test_measures_stand_with_their_changes():
    found = choice_table(PROBLEM, TABLE)
    assert found.measures == ["ride", "grip"]
    present, knee = found.rows
    assert present[:3] == (0, "present design", [Cell("2.0"), Cell("4.000")])
    assert knee == (1, "knee", [Cell("1.5", "-25.0 %", True), Cell("4.001", "0.0 %", None)], "at the limit")


def test_without_a_present_design_there_are_values_alone():
    (row,) = choice_table(PROBLEM, TABLE[1:]).rows
    assert row.cells == [Cell("1.5"), Cell("4.001")]


def test_variables_at_bounds_of_one_kind_stand_together():
    bounds = "spring at its lower bound; damper at its lower bound; bar beyond its upper bound"
    active = f"{bounds}; at the limit SWS <= 9 mm"
    (row,) = choice_table(PROBLEM, TABLE[1:].assign(active=active)).rows
    assert row.active == (
        "at the limit SWS <= 9 mm; at the lower bound: spring, damper; beyond the upper bound: bar"
    )

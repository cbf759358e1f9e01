"""Which candidate to take: better than the present design in every measure, else the knee."""

import pandas as pd
import pytest

from garage import QUARTER, ROAD
from suspension_ctrl import LoadCase, Problem, RideProblem
from suspension_ctrl.desk.advice import Advice, shown_change

PROBLEM = Problem(
    evaluate=lambda designs: designs, lower=(0.0, 0.0), upper=(9.0, 9.0), objectives=("ride", "grip"),
    variables=("spring", "damper"),
)  # fmt: skip
PRESENT = ("present design", 4.0, 4.0)


def advised(*rows: tuple, active: str = "") -> Advice:
    first = 0 if rows[0][0] == PRESENT[0] else 1
    table = pd.DataFrame(
        [(name, x, y, x, y, active) for name, x, y in rows],
        columns=["name", "spring", "damper", "ride", "grip", "active"],
        index=range(first, first + len(rows)),
    )
    return Advice.of(PROBLEM, table)


def test_the_largest_gain_without_a_loss_is_taken():
    found = advised(PRESENT, ("least ride", 1.0, 6.0), ("none worse", 3.0, 4.0), ("knee", 2.0, 2.0))
    assert found.number == 3
    assert found.said == [
        "Take candidate 3, knee. Against the present design no measure is worse: ride -50.0 %, grip -50.0 %.",
        "No measure is worse with 2 either, but less is gained in sum.",
        "It has spring 2, damper 2.",
    ]


def test_a_change_that_is_not_shown_is_no_loss():
    assert advised(PRESENT, ("least ride", 1.0, 4.0 * 1.0004), ("knee", 2.0, 5.0)).number == 1
    assert advised(PRESENT, ("least ride", 1.0, 4.0 * 1.0006), ("knee", 2.0, 5.0)).number == 2


def test_the_knee_is_taken_where_every_gain_has_a_price():
    found = advised(PRESENT, ("least ride", 1.0, 6.0), ("knee", 3.0, 5.0))
    assert found.number == 2
    assert found.said[:2] == [
        "Take candidate 2, knee, unless one measure decides: "
        "against the present design ride -25.0 %, grip +25.0 %.",
        "Every design of the front is worse than the present design in some measure.",
    ]


def test_a_present_design_beyond_a_limit_is_told():
    found = advised(PRESENT, ("knee", 3.0, 3.0), active="beyond the limit ride <= 2")
    assert "The present design is beyond the limit ride <= 2." in found.said


def test_a_loss_against_a_present_design_beyond_a_limit_is_the_price_of_the_limit():
    found = advised(PRESENT, ("knee", 3.0, 5.0), active="beyond the limit ride <= 2")
    assert found.said[1:3] == [
        "The present design is beyond the limit ride <= 2.",
        "No design within the limits is as good as the present design in every measure.",
    ]


def test_without_a_present_design_there_are_no_changes():
    found = advised(("least ride", 1.0, 6.0), ("knee", 3.0, 5.0))
    assert (found.number, found.said[0]) == (2, "Take candidate 2, knee, unless one measure decides.")


def test_against_a_measure_of_zero_any_rise_is_a_loss():
    present = ("present design", 4.0, 0.0)
    assert advised(present, ("least ride", 1.0, 1.0), ("knee", 2.0, 0.0)).number == 2


@pytest.mark.parametrize(
    ("active", "said"),
    [
        ("at the limit ride <= 2", ["It is at the limit ride <= 2, without margin for scatter."]),
        ("spring at its upper bound", ["Wider bounds may give more: spring at its upper bound."]),
    ],
)
def test_limits_and_bounds_that_are_reached_are_told(active, said):
    assert advised(("knee", 3.0, 5.0), active=active).said[2:] == said


def test_in_several_load_cases_a_limit_is_that_of_the_worst():
    cases = [LoadCase(vehicle=QUARTER, road=ROAD, speed=v) for v in (10.0, 20.0)]
    bounds = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
    problem = RideProblem(cases=cases, bounds=bounds, measures=["ACC", "SWS"], nodes=256)
    rows = [("present design", 2e4, 2e3, 4.0, 0.02), ("knee", 1e4, 2e3, 3.0, 0.03)]
    columns = ["name", "spring [N/m]", "damper [N s/m]", "ACC [m/s^2]", "SWS [m]"]
    table = pd.DataFrame(rows, columns=columns).assign(active=["beyond the limit SWS <= 10 mm", ""])
    assert (
        "The present design is beyond the limit SWS <= 10 mm in the worst load case."
        in Advice.of(problem, table).said
    )


@pytest.mark.parametrize(
    ("change", "text"), [(-0.049, "0.0 %"), (0.05, "0.0 %"), (0.051, "+0.1 %"), (-2.04, "-2.0 %")]
)
def test_a_change_below_what_is_shown_has_no_sign(change, text):
    assert shown_change(change) == text

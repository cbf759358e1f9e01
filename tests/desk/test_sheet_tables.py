"""Tables of the sheet: units of suppliers, numbers without exponents, no empty columns."""

import pytest

from garage import FULL, QUARTER, ROAD, SPEED
from suspension_ctrl import LoadCase, RideProblem
from suspension_ctrl.desk.parts import parts_of
from suspension_ctrl.desk.sheet_tables import (
    checked_tolerances,
    described,
    measure_block,
    number,
    part_block,
    range_block,
)

PROBLEM = RideProblem(
    QUARTER,
    ROAD,
    speed=SPEED,
    bounds={"spring": (10e3, 30e3), "damper": (500.0, 5e3)},
    constraints=["SWS <= 0.03"],
)
DESIGN = {"spring": 22e3, "damper": 1500.0}


def table(block) -> list[dict[str, str]]:
    return [dict(zip(block.header, row, strict=True)) for row in block.rows]


@pytest.mark.parametrize(
    ("value", "text"), [(15620000.0, "15620000"), (1234.56, "1235"), (0.000123456, "0.0001235"), (-0.0, "-0")]
)
def test_numbers_have_four_digits_and_no_exponent(value, text):
    assert number(value) == text


def test_springs_are_in_newtons_by_millimetre_and_bars_by_degree():
    values = FULL.coefficients({"front": (21e3, 1500.0), "rear": (23e3, 1600.0), "front_antiroll": 18e3})
    block = part_block(parts_of(FULL, values), {"front.spring": 0.05}, {})
    rows = {row["part"]: row for row in table(block)}
    assert (rows["front.spring"]["value"], rows["front.spring"]["unit"]) == ("21", "N/mm")
    assert rows["front.spring"]["tolerance"] == "±5 %"
    assert (rows["front_antiroll"]["value"], rows["front_antiroll"]["unit"]) == ("314.2", "N m/deg")
    assert "present" not in block.header


def test_limits_are_in_the_unit_of_their_value():
    rows = table(measure_block(PROBLEM, DESIGN, {"spring": 22e3, "damper": 3000.0}))
    assert [row["measure"] for row in rows] == ["ACC", "SWS", "DTL", "SWS <= 30 mm"]
    assert (rows[3]["value"], rows[3]["unit"], rows[3]["limit"]) == (rows[1]["value"], "mm", "met")
    assert rows[0]["change"].endswith(" %")


def test_load_cases_are_numbered_where_there_are_several():
    (row,) = table(range_block(PROBLEM, DESIGN))
    travel = float(PROBLEM.evaluate([list(DESIGN.values())])[0, 1])
    assert float(row["travel rms"]) == pytest.approx(1e3 * travel, rel=5e-3)  # of three digits
    assert "case" not in row
    slow = LoadCase(vehicle=QUARTER, road=ROAD, speed=10.0)
    both = PROBLEM.replace(cases=[*PROBLEM.cases, slow])
    assert [row["case"] for row in table(range_block(both, DESIGN))] == ["1", "2"]
    assert described(both)[1:] == [
        "Road of all cases: power law: Gd(1 cycle/m) = 5e-06 m^3, exponent 2.5.",
        "Case 1, share 1: 20 m/s.",
        "Case 2, share 1: 10 m/s.",
    ]
    many = PROBLEM.replace(cases=[LoadCase(vehicle=QUARTER, road=ROAD, speed=5.0 + i) for i in range(6)])
    assert described(many)[-1] == "And 3 more load cases."
    assert len(described(many.replace(cases=many.cases[:3]))) == 1 + 4  # the road and three cases


@pytest.mark.parametrize(
    ("tolerances", "message"),
    [
        ({"damper": 0.0}, "tolerance of damper must be finite and > 0, got 0.0"),
        ({"front": 0.1}, "tolerances must be one of spring, damper, got 'front'"),
    ],
)
def test_tolerances_are_of_coefficients_and_above_zero(tolerances, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        checked_tolerances(PROBLEM, DESIGN, tolerances)

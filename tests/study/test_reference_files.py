"""Reference fronts in files: tables of objectives in any unit, folders of comparisons of the same problem."""

import re

import numpy as np
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.study.campaign import Campaign
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.reference_files import load_reference

LINE = Problem(
    evaluate=lambda x: np.hstack([x, 1 - x]), lower=(0.0,), upper=(1.0,), objectives=("SWS", "@share"),
    units={"SWS": "m"},
)  # fmt: skip


def test_a_table_is_read_in_the_units_of_its_header(tmp_path):
    """The third row is dominated; a name that a spreadsheet would take for a formula is escaped."""
    (tmp_path / "front.csv").write_text("x1,'@share [-],SWS [mm]\n9,0.5,20\n9,0.2,30\n9,0.5,40\n")
    found = load_reference(tmp_path / "front.csv", LINE)
    np.testing.assert_allclose(found.front.objectives, [[0.02, 0.5], [0.03, 0.2]], rtol=1e-15)
    assert found.origin == repr(str(tmp_path / "front.csv"))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("SWS [m]\n1\n2\n", "columns must include @share with its unit in the header, as in '@share [-]', got "),
        ("SWS,@share\n1,2\n2,1\n", "columns must include SWS with its unit in the header, as in 'SWS [m]', "),
        ("SWS [N],@share\n1,2\n2,1\n", "SWS must be in m or a unit like it, got '1.0 N' in N"),
        ("SWS [m],@share\n1,2\n1,3\n", "rows must differ in every objective, got 1 non-dominated ones that "),
        ("SWS [m],@share\n1,2\n", "rows of numbers must be 2 or more, got 1"),
        ("SWS [m],@share\n1,2\n2,inf\n", "'@share' must be a number up to 1e+09, got 'inf' in row 2"),
    ],
)  # fmt: skip
def test_a_table_that_does_not_fit_is_one_line(tmp_path, text, message):
    path = tmp_path / "front.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=f"^{re.escape(f'{path}: {message}')}") as found:
        load_reference(path, LINE)
    assert "\n" not in str(found.value)


def compared(problem: Problem, **changes) -> Comparison:
    settings = {"algorithms": ["nsga2"], "populations": [20], "iterations": [2]}
    return Comparison(problem=problem, **settings | changes)


def test_the_front_of_another_comparison_of_the_problem_is_taken(tmp_path):
    """Of other algorithms and sizes, as it is kept there."""
    made = Campaign(compared(LINE), tmp_path / "a", tolerance=0.02).reference({})
    found = load_reference(tmp_path / "a", LINE)
    assert found == made
    again = Campaign(compared(LINE, populations=[30], algorithms=["sobol"]), tmp_path / "b").reference({}, found)
    assert again == made


def test_a_folder_without_a_front_and_one_of_another_problem_are_refused(tmp_path):
    with pytest.raises(ValueError, match=r"^reference must be a CSV file, or the folder of a comparison with a "):
        load_reference(tmp_path, LINE)
    Campaign(compared(LINE), tmp_path, tolerance=0.02).reference({})
    other = Problem(evaluate=LINE.evaluate, lower=(0.0,), upper=(2.0,), objectives=("SWS", "@share"))
    message = r"^problem.upper.0 must be 1.0 as in .* to take its reference front, got 2.0"
    with pytest.raises(ValueError, match=message):
        load_reference(tmp_path, other)
    (tmp_path / "reference" / "final" / "front.csv").write_text("0,1\n")
    with pytest.raises(ValueError, match=r"front.csv: must be as it was stored, got other 4 bytes$"):
        load_reference(tmp_path, LINE)


def test_copies_of_a_point_count_once_and_a_table_may_be_too_long(tmp_path):
    path = tmp_path / "front.csv"
    path.write_text("SWS [m],@share [-]\n0,2\n" + "1,1\n" * 3000)
    assert load_reference(path, LINE).front.objectives.tolist() == [[0.0, 2.0], [1.0, 1.0]]
    path.write_text("SWS [m],@share [-]\n0,2\n" + "1,1\n" * 100_000)
    with pytest.raises(ValueError, match=r"front.csv: rows of numbers must be 100000 or less, got 100001"):
        load_reference(path, LINE)


def test_a_file_that_is_not_there_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError):
        load_reference(tmp_path / "no.csv", LINE)

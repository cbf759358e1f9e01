"""Reference fronts that later comparisons take: the same front, of the same problem only, or none at all."""

import hashlib
import json
import os
from pathlib import Path

import numpy as np
import pytest
from platformdirs import user_cache_path

from suspension_ctrl import Problem
from suspension_ctrl.search import indicators, kinds, spreading
from suspension_ctrl.study import kept_fronts, machine, reference
from suspension_ctrl.study.campaign import Campaign
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.kept_fronts import KeptFronts
from suspension_ctrl.study.reference import Reference, sought

TOLERANCE = 0.02


class Line:
    """Objectives x and slope (1 - x), with a count of evaluated designs."""

    def __init__(self, slope: float = 1.0) -> None:
        self.slope, self.evaluated = slope, 0

    def __call__(self, x):
        self.evaluated += len(x)
        return np.hstack([x, self.slope * (1 - x)])


def problem_of(line: Line, upper: float = 1.0) -> Problem:
    return Problem(evaluate=line, lower=(0.0,), upper=(upper,), objectives=("a", "b"))


def campaign_of(problem: Problem, folder: Path, fronts: Path | None, tolerance: float = TOLERANCE) -> Campaign:
    comparison = Comparison(problem=problem, algorithms=["nsga2"], populations=[20], iterations=[2])
    return Campaign(comparison, folder, tolerance, fronts=KeptFronts(fronts))


def test_a_later_comparison_takes_the_front_without_a_grid(tmp_path):
    """It evaluates the 64 designs of its own plan and of the front's; a grid has at least 100 and 200."""
    made, again = Line(), Line()
    makes = campaign_of(problem_of(made), tmp_path / "a", tmp_path / "fronts")
    takes = campaign_of(problem_of(again), tmp_path / "b", tmp_path / "fronts")
    assert makes.kept_front is None
    first, second = makes.reference({}), takes.reference({})
    assert second == first == takes.kept_front
    assert second.origin.startswith("a grid of ")
    assert (made.evaluated > 300, again.evaluated) == (True, 2 * 64)


def test_the_front_of_another_problem_or_tolerance_is_not_taken(tmp_path):
    fronts, line = tmp_path / "fronts", problem_of(Line())
    first = campaign_of(line, tmp_path / "a", fronts).reference({})
    kept = KeptFronts(fronts)
    assert kept.find(line, TOLERANCE) == first
    assert kept.find(line, TOLERANCE / 2) is None
    assert kept.find(problem_of(Line(), upper=0.5), TOLERANCE) is None
    assert kept.find(problem_of(Line(slope=1 + 1e-12)), TOLERANCE) is None


def test_a_front_of_other_code_or_versions_is_not_taken(tmp_path, monkeypatch):
    fronts, line = KeptFronts(tmp_path / "fronts"), problem_of(Line())
    first = campaign_of(line, tmp_path / "a", fronts.folder).reference({})
    (path,) = fronts.folder.iterdir()
    modules = (reference, indicators, kinds, spreading)
    sources = (Path(module.__file__).read_bytes() for module in modules)
    assert json.loads(path.read_text())["plan"]["code"] == hashlib.sha256(b"".join(sources)).hexdigest()[:32]
    monkeypatch.setattr(machine, "provenance", lambda: {"numpy": "0.0"})
    assert fronts.find(line, TOLERANCE) is None
    monkeypatch.undo()
    assert fronts.find(line, TOLERANCE) == first


@pytest.mark.parametrize("key", ["plan", "summary", "front", "origin"])
def test_a_file_that_is_not_as_it_was_written_is_replaced(tmp_path, key):
    fronts, line = tmp_path / "fronts", problem_of(Line())
    first = campaign_of(line, tmp_path / "a", fronts).reference({})
    (path,) = fronts.iterdir()
    content = json.loads(path.read_text())
    if key == "front":
        content[key]["objectives"][3][0] += 1e-9
    else:
        del content[key]
    path.write_text(json.dumps(content))
    assert KeptFronts(fronts).find(line, TOLERANCE) is None
    assert campaign_of(line, tmp_path / "b", fronts).reference({}) == first
    assert KeptFronts(fronts).find(line, TOLERANCE) == first


def test_a_front_of_runs_is_not_kept():
    """It depends on the runs; a grid of five variables has more than 20 million designs."""
    kept = list[Reference]()
    wide = Problem(evaluate=Line(), lower=(0.0,) * 5, upper=(1.0,) * 5, objectives=("a", "b"))
    assert "all timed runs" in sought(wide, [np.array([[0.0, 1.0], [1.0, 0.0]])], keep=kept.append).origin
    assert not kept
    found = sought(problem_of(Line()), [], TOLERANCE, keep=kept.append)
    assert kept == [found]


def test_a_folder_that_cannot_be_written_is_no_error(tmp_path):
    (tmp_path / "file").write_text("")
    found = campaign_of(problem_of(Line()), tmp_path / "a", tmp_path / "file" / "fronts").reference({})
    assert found.origin.startswith("a grid of ")


def test_the_oldest_fronts_leave_the_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_fronts, "MOST", 2)
    found = campaign_of(problem_of(Line()), tmp_path / "a", None).reference({})
    fronts, problems = KeptFronts(tmp_path / "fronts"), [problem_of(Line(slope)) for slope in (1.0, 2.0, 3.0)]
    for age, problem in enumerate(problems):
        fronts.keep(problem, TOLERANCE, found)
        for path in fronts.folder.iterdir():  # clocks of file systems are coarse
            os.utime(path, (age, path.stat().st_mtime - 10))
    assert [fronts.find(problem, TOLERANCE) is not None for problem in problems] == [False, True, True]


def test_many_fronts_are_kept(tmp_path):
    found = campaign_of(problem_of(Line()), tmp_path / "a", None).reference({})
    fronts, problems = KeptFronts(tmp_path / "fronts"), [problem_of(Line(1.0 + i)) for i in range(12)]
    for problem in problems:
        fronts.keep(problem, TOLERANCE, found)
    assert all(fronts.find(problem, TOLERANCE) for problem in problems)


def test_the_environment_names_the_folder_or_none(tmp_path, monkeypatch):
    monkeypatch.setenv(kept_fronts.FOLDER, str(tmp_path))
    assert KeptFronts.of_user().folder == tmp_path
    monkeypatch.setenv(kept_fronts.FOLDER, "")
    assert KeptFronts.of_user().folder is None
    monkeypatch.delenv(kept_fronts.FOLDER)
    assert KeptFronts.of_user().folder == user_cache_path("suspension-ctrl") / "fronts"

"""Comparisons with the known fronts and with pymoo, on a few evaluations."""

import numpy as np
import pandas as pd
import pytest

import engineering
import real_world
from engineering import fronts
from suspension_ctrl.commands import terminal

SIZES = {"population": 40, "evaluations": 200}


def test_hypervolumes_by_problem_and_algorithm(tmp_path):
    real_world.fronts(problems="RE24,CRE23", seeds=2, **SIZES, out=tmp_path / "results")
    runs = pd.read_csv(tmp_path / "results/runs.csv")
    assert len(runs) == 2 * 3 * 2
    assert (runs.population <= runs.archive).all()
    shown = pd.read_csv(tmp_path / "results/fronts.csv", index_col=["problem", "algorithm"])
    assert shown.archive["CRE23", "nsga2"] > shown.archive["CRE23", "random"] > 0
    assert terminal.report.folder == tmp_path / "results"


@pytest.mark.filterwarnings("ignore")  # pymoo's, of its own future
@pytest.mark.parametrize(("scaled", "algorithms"), [(False, 4), (True, 5)])
def test_pymoo_beside_ours_with_as_many_evaluations(tmp_path, scaled, algorithms):
    pytest.importorskip("pymoo")
    real_world.peers(problems="RE21", seeds=3, **SIZES, scaled=scaled, out=tmp_path)
    runs = pd.read_csv(tmp_path / "runs.csv")
    assert len(runs) == algorithms * 3 * 2
    assert set(runs.evaluations) == {200}
    compared = pd.read_csv(tmp_path / "differences.csv")
    assert [tuple(pair) for pair in compared[["first", "second"]].to_numpy()[::2]] == list(
        real_world.pairs(scaled)
    )


def test_scaled_problem_has_the_volume_of_its_own_front():
    """The same search gives the same share, whatever the scale."""
    problem, front = real_world.for_all("RE33", scaled=True)
    designs = np.array([[60.0, 90.0, 2000.0, 12.0], [70.0, 100.0, 2500.0, 15.0]])
    plain, known = engineering.problem("RE33"), fronts.reference("RE33")
    share = front.relative_hypervolume(problem.evaluate(designs))
    assert share == pytest.approx(known.relative_hypervolume(plain.evaluate(designs)), rel=1e-12)


def test_an_unknown_problem_is_one_line_and_status_2(script, tmp_path):
    done = script("real_world", "fronts", "--problems", "RE99", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("error: problems must be ")
    assert "RE99" in done.stderr
    assert list(tmp_path.iterdir()) == []

"""Templates of studies: each is complete, runs as it is, and is not written over a file."""

import pandas as pd
import pytest

from suspension_ctrl import datafiles, load_study
from suspension_ctrl.commands.new import KINDS


@pytest.mark.parametrize("kind", KINDS)
def test_a_template_is_a_study_that_runs(called, tmp_path, kind):
    done = called("new", kind, "--out", "mine.toml")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.splitlines()[-1] == "mine.toml"
    study = load_study(tmp_path / "mine.toml")
    assert tuple(study.present) == study.problem.variables
    values = study.problem.evaluate([list(study.present.values())])[0]
    assert -0.5 < values[-1] < 0  # the present design is within the limit, which is not far
    (tmp_path / "front.csv").write_text("ACC [m/s^2],SWS [m],DTL [N]\n0.5,0.02,500\n2,0.005,900\n")
    done = called(
        "compare", "--study", "mine.toml", "--populations", 20, "--iterations", 1, "--repeats", 1,
        "--algorithms", "random", "--reference", "front.csv", "--out", "out",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert len(pd.read_csv(tmp_path / "out" / "runs.csv")) == 1
    done = called("optimum", "--study", "mine.toml", "--population", 20, "--iterations", 1, "--out", "best")
    assert (done.returncode, done.stderr) == (0, "")
    table = pd.read_csv(tmp_path / "best" / "candidates.csv")
    assert table.name[0] == "present design"
    assert len(table) > 1


def test_every_template_can_be_had():
    assert set(KINDS) == set(datafiles.stems("templates"))


def test_other_kinds_and_files_that_exist_are_refused(refused, tmp_path):
    refused("new", ["bicycle", "--out", "b.toml"], "kind must be one of quarter-car, half-car, full-car, multi", 2)
    (tmp_path / "there.toml").write_text("mine")
    refused("new", ["half-car", "--out", "there.toml"], "out must be a file that does not exist yet, got ", 2)
    assert (tmp_path / "there.toml").read_text() == "mine"

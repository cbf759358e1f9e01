"""The comparison over many seeds: the same tables wherever the runs are made, and after whatever stopped them."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from suspension_ctrl.paper.experiment import ride_problem
from suspension_ctrl.study.reference import grid_front

ARGUMENTS = (
    "--quality", "--algorithms", "nsga2,sobol", "--populations", 60, "--iterations", "5,10", "--repeats", 2,
    "--seeds", 3,
)  # fmt: skip
TABLES = [f"{name}{ending}" for name in ("equal", "differences") for ending in (".csv", ".md", ".tex")]
SAME = ["quality.csv"]


@pytest.fixture(scope="module")
def arguments(tmp_path_factory) -> list[str]:
    """Options of a comparison whose reference front, of a coarse grid, is given: that takes most of the time."""
    path = tmp_path_factory.mktemp("reference") / "front.csv"
    pd.DataFrame(grid_front(ride_problem(), 60), columns=["ACC [m/s^2]", "SWS [m]", "DTL [N]"]).to_csv(path)
    return [*map(str, ARGUMENTS), "--reference", str(path)]


@pytest.fixture(scope="module")
def alone(script, arguments, tmp_path_factory):
    out = tmp_path_factory.mktemp("alone") / "results"
    done = script("compare", *arguments, "--out", out)
    assert done.returncode == 0, done.stderr
    return out, done


def test_says_what_came_of_it(alone):
    out, done = alone
    words = (out / "verdict.md").read_text()
    assert words.startswith("No verdict: 3 runs against 3 cannot differ significantly.")
    assert words.strip() in " ".join(done.stdout.split())
    assert "Final populations, medians" in done.stdout
    assert "To 0.995 of the reference hypervolume" in done.stdout
    assert done.stdout.splitlines()[-1] == str(out)


def test_rows_say_whether_their_time_is_a_timing(alone):
    runs = pd.read_csv(alone[0] / "runs.csv")
    assert runs.timing.sum() == 2 * 2 * 2
    judged = runs[~runs.timing]
    assert len(judged) == 2 * 3
    assert judged.relative_hypervolume.between(0.5, 1).all()
    assert judged.seconds.gt(0).all()


def test_writes_tables_and_figures(alone):
    out, _ = alone
    names = {path.name for path in out.glob("[!.]*")}
    figures = {
        f"{kind}_n{n}.{e}" for kind in ("anytime", "boxes", "attainment") for n in (60,) for e in ("png", "pdf")
    }
    assert {*TABLES, *SAME, "to_reach.csv", "verdict.md"} | figures <= names
    quality = pd.read_csv(out / "quality.csv")
    assert "seconds" not in quality
    last = quality[(quality.population == 60) & (quality.evaluations == 660)]
    assert set(last.set) == {"population", "archive", "archive of N"}
    assert "N=" not in (out / "equal.tex").read_text()
    assert r"\toprule" in (out / "equal.tex").read_text()


def test_killed_and_started_again_on_two_processes_it_has_the_same_tables(
    alone, arguments, checkout, script, tmp_path
):
    """Killed among the timed runs, then among the others; what was finished is not made again."""
    out = tmp_path / "killed"
    command = [sys.executable, str(checkout / "scripts" / "compare.py"), *arguments, "--out", str(out)]
    settings = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True, "env": os.environ}
    for folder, runs, number in (("timed", 3, signal.SIGKILL), ("quality", 2, signal.SIGKILL)):
        process = subprocess.Popen(command, **settings)
        while len(list((out / folder / "records").glob("[!.]*.json"))) < runs and process.poll() is None:
            time.sleep(0.005)
        process.send_signal(number)
        process.communicate()
    before = stamps(out)
    assert 8 < len(before) < 8 + 6
    more = ["--jobs", 2, "--out", out]
    done = script("compare", *arguments, *more, warnings="default")  # of a run half stored
    assert done.returncode == 0, done.stderr
    assert re.search(r"^timed runs, 8 of 8 in .* s, 8 found$", done.stderr, re.MULTILINE)
    assert (out / "quality.csv").read_bytes() == (alone[0] / "quality.csv").read_bytes()
    assert {name: stamp for name, stamp in stamps(out).items() if name in before} == before
    for name in sorted(path.name for path in (alone[0] / "fronts").iterdir()):
        assert (out / "fronts" / name).read_bytes() == (alone[0] / "fronts" / name).read_bytes()


def stamps(out: Path) -> dict[str, int]:
    return {str(path): path.stat().st_mtime_ns for path in out.glob("*/records/[!.]*.json")}


def test_another_command_does_not_go_on_in_the_folder(alone, arguments, script):
    done = script("compare", *arguments, "--seed", 1, "--out", alone[0])
    assert done.returncode == 2
    assert done.stderr.startswith("error: seed must be 0 as in '")
    assert done.stderr.count("\n") == 1

"""Campaigns that are killed, or whose disk gives out, go on where they were: real processes, real signals."""

import json
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl import Problem
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study.campaign import Campaign
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.reference import Reference
from suspension_ctrl.study.store import FolderStore, SpoiltRunWarning

RUNS, BUDGET, POPULATION = 24, 200, 20

PROGRAM = f"""
import os, time
from pathlib import Path
import numpy as np
from suspension_ctrl import Nsga2, Problem, Sampling
from suspension_ctrl.commands import terminal
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study.store import FolderStore, SpoiltRunWarning
from suspension_ctrl.study.study import Study

def main(folder: Path, pause: float):
    log = os.open(folder / "evaluated", os.O_CREAT | os.O_APPEND | os.O_WRONLY)

    def evaluate(x):
        time.sleep(pause)
        os.write(log, b"." * len(x))
        return np.stack([x[:, 0], 1 - x[:, 0] + x[:, 1]], axis=1)

    line = np.linspace(0, 1, 50)
    study = Study(
        problems={{"p": Problem(evaluate=evaluate, lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"))}},
        algorithms={{
            "nsga2": Nsga2(population={POPULATION}), "random": Sampling(population={POPULATION}, points="random")
        }},
        seeds=range({RUNS // 2}),
        budgets=[40, {BUDGET}],
        references={{"p": ReferenceFront.of(np.stack([line, 1 - line], axis=1))}},
    )
    store = FolderStore(folder / "store", {{"plan": 1}})
    for run, _ in study.carry_out(store):
        os.write(log, f"<{{run.name}}>".encode())
    study.table(store).drop(columns="seconds").to_csv(folder / "table.csv", index=False)

terminal.run_script(main)
"""


def start(folder: Path, pause: float, **settings) -> subprocess.Popen:
    folder.mkdir(exist_ok=True)
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM, str(folder), str(pause)], stderr=subprocess.PIPE, text=True, **settings
    )


def finish(folder: Path, pause: float = 0.0, **settings) -> tuple[int, str]:
    """Exit status and what was printed as an error of a campaign that is left alone."""
    process = start(folder, pause, **settings)
    _, error = process.communicate()
    return process.returncode, error


def log(folder: Path) -> str:
    path = folder / "evaluated"
    return path.read_text() if path.exists() else ""


def finished(folder: Path) -> list[str]:
    """Names of the runs that were handed out as done, in order."""
    return [part.split(">")[0] for part in log(folder).split("<")[1:]]


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("undisturbed")
    assert finish(folder) == (0, "")
    return folder


def test_five_times_killed_and_started_again_is_as_if_never_killed(undisturbed, tmp_path):
    """Killed after so many characters of the log, at five moments spread over the campaign."""
    folder = tmp_path / "killed"
    for kill in range(5):
        process = start(folder, 0.002)
        before = len(log(folder))
        moment = before + 120 + 106 * kill  # within the first run, or up to two runs later
        while len(log(folder)) < moment and process.poll() is None:
            time.sleep(0.0005)
        process.kill()
        process.wait()
        process.stderr.close()
        assert not (folder / "table.csv").exists()
    done = len(FolderStore(folder / "store", {"plan": 1}))
    assert 3 <= done < RUNS  # the kills were within the campaign
    status, said = finish(folder)
    assert status == 0
    assert all(line.endswith("the run is repeated") for line in said.splitlines())
    assert (folder / "table.csv").read_bytes() == (undisturbed / "table.csv").read_bytes()
    names = finished(folder)
    assert len(set(names)) == len(names)
    # Every run is made once, but for what the kills met.
    assert RUNS * BUDGET <= log(folder).count(".") <= RUNS * BUDGET + 5 * BUDGET


def test_a_full_disk_ends_it_in_one_line_and_loses_nothing(undisturbed, tmp_path):
    """Files that may grow to so many bytes and no more stand for a disk that is full: writing fails alike."""
    resource = pytest.importorskip("resource", reason="the system does not limit the size of files")
    folder = tmp_path / "full"
    assert finish(folder) == (0, "")
    (folder / "table.csv").unlink()
    for part in ("final", "runs", "records"):
        for path in sorted((folder / "store" / part).iterdir())[5:]:
            path.unlink()
    largest = max(path.stat().st_size for path in (folder / "store" / "runs").iterdir())
    (folder / "evaluated").unlink()

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (largest // 2, resource.RLIM_INFINITY))

    status, error = finish(folder, preexec_fn=limit)
    assert status == 1
    assert error.count("\n") == 1
    assert error.startswith(f"error: [Errno 27] File too large: '{folder / 'store'}")
    assert error.endswith(f"; finished runs are kept: start again with '{folder / 'store'}' to resume\n")
    store = FolderStore(folder / "store", {"plan": 1})
    assert len(store) == 5
    assert all(len(store[name].course) for name in store)
    del store  # another process may open it
    assert finish(folder)[0] == 0
    assert (folder / "table.csv").read_bytes() == (undisturbed / "table.csv").read_bytes()


def test_a_folder_that_turns_read_only_ends_it_in_one_line(undisturbed, tmp_path):
    """The folder of the runs is moved away and a file stands in its place, where nothing can be written."""
    folder = tmp_path / "read-only"
    process = start(folder, 0.02)
    while len(finished(folder)) < 3:
        time.sleep(0.005)
    runs = folder / "store" / "runs"
    runs.rename(folder / "elsewhere")
    runs.touch(0o400)
    _, error = process.communicate()
    assert process.returncode == 1
    assert error.count("\n") == 1
    assert error.startswith("error: [Errno 20] Not a directory: ")
    kept = sorted(path.stem for path in (folder / "elsewhere").glob("[!.]*"))
    assert kept == sorted(finished(folder))
    assert all(len(pd.read_csv(folder / "elsewhere" / f"{name}.csv")) for name in kept)
    runs.unlink()
    (folder / "elsewhere").rename(runs)
    assert finish(folder)[0] == 0
    assert (folder / "table.csv").read_bytes() == (undisturbed / "table.csv").read_bytes()
    assert len(set(finished(folder))) == len(finished(folder)) == RUNS


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="whoever may write anywhere is not refused"
)
def test_a_folder_without_permission_is_refused_in_one_line(tmp_path):
    folder = tmp_path / "mine"
    folder.mkdir()
    (folder / "store").mkdir(mode=0o500)
    status, error = finish(folder)
    assert status == 1
    assert error.startswith("error: [Errno 13] Permission denied: ")
    assert error.count("\n") == 1


class Line:
    """f1 = x, f2 = 1 - x + y, whose front is f2 = 1 - f1; it counts its designs."""

    def __init__(self):
        self.designs = 0

    def __call__(self, x):
        self.designs += len(x)
        return np.stack([x[:, 0], 1 - x[:, 0] + x[:, 1]], axis=1)


def compared(evaluate, **changes) -> Comparison:
    problem = Problem(evaluate=evaluate, lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"), **changes)
    return Comparison(
        problem=problem, algorithms=["nsga2", "sobol"], populations=[20], iterations=[2], repeats=2, seeds=3
    )


SAMPLE = 64  # designs that tell one problem from another


def test_a_campaign_in_a_program_resumes_from_its_folder(tmp_path):
    line, watched = Line(), []

    def watch(runs, total, text, found):
        watched.append((text, total, found))
        return runs

    campaign = Campaign(compared(line), tmp_path, tolerance=0.02, watch=watch)
    store = campaign.time()
    assert sorted(store) == sorted(run.name for run in campaign.comparison.timed_runs())
    assert campaign.kept(judged=True) == (4, 4 + 6)
    front, _ = campaign.reference(store)
    table, judged = campaign.judge(front)
    assert table.groupby(["algorithm", "seed"]).ngroups == len(judged) == 2 * 3
    finals = campaign.comparison.studies()[20].finals(judged)
    assert finals.groupby(["algorithm", "seed"]).size().between(1, 20).all()
    assert (finals.f2 >= 1 - finals.f1 - 1e-12).all()
    assert watched == [("timed runs", 4, 0), ("quality, N = 20", 6, 0)]
    assert campaign.kept(judged=False) == (4, 4)
    assert campaign.kept(judged=True) == (10, 10)

    before = line.designs
    again, _ = campaign.judge(front)
    pd.testing.assert_frame_equal(again, table)
    assert watched[-1] == ("quality, N = 20", 6, 6)
    assert line.designs == before + SAMPLE
    read = campaign.time()  # from files what was made before
    for name, run in store.items():
        for made, again in zip(run, read[name], strict=True):
            pd.testing.assert_frame_equal(made, again, check_exact=True)
    assert watched[-1] == ("timed runs", 4, 4)
    assert line.designs == before + 2 * SAMPLE  # nothing is warmed up


def test_runs_judged_at_other_budgets_are_not_resumed(tmp_path):
    """As those of a folder from before budgets were few: one line, before anything is timed."""
    campaign = Campaign(compared(Line()), tmp_path, tolerance=0.02)
    front = ReferenceFront.of(np.array([[0, 1.0], [1.0, 0]]))
    campaign.judge(front)
    campaign.check_judged(judged=True)
    path = tmp_path / "quality" / "plan.json"
    plan = json.loads(path.read_text())
    del plan["budgets"]
    path.write_text(json.dumps(plan))
    said = r"^budgets must be None as in '.*plan.json' to resume there, got {'20': \[20, 29, 42, 60\]}$"
    for resumed in (partial(campaign.check_judged, judged=True), partial(campaign.judge, front)):
        with pytest.raises(ValueError, match=said):
            resumed()


def test_the_reference_front_of_a_grid_is_made_once_for_a_folder(tmp_path):
    line = Line()
    campaign = Campaign(compared(line), tmp_path, tolerance=0.02)
    found = campaign.reference({})
    assert found.origin.startswith("a grid of 200 x 200 values (")
    assert found.front.volume == pytest.approx(0.71, abs=0.5 / 199)  # closed form, less triangles between points
    before = line.designs
    assert campaign.reference({}) == found
    assert line.designs == before + SAMPLE

    (tmp_path / "reference" / "final" / "front.csv").write_text("0,1\n")
    with pytest.warns(SpoiltRunWarning, match=r"front.csv: must be as it was stored"):
        assert campaign.reference({}) == found


def test_a_given_reference_front_is_kept_and_another_one_refused(tmp_path):
    line = Line()
    given, other = (Reference(ReferenceFront.of(np.array([[0, f2], [1.0, 0]])), "a table") for f2 in (1.0, 2.0))
    campaign = Campaign(compared(line), tmp_path)
    assert campaign.reference({}, given) == given
    assert line.designs == SAMPLE
    with pytest.raises(ValueError, match=r"^given.* must be .* to resume there"):
        campaign.reference({}, other)


@pytest.mark.parametrize(
    ("evaluate", "changes", "key"),
    [
        (lambda x: Line()(x) * (1 + 1e-15), {}, "problem"),
        (Line(), {"kinds": {"x1": (0, 0.5, 1)}}, "problem.kinds.x1"),
        (Line(), {"constraints": ("g",)}, "problem.constraints"),
    ],
)
def test_a_reference_front_of_another_problem_is_refused(tmp_path, evaluate, changes, key):
    Campaign(compared(Line()), tmp_path, tolerance=0.02).reference({})
    with pytest.raises(ValueError, match=f"^{key}.* must be .* to resume there"):
        Campaign(compared(evaluate, **changes), tmp_path, tolerance=0.02).reference({})


def test_another_tolerance_makes_no_use_of_a_reference_front(tmp_path):
    Campaign(compared(Line()), tmp_path, tolerance=0.02).reference({})
    with pytest.raises(ValueError, match=r"^tolerance must be 0.02 as in .* to resume there, got 0.01$"):
        Campaign(compared(Line()), tmp_path, tolerance=0.01).reference({})

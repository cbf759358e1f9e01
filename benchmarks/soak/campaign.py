"""A small campaign as a program, ``python -m soak.campaign FOLDER``, to be killed, starved and started again."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pandas as pd
from typer import Option

from suspension_ctrl import Problem
from suspension_ctrl.commands import terminal
from suspension_ctrl.quantities import Real
from suspension_ctrl.study.campaign import Campaign
from suspension_ctrl.study.comparison import Comparison
from suspension_ctrl.study.store import keeping
from suspension_ctrl.study.workers import cluster
from suspension_ctrl.tables import write_csv

BENCHMARKS = Path(__file__).parents[1]
EVENTS = ("open", "os.rename", "os.remove", "os.mkdir")
"""Of Python's audit events those of the file system."""

RESULTS, TABLE, COUNT = "results", "table.csv", "events"


def line(designs: Real) -> Real:
    """Return f1 = x and f2 = 1 - x + y of designs (n, 2): the front is y = 0."""
    return np.stack([designs[:, 0], 1 - designs[:, 0] + designs[:, 1]], axis=1)


def made(folder: Path, jobs: int | None = None, scheduler: str | None = None) -> pd.DataFrame:
    """Carry out the campaign in a folder, or what is missing of it, and return its table without times."""
    problem = Problem(evaluate=line, lower=(0, 0), upper=(1, 1), objectives=("f1", "f2"))
    comparison = Comparison(
        problem=problem, algorithms=["nsga2", "sobol"], populations=[20], iterations=[5], repeats=3, seeds=6
    )
    campaign = Campaign(comparison, folder, tolerance=0.02)
    reference = campaign.reference(campaign.time())
    assert reference is not None  # the line has a front
    with cluster(jobs, scheduler) as client:
        table, _ = campaign.judge(reference.front, client)
    order = ["algorithm", "seed", "budget", "set"]
    return table.drop(columns="seconds").sort_values(order, ignore_index=True)


def main(
    folder: Path,
    kill_at: Annotated[int, Option(help="Event of the file system in the folder at which to be killed.")] = 0,
    jobs: Annotated[int | None, Option(help="Processes.")] = None,
    scheduler: Annotated[str | None, Option(help="Address of a scheduler.")] = None,
) -> None:
    """Carry out a small campaign in a folder, or what is missing of it."""
    seen = iter(range(1, sys.maxsize))

    def watch(event: str, arguments: tuple[Any, ...]) -> None:
        if event in EVENTS and str(arguments[0]).startswith(str(folder)) and next(seen) == kill_at:
            os.kill(os.getpid(), signal.SIGKILL)

    sys.addaudithook(watch)
    with keeping(folder):
        write_csv(folder / TABLE, made(folder / RESULTS, jobs, scheduler))
    (folder / COUNT).write_text(str(next(seen)), encoding="utf-8")


def start(folder: Path, *options: object, **settings: Any) -> subprocess.Popen[str]:
    """Start the campaign in a process and a session of its own."""
    paths = [str(BENCHMARKS), str(BENCHMARKS.parent / "src")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([*paths, os.environ.get("PYTHONPATH", "")])}
    command = [sys.executable, "-m", "soak.campaign", str(folder), *map(str, options)]
    pipes: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, **pipes, env=environment, start_new_session=True, **settings)


def finish(folder: Path, *options: object, **settings: Any) -> tuple[int, str]:
    """Leave the campaign alone until it ends; return its exit status and standard error."""
    with start(folder, *options, **settings) as process:
        _, error = process.communicate(timeout=600)
    return process.returncode, error


def table_of(folder: Path) -> bytes:
    """Return the table of a campaign that has ended."""
    return (folder / TABLE).read_bytes()


def records(folder: Path) -> Mapping[Path, int]:
    """Return when each stored run was stored, by the path of its record."""
    return {path: path.stat().st_mtime_ns for path in _records(folder)}


def _records(folder: Path) -> Iterator[Path]:
    return (folder / RESULTS).glob("*/records/[!.]*.json")


def left_over(folder: Path) -> list[Path]:
    """Return the unfinished files in a folder."""
    return list(folder.rglob(".unfinished*"))


if __name__ == "__main__":
    terminal.run_script(main)

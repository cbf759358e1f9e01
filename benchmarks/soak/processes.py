"""Workers that are killed or kill themselves, schedulers that are killed or of other versions."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np

from suspension_ctrl import Nsga2, Problem, ReferenceFront, Study
from suspension_ctrl.quantities import Real
from suspension_ctrl.study.workers import local_cluster

from . import campaign
from .counts import Counts


def deadly(designs: Real) -> Real:
    """Kill the process that evaluates."""
    os.kill(os.getpid(), signal.SIGKILL)
    return designs


def deadly_runs(runs: int = 4) -> Counts:
    """Make as many runs that kill their process as others, on two workers: those have their results."""
    counts = Counts(f"{runs} runs that kill their process among {2 * runs}")
    front = ReferenceFront.of(campaign.line(np.column_stack([np.linspace(0, 1, 50), np.zeros(50)])))
    box: dict[str, Any] = {"lower": (0, 0), "upper": (1, 1), "objectives": ("f1", "f2")}
    problems = {
        "deadly": Problem(evaluate=deadly, **box),
        "good": Problem(evaluate=campaign.line, **box),
        "unpicklable": Problem(evaluate=_unpicklable(), **box),
    }
    study = Study(
        problems=problems, algorithms={"a": Nsga2(population=20)}, seeds=range(runs), budgets=[100],
        references=dict.fromkeys(problems, front),
    )  # fmt: skip
    with local_cluster(2) as client:
        made = study.carry_out({}, client)
        errors = {run.name: failure.error if failure else "" for run, failure in made}
    for name, error in errors.items():
        right = {"deadly": "KilledWorker: ", "good": "", "unpicklable": "TypeError: "}[name.split("_")[0]]
        counts.judge(f"{name}: {error}", lost=bool(error) != bool(right), unnamed=not error.startswith(right))
    return counts


def _unpicklable() -> Callable[[Real], Real]:
    lock = threading.Lock()
    return lambda designs: campaign.line(designs) if lock else designs


def workers_killed(folder: Path, count: int) -> Counts:
    """Kill a worker of a campaign on two of them, again and again."""
    counts = Counts("a worker killed")
    wanted = _undisturbed(folder)
    for number, place in enumerate(_places(folder, "worker", count)):
        process = campaign.start(place, "--jobs", 2)
        victims = _workers_of(process)
        time.sleep(0.3 * (number % 5))
        if victims:
            with suppress(ProcessLookupError):
                os.kill(victims[0], signal.SIGKILL)
        _, error = process.communicate(timeout=300)
        status = process.returncode
        at_start = status == 1 and error.count("\n") == 1 and error.startswith("error: processes must start")
        if at_start:
            campaign.finish(place, "--jobs", 2)
        differs = campaign.table_of(place) != wanted
        counts.judge(
            f"{status} {error!r}", differing=differs, unnamed=not (at_start or (status, error) == (0, ""))
        )
    return counts


def _places(folder: Path, name: str, count: int) -> Iterator[Path]:
    """Make and yield numbered folders in a folder."""
    for number in range(count):
        place = folder / f"{name}{number}"
        place.mkdir()
        yield place


def _undisturbed(folder: Path) -> bytes:
    place = folder / "undisturbed"
    place.mkdir(parents=True, exist_ok=True)
    campaign.finish(place)
    return campaign.table_of(place)


def _workers_of(process: "subprocess.Popen[str]") -> Sequence[int]:
    """Wait for the workers of a campaign and return them."""
    import psutil

    while process.poll() is None:
        with suppress(psutil.Error):
            children = psutil.Process(process.pid).children()
            workers = [one.pid for one in children if any("spawn_main" in text for text in one.cmdline())]
            if len(workers) == 2:
                return workers
        time.sleep(0.02)
    return []


def schedulers(folder: Path, count: int) -> Counts:
    """Kill the scheduler of a campaign, which goes on without; hand it one of another version, and none at all."""
    counts = Counts("scheduler killed, absent, of another version")
    wanted = _undisturbed(folder)
    for place in _places(folder, "scheduler", count):
        with scheduler(place) as (process, address):
            running = campaign.start(place, "--scheduler", address)
            quality = place / campaign.RESULTS / "quality" / "records"
            while running.poll() is None and not (quality.is_dir() and any(quality.glob("*.json"))):
                time.sleep(0.01)
            process.kill()
            _, error = running.communicate(timeout=300)
        before = campaign.records(place)
        said = (running.returncode, error.count("\n")) == (1, 1) and error.startswith("error: scheduler lost")
        status, _ = campaign.finish(place)
        repeated = sum(campaign.records(place)[path] != moment for path, moment in before.items())
        differs = status != 0 or campaign.table_of(place) != wanted
        what = f"killed: {running.returncode} {error!r}"
        counts.judge(what, differing=differs, repeated=repeated, unnamed=not (said or running.returncode == 0))
    place = folder / "versions"
    place.mkdir()
    status, error = campaign.finish(place, "--scheduler", "tcp://127.0.0.1:1")
    counts.judge(f"absent: {error!r}", unnamed=not _refused(status, error, "scheduler must be one that answers"))
    other = folder / "other" / "scipy-0.1.dist-info"
    other.mkdir(parents=True)
    (other / "METADATA").write_text("Metadata-Version: 2.1\nName: scipy\nVersion: 0.1\n", encoding="utf-8")
    with scheduler(place, path=other.parent) as (_, address):
        status, error = campaign.finish(place, "--scheduler", address)
    counts.judge(
        f"version: {error!r}", unnamed=not _refused(status, error, "scheduler must have workers with scipy")
    )
    return counts


def _refused(status: int, error: str, text: str) -> bool:
    return status == 2 and error.count("\n") == 1 and error.startswith(f"error: {text}")


@contextmanager
def scheduler(folder: Path, path: Path | None = None) -> "Iterator[tuple[subprocess.Popen[bytes], str]]":
    """Run a scheduler and a worker of it, which finds further packages in a folder; yield it and its address."""
    file, paths = folder / "scheduler.json", [str(campaign.BENCHMARKS), os.environ.get("PYTHONPATH", "")]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([*([str(path)] if path else []), *paths])}
    quiet: dict[str, Any] = {
        "stdout": subprocess.DEVNULL,
        "stderr": subprocess.DEVNULL,
        "cwd": folder,
        "env": environment,
    }
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    with subprocess.Popen([*command, "--no-dashboard", "--scheduler-file", str(file)], **quiet) as process:
        try:
            while True:
                with suppress(FileNotFoundError, json.JSONDecodeError):
                    address = json.loads(file.read_text(encoding="utf-8"))["address"]
                    break
                time.sleep(0.05)
            command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1"]
            with subprocess.Popen([*command, "--no-nanny", "--no-dashboard"], **quiet) as worker:
                try:
                    yield process, address
                finally:
                    worker.kill()
        finally:
            process.kill()

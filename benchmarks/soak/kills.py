"""Campaigns that are killed, at events of the file system and at any time, and started again."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from . import campaign
from .counts import Counts

COMPARE = ("compare", "--quick", "--quality", "--jobs", "2", "--out")
SECONDS = 5.0  # within which a campaign ends


def killed(folder: Path, count: int, seed: int = 0) -> list[Counts]:
    """Kill campaigns `count` times, half of them at events of the file system, and compare what they leave."""
    undisturbed, draw = folder / "undisturbed", random.Random(seed)
    undisturbed.mkdir(parents=True)
    status, error = campaign.finish(undisturbed)
    if (status, error) != (0, ""):
        raise RuntimeError(f"the undisturbed campaign must end in silence, got {status}: {error}")
    events = int((undisturbed / campaign.COUNT).read_text(encoding="utf-8"))
    rows = Counts("SIGKILL at an event of the file system"), Counts("SIGKILL at any time")
    for number in range(count):
        place = folder / f"killed{number // 10}"  # ten kills of each campaign
        place.mkdir(exist_ok=True)
        if number % 2:
            _kill(rows[1], place, after=draw.uniform(0, SECONDS))
        else:
            _kill(rows[0], place, event=draw.randrange(1, max(2, events // 5)))
        if number % 10 == 9 or number == count - 1:
            _end(rows[number % 2], place, campaign.table_of(undisturbed))
    return list(rows)


def _kill(counts: Counts, place: Path, event: int = 0, after: float | None = None) -> None:
    before = campaign.records(place)
    process = campaign.start(place, "--kill-at", event)
    if after is not None:
        deadline = time.monotonic() + after
        while time.monotonic() < deadline and process.poll() is None:
            time.sleep(0.001)
        process.kill()
    _, error = process.communicate(timeout=600)
    stored = campaign.records(place)
    lost = sum(path not in stored for path in before)
    repeated = sum(path in stored and stored[path] != moment for path, moment in before.items())
    said = [text for text in error.splitlines() if not text.startswith("warning: ")]
    counts.judge(
        f"{place.name} event {event} after {after}: {error!r}", lost=lost, repeated=repeated, unnamed=bool(said)
    )


def _end(counts: Counts, place: Path, wanted: bytes) -> None:
    """Let a killed campaign end; its unfinished files are old by then."""
    for path in campaign.left_over(place):
        os.utime(path, (0, 0))
    before = campaign.records(place)
    status, error = campaign.finish(place)
    stored = campaign.records(place)
    counts.lost += sum(path not in stored for path in before)
    counts.repeated += sum(path in stored and stored[path] != moment for path, moment in before.items())
    if status or campaign.table_of(place) != wanted:
        counts.differing += 1
        counts.failures.append(f"{place.name}: status {status}, {error}")
    counts.left += len(campaign.left_over(place))
    shutil.rmtree(place)


def signalled(folder: Path, count: int, seed: int = 0, longest: float = 15.0) -> Counts:
    """Send Ctrl-C and SIGTERM to a comparison on two processes at any time: one line, nothing left behind."""
    counts, draw = Counts("Ctrl-C or SIGTERM at any time"), random.Random(seed)
    words = {signal.SIGINT: "error: interrupted\n", signal.SIGTERM: "error: terminated\n"}
    for number in range(count):
        place = folder / f"signalled{number}"
        place.mkdir(parents=True)
        kind, after = draw.choice(list(words)), draw.uniform(0.1, longest)
        command = [sys.executable, "-c", "from suspension_ctrl.commands import main; main()", *COMPARE]
        pipes: dict[str, Any] = {"stdout": subprocess.DEVNULL, "stderr": subprocess.PIPE, "text": True}
        with subprocess.Popen([*command, place / "out"], **pipes, start_new_session=True) as process:
            time.sleep(after)
            (os.killpg if kind == signal.SIGINT else os.kill)(process.pid, kind)  # a terminal's reaches all
            _, error = process.communicate(timeout=120)
        said = (process.returncode, error) in ((128 + kind, words[kind]), (0, ""), (-kind, ""))  # before Python
        left = len(session(process.pid)) + len(campaign.left_over(place))
        counts.judge(
            f"{kind.name} after {after:.2f} s: {process.returncode} {error!r}", unnamed=not said, left=left
        )
        shutil.rmtree(place)
    return counts


def session(number: int, patience: float = 3.0) -> list[int]:
    """Return the processes of a session that live on after a while."""
    import psutil

    deadline = time.monotonic() + patience
    while True:
        alive = []
        for process in psutil.process_iter(["status"]):
            try:
                if os.getsid(process.pid) == number and process.info["status"] != psutil.STATUS_ZOMBIE:
                    alive.append(process.pid)
            except OSError:
                continue
        if not alive or time.monotonic() > deadline:
            return alive
        time.sleep(0.1)

"""Section 5: the main script from the command to its end, and what importing the package takes."""

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pandas as pd

from sections.timing import take_turns

COMPARE = "python scripts/compare.py"
IMPORTS = ("import control", "import suspension_ctrl")
"""Statements that are timed one after the other in a new process, so that the second leaves out the first."""


def measure(compare: Path, arguments: list[str], repeats: int, import_repeats: int) -> pd.DataFrame:
    """Return one row per process and statement: contender, repeat, seconds."""

    def whole(_: int) -> Any:
        return lambda: run([str(compare), *arguments])

    rows = [
        {key: row[key] for key in ("contender", "repeat", "seconds")}
        for row in take_turns({COMPARE: whole}, repeats, limit=float("inf"))
    ]
    for repeat in range(import_repeats + 1):
        times = import_seconds()
        if repeat:  # the first brings the files into memory
            rows += [{"contender": name, "repeat": repeat, "seconds": time} for name, time in times.items()]
    return pd.DataFrame(rows)


def import_seconds() -> dict[str, float]:
    """Return the time of each of `IMPORTS` in a new process [s]."""
    steps = "".join(f"{statement}; t.append(perf_counter()); " for statement in IMPORTS)
    program = f"from time import perf_counter; t = [perf_counter()]; {steps}print(*t)"
    times = [float(text) for text in run(["-c", program]).split()]
    return {name: after - before for name, before, after in zip(IMPORTS, times[:-1], times[1:], strict=True)}


def run(arguments: list[str]) -> str:
    """Run Python in a folder of its own and return what it prints."""
    with TemporaryDirectory() as folder:
        command = [sys.executable, *arguments]
        return subprocess.run(command, check=True, capture_output=True, text=True, cwd=folder).stdout

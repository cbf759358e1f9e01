"""Kill, starve and spoil campaigns in bulk and print what it did to them, a row of counts each.

`make soak` is the long form, ``ARGS=--quick`` the short one of the tests; `--docs` writes the table to a page.
"""

import os
import platform
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table
from typer import Option

from suspension_ctrl.commands import terminal
from suspension_ctrl.study.machine import processor_name
from suspension_ctrl.tables import write_text

from . import disks, fuzz, kills, names, processes, spoilt
from .counts import Counts
from .readers import readers

PAGE, MARK = "reliability.md", "<!-- soak -->\n"
COLUMNS = ("tried", "lost", "repeated", "differing", "unnamed", "left")


def rows(folder: Path, *, quick: bool) -> Iterator[Counts]:
    """Yield the counts of each kind of abuse."""
    yield from kills.killed(folder / "killed", 2 if quick else 100)
    yield disks.two_writers(folder, 60 if quick else 1000)
    yield from disks.full(folder / "full", mounted=not quick and disks.may_mount(), sizes=1 if quick else 2)
    yield spoilt.spoilt(folder / "spoilt", 13 if quick else None)
    yield names.hostile()
    if not quick:
        yield processes.deadly_runs()
        yield processes.workers_killed(folder / "workers", 5)
        yield processes.schedulers(folder / "schedulers", 2)
        yield kills.signalled(folder / "signalled", 20)
        yield fuzzed(10_000)


def fuzzed(files: int) -> Counts:
    """Hand fuzzed files to every reader; `python -m soak.fuzz 10000` says which."""
    counts = Counts(f"fuzzed files, {files:,} of each reader")
    for name, reader in readers().items():
        outcome = fuzz.fuzz(reader, files)
        counts.tried += outcome.files
        counts.unnamed += len(outcome.failures)
        counts.failures += [f"{name} {failure}" for failure in outcome.failures]
    return counts


def page(found: Sequence[Counts]) -> str:
    """Return the counts as a table in Markdown, with date and machine."""
    lines = [f"| abuse | {' | '.join(COLUMNS)} |", f"|---|{'---|' * len(COLUMNS)}"]
    lines += [f"| {one.abuse} | {' | '.join(str(getattr(one, name)) for name in COLUMNS)} |" for one in found]
    where = f"{processor_name()}, {os.cpu_count()} cores, {platform.system()}, Python {platform.python_version()}"
    return "\n".join([f"Measured on {datetime.now(UTC):%Y-%m-%d}: {where}.", "", *lines, ""])


def main(
    quick: Annotated[bool, Option("--quick", help="Short form, under a minute.")] = False,
    docs: Annotated[Path | None, Option(help="Folder of reliability.md, whose table is renewed.")] = None,
) -> None:
    """Kill, starve and spoil campaigns in bulk, and count what it did to them."""
    if docs and not (docs / PAGE).is_file():
        raise ValueError(f"docs must be a folder with {PAGE}, got {str(docs)!r}")
    shown, found = Table("abuse", *COLUMNS, "seconds"), []
    with tempfile.TemporaryDirectory(prefix="soak-") as folder:
        start = time.monotonic()
        for one in rows(Path(folder), quick=quick):
            found.append(one)
            counts = (str(getattr(one, name)) for name in COLUMNS)
            shown.add_row(one.abuse, *counts, f"{time.monotonic() - start:.0f}")
            print(one.abuse, one.harm(), file=sys.stderr, flush=True)
    Console(width=120).print(shown)
    for failure in (text for one in found for text in one.failures):
        terminal.complain(failure)
    if docs:
        text = (docs / PAGE).read_text(encoding="utf-8")
        write_text(docs / PAGE, text.partition(MARK)[0] + MARK + page(found))
    if any(one.harm() for one in found):
        raise typer.Exit(1)


if __name__ == "__main__":
    terminal.run_script(main)

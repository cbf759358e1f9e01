"""The terminal: one-line errors, progress, and the report of the command, printed after its files are written."""

import os
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager, nullcontext
from io import TextIOWrapper
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import typer
from rich import progress as bars
from rich.console import Console

from .. import escaping
from . import signals
from .report import Form, Report, Table

if TYPE_CHECKING:
    import pandas as pd


class Output(Console):
    """A console that is silent once its pipe is closed: the command carries on, and its files are written."""

    def on_broken_pipe(self) -> None:
        """Print nothing more."""
        self.quiet = True
        if self.file is sys.__stdout__:
            _drop_output()


def _drop_output() -> None:
    """Send the rest of standard output nowhere: at the end of the process it would raise once more."""
    if sys.__stdout__ is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.__stdout__.fileno())


PIPE = 80
"""Columns of text outside of a terminal."""

console = Output(width=None if sys.stdout.isatty() else PIPE)
stderr = Console(stderr=True)
report = Report()
"""The report of the command that runs."""
T = TypeVar("T")


def run(app: typer.Typer, *before: str, name: str | None = None) -> NoReturn:
    """Run an app with the arguments `before` and those of this process, and exit with its status.

    An error is one line on standard error, with status 2 for wrong input, 1 for a file that cannot be read or
    written and for a missing package, 130 for Ctrl-C, 143 for SIGTERM.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")  # no error for a symbol outside of the encoding
    warnings.showwarning = _warn
    begin(Form.TEXT)
    try:
        signals.end_in_order()
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "overflow|divide by zero|invalid value", RuntimeWarning)
            result = "", app([*before, *sys.argv[1:]], prog_name=name, standalone_mode=False)
        say(ended=True)
    except BaseException as error:
        result = signals.ended() or _ending(error)
    try:
        sys.stdout.flush()
    except OSError:  # a full disk
        _drop_output()
    message, status = signals.ended() or result
    for line in filter(None, message.split("\n")):
        complain(line)
    sys.exit(status)


def _ending(error: BaseException) -> tuple[str, int]:
    """Return lines and exit status for an error of input or system; raise any other."""
    if isinstance(error, typer.TyperException):
        return " ".join(error.format_message().split()), 2
    if isinstance(error, ValueError):
        from ..documents import lines_of

        return "\n".join(lines_of(error)), 1 if isinstance(error, OSError) else 2
    if isinstance(error, ArithmeticError | RuntimeWarning):
        return f"numbers must be of moderate size, got {error.args[-1]}", 2
    if isinstance(error, OSError | ImportError):
        return str(error), 1
    if isinstance(error, MemoryError):
        return f"not enough memory: {error}", 1
    if isinstance(error, KeyboardInterrupt | typer.Abort):
        return "interrupted", 130
    raise error


def _warn(message: Warning | str, *_: object, **__: object) -> None:
    """Print a warning in one line, without its line of code."""
    complain(str(message), "warning")


def run_script(main: Callable[..., None]) -> NoReturn:
    """Run `main` as an app of one command."""
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    app.command()(main)
    run(app)


def complain(message: str, kind: str = "error") -> None:
    """Print one line on standard error."""
    print(escaping.terminal(f"{kind}: {' '.join(message.split())}"), file=sys.stderr)


def progress(items: Iterable[T], total: int, text: str = "") -> Iterator[T]:
    """Yield `items` with a progress bar, drawn only between them so that it does not disturb timings."""
    columns = [
        bars.TextColumn(text, markup=False),
        bars.BarColumn(),
        bars.MofNCompleteColumn(),
        bars.TimeElapsedColumn(),
    ]
    columns += [bars.TextColumn("left"), bars.TimeRemainingColumn()]
    settings: dict[str, Any] = {"transient": True, "auto_refresh": False, "disable": not stderr.is_terminal}
    with bars.Progress(*columns, console=stderr, **settings) as bar:
        task = bar.add_task("", total=total)
        bar.refresh()
        for item in items:
            bar.update(task, advance=1, refresh=True)
            yield item


def waiting(text: str) -> AbstractContextManager[Any]:
    """Return a context that shows a text with a spinner, in a terminal only."""
    return stderr.status(text, spinner="line") if stderr.is_terminal else nullcontext()


@contextmanager
def compiling() -> Iterator[None]:
    """Announce the first compilation by numba in the block, in a terminal only."""
    from numba.core import event

    class Compilation(event.Listener):
        announced = not stderr.is_terminal

        def on_start(self, _event: object) -> None:
            if not self.announced:
                stderr.print("compiling, once after installation: about 10 s", highlight=False)
            self.announced = True

        on_end = on_start

    with event.install_listener("numba:compile", Compilation()):
        yield


def begin(form: Form) -> None:
    """Begin the report of a command, to be printed in a form."""
    global report
    report = Report(form)


def note(text: str) -> None:
    """Add a paragraph without markup to the report; unprintable characters are escaped."""
    report.items.append(text)


def note_lines(text: str) -> None:
    """Add a text to the report line by line, as `note`."""
    for line in text.splitlines():
        note(line)


def show(
    title: str,
    table: "pd.DataFrame",
    digits: Mapping[str, int] | None = None,
    keys: int = 1,
    *,
    readable: bool = False,
    sides: bool = False,
) -> None:
    """Add a table to the report; `digits` is the number of decimals by column; NaN is blank.

    The columns of a table wider than the terminal are printed in blocks, each with the first `keys` columns. A
    `readable` table is in SI units and printed in mm, kN, kN/m and kN s/m; with `sides` left and right are printed
    as one row where they are equal to the digits shown.
    """
    report.items.append(Table(title, table, digits or {}, keys, readable, sides))


def end(folder: Path) -> None:
    """Name the folder of the results, the last line printed."""
    report.folder = folder


def say(*, ended: bool = False) -> None:
    """Print the report so far, if it is text: a long command shows its first tables before the last are there.

    `run` prints the rest once a command has `ended`, in any form.
    """
    if report.form is Form.TEXT:
        for line, title in report.text(console.width, plain=not console.is_terminal):
            console.out(line, style="bold" if title else None, highlight=False)
        report.items.clear()
    elif report.form is Form.JSON and ended:
        console.out(report.document(), highlight=False)
    if ended and report.folder is not None and report.form is not Form.JSON:
        console.out("\n" * report.apart + str(report.folder), highlight=False)

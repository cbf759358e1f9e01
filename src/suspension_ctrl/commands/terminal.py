"""The terminal: one-line errors, tables that fit its width, progress."""

import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from io import TextIOWrapper
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import typer
from rich import progress as bars
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from .. import escaping
from . import signals

if TYPE_CHECKING:
    import pandas as pd

console = Console(width=None if sys.stdout.isatty() else 130)
stderr = Console(stderr=True)
T = TypeVar("T")

_PIPE = 80  # columns of a paragraph outside of a terminal
_GAP = 3  # columns of text between two columns of a table


def run(app: typer.Typer, *before: str, name: str | None = None) -> NoReturn:
    """Run an app with the arguments `before` and those of this process, and exit with its status.

    An error is one line on standard error, with status 2 for wrong input, 1 for a file that cannot be read or
    written and for a missing package, 130 for Ctrl-C, 143 for SIGTERM.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")  # no error for a symbol outside of the encoding
    warnings.showwarning = _warn
    try:
        signals.end_in_order()
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "overflow|divide by zero|invalid value", RuntimeWarning)
            result = "", app([*before, *sys.argv[1:]], prog_name=name, standalone_mode=False)
    except BaseException as error:
        result = signals.ended() or _ending(error)
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

        return "\n".join(lines_of(error)), 2
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


def note(text: str) -> None:
    """Print a paragraph without markup, unprintable characters escaped; in 80 columns outside of a terminal."""
    width = console.width if console.is_terminal else min(console.width, _PIPE)
    console.print(escaping.terminal(text), markup=False, highlight=False, emoji=False, width=width)


def note_lines(text: str) -> None:
    """Print a text line by line, as `note`."""
    for line in text.splitlines():
        note(line)


def show(title: str, table: "pd.DataFrame", digits: dict[str, int] | None = None, keys: int = 1) -> None:
    """Print a table; `digits` is the number of decimals by column; NaN is blank.

    The columns of a table wider than the terminal are printed in blocks, each with the first `keys` columns.
    """
    cells = {str(c): [_cell(value, (digits or {}).get(c)) for value in table[c]] for c in table.columns}
    right = {str(c) for c in table.columns if table[c].dtype.kind in "iuf"}
    widths = {name: max(map(len, [name, *column])) + _GAP for name, column in cells.items()}
    console.print(Text(escaping.terminal(title), style="bold"))
    for block in _blocks(list(cells)[:keys], list(cells)[keys:], widths):
        shown = Table(box=SIMPLE_HEAD, pad_edge=False, show_edge=False)
        for name in block:  # as Text: units in brackets are no markup
            shown.add_column(
                Text(escaping.terminal(name)), justify="right" if name in right else "left", no_wrap=True
            )
        for row in zip(*(cells[name] for name in block), strict=True):
            if any(row[keys:]):
                shown.add_row(*map(Text, row))
        console.print(shown)
        console.print()


def _blocks(keys: list[str], others: list[str], widths: dict[str, int]) -> list[list[str]]:
    """Return the columns in blocks that fit the terminal, each with one of the `others` at least."""
    blocks: list[list[str]] = []
    for name in others:
        if not blocks or sum(widths[c] for c in [*blocks[-1], name]) > console.width:
            blocks.append(list(keys))
        blocks[-1].append(name)
    return blocks or [keys]


def _cell(value: Any, digits: int | None) -> str:
    if not isinstance(value, float):  # numpy's are floats
        return escaping.terminal(str(value))
    return "" if value != value else f"{value:.6g}" if digits is None else f"{value:.{digits}f}"

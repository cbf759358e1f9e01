"""What the scripts share: one-line errors, lists on the command line, tables and progress in the terminal."""

import sys
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

import numpy as np
import pandas as pd
import typer
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeElapsedColumn
from rich.table import Table
from rich.text import Text

console = Console(width=None if sys.stdout.isatty() else 130)
_stderr = Console(stderr=True, soft_wrap=True)
T = TypeVar("T")


def run_script(main: Callable[..., None]) -> None:
    """Run `main` as a command; bad input ends it with one line on standard error and exit status 2.

    A file that cannot be read or written ends it with one line and status 1, an interrupt with 130.
    """
    app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    app.command()(main)
    try:
        sys.exit(app(standalone_mode=False))
    except typer.TyperException as error:
        _fail(error.format_message(), 2)
    except ValueError as error:
        _fail(str(error), 2)
    except OSError as error:
        _fail(str(error), 1)
    except MemoryError as error:
        _fail(f"not enough memory: {error}", 1)
    except (KeyboardInterrupt, typer.Abort):
        _fail("interrupted", 130)


def _fail(message: str, status: int) -> None:
    complain(message)
    sys.exit(status)


def complain(message: str) -> None:
    """Print one line on standard error."""
    _stderr.print(f"error: {' '.join(message.split())}", markup=False, highlight=False, emoji=False)


def whole_number(text: str) -> int:
    """Return the whole number that an option's text stands for."""
    try:
        return int(text)
    except ValueError:
        raise typer.BadParameter(f"must be a whole number, got {text!r}") from None


def number(text: str) -> float:
    """Return the number that an option's text stands for."""
    try:
        return float(text)
    except ValueError:
        raise typer.BadParameter(f"must be a number, got {text!r}") from None


def whole_numbers(name: str, text: str) -> list[int]:
    """Return the whole numbers of a comma-separated list, each once; ValueError naming `name` otherwise."""
    try:
        return list(dict.fromkeys(int(part) for part in text.split(",")))
    except ValueError:
        raise ValueError(f"{name} must be whole numbers separated by commas, got {text!r}") from None


def numbers(name: str, text: str, count: int) -> list[float]:
    """Return the `count` numbers of a comma-separated list; ValueError naming `name` otherwise."""
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count:
        raise ValueError(f"{name} must be {count} numbers separated by commas, got {text!r}")
    return values


def band_of(text: str | None) -> dict[str, tuple[float, float]]:
    """Return the setting ``band`` [Hz] that an option's text stands for, none if it is not given."""
    if text is None:
        return {}
    low, high = numbers("band", text, 2)
    return {"band": (low, high)}


def names(text: str) -> list[str]:
    """Return the names of a comma-separated list, each once."""
    return list(dict.fromkeys(part.strip() for part in text.split(",")))


def progress(items: Iterable[T], total: int) -> Iterator[T]:
    """Pass `items` through with a progress bar, drawn only between them so as not to disturb a timed one."""
    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False) as bar:
        task = bar.add_task("", total=total)
        for item in items:
            bar.update(task, advance=1, refresh=True)
            yield item


def note(text: str) -> None:
    """Print a paragraph as it is."""
    console.print(text, markup=False, highlight=False, emoji=False)


def show(title: str, table: pd.DataFrame, digits: dict[str, int] | None = None) -> None:
    """Print a table; numbers with the decimals that `digits` names by column, blank where there is none."""
    shown = Table(title=title, title_justify="left", title_style="bold", box=SIMPLE_HEAD, pad_edge=False)
    for column in table.columns:
        numeric = pd.api.types.is_numeric_dtype(table[column])
        shown.add_column(Text(str(column)), justify="right" if numeric else "left", no_wrap=True)
    for row in table.itertuples(index=False):
        cells = zip(table.columns, row, strict=True)
        shown.add_row(
            *(Text(_cell(v, (digits or {}).get(c))) for c, v in cells)
        )  # units in brackets are no markup
    console.print(shown)


def _cell(value: Any, digits: int | None) -> str:
    if isinstance(value, float | np.floating):
        return "" if np.isnan(value) else f"{value:.{digits}f}" if digits is not None else f"{value:.6g}"
    return str(value)

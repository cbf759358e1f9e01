"""CSV files in and out: numbers under the names of their columns, read strictly and written whole.

Lines that start with ``#`` say where the numbers are from.
"""

import csv
import json
import math
import os
import re
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING, Any

import numpy as np

from .quantities import Real

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_LARGEST = 1e9  # beyond roads and vehicles; its square is finite
_DEVICES = r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)"  # reserved names of Windows, with any ending


def read_table(path: str | PathLike[str]) -> tuple[list[str], Real]:
    """Return names of columns (c,) and finite values (rows, c) of two rows or more; ValueError otherwise."""
    names, *rows = table_rows(path)
    if len(rows) < 2:
        raise ValueError(f"{path}: there must be two rows of numbers at least, got {len(rows)}")
    values = np.array([_numbers(path, number, names, row) for number, row in enumerate(rows, start=1)])
    return names, values


def table_rows(path: str | PathLike[str]) -> list[list[str]]:
    """Return the rows of a CSV file, the first the names of its columns, without comments and empty lines."""
    try:
        with Path(path).open(encoding="utf-8-sig", newline="") as file:
            lines = (line for line in file if line.strip() and not line.startswith("#"))
            rows = [[cell.strip() for cell in row] for row in csv.reader(lines, strict=True)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: must be a CSV file in UTF-8, got {' '.join(str(error).split())}") from None
    if not rows:
        raise ValueError(f"{path}: must begin with the names of its columns, got nothing")
    return rows


def _numbers(path: str | PathLike[str], number: int, names: list[str], row: list[str]) -> list[float]:
    if len(row) != len(names):
        raise ValueError(f"{path}: row {number} must have {len(names)} cells as {names}, got {len(row)}")
    return [_number(path, number, name, cell) for name, cell in zip(names, row, strict=True)]


def _number(path: str | PathLike[str], number: int, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not abs(value) <= _LARGEST:
        raise ValueError(f"{path}: {name!r} must be a number up to {_LARGEST:g}, got {cell!r} in row {number}")
    return value


def file_name(text: str) -> str:
    """Return the text as a file's name: letters, digits and ``._+-`` as they are, ``_`` for all else."""
    name = re.sub(r"[^\w.+-]", "_", text).strip(".") or "_"
    return f"_{name}" if re.match(_DEVICES, name, re.IGNORECASE) else name


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Let `write` fill a temporary file beside `path`, of the same ending, then put it in place in one step."""
    with NamedTemporaryFile(dir=path.parent, prefix=".", suffix=path.suffix, delete=False) as file:
        temporary = Path(file.name)
    try:
        write(temporary)
        temporary.chmod(0o644)
        with temporary.open("rb+") as written:
            os.fsync(written.fileno())  # the content is on the disk before the name is
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_csv(path: Path, frame: "pd.DataFrame") -> None:
    """Write a table without its index."""
    write_whole(path, lambda temporary: frame.to_csv(temporary, index=False))


def write_text(path: Path, text: str) -> None:
    """Write a text file."""
    write_whole(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write a JSON file, indented."""
    write_text(path, json.dumps(dict(content), indent=2) + "\n")


def write_table(stem: Path, frame: "pd.DataFrame") -> None:
    """Write a table as CSV in full, and as Markdown and LaTeX (booktabs) with six digits."""
    write_csv(stem.with_suffix(".csv"), frame)
    shown = frame.map(lambda value: f"{value:.6g}" if isinstance(value, float) else value)
    write_text(stem.with_suffix(".md"), shown.to_markdown(index=False, disable_numparse=True) + "\n")
    latex = shown.style.hide(axis="index").format(escape="latex").format_index(escape="latex", axis="columns")
    write_text(stem.with_suffix(".tex"), latex.to_latex(hrules=True))


def write_figure(stem: Path, figure: "Figure") -> None:
    """Write a figure as PNG and as PDF, named `stem` with the ending added."""
    for suffix in (".png", ".pdf"):
        write_whole(stem.with_name(stem.name + suffix), lambda temporary: figure.savefig(temporary, dpi=160))

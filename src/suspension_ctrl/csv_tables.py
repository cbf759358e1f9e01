"""CSV files of numbers under the names of their columns; lines that start with ``#`` say where they are from."""

import csv
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from os import PathLike

_LARGEST = 1e9
"""Beyond what roads and vehicles have; its square is still a number."""


def read_table(path: "str | PathLike[str]") -> tuple[list[str], NDArray[np.float64]]:
    """Return the names of the columns (c,) and their values (rows, c), two rows at least.

    Raises
    ------
    ValueError
        Naming the file, if it is no such table or a cell is no finite number.
    OSError
        If the file cannot be read.
    """
    names, *rows = table_rows(path)
    if len(rows) < 2:
        raise ValueError(f"{path}: there must be two rows of numbers at least, got {len(rows)}")
    values = np.array([_numbers(path, number, names, row) for number, row in enumerate(rows, start=1)])
    return names, values


def table_rows(path: "str | PathLike[str]") -> list[list[str]]:
    """Return the rows of a CSV file, the first the names of its columns, without comments and empty lines."""
    try:
        with Path(path).open(encoding="utf-8-sig", newline="") as file:
            lines = (line for line in file if line.strip() and not line.startswith("#"))
            rows = [[cell.strip() for cell in row] for row in csv.reader(lines, strict=True)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise ValueError(f"{path}: must be a CSV file in UTF-8, got {_one_line(error)}") from None
    if not rows:
        raise ValueError(f"{path}: must begin with the names of its columns, got nothing")
    return rows


def _numbers(path: "str | PathLike[str]", number: int, names: list[str], row: list[str]) -> list[float]:
    if len(row) != len(names):
        raise ValueError(f"{path}: row {number} must have {len(names)} cells as {names}, got {len(row)}")
    return [_number(path, number, name, cell) for name, cell in zip(names, row, strict=True)]


def _number(path: "str | PathLike[str]", number: int, name: str, cell: str) -> float:
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not abs(value) <= _LARGEST:
        raise ValueError(f"{path}: {name!r} must be a number up to {_LARGEST:g}, got {cell!r} in row {number}")
    return value


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())

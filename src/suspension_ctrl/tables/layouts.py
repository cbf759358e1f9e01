"""Layout of a CSV file, detected from its first lines: header, separator, decimal sign and comment sign.

Cells are separated by tabs, semicolons, commas, vertical bars or blanks; a decimal comma is allowed unless commas
separate. Lines that start with ``#``, ``%`` or ``!`` are comments.
"""

import csv
from collections.abc import Callable, Iterator, Sequence
from itertools import islice
from math import isnan, nan
from typing import TYPE_CHECKING, Any, NamedTuple, Self, TextIO

import numpy as np

from .. import checks
from ..quantities import Real

if TYPE_CHECKING:
    import pandas as pd

LARGEST = 1e9
"""Largest number in a table: beyond roads and vehicles, and its square is finite."""
HEAD = 65536
"""Characters of the first lines together, and of any line at most."""
_ROWS = 100_000  # at a time
_COMMENTS, _SEPARATORS = ("#", "%", "!"), "\t;,|"
_SIGNS = {".": str.maketrans("_", " "), ",": str.maketrans(",._", ".  ")}  # float() takes 1_0 for 10


class Layout(NamedTuple):
    """The layout of a file."""

    names: list[str]  # of the columns, none without a header
    width: int  # number of columns
    row: list[str]  # cells of the first row, with an empty one after a separator at its end
    header: int  # lines before it
    separator: str  # " " for any blanks
    decimal: str
    comment: str

    @classmethod
    def of(cls, lines: Sequence[str]) -> Self:
        """Detect the layout from the first lines of a file; csv.Error or ValueError without success."""
        if max(map(len, lines), default=0) > HEAD:
            raise ValueError(f"the file must have lines of {HEAD} characters at most, got a longer one")
        comment = next((text[0] for text in map(str.lstrip, lines) if text.startswith(_COMMENTS)), "#")
        texts = [
            (i, line) for i, line in enumerate(lines) if line.strip() and not line.lstrip().startswith(_COMMENTS)
        ]
        if not texts:
            raise ValueError("the file must begin with the names of its columns, got nothing")
        (first, top), row = texts[0], texts[min(1, len(texts) - 1)][1].partition(comment)[0]
        if bare := _separator(top.partition(comment)[0], single=True):
            row = top.partition(comment)[0]
        separator = bare or _separator(row) or next((one for one in _SEPARATORS if one in top), ",")
        names, cells = [] if bare else _without_last(_cells(top, separator)), _cells(row, separator)
        width, after = len(names) or len(_without_last(cells)), 0 if bare else 1
        comma = separator != "," and any("," in line for _, line in texts[after:])
        return cls(names, width, cells, first + after, separator, "," if comma else ".", comment)

    def renamed(self, names: Sequence[str] | None) -> Self:
        """Return the layout with other names of its columns, if given; ValueError unless as many."""
        if names is None:
            return self
        checks.listed("columns", names)
        if len(names) != self.width:
            raise ValueError(f"columns must be names of {self.width} columns, got {checks.shown(list(names))}")
        return self._replace(names=[str(name).strip() for name in names])

    def places(self, columns: Sequence[str] | Callable[[Sequence[str]], Sequence[int]] | None) -> list[int]:
        """Return the indices of the columns, by default and without names of all; ValueError if one is missing."""
        if callable(columns):
            return list(columns(self.names) if self.names else range(self.width))
        for name in columns or ():
            if name not in self.names:
                raise ValueError(f"columns must include {name!r}, got {checks.shown(self.names)}")
        return list(range(self.width)) if columns is None else [self.names.index(name) for name in columns]

    def values(self, file: TextIO, wanted: Sequence[int]) -> Real:
        """Return the finite values (n, c) of the wanted columns; ValueError about the first wrong cell."""
        import pandas as pd

        kinds = {i: float if i in wanted else str for i in range(max(self.width, len(self.row)))}
        options: dict[str, Any] = {
            "sep": r"\s+" if self.separator == " " else self.separator, "decimal": self.decimal,
            "comment": self.comment, "names": list(kinds), "header": None, "dtype": kinds,
            "na_filter": False, "skipinitialspace": True, "chunksize": _ROWS,
        }  # fmt: skip
        values = np.empty((0, len(wanted)))
        self._begin(file)
        try:
            for part in pd.read_csv(file, **options):
                numbers, start = self._numbers(part, wanted), len(values)
                # in place: without a copy of a large table
                values.resize((start + len(part), len(wanted)), refcheck=False)
                values[start:] = numbers
        except (ValueError, OverflowError):
            raise ValueError(self._mistake(file, wanted, len(values))) from None
        return values

    def _numbers(self, part: "pd.DataFrame", wanted: Sequence[int]) -> Real:
        """Return the values of rows; ValueError for NaN, large values and cells beyond the columns."""
        values: Real = part[list(wanted)].to_numpy(dtype=float)
        if not values.size:
            return values
        beyond = any((part[i] != "").any() for i in part.columns[self.width :])
        # pandas converts a column of True and False to 1 and 0
        named = any(isnan(_number(self.row[i], self.decimal)) for i in wanted)
        if beyond or named or not (values.min() >= -LARGEST and values.max() <= LARGEST):
            raise ValueError
        return values

    def _begin(self, file: TextIO) -> None:
        """Move to the first row."""
        file.seek(0)
        for _ in range(self.header):
            file.readline()

    def _mistake(self, file: TextIO, wanted: Sequence[int], good: int) -> str:
        """Return the message about the first wrong row after `good` correct ones."""
        self._begin(file)
        for number, row in enumerate(self._rows(file, good), start=good + 1):
            cells = _without_last(row) if len(row) > self.width else row
            if len(cells) != self.width:
                names = f" as in {checks.shown(self.names)}" if number == 1 and self.names else ""
                return f"row {number} must have {self.width} cells{names}, got {len(cells)}"
            for i in wanted:
                if not abs(_number(cells[i], self.decimal)) <= LARGEST:
                    name = checks.shown(self.names[i]) if self.names else f"column {i + 1}"
                    return (
                        f"{name} must be a number up to {LARGEST:g}, got {checks.shown(cells[i])} in row {number}"
                    )
        return "the file must be CSV, got rows that cannot be told apart"

    def _rows(self, file: TextIO, first: int) -> Iterator[list[str]]:
        texts = (line.partition(self.comment)[0] for line in file)
        lines = islice((text for text in texts if text.strip()), first, None)
        if self.separator == " ":
            return map(str.split, lines)
        rows = csv.reader(lines, delimiter=self.separator, strict=True)
        return ([cell.strip() for cell in row] for row in rows)


def _cells(line: str, separator: str) -> list[str]:
    if separator == " ":
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]


def _without_last(cells: list[str]) -> list[str]:
    """Return the cells without an empty one after a separator at the end of the line."""
    return cells[:-1] if len(cells) > 1 and not cells[-1] else cells


def _separator(line: str, *, single: bool = False) -> str | None:
    """Return the separator of a line of two or more numbers, blanks of a `single` one; None for another line."""
    if single and not isnan(_number(line.strip(), ".")):
        return " "
    for one in f"{_SEPARATORS} ":
        signs = "." if one == "," else ".,"
        cells = _without_last(_cells(line, one)) if one in line.strip() else [""]
        if all(any(not isnan(_number(cell, sign)) for sign in signs) for cell in cells):
            return one
    return None


def _number(cell: str, decimal: str) -> float:
    """Return the number in a cell, NaN if there is none."""
    try:
        return float(cell.translate(_SIGNS[decimal]))
    except ValueError:
        return nan

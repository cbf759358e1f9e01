"""How a CSV file is laid out, told by its first lines: header, separator, decimal sign and comment sign.

Cells are separated by tabs, semicolons, commas or blanks; a decimal comma goes with all but commas. Lines that
start with ``#`` or ``%`` are comments.
"""

import csv
from collections.abc import Iterator, Sequence
from math import isnan, nan
from typing import Any, NamedTuple, Self, TextIO

from . import checks
from .quantities import Real

LARGEST = 1e9
"""Of numbers in a table: beyond roads and vehicles, and its square is finite."""
HEAD = 65536
"""Characters of the first lines, and most of a line."""
_SIGNS = {".": str.maketrans("_", " "), ",": str.maketrans(",._", ".  ")}  # float() takes 1_0 for 10


class Layout(NamedTuple):
    """The layout of a file."""

    names: list[str]  # of the columns, none without a header
    width: int  # number of columns
    row: list[str]  # the first; with a separator at its end, one cell more
    header: int  # lines before it
    separator: str  # " " for any blanks
    decimal: str
    comment: str

    @classmethod
    def of(cls, lines: Sequence[str]) -> Self:
        """Tell the layout by the first lines of a file; csv.Error or ValueError if there is none."""
        if max(map(len, lines), default=0) > HEAD:
            raise ValueError(f"the file must have lines of {HEAD} characters at most, got a longer one")
        comment = next((line[0] for line in lines if line.startswith(("#", "%"))), "#")
        texts = [(i, line) for i, line in enumerate(lines) if line.strip() and line.lstrip()[0] not in "#%"]
        if not texts:
            raise ValueError("the file must begin with the names of its columns, got nothing")
        first, top = texts[0]
        if bare := _separator(top):
            return cls._told([], _cells(top, bare), first, bare, comment, texts)
        row = texts[min(1, len(texts) - 1)][1].partition(comment)[0]
        separator = _separator(row) or next((one for one in "\t;," if one in top), ",")
        names, cells = _without_last(_cells(top, separator)), _cells(row, separator)
        return cls._told(names, cells, first + 1, separator, comment, texts[1:])

    @classmethod
    def _told(
        cls, names: list[str], row: list[str], header: int, separator: str, comment: str, texts: Sequence[Any]
    ) -> Self:
        comma = separator != "," and any("," in line for _, line in texts)
        width = len(names) or len(_without_last(row))
        return cls(names, width, row, header, separator, "," if comma else ".", comment)

    def places(self, columns: Sequence[str] | None) -> list[int]:
        """Return the places of the columns, by default of all; ValueError if one is absent."""
        for name in columns or ():
            if name not in self.names:
                raise ValueError(f"columns must include {name!r}, got {checks.shown(self.names)}")
        return list(range(self.width)) if columns is None else [self.names.index(name) for name in columns]

    def values(self, file: TextIO, wanted: Sequence[int]) -> Real:
        """Return the finite values (n, c) of the wanted columns; ValueError about the first that is none."""
        import pandas as pd

        kinds = {i: float if i in wanted else str for i in range(max(self.width, len(self.row)))}
        separator = r"\s+" if self.separator == " " else self.separator
        signs: dict[str, Any] = {"sep": separator, "decimal": self.decimal, "comment": self.comment}
        options: dict[str, Any] = {
            "names": list(kinds),
            "header": None,
            "na_filter": False,
            "skipinitialspace": True,
        }
        self._begin(file)
        try:
            table = pd.read_csv(file, dtype=kinds, **signs, **options)
        except (ValueError, OverflowError):
            raise ValueError(self._mistake(file, wanted)) from None
        values = table[list(wanted)].to_numpy(dtype=float)
        beyond = any((table[i] != "").any() for i in kinds if i >= self.width)
        if values.size and (beyond or not self._are_numbers(values, wanted)):
            raise ValueError(self._mistake(file, wanted))
        return values

    def _are_numbers(self, values: Real, wanted: Sequence[int]) -> bool:
        """Whether none is NaN or too large, or a column of True and False, which pandas takes for 1 and 0."""
        numbers = not any(isnan(_number(self.row[i], self.decimal)) for i in wanted)
        return bool(numbers and values.min() >= -LARGEST and values.max() <= LARGEST)

    def _begin(self, file: TextIO) -> None:
        """Go to the first row."""
        file.seek(0)
        for _ in range(self.header):
            file.readline()

    def _mistake(self, file: TextIO, wanted: Sequence[int]) -> str:
        """Return a sentence about the first row that is wrong."""
        self._begin(file)
        for number, row in enumerate(self._rows(file), start=1):
            cells = _without_last(row) if len(row) > self.width else row
            if len(cells) != self.width:
                return f"row {number} must have {self.width} cells, got {len(cells)}"
            for i in wanted:
                if not abs(_number(cells[i], self.decimal)) <= LARGEST:
                    name = checks.shown(self.names[i]) if self.names else f"column {i + 1}"
                    return (
                        f"{name} must be a number up to {LARGEST:g}, got {checks.shown(cells[i])} in row {number}"
                    )
        return "the file must be CSV, got rows that cannot be told apart"

    def _rows(self, file: TextIO) -> Iterator[list[str]]:
        texts = (line.partition(self.comment)[0] for line in file)
        lines = (text for text in texts if text.strip())
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


def _separator(line: str) -> str | None:
    """Return the separator of a line of numbers, two at least; None for another line."""
    for one in "\t;, ":
        signs = "." if one == "," else ".,"
        cells = _without_last(_cells(line, one)) if one in line.strip() else [""]
        if all(any(not isnan(_number(cell, sign)) for sign in signs) for cell in cells):
            return one
    return None


def _number(cell: str, decimal: str) -> float:
    """Return a number with a decimal sign, NaN if it is none."""
    try:
        return float(cell.translate(_SIGNS[decimal]))
    except ValueError:
        return nan

"""CSV files in and out: numbers under the names of their columns, read strictly and written whole.

Cells that are read are separated by tabs, semicolons, commas or blanks; a decimal comma goes with all but commas.
Lines that start with ``#`` or ``%`` say where the numbers are from.
"""

import csv
import json
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import TYPE_CHECKING, Any, NamedTuple, Self, TextIO

import numpy as np

from . import checks, escaping
from .documents import naming
from .quantities import Real

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_LARGEST = 1e9  # beyond roads and vehicles; its square is finite
_MEGABYTES = 100  # of a file
_HEAD = 65536  # characters of the first lines, which tell the layout of the others
_SIGNS = {".": str.maketrans("_", " "), ",": str.maketrans(",._", ".  ")}  # float() takes 1_0 for 10
_DEVICES = r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)"  # reserved names of Windows, with any ending


def read_table(
    path: str | PathLike[str], columns: Sequence[str] | None = None, rows: int = 2
) -> tuple[list[str], Real]:
    """Return names of columns (c,), none without a header, and finite values (n, c) of `rows` or more.

    With `columns`, these are returned and the others may hold texts. Raises ValueError, naming the file.
    """
    with naming(path):
        checks.regular(Path(path), _MEGABYTES)
        try:
            with Path(path).open(encoding="utf-8-sig", newline="") as file:
                layout = _Layout.of(file.readlines(_HEAD))
                wanted = layout.places(columns)
                values = layout.values(file, wanted)
        except (UnicodeDecodeError, csv.Error) as error:
            got = "another encoding" if isinstance(error, UnicodeDecodeError) else "quotes that do not end"
            raise ValueError(f"the file must be CSV in UTF-8, got {got}") from None
        if len(values) < rows:
            raise ValueError(f"rows of numbers must be {rows} or more, got {len(values)}")
        return [layout.names[i] for i in wanted if layout.names], values


class _Layout(NamedTuple):
    names: list[str]  # of the columns, none without a header
    size: int  # number of columns
    row: list[str]  # the first; with a separator at its end, one cell more
    header: int  # lines before it
    separator: str  # " " for any blanks
    decimal: str
    comment: str

    @classmethod
    def of(cls, lines: Sequence[str]) -> Self:
        """Tell the layout by the first lines of a file."""
        if max(map(len, lines), default=0) > _HEAD:
            raise ValueError(f"the file must have lines of {_HEAD} characters at most, got a longer one")
        comment = next((line[0] for line in lines if line.startswith(("#", "%"))), "#")
        rows = [(i, line) for i, line in enumerate(lines) if line.strip() and line[0] not in "#%"]
        if not rows:
            raise ValueError("the file must begin with the names of its columns, got nothing")
        (first, top), row = rows[0], rows[min(1, len(rows) - 1)][1].partition(comment)[0]
        if bare := _separator(top):
            row = top
        separator = bare or _separator(row) or next((one for one in "\t;," if one in top), ",")
        comma = separator != "," and any("," in line for _, line in rows[not bare :])
        names = [] if bare else _without_last(_cells(top, separator))
        cells = _cells(row, separator)
        size = len(names) or len(_without_last(cells))
        return cls(names, size, cells, first + (not bare), separator, "," if comma else ".", comment)

    def places(self, columns: Sequence[str] | None) -> list[int]:
        """Return the places of the columns, by default of all."""
        for name in columns or ():
            if name not in self.names:
                raise ValueError(f"columns must include {name!r}, got {checks.shown(self.names)}")
        return list(range(self.size)) if columns is None else [self.names.index(name) for name in columns]

    def values(self, file: TextIO, wanted: Sequence[int]) -> Real:
        """Return the values (n, c) of the wanted columns."""
        import pandas as pd

        kinds: dict[int, type] = {i: float if i in wanted else str for i in range(max(self.size, len(self.row)))}
        separator = r"\s+" if self.separator == " " else self.separator
        options: dict[str, Any] = {"na_filter": False, "skipinitialspace": True, "header": None}
        self._begin(file)
        try:
            table = pd.read_csv(
                file, sep=separator, decimal=self.decimal, comment=self.comment, names=list(kinds), dtype=kinds,
                **options,
            )  # fmt: skip
            found = table[list(wanted)].to_numpy(dtype=float)
            if not found.size:
                return found
            good = all((table[i] == "").all() for i in table.columns[self.size :])
            good &= found.min() >= -_LARGEST and found.max() <= _LARGEST  # and no NaN
            good &= not any(np.isnan(_number(self.row[i], self.decimal)) for i in wanted)  # but True or False
        except (ValueError, OverflowError):
            good = False
        if not good:
            raise ValueError(self._mistake(file, wanted))
        return found

    def _begin(self, file: TextIO) -> None:
        """Go to the first row."""
        file.seek(0)
        for _ in range(self.header):
            file.readline()

    def _mistake(self, file: TextIO, wanted: Sequence[int]) -> str:
        """Return a sentence about the first row that is wrong."""
        self._begin(file)
        for number, row in enumerate(self._rows(file), start=1):
            cells = _without_last(row) if len(row) > self.size else row
            if len(cells) != self.size:
                return f"row {number} must have {self.size} cells, got {len(cells)}"
            for i in wanted:
                if not abs(_number(cells[i], self.decimal)) <= _LARGEST:
                    name = repr(self.names[i]) if self.names else f"column {i + 1}"
                    got = f"{checks.shown(cells[i])} in row {number}"
                    return f"{name} must be a number up to {_LARGEST:g}, got {got}"
        return "the file must be CSV in UTF-8, got rows that cannot be told apart"

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
        if one in line.strip():
            cells = _without_last(_cells(line, one))
            if not any(np.isnan(_number(cell, "." if one == "," else ",")) for cell in cells):
                return one
    return None


def _number(cell: str, decimal: str) -> float:
    """Return a number with a decimal sign, NaN if it is none."""
    try:
        return float(cell.translate(_SIGNS[decimal]))
    except ValueError:
        return np.nan


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
    """Write a table without its index, no text of it a formula."""
    harmless = escaping.frame(frame, escaping.csv)
    write_whole(path, lambda temporary: harmless.to_csv(temporary, index=False))


def read_csv(path: Path) -> "pd.DataFrame":
    """Read a table that `write_csv` wrote."""
    import pandas as pd

    return escaping.frame(pd.read_csv(path), escaping.from_csv)


def write_text(path: Path, text: str) -> None:
    """Write a text file."""
    write_whole(path, lambda temporary: temporary.write_text(text, encoding="utf-8"))


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write a JSON file, indented."""
    write_text(path, json.dumps(dict(content), indent=2) + "\n")


def write_table(stem: Path, frame: "pd.DataFrame") -> None:
    """Write a table as CSV in full, and as Markdown and LaTeX (booktabs) with six digits."""
    write_csv(stem.with_suffix(".csv"), frame)
    markdown, latex = (_shown(frame, medium) for medium in (escaping.markdown, escaping.latex))
    write_text(stem.with_suffix(".md"), markdown.to_markdown(index=False, disable_numparse=True) + "\n")
    write_text(stem.with_suffix(".tex"), latex.style.hide(axis="index").to_latex(hrules=True))


def _shown(frame: "pd.DataFrame", medium: Callable[[str], str]) -> "pd.DataFrame":
    texts = escaping.frame(frame, medium)
    return texts.map(lambda value: f"{value:.6g}" if isinstance(value, float) else value)


def write_figure(stem: Path, figure: "Figure") -> None:
    """Write a figure as PNG and as PDF, named `stem` with the ending added."""
    for suffix in (".png", ".pdf"):
        write_whole(stem.with_name(stem.name + suffix), lambda temporary: figure.savefig(temporary, dpi=160))

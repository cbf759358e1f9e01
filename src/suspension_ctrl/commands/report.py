"""The report of a command: paragraphs, tables and its folder, kept until its files are written.

It is printed as text, as one JSON document, or as the path of the folder alone.
"""

import json
import math
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import escaping

if TYPE_CHECKING:
    import pandas as pd

_PLAIN = str.maketrans({"µ": "u", "²": "^2", "³": "^3", "·": " ", "…": "...", "±": "+-", "°": "deg"})


class Form(StrEnum):
    """How a report is printed."""

    TEXT = "text"
    QUIET = "quiet"  # the path of the folder alone
    JSON = "json"


class Table(NamedTuple):
    """A table of a report."""

    title: str
    frame: "pd.DataFrame"  # in SI units
    decimals: Mapping[str, int]  # of columns by the header that is printed
    keys: int  # first columns, repeated where the columns stand in blocks
    readable: bool  # printed in mm, kN, kN/m and kN s/m
    sides: bool = False  # left and right printed as one row where they are equal to the digits shown

    def lines(self, room: int, *, plain: bool) -> Iterator[str]:
        """Yield the lines of the table; NaN is blank."""
        from ..tables.headers import readable
        from ..tables.rounding import rounded
        from .text_tables import Column, lines_of, sides_in_one

        frame = readable(self.frame) if self.readable else self.frame
        columns = []
        for name in frame:
            cells = rounded(frame[name].tolist(), self.decimals.get(str(name)), alike="unit" not in frame)
            texts = [_shown(cell, plain=plain) for cell in cells]
            columns.append(Column(_shown(str(name), plain=plain), texts, frame[name].dtype.kind in "iuf"))
        columns = sides_in_one(columns) if self.sides else columns
        yield from lines_of(columns, self.keys, room, "-" if plain else "─")

    def record(self) -> dict[str, Any]:
        """Return the table for JSON: title, units by column, and a record for each row."""
        from ..tables.headers import own_name_and_unit

        names = [own_name_and_unit(str(header)) for header in self.frame]
        keys = [name for name, _ in names]
        if len(set(keys)) < len(keys):  # as in "ACC [m/s^2]" beside "ACC [%]"
            keys = [str(header) for header in self.frame]
        rows = zip(*(map(_value, self.frame[header].tolist()) for header in self.frame), strict=True)
        return {
            "title": self.title,
            "units": {key: unit for key, (_, unit) in zip(keys, names, strict=True) if unit},
            "records": [dict(zip(keys, row, strict=True)) for row in rows],
        }


@dataclass
class Report:
    """Paragraphs and tables in their order, and the folder."""

    form: Form = Form.TEXT
    items: list[str | Table] = field(default_factory=list)
    folder: Path | None = None
    begun: bool = False  # whether a line is printed
    apart: bool = False  # whether an empty line must follow: after a table

    def text(self, room: int, *, plain: bool) -> Iterator[tuple[str, bool]]:
        """Yield the lines of the report and whether each is a title; `plain` lines have no signs beyond ASCII."""
        for item in self.items:
            is_table = isinstance(item, Table)
            if self.apart or (is_table and self.begun):
                yield "", False
            title, lines = (item.title, item.lines(room, plain=plain)) if isinstance(item, Table) else (item, [])
            for line in textwrap.wrap(_shown(title, plain=plain), room) or [""]:
                yield line, is_table
            yield from ((line, False) for line in lines)
            self.begun, self.apart = True, is_table

    def document(self) -> str:
        """Return the report as JSON."""
        content = {
            "folder": None if self.folder is None else str(self.folder),
            "paragraphs": [item for item in self.items if not isinstance(item, Table)],
            "tables": [item.record() for item in self.items if isinstance(item, Table)],
        }
        return json.dumps(content, indent=2, allow_nan=False)


def _shown(text: str, *, plain: bool) -> str:
    shown = escaping.terminal(text)
    return shown.translate(_PLAIN) if plain else shown


def _value(cell: Any) -> Any:
    """Return a cell for JSON; null for NaN and infinity."""
    if isinstance(cell, float):
        return cell if math.isfinite(cell) else None
    return cell if cell is None or isinstance(cell, int | str) else str(cell)

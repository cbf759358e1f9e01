"""Tables of texts at the width of a terminal: headers and texts are wrapped, wide tables stand in blocks."""

import re
import textwrap
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import NamedTuple

from rich.cells import cell_len

from ..tables.blocks import blocks
from ..vehicles.parameters import alike

_GAP = 2  # characters between two columns
_TEXT = 24  # characters to which a text may be wrapped
_LEAST = 8  # characters of a name that is broken
_UNIT = re.compile(r"\[[^\]]*\]$")


class Column(NamedTuple):
    """A column of a table."""

    header: str
    cells: Sequence[str]
    right: bool  # numbers, which are never broken

    @property
    def natural(self) -> int:
        """Width of the column with every text in one line."""
        return max(map(cell_len, [self.header, *self.cells]))

    @property
    def word(self) -> int:
        """Width of the longest word of the cells."""
        return max((cell_len(word) for cell in self.cells for word in cell.split()), default=0)

    @property
    def least(self) -> int:
        """Width of the column with its header, and texts longer than `_TEXT`, wrapped between words."""
        widest = max(map(cell_len, self.cells), default=0)
        body = widest if self.right else max(min(widest, _TEXT), self.word)
        return max([body, *map(cell_len, _bound(self.header).split(" "))])


def sides_in_one(columns: Sequence[Column]) -> list[Column]:
    """Return a table with one row for left and right where all cells beside the name are equal."""
    names = list(columns[0].cells)
    rows = dict(zip(names, zip(*(one.cells for one in columns[1:]), strict=True), strict=True))
    if len(rows) < len(names):  # names that stand twice
        return list(columns)
    pairs = {own[0]: f"{common} (left and right)" for common, own in alike(rows).items() if len(own) == 2}
    left_out = {own[1] for own in alike(rows).values() if len(own) == 2}
    kept = [i for i, name in enumerate(names) if name not in left_out]
    named = columns[0]._replace(cells=[pairs.get(name, name) for name in names])
    return [one._replace(cells=[one.cells[i] for i in kept]) for one in (named, *columns[1:])]


def lines_of(columns: Sequence[Column], keys: int, room: int, rule: str) -> Iterator[str]:
    """Yield the lines of a table of at most `room` characters, an empty line between blocks.

    Each block has the first `keys` columns; a row without any other cell is left out.
    """
    by_name = {str(n): column for n, column in enumerate(columns)}
    least = {name: column.least for name, column in by_name.items()}
    for n, names in enumerate(blocks(list(by_name), keys, least, room, _GAP)):
        yield from [""] if n else []
        shown = [by_name[name] for name in names]
        widths = _widths(shown, [least[name] for name in names], room - _GAP * (len(names) - 1))
        rows = [row for row in zip(*(one.cells for one in shown), strict=True) if any(row[keys:] or row)]
        head = [_wrapped(_bound(one.header), width) for one, width in zip(shown, widths, strict=True)]
        body = [
            [
                [cell] if one.right else _wrapped(cell, width)
                for one, cell, width in zip(shown, row, widths, strict=True)
            ]
            for row in rows
        ]
        widths = [max(map(cell_len, chain.from_iterable(texts))) for texts in zip(head, *body, strict=True)]
        yield from _lines(_row(head, bottom=True), shown, widths)
        yield rule * (sum(widths) + _GAP * (len(widths) - 1))
        for cells in body:
            yield from _lines(_row(cells, bottom=False), shown, widths)


def _widths(columns: Sequence[Column], least: Sequence[int], room: int) -> list[int]:
    """Return the widths of the columns: wider where there is room, with broken names where there is none."""
    widths = list(least)
    for n, column in enumerate(columns):
        widths[n] += max(0, min(column.natural - widths[n], room - sum(widths)))
    texts = [n for n, column in enumerate(columns) if not column.right]
    while texts and sum(widths) > room and max(widths[n] for n in texts) > _LEAST:
        whole = [n for n in texts if widths[n] > max(columns[n].word, _LEAST)]
        widths[max(whole or texts, key=widths.__getitem__)] -= 1
    return widths


def _row(cells: Sequence[Sequence[str]], *, bottom: bool) -> list[list[str]]:
    """Return the cells (c, lines) with empty lines above or below, so that all have as many."""
    most = max(map(len, cells))
    return [
        [""] * (most - len(cell)) + [*cell] if bottom else [*cell] + [""] * (most - len(cell)) for cell in cells
    ]


def _lines(row: Sequence[Sequence[str]], columns: Sequence[Column], widths: Sequence[int]) -> Iterator[str]:
    for line in zip(*row, strict=True):
        texts = []
        for text, column, width in zip(line, columns, widths, strict=True):
            space = " " * (width - cell_len(text))
            texts.append(space + text if column.right else text + space)
        yield (" " * _GAP).join(texts).rstrip()


def _bound(header: str) -> str:
    """Return a header whose unit is not broken."""
    return _UNIT.sub(lambda unit: unit[0].replace(" ", "\N{NO-BREAK SPACE}"), header)


def _wrapped(text: str, width: int) -> list[str]:
    """Return a text in lines of at most `width` characters; a longer word is broken after `_` or `.`."""
    lines = textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False) or [""]
    part = re.compile(rf".{{1,{width}}}$|.{{0,{width - 1}}}[_.]|.{{1,{width}}}")
    broken = [piece for line in lines for piece in (part.findall(line) if len(line) > width else [line])]
    return [line.replace("\N{NO-BREAK SPACE}", " ") for line in broken]

"""A printed page, A4: a title, paragraphs, a picture and tables, all in one size of letters that fits."""

import re
import textwrap
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import escaping

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAGE = _WIDTH, _HEIGHT = 8.27, 11.69
"""Size of a page [in]."""

_MARGIN = 0.75  # inches
_ROW, _TITLE, _PICTURE = 0.165, 0.42, 2.3  # inches, at full size
_LETTER, _SIZE = 0.6, 8.0  # width of a letter over its size, and size in points
_COLUMNS, _GAP = 105, 3  # letters of a paragraph, and between columns of a table
_NUMBER = re.compile(r"[^A-Za-z]*")  # a cell to the right


class Block(NamedTuple):
    """A table with a title, and a note below it."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""


class Picture(NamedTuple):
    """Axes side by side, each drawn by a function."""

    draw: Sequence[Callable[["Axes"], None]]


Content = str | Block | Picture
"""A paragraph, a table or a picture."""


def fill(figure: "Figure", title: str, date: str, contents: Sequence[Content]) -> None:
    """Put contents on a page one below the other; letters shrink until all fits."""
    scale = min(1.0, (_HEIGHT - 2 * _MARGIN - _TITLE) / sum(map(_height, contents)))
    top = _HEIGHT - _MARGIN
    _text(figure, _MARGIN, top, title, 13, weight="bold")
    _text(figure, _WIDTH - _MARGIN, top, date, 8, ha="right")
    top -= _TITLE
    for one in contents:
        _put(figure, one, top, scale)
        top -= scale * _height(one)


def _height(one: Content) -> float:
    """Return the height of a content at full size [in]."""
    if isinstance(one, Picture):
        return _PICTURE
    if isinstance(one, str):
        return _ROW * (len(_wrapped(one)) + 0.7)
    return _ROW * (len(one.rows) + 3.5 + len(_wrapped(one.note)))


def _put(figure: "Figure", one: Content, top: float, scale: float) -> None:
    """Put a content below a height [in]."""
    if isinstance(one, Picture):
        _draw(figure, one, top, scale)
    elif isinstance(one, str):
        _lines(figure, _wrapped(one), top, scale)
    else:
        _text(figure, _MARGIN, top, one.title, 9 * scale, weight="bold")
        _table(figure, one, top - 1.3 * _ROW * scale, scale)
        _lines(figure, _wrapped(one.note), top - (len(one.rows) + 2.5) * _ROW * scale, scale)


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _COLUMNS)


def _lines(figure: "Figure", lines: Sequence[str], top: float, scale: float) -> None:
    for i, line in enumerate(lines):
        _text(figure, _MARGIN, top - i * _ROW * scale, line, _SIZE * scale, color="0.25")


def _table(figure: "Figure", block: Block, top: float, scale: float) -> None:
    """Put a table: columns of numbers to the right, all as wide as their longest cell needs."""
    columns = list(zip(block.header, *block.rows, strict=True))
    widths = [max(map(len, column)) + _GAP for column in columns]
    letters, room = sum(widths) - _GAP, _WIDTH - 2 * _MARGIN
    size = min(_SIZE * scale, room * 72 / (_LETTER * letters))
    spread = room / letters if letters * _LETTER * size / 72 > 0.6 * room else _LETTER * size / 72
    left = _MARGIN
    for column, width in zip(columns, widths, strict=True):
        to_right = all(_NUMBER.fullmatch(cell) for cell in column[1:])
        x = left + (width - _GAP) * spread if to_right else left
        for i, cell in enumerate(column):
            _text(figure, x, top - i * _ROW * scale, cell, size, ha="right" if to_right else "left")
        left += width * spread
    for row in (0, len(block.rows)):
        y = (top - (row + 0.5) * _ROW * scale) / _HEIGHT
        ends = [_MARGIN / _WIDTH, min(left - _GAP * spread, _WIDTH - _MARGIN) / _WIDTH]
        figure.add_artist(_rule(ends, y))


def _rule(x: Sequence[float], y: float) -> Any:
    from matplotlib.lines import Line2D

    return Line2D(x, [y, y], color="0.5", lw=0.6)


def _draw(figure: "Figure", picture: Picture, top: float, scale: float) -> None:
    count = len(picture.draw)
    room = (_WIDTH - 2 * _MARGIN) / count
    for i, draw in enumerate(picture.draw):
        left, height = _MARGIN + i * room + 0.6, _PICTURE * scale - 0.75
        box = (left / _WIDTH, (top - height - 0.1) / _HEIGHT, (room - 0.75) / _WIDTH, height / _HEIGHT)
        draw(figure.add_axes(box))


def _text(figure: "Figure", x: float, y: float, text: str, size: float, **style: Any) -> None:
    shown = re.sub(r"\^([23])", lambda power: "²³"[int(power[1]) - 2], escaping.figure(text))
    figure.text(x / _WIDTH, y / _HEIGHT, shown, fontsize=size, va="center", **style)

r"""Texts of files and users made harmless: one function per medium, a name in, a text for that medium out.

Every medium shows a character that does not print (control characters, escape sequences, marks of right-to-left
writing) as Python's escape of it: ``\x1b``, ``\u202e``.
"""

import html as _html
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

_FORMULA = re.compile(r"\s*['=+\-@\uff0b\uff0d\uff1d\uff20]")  # OWASP, "CSV injection"; ' is the mark itself
_LATEX = str.maketrans(
    {char: f"\\{char}" for char in "&%$#_{}"}
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    | {"<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}"}
)
_MARKDOWN = re.compile(r"[\\`*|~$]|(?<!\w)_|_(?!\w)|\[(?=[^\]]*\][(\[:])")


def terminal(text: str) -> str:
    """Return the text for a terminal; rich takes it as `Text`, without markup."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def figure(text: str) -> str:
    """Return the text for matplotlib: ``$`` opens no formula, and ``_`` in front hides no label from a legend."""
    return re.sub("^_", " _", terminal(text).replace("$", r"\$"))


def csv(text: str) -> str:
    """Return the text for a cell that no spreadsheet takes for a formula: ``'`` marks one that could be."""
    if text.isprintable() and (not _FORMULA.match(text) or _is_number(text)):
        return text
    return "'" + terminal(text.replace("\\", r"\\"))


def from_csv(text: str) -> str:
    """Return the text of which `csv` made this one."""
    if not text.startswith("'"):
        return text
    return text[1:].encode("latin-1", "backslashreplace").decode("unicode_escape")


def html(text: str) -> str:
    """Return the text for the content or an attribute of HTML."""
    return _html.escape(terminal(text))


def markdown(text: str) -> str:
    """Return the text for a paragraph or a cell of Markdown."""
    return _MARKDOWN.sub(r"\\\g<0>", _html.escape(terminal(text), quote=False))


def latex(text: str) -> str:
    """Return the text for LaTeX."""
    return terminal(text).translate(_LATEX)


def frame(table: "pd.DataFrame", medium: Callable[[str], str]) -> "pd.DataFrame":
    """Return a table with the texts of its cells and headers for a medium."""

    def escaped(column: "pd.Series[Any]") -> "pd.Series[Any]":
        numbers = column.dtype.kind in "biufc"  # left alone: a profile has millions
        return column if numbers else column.map(lambda cell: medium(cell) if isinstance(cell, str) else cell)

    return table.apply(escaped).rename(columns=lambda name: medium(str(name)))


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True

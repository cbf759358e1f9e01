r"""Escaping of texts from files and users: one function per output medium.

All media show an unprintable character (control characters, escape sequences, marks of right-to-left writing) as
its escape in Python: ``\x1b``, ``\u202e``.
"""

import html as _html
import re
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

_FORMULA = re.compile(r"\s*['=+\-@\uff0b\uff0d\uff1d\uff20]")  # OWASP, "CSV injection"; ' is the sign of `csv`
_LATEX = str.maketrans(
    {char: f"\\{char}" for char in "&%$#_{}"}
    | {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    | {"<": r"\textless{}", ">": r"\textgreater{}", "|": r"\textbar{}"}
)
_MARKDOWN = re.compile(r"[\\`*|~$]|(?<!\w)_|_(?!\w)|\[(?=[^\]]*\][(\[:])")


def terminal(text: str) -> str:
    """Return the text for a terminal, where rich prints it as `Text` without markup."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def figure(text: str) -> str:
    """Return the text for matplotlib: no formula between ``$``, no leading ``_``, which hides a label."""
    return re.sub("^_", " _", terminal(text).replace("$", r"\$"))


def csv(text: str) -> str:
    """Return the text for a CSV cell; ``'`` before a text that a spreadsheet could read as a formula."""
    if text.isprintable() and (not _FORMULA.match(text) or _is_number(text)):
        return text
    return "'" + terminal(text.replace("\\", r"\\"))


def from_csv(text: str) -> str:
    """Return the text from its form by `csv`."""
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
    """Return a table with the texts of cells and headers escaped for a medium."""

    def escaped(column: "pd.Series[Any]") -> "pd.Series[Any]":
        numbers = column.dtype.kind in "biufc"  # unchanged: a profile has millions
        return column if numbers else column.map(lambda cell: medium(cell) if isinstance(cell, str) else cell)

    texts = [kind for kind in table.dtypes if kind.kind not in "biufc"]
    return (table.apply(escaped) if texts else table).rename(columns=lambda name: medium(str(name)))


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True

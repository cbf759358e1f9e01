"""Candidates as tables to read: parts that fit a page, and a page of Markdown."""

from collections.abc import Iterator, Mapping, Sequence

import pandas as pd

from .. import escaping
from ..search.problem import Minimisable, headers_of
from ..tables.headers import readable
from ..tables.rounding import rounded
from .proofs import PRICE, RESIDUAL

_MODES = 4  # that stand side by side, in two columns each; the columns of more do not fit a page
_OF_MODES = {  # first header, end of the columns of a table of candidates, and decimals
    "Natural frequencies [Hz], without dampers, by candidate": ("frequency of", " [Hz]", 2),
    "Damping ratios [-] by candidate": ("damping of", " damping [-]", 3),
}


def parts_of(problem: Minimisable, table: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return parts of a table of `candidates` by title, in SI units; of many modes with a row for each mode."""
    d, headers = len(problem.variables), list(headers_of(problem))
    given = [str(one) for one in table]
    changes = {f"{name} change [%]": f"{name} [%]" for name in problem.objectives}
    travels = [one for one in given if "travel in " in one]
    prices = [one for one in given if one.startswith(PRICE)]
    modes = [
        one for one in given if one not in {"name", "active", *headers, *changes, *travels, *prices, RESIDUAL}
    ]
    columns = {
        "Candidates": ["name", *headers[d:]],
        "Changes against the present design": [one for one in given if one in changes],
        "Designs and largest travel" if travels else "Designs": [*headers[:d], *travels],
        "Modes, without dampers, and damping ratios": [] if len(modes) > 2 * _MODES else modes,
        f"Prices: change of {problem.objectives[0]} by the values of other measures and by limits": prices,
    }
    numbered = table.rename(columns=changes).rename_axis("no.").reset_index()
    parts = {
        title: numbered[["no.", *(changes.get(name, name) for name in names)]]
        for title, names in columns.items()
        if names
    }
    return parts if len(modes) <= 2 * _MODES else parts | _by_mode(table[modes])


def _by_mode(modes: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Return frequencies and damping ratios by title, a row for each mode and a column for each candidate."""
    parts = {}
    for title, (first, end, _) in _OF_MODES.items():
        headers = [header for header in map(str, modes) if header.endswith(end)]
        part = pd.DataFrame(modes[headers].to_numpy().T, columns=list(map(str, modes.index)))
        part.insert(0, first, [header.removesuffix(end) for header in headers])
        parts[title] = part
    return parts


def decimals_of(part: pd.DataFrame) -> dict[str, int]:
    """Return the decimals of changes [%] and of modes; other columns show the digits that matter."""
    for first, _, decimals in _OF_MODES.values():
        if first in part:
            return dict.fromkeys(map(str, part), decimals)
    digits = {"[%]": 1, " damping [-]": 3}
    return {str(header): n for header in part for end, n in digits.items() if str(header).endswith(end)}


def markdown(title: str, parts: Mapping[str, pd.DataFrame], texts: Sequence[str]) -> str:
    """Return a page of Markdown: sentences, then parts of the table in mm and kN."""
    return "\n".join(_lines(title, parts, texts)) + "\n"


def _lines(title: str, parts: Mapping[str, pd.DataFrame], texts: Sequence[str]) -> Iterator[str]:
    yield from (f"# {escaping.markdown(title)}", "", *(f"- {escaping.markdown(text)}" for text in texts))
    for name, part in parts.items():
        shown, digits = readable(part), decimals_of(part)
        cells = pd.DataFrame(
            {str(header): rounded(shown[header].tolist(), digits.get(str(header))) for header in shown}
        )
        sides = ["right" if shown[header].dtype.kind in "iuf" else "left" for header in shown]
        table = escaping.frame(cells, escaping.markdown)
        yield from ("", f"## {name}", "", table.to_markdown(index=False, disable_numparse=True, colalign=sides))

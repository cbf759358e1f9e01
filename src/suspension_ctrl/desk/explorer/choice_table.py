"""Candidates beside the present design at the top of a page: measures with their changes, and which to take."""

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from ...search.problem import Minimisable, headers_of
from ...tables.headers import readable
from ...tables.rounding import rounded
from ..advice import chosen_changes, shown_change
from ..candidate_table import PRESENT
from ..choosing import EQUAL

if TYPE_CHECKING:
    import pandas as pd


class Cell(NamedTuple):
    """A measure of a design, and its change against the present one."""

    value: str
    change: str = ""
    better: bool | None = None  # None where it is equal, or there is no present design


class Row(NamedTuple):
    """A design with its measures."""

    number: int  # 0 of the present design
    name: str
    cells: list[Cell]
    active: str


class ChoiceTable(NamedTuple):
    """Headers of the measures, and a row for each candidate and the present design."""

    measures: list[str]
    rows: list[Row]


def choice_table(problem: Minimisable, table: "pd.DataFrame") -> ChoiceTable:
    """Return the choice among candidates of a table of `candidates`."""
    shown = readable(table[list(headers_of(problem))[len(problem.variables) :]])
    columns = [rounded(shown[header].tolist()) for header in shown]
    cells = [[Cell(value) for value in values] for values in zip(*columns, strict=True)]
    if table.name.iloc[0] == PRESENT:
        changes = chosen_changes(problem, table).tolist()
        cells[1:] = [list(_changed(*both)) for both in zip(cells[1:], changes, strict=True)]
    reached = map(_by_bound, map(str, table.active))
    whole = zip(table.index.tolist(), table.name, cells, reached, strict=True)
    return ChoiceTable(list(map(str, shown)), [Row(*row) for row in whole])


def _by_bound(active: str) -> str:
    """Return bounds and limits that a design reaches, variables at bounds of one kind together."""
    texts, bounds = [], dict[str, list[str]]()
    for text in filter(None, active.split("; ")):
        name, at, bound = text.partition(" its ")
        if at:
            variable, where = name.rsplit(" ", 1)
            bounds.setdefault(f"{where} the {bound}", []).append(variable)
        else:
            texts.append(text)
    return "; ".join([*texts, *(f"{where}: {', '.join(names)}" for where, names in bounds.items())])


def _changed(cells: list[Cell], changes: list[float]) -> Iterator[Cell]:
    for (value, *_), change in zip(cells, changes, strict=True):
        yield Cell(value, shown_change(change), None if abs(change) <= EQUAL else change < 0)

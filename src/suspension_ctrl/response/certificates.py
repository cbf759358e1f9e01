"""Certificates: measures of a design linearised and simulated side by side."""

import html
import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain, groupby
from typing import TYPE_CHECKING, NamedTuple

from ..quantities import Record, unit

if TYPE_CHECKING:
    import pandas as pd

_HEADER = ("measure", "unit", "linearised", "simulated", "low", "high", "equivalent")
_NAME, _NUMBERS = 28, (11, 10, 10, 10, 11)  # widths of name with unit, and of numbers
_LONGEST = 9  # of a number
_COLUMNS = 80


class Certified(NamedTuple):
    """A measure in a load case, or over all of them; NaN where there is no value."""

    case: str  # number of the load case, "all"
    measure: str
    unit: str
    linearised: float
    simulated: float  # mean over the seeds
    low: float  # of the 95 % interval of that mean
    high: float
    equivalent: float  # simulated with an equivalent spring or damper in place of each force law
    note: str = ""

    @property
    def outside(self) -> bool:
        """Whether the linearised value is outside the interval."""
        return self.linearised < self.low or self.linearised > self.high


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Certificate(Record):
    """Measures of a design, linearised and simulated, by load case.

    Parameters
    ----------
    title : str
        Number and length of the roads.
    design : mapping of str to float
        Variables of the design.
    cases : tuple of str
        Road, speed and share of each load case.
    rows : tuple of Certified
    limits : tuple of str
        Limits of the problem with their verdicts by the simulated values.
    length : float
        Length of each road [m].
    seeds : tuple of int
        Seeds of the roads.
    """

    title: str
    design: Mapping[str, float]
    cases: tuple[str, ...]
    rows: tuple[Certified, ...]
    limits: tuple[str, ...]
    length: float = field(metadata=unit("m"))
    seeds: tuple[int, ...]

    def to_frame(self) -> "pd.DataFrame":
        """Return a row for each load case and measure, ``outside`` where linearisation leaves the interval."""
        import pandas as pd

        rows = [(*one[:-1], one.outside, one.note) for one in self.rows]
        table = pd.DataFrame(rows, columns=[*Certified._fields[:-1], "outside", "note"])
        return table.set_index(["case", "measure"])

    def __repr__(self) -> str:
        lines = "\n".join(self._lines()).split("\n")
        fitted = (_wrapped(line) if len(line) > _COLUMNS else [line.rstrip()] for line in lines)
        return "\n".join(chain.from_iterable(fitted))

    def _repr_html_(self) -> str:
        table = self.to_frame().reset_index().to_html(index=False, float_format="{:.4g}".format, na_rep="")
        return f"<p>{html.escape(self.title)}</p>{table}"

    def _lines(self) -> Iterator[str]:
        yield self.title
        values = ", ".join(f"{name} {value:g}" for name, value in self.design.items())
        yield from _wrapped(f"Design: {values}")
        titles = {str(n): f"Case {n}, {case}" for n, case in enumerate(self.cases, start=1)}
        for number, rows in groupby(self.rows, key=lambda row: row.case):
            yield from ["", *_wrapped(titles.get(number, "All load cases")), _line(_HEADER)]
            yield from map(_line, map(_cells, rows))
        yield from ["", *self.limits] if self.limits else []
        if any(one.outside for one in self.rows):
            yield "* outside the 95 % interval of the simulated mean"
        yield from dict.fromkeys(f"{one.measure}: {one.note}" for one in self.rows if one.note)


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _COLUMNS, subsequent_indent="    ")


def _cells(row: Certified) -> list[str]:
    """Return the texts of a row."""
    values = (row.linearised, row.simulated, row.low, row.high, row.equivalent)
    numbers = ["" if value != value else _number(value) for value in values]
    numbers[0] += "*" if row.outside else " "
    return [row.measure, row.unit, *numbers]


def _number(value: float) -> str:
    """Return a number with four digits, or three where four are too long."""
    text = f"{value:.4g}"
    return text if len(text) <= _LONGEST else f"{value:.3g}"


def _line(cells: tuple[str, ...] | list[str]) -> str:
    """Return a line of the table, names to the left, units and numbers to the right; a long name on its own."""
    name, unit, *numbers = cells
    room = _NAME - len(unit) - 1
    first, rest = (name, "") if len(name) > room else ("", name)
    start = rest.ljust(_NAME - len(unit)) + unit
    line = start + "".join(cell.rjust(one) for cell, one in zip(numbers, _NUMBERS, strict=True))
    return f"{first}\n{line}" if first else line

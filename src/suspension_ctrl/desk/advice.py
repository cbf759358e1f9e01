"""Which candidate to take, and why: one better than the present design in every measure, or else the knee."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Self

from ..quantities import Real
from ..response.problem import RideProblem
from ..search.problem import Minimisable, headers_of
from ..tables.headers import name_and_unit, shown_value
from .candidate_table import full_changes
from .choosing import EQUAL, KNEE, improving

if TYPE_CHECKING:
    import pandas as pd


class Advice(NamedTuple):
    """A candidate by its number, and sentences."""

    number: int
    said: list[str]

    @classmethod
    def of(cls, problem: Minimisable, table: "pd.DataFrame") -> Self:
        """Return the advice of a table of `candidates`."""
        chosen = table[table.index > 0]
        numbers = chosen.index.tolist()
        knee = next((n for n, name in zip(numbers, chosen.name, strict=True) if KNEE in name), numbers[0])
        if len(table) == len(chosen):
            return cls(knee, [f"Take {_named(chosen, knee)}, {_UNLESS}.", *_facts(problem, chosen, knee)])
        changes, labels = chosen_changes(problem, table), list(problem.objectives)
        better = [numbers[row] for row in improving(changes)]
        number = better[0] if better else knee
        told = _told(labels, changes[numbers.index(number)])
        if better:
            said = [f"Take {_named(chosen, number)}. Against the present design no measure is worse: {told}."]
            said += [_OTHERS.format(_listed(better[1:]))] if len(better) > 1 else []
        else:
            said = [f"Take {_named(chosen, number)}, {_UNLESS}: against the present design {told}."]
        beyond = [one for one in str(table.active.iloc[0]).split("; ") if one.startswith("beyond")]
        worst = isinstance(problem, RideProblem) and len(problem.cases) > 1
        where = " in the worst load case" * worst
        said += [f"The present design is {' and '.join(beyond)}{where}."] if beyond else []
        said += [] if better else [_PRICE if beyond else _NONE]
        return cls(number, [*said, *_facts(problem, chosen, number)])


_UNLESS = "unless one measure decides"
_OTHERS = "No measure is worse with {} either, but less is gained in sum."
_PRICE = "No design within the limits is as good as the present design in every measure."
_NONE = "Every design of the front is worse than the present design in some measure."


def chosen_changes(problem: Minimisable, table: "pd.DataFrame") -> Real:
    """Return the changes (n, m) of candidates against the present design, the first row [%]."""
    values = table[list(headers_of(problem))[len(problem.variables) :]].to_numpy(dtype=float)
    return full_changes(values[1:], values[0])


def _named(table: "pd.DataFrame", number: int) -> str:
    return f"candidate {number}, {table.name[number]}"


def _told(labels: Sequence[str], changes: Real) -> str:
    """Return the changes of measures (m,) in words."""
    return ", ".join(f"{name} {shown_change(one)}" for name, one in zip(labels, changes.tolist(), strict=True))


def shown_change(change: float) -> str:
    """Return a change [%] with its sign, none of one that does not count."""
    return "0.0 %" if abs(change) <= EQUAL else f"{change:+.1f} %"


def _listed(numbers: Sequence[int]) -> str:
    return " and ".join(map(str, numbers))


def _facts(problem: Minimisable, table: "pd.DataFrame", number: int) -> list[str]:
    """Return sentences about the values of a candidate, and the limits and bounds that it reaches."""
    headers = list(headers_of(problem))[: len(problem.variables)]
    values = (shown_value(table[one][number], name_and_unit(one)[1]) for one in headers)
    said = [f"It has {', '.join(map(' '.join, zip(problem.variables, values, strict=True)))}."]
    active = [one for one in str(table.active[number]).split("; ") if one]
    limits, bounds = ([one for one in active if ("limit" in one) == wanted] for wanted in (True, False))
    said += [f"It is {' and '.join(limits)}, without margin for scatter."] if limits else []
    return [*said, *([f"Wider bounds may give more: {', '.join(bounds)}."] if bounds else [])]

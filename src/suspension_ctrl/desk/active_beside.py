"""Active suspensions beside a decision: the share that passive ones take in a sentence, and fronts to draw."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple, Self

from ..response.problem import RideProblem
from ..tables.headers import shown_value
from .attaining import ACTIVE, PASSIVE, SHARE, attainable, attained
from .bound import SKYHOOK
from .candidate_table import PRESENT, Present

if TYPE_CHECKING:
    import pandas as pd


class ActiveBeside(NamedTuple):
    """A sentence, and tables of `attained` and `attainable`, None where they cannot be had."""

    text: str
    shares: "pd.DataFrame | None" = None
    fronts: "pd.DataFrame | None" = None

    @classmethod
    def of(cls, problem: RideProblem, present: Present | None) -> Self:
        """Compare; without present design, or where no controller can be found, the sentence tells why."""
        if not present:
            return cls("What is attainable is not told without a present design.")
        try:
            shares = attained(problem, present)
            return cls(_text(problem.nominal, shares), shares, attainable(problem, present=present))
        except ValueError as error:
            return cls(f"What is attainable is not told: {error}.")

    def by_controller(self, headers: Iterable[str]) -> "dict[str, pd.DataFrame]":
        """Return the front of each controller, none where it lacks one of the headers: of robust measures."""
        if self.fronts is None or not {*headers} <= {*self.fronts}:
            return {}
        return {f"attainable, {name}": part for name, part in self.fronts.groupby("controller", sort=False)}


def _text(problem: RideProblem, shares: "pd.DataFrame") -> str:
    """Return a sentence about a table of `attained`."""
    first, *others = problem.objectives
    unit = problem.units[first]
    values = {name: shown_value(value, unit, 3) for name, value in shares.iloc[:, 0].items()}
    sky = f"skyhook has {values[SKYHOOK]}, " if SKYHOOK in values else ""
    return (
        f"The passive optimum takes {shares[SHARE][PASSIVE]:.0f} % of what is attainable: {first} of "
        f"{values[PASSIVE]} in place of {values[PRESENT]} with no more {' and '.join(others)} than the present "
        f"design; {sky}an active suspension with full information {values[ACTIVE]}."
    )

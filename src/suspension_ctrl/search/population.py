"""Populations: designs with objectives and constraints, the base class of states, runs and traces."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Bool, Checked, FrozenMapping, Integer, Real, Record, frozen_array, kept
from .constraints import violations
from .indicators import non_dominated

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Population(Record):
    """Designs with their objectives and constraints."""

    designs: Real  # (n, d)
    objectives: Real  # (n, m)
    constraints: Real  # (n, c), met where they are <= 0
    headers: tuple[str, ...] = ()  # (d + m,) of variables and objectives, "SWS [m]"; x1 .. xd, f1 .. fm if empty

    def __post_init__(self) -> None:
        self._keep(
            designs=kept(self.designs), objectives=kept(self.objectives), constraints=kept(self.constraints)
        )
        if not self.headers:
            self._keep(headers=numbered_headers(self.designs.shape[1], self.objectives.shape[1]))

    @cached_property
    def violation(self) -> Real:
        """Violation of each design (n,): the sum of max(0, g) over its constraints."""
        return frozen_array(violations(self.constraints, 0))

    @property
    def feasible(self) -> Bool:
        """Feasibility of each design (n,)."""
        return (self.violation == 0) & ~np.isnan(self.objectives).any(axis=1)

    def to_frame(self) -> "pd.DataFrame":
        """Return a row per design: variables, objectives and, where there are constraints, `violation`."""
        import pandas as pd  # a third of a second: not at import of the package

        table = pd.DataFrame(np.hstack([self.designs, self.objectives]), columns=list(self.headers))
        return table.assign(violation=self.violation) if self.constraints.shape[1] else table

    def front(self) -> "pd.DataFrame":
        """Return the rows of the non-dominated feasible designs, each once, without `violation`."""
        return self.to_frame()[list(self.headers)].iloc[self.on_front()].reset_index(drop=True)

    def on_front(self) -> Integer:
        """Return the indices (k,) of the non-dominated feasible designs, each once."""
        feasible = np.flatnonzero(self.feasible)
        front = feasible[non_dominated(self.objectives[feasible])]
        rows = np.hstack([self.designs[front], self.objectives[front]])
        return front[np.sort(np.unique(rows, axis=0, return_index=True)[1])]

    def _repr_html_(self) -> str:
        return self.to_frame().to_html(max_rows=20)

    def __repr__(self) -> str:
        counts = f"{len(self.designs)} designs, {self.feasible.sum()} feasible"
        return f"{type(self).__name__}: {counts}\n{self._ideal()}"

    def _ideal(self) -> str:
        kept = self.objectives[self.feasible]
        if not len(kept):
            return "    no feasible design"
        named = zip(self.headers[self.designs.shape[1] :], kept.min(axis=0), strict=True)
        return "    least " + ", ".join(_with_unit(header, value) for header, value in named)


@lru_cache
def numbered_headers(variables: int, objectives: int) -> tuple[str, ...]:
    """Return x1 .. xd, f1 .. fm."""
    counted = (("x", variables), ("f", objectives))
    return tuple(f"{letter}{i + 1}" for letter, count in counted for i in range(count))


def _with_unit(header: str, value: float) -> str:
    name, _, unit = header.partition(" [")
    return f"{name} {value:.5g} {unit.removesuffix(']')}".rstrip()


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Settings(Checked):
    """Settings of an optimiser; whole numbers are at least the ``least`` of their fields."""

    population: int = field(metadata={"least": 4})

    def __post_init__(self) -> None:
        for one in (one for one in self._fields() if "least" in one.metadata):
            self._keep(**{one.name: checks.at_least(one.name, getattr(self, one.name), one.metadata["least"])})
        super().__post_init__()


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Generational(Settings):
    """Settings of an algorithm that evaluates a whole population in each iteration."""

    def evaluations_per_iteration(self, _objectives: int, /) -> int:
        """Return the number of evaluations in an iteration."""
        return self.population


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class State(Population):
    """The population of a search after an iteration."""

    ideal: Real  # (m,) least value so far of each objective, of feasible designs once there is one
    evaluations: int  # so far
    memory: Mapping[str, Real]  # further arrays from which the algorithm continues
    course: Real | None = None  # (k, m) ideal points after the iterations since the last state, if not of one

    @classmethod
    def of(
        cls, designs: Real, values: Real, ideal: Real, evaluations: int, course: Real | None = None,
        **memory: ArrayLike,
    ) -> "State":  # fmt: skip
        """Return the state of a population with these values (n, m + c)."""
        return cls(
            designs=designs, objectives=values[:, : ideal.size], constraints=values[:, ideal.size :],
            ideal=frozen_array(ideal), evaluations=evaluations, course=course,
            memory=FrozenMapping({name: kept(value) for name, value in memory.items()}),
        )  # fmt: skip

    def arrays(self) -> tuple[Real, Real, Real, int]:
        """Return copies of designs (n, d), values (n, m + c) and ideal point (m,), and the evaluations."""
        values = np.hstack([self.objectives, self.constraints])
        return self.designs.copy(), values, self.ideal.copy(), self.evaluations

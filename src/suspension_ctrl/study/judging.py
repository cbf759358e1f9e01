"""Sets of designs that a run has found within each budget, and their indicators against a reference front."""

from collections.abc import Iterator
from itertools import groupby
from typing import Any, NamedTuple, Self

import numpy as np

from ..quantities import Integer, Real
from ..search.indicators import ReferenceFront, evenly_spread
from ..search.shortfall import Shortfall
from ..search.trace import Trace

POPULATION, ARCHIVE, CUT_ARCHIVE = "population", "archive", "archive of N"
"""Judged sets of feasible designs: the population; all non-dominated evaluated designs; and N of these, spread."""

INDICATORS = ("relative_hypervolume", "igd_plus", "epsilon", "spread")


def judged(traced: Trace, population: int, reference: ReferenceFront) -> Iterator[dict[str, Any]]:
    """Yield a row per budget and set; a state is judged once for all budgets within which it is the last.

    So is a set that is another one: the population of a sample is its archive, and a small archive is not cut.
    """
    feasible, begin = traced.feasible, 0
    archive = _Front.of(np.empty((0, traced.objectives.shape[1])), reference)
    for _, budgets in groupby(sorted(traced.states), lambda budget: traced.states[budget].evaluations):
        budget, *others = budgets
        state, new = traced.states[budget], slice(begin, begin := traced.spent[budget])
        archive = archive.grown(traced.objectives[new][feasible[new]], reference)
        found = state.objectives[state.feasible]
        found = _rows(found, reference.best(found))
        cut = archive.cut(population, reference)
        is_archive = np.array_equal(found, archive.objectives)
        final = cut if is_archive else _Front.of(_cut(found, population), reference)
        sets = {POPULATION: final, ARCHIVE: archive, CUT_ARCHIVE: cut}
        different = {id(front): front for front in sets.values()}
        known = {key: front.indicators(reference) for key, front in different.items()}
        rows = [{"evaluations": state.evaluations, "set": name, **known[id(sets[name])]} for name in sets]
        yield from ({"budget": one, **row} for one in (budget, *others) for row in rows)


class _Front(NamedTuple):
    """Mutually non-dominated objectives, and what they lack to a reference front: few further ones change it."""

    objectives: Real  # (n, m), column by column in memory
    shortfall: Shortfall

    @classmethod
    def of(cls, objectives: Real, reference: ReferenceFront) -> Self:
        """Return the front of mutually non-dominated objectives (n, m)."""
        return cls(objectives, reference.shortfall(objectives))

    def grown(self, new: Real, reference: ReferenceFront) -> Self:
        """Return the front of these objectives and new ones (k, m); what leaves it is dominated, gap by gap."""
        both = np.concatenate([self.objectives.T, new.T], axis=1).T
        best, known = reference.best(both), len(self.objectives)
        shortfall = reference.shortfall(new[best[best >= known] - known], self.shortfall)
        return type(self)(_rows(both, best), shortfall)

    def cut(self, size: int, reference: ReferenceFront) -> Self:
        """Return a front of at most `size` of the objectives, evenly spread."""
        found = _cut(self.objectives, size)
        return self if found is self.objectives else self.of(found, reference)

    def indicators(self, reference: ReferenceFront) -> dict[str, Any]:
        """Return the number of members and `INDICATORS`."""
        volume, spread = reference.volume_and_spread(self.objectives)
        values = volume, self.shortfall.igd_plus, self.shortfall.epsilon, spread
        return {"members": len(self.objectives), **dict(zip(INDICATORS, values, strict=True))}


def _cut(front: Real, size: int) -> Real:
    """Return at most so many rows of a front (n, m), evenly spread."""
    return front if len(front) <= size else _rows(front, evenly_spread(front, size, few=0))


def _rows(objectives: Real, chosen: Integer) -> Real:
    """Return rows of objectives (n, m), column by column in memory."""
    return np.ascontiguousarray(objectives.T)[:, chosen].T

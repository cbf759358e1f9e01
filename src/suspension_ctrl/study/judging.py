"""Sets of designs that a run has found within each budget, and their indicators against a reference front."""

from collections.abc import Iterator
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from ..quantities import Real
from ..search.indicators import ReferenceFront, best_of, evenly_spread, non_dominated
from ..search.population import State
from ..search.trace import Trace

POPULATION, ARCHIVE, CUT_ARCHIVE = "population", "archive", "archive of N"
"""Judged sets of feasible designs: the population; all non-dominated evaluated designs; and N of these, spread."""

INDICATORS = ("relative_hypervolume", "igd_plus", "epsilon", "spread")


def judged(traced: Trace, population: int, reference: ReferenceFront) -> Iterator[dict[str, Any]]:
    """Yield a row per budget and set; a state is judged once for all budgets within which it is the last."""
    none, begin = np.empty((0, traced.objectives.shape[1])), 0
    archive = _Archive(none, reference.gaps(none))
    for _, budgets in groupby(sorted(traced.states), lambda budget: traced.states[budget].evaluations):
        budget, *others = budgets
        new = slice(begin, begin := traced.spent[budget])
        archive = archive.grown(traced.objectives[new][traced.feasible[new]], reference)
        rows = list(_rows(traced.states[budget], archive, population, reference))
        yield from ({"budget": one, **row} for one in (budget, *others) for row in rows)


class _Archive(NamedTuple):
    """Non-dominated objectives (n, m), and the gaps of a reference front to them, which further ones lower."""

    front: Real
    gaps: Real

    def grown(self, new: Real, reference: ReferenceFront) -> "_Archive":
        """Return the archive of these objectives and new ones (k, m); what leaves it is dominated, gap by gap."""
        both = np.concatenate([self.front, new])
        best = non_dominated(both)
        return _Archive(both[best], reference.gaps(new[best[len(self.front) :]], self.gaps))


def _rows(state: State, archive: _Archive, population: int, reference: ReferenceFront) -> Iterator[dict[str, Any]]:
    """Yield a row per set of a state."""
    sets = {POPULATION: best_of(state.objectives[state.feasible]), CUT_ARCHIVE: archive.front}
    sets = {name: front[evenly_spread(front, population)] for name, front in sets.items()}
    for name in (POPULATION, ARCHIVE, CUT_ARCHIVE):
        front = sets.get(name, archive.front)
        gaps = archive.gaps if name == ARCHIVE else reference.gaps(front)
        yield {
            "evaluations": state.evaluations, "set": name, "members": len(front),
            "relative_hypervolume": reference.relative_hypervolume(front), "igd_plus": float(np.sqrt(gaps).mean()),
            "epsilon": reference.epsilon(front), "spread": reference.spread(front),
        }  # fmt: skip

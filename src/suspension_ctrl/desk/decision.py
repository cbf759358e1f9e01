"""A decision: searches of a ride problem with and without its limits, candidates, effects of limits and bounds."""

import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, Self

import numpy as np

from ..quantities import Real
from ..response.measures.limits import Limit
from ..response.problem import RideProblem
from ..search.constraints import InfeasibleWarning
from ..search.driver import minimise
from ..search.population import Population
from ..search.run import Optimiser
from ..tables.headers import shown_range, shown_value
from .active import designs_by_text, limit_text
from .candidate_table import Present, candidates
from .choosing import flat, front_of
from .optimality import EXACT
from .proofs import RESIDUAL, can_be_refined, refined_candidates, with_ends

if TYPE_CHECKING:
    import pandas as pd


class Decision(NamedTuple):
    """Runs of a ride problem within its limits and without them, and the candidates."""

    problem: RideProblem
    run: Population
    free: Population  # that of the problem without limits, `run` itself if it has none
    table: "pd.DataFrame"

    @classmethod
    def of(
        cls,
        problem: RideProblem,
        optimiser: Optimiser,
        *,
        iterations: int,
        seed: int,
        present: Present | None = None,
    ) -> Self:
        """Search and choose; ValueError that names the nearest design if none is within the limits."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", InfeasibleWarning)
            run = minimise(problem, optimiser, iterations=iterations, seed=seed)
        _check_feasible(problem, run)
        free, without = run, problem.replace(constraints=())
        if problem.constraints:
            free = minimise(without, optimiser, iterations=iterations, seed=seed)
        if not can_be_refined(problem):
            return cls(problem, run, free, candidates(problem, run, present=present))
        run, table = refined_candidates(problem, with_ends(problem, run), present)
        return cls(problem, run, with_ends(without, free) if problem.constraints else run, table)

    def describe(self) -> list[str]:
        """Return what limits and bounds do, and which measures are equal on the front, a sentence each."""
        return [*self._equal(), *self._limits(), self._exact(), self._active()]

    def _equal(self) -> Iterator[str]:
        """Yield a sentence about measures that all designs of the front have alike."""
        front = front_of(self.problem, self.run).objectives
        equal = flat(front)
        pairs = zip(self.problem.measures, front[0].tolist(), equal.tolist(), strict=True)
        have = [f"{one.label} of {shown_value(one.sign * value, one.unit)}" for one, value, same in pairs if same]
        if equal.all():
            yield f"The front is one point, the best of every measure: {', '.join(have)}."
        elif have:
            yield f"All designs of the front have {' and '.join(have)}: only other measures are traded."

    def _limits(self) -> Iterator[str]:
        """Yield a sentence about each limit, or about the limits that are possible."""
        problem = self.problem
        if not problem.constraints:
            front = front_of(problem, self.run).objectives
            ranges = zip(problem.measures, front.min(axis=0), front.max(axis=0), flat(front), strict=True)
            possible = "; ".join(
                f"{one.label} from {shown_range(low, high, one.unit)}"
                for one, low, high, equal in ranges
                if not (one.maximise or equal)
            )
            between = f" The front has {possible}: limits between these are possible."
            yield "No limit is set." + between * bool(possible)
            return
        front = self.free.designs[self.free.on_front()]
        values = problem.evaluate(front)
        m, where = len(problem.objectives), " in the worst load case" * (len(problem.cases) > 1)
        for limit, g in zip(problem.constraints, values[:, m:].T, strict=True):
            found, unit = measured(limit, g), limit.measure.unit
            if (g <= 0).all():
                nearest = shown_value(found[g.argmax()], unit)
                yield f"{limit_text(limit)} does nothing: the nearest design of the front has {nearest}{where}."
            else:
                possible = shown_range(found.min(), found.max(), unit)
                yield f"{limit_text(limit)} cuts the front: limits from {possible} are possible{where}."

    def _active(self) -> str:
        """Return a sentence about active bounds and limits with the candidates that reach them."""
        table = self.table[self.table.index > 0]
        found = designs_by_text([[text for text in one.split("; ") if text] for one in table.active])
        parts = [f"{text} ({', '.join(map(str, numbers))})" for text, numbers in found.items()]
        own = self.table.active.get(0)
        parts += [f"present design: {own}"] if own else []
        return f"Active, by candidate: {'; '.join(parts) or 'no bound and no limit'}."

    def _exact(self) -> str:
        """Return a sentence about the residuals of the candidates."""
        if RESIDUAL not in self.table:
            return "Candidates are as they were found: a measure that may have kinks is not refined."
        residuals = self.table[RESIDUAL][self.table.index > 0]
        if residuals.max() <= EXACT and residuals.notna().all():
            return f"Every candidate is an exact optimum: no residual is above {EXACT:.0e}."
        others = residuals.index[~(residuals <= EXACT)]
        told = ", ".join(map(str, others))
        return f"Every candidate but {told} is an exact optimum, with a residual of at most {EXACT:.0e}."


def measured(limit: Limit, g: Real) -> Real:
    """Return the measure of a limit (n,) from values of its constraint (n,)."""
    return np.asarray((g - limit.offset) / limit.scale)


def _check_feasible(problem: RideProblem, run: Population) -> None:
    """Raise ValueError that tells how near the limits the nearest design is, if none is within them."""
    if run.feasible.any():
        return
    nearest = int(run.violation.argmin())
    beyond = [
        (
            limit_text(limit),
            f"{limit.measure.label} of {shown_value(float(measured(limit, g)), limit.measure.unit)}",
        )
        for limit, g in zip(problem.constraints, run.constraints[nearest], strict=True)
        if g > 0
    ]
    limits, have = zip(*beyond, strict=True)
    raise ValueError(
        f"limits must be possible within the bounds: the nearest design has {' and '.join(have)}, "
        f"got {' and '.join(limits)}"
    )

"""Candidates as exact optima: designs refined, with residual and the prices of limits."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import Real, column_headers
from ..response.measures.limits import Limit
from ..response.measures.measure import OwnMeasure
from ..response.measures.peak import Peak
from ..response.measures.robust import Robust
from ..response.problem import RideProblem
from ..search.run import Run
from .active import limit_text
from .candidate_table import COUNT, Present, against_present, table_of
from .choosing import BETWEEN, SAME, chosen, front_of, scaled
from .descent import HELD
from .refinement import Refined, least_of, price_unit, refine

if TYPE_CHECKING:
    import pandas as pd

RESIDUAL, PRICE = "residual", "price of "
LEAST = "least "

_STARTS = 2  # designs of a run with the least of an objective


def can_be_refined(problem: RideProblem) -> bool:
    """Whether a variable is real and measures are smooth: peaks, quantiles, functions of users may have kinks."""
    judged = (*problem.measures, *(limit.measure for limit in problem.constraints))
    ends = zip(problem.variables, problem.lower, problem.upper, strict=True)
    free = [problem.kinds.get(name, "") in ("", "log") for name, low, high in ends if low < high]
    return any(free) and not any(isinstance(measure, Peak | Robust | OwnMeasure) for measure in judged)


def with_ends(problem: RideProblem, run: Run) -> Run:
    """Return the run with the exact least of each objective beside its own designs."""
    rows = run.on_front()
    designs = list[list[float]]()
    for j, name in enumerate(problem.objectives):
        starts = run.designs[rows[run.objectives[rows, j].argsort(kind="stable")[:_STARTS]]]
        with suppress(ValueError):  # where descents fail the designs of the run stay
            designs.append(list(least_of(problem, name, starts).design.values()))
    return with_designs(problem, run, np.reshape(designs, (-1, len(problem.variables))))


def with_designs(problem: RideProblem, run: Run, designs: Real) -> Run:
    """Return the run with designs (k, d) beside its own."""
    values = values_of(problem, designs)
    m = len(problem.objectives)
    return replace(
        run,
        designs=np.vstack([run.designs, designs]),
        objectives=np.vstack([run.objectives, values[:, :m]]),
        constraints=np.vstack([run.constraints, values[:, m:]]),
    )


def values_of(problem: RideProblem, designs: Real) -> Real:
    """Return objectives and constraints (n, m + c) of refined designs (n, d), which meet limits up to `HELD`."""
    values, m = problem.evaluate(designs), len(problem.objectives)
    values[:, m:][(values[:, m:] > 0) & (values[:, m:] <= HELD)] = 0.0
    return values


def refined_candidates(
    problem: RideProblem, run: Run, present: Present | None = None
) -> "tuple[Run, pd.DataFrame]":
    """Return the run with its candidates refined, and the table of `candidates` with residuals and prices.

    The least of an objective is refined as that; any other candidate to the least of the first objective with the
    others at most at their values, so that the result is at least as good in all of them. A candidate from which
    the descent finds nothing as good stays as it is, without a residual.
    """
    front = front_of(problem, run)
    rows = chosen(front.objectives, problem.objectives, COUNT, against_present(problem, front.objectives, present))
    found = [_refined(problem, name, front.designs[row], front.objectives[row]) for row, name in rows.items()]
    designs = np.array([_design(one, front.designs[row]) for one, row in zip(found, rows, strict=True)])
    values = values_of(problem, designs)
    whole = np.vstack([front.objectives, values[:, : front.objectives.shape[1]]])
    kept = _distinct(scaled(whole)[-len(rows) :], list(rows.values()))
    order = sorted(kept, key=lambda place: tuple(values[place].tolist()))
    table = table_of(problem, [kept[place] for place in order], designs[order], values[order], present)
    proof = _proof(problem, [found[place] for place in order])
    proof.index = table.index[-len(proof) :]
    return with_designs(problem, run, designs[order]), table.join(proof)


def _design(one: Refined | None, before: Real) -> Real:
    """Return the refined design (d,), or the one before if there is none."""
    return before if one is None else np.array(list(one.design.values()))


def _distinct(points: Real, names: Sequence[str]) -> dict[int, str]:
    """Return the names of candidates by row of scaled objectives (k, m), equal ones as one."""
    found = dict[int, str]()
    for row, name in enumerate(names):
        equal = next((one for one in found if np.abs(points[one] - points[row]).max() <= SAME), None)
        if equal is None:
            found[row] = name
        else:
            parts = [part for part in (found[equal], name) if part != BETWEEN]
            found[equal] = ", ".join(parts) or BETWEEN
    return found


def _proof(problem: RideProblem, found: Sequence[Refined | None]) -> "pd.DataFrame":
    """Return residuals and prices of refined candidates, a row each, empty where there is none."""
    import pandas as pd

    first, *others = problem.objectives
    own = {name: (f"{PRICE}{name}", problem.units[name]) for name in others}
    own |= {str(one): (f"{PRICE}{limit_text(one)}", one.measure.unit) for one in problem.constraints}
    units = {column: price_unit(problem.units[first], unit) for column, unit in own.values()}
    rows = [_prices(one, first, {name: column for name, (column, _) in own.items()}) for one in found]
    table = pd.DataFrame(rows, columns=[RESIDUAL, *units])
    return table.set_axis(column_headers([RESIDUAL, *units], units), axis=1)


def _refined(problem: RideProblem, name: str, design: Real, objectives: Real) -> Refined | None:
    """Return a candidate (d,) with objectives (m,) refined, None if the result is not as good in all of them."""
    known = dict(zip(problem.objectives, objectives.tolist(), strict=True))
    least = [each for each in known if f"{LEAST}{each}" in name.split(", ")]
    minimised = (least or list(known))[0]
    reached = {limit.measure.label for limit in problem.constraints if _is_reached(limit, known)}
    kept = {} if least else {each: known[each] for each in known if each not in {minimised, *reached}}
    try:
        found = refine(problem, design, minimise=minimised, within=kept)
    except ValueError:
        return None
    compared = [minimised] if least else list(known)
    good = all(found.measures[each] <= known[each] + HELD * abs(known[each]) for each in compared)
    return found if good else None


def _is_reached(limit: Limit, known: Mapping[str, float]) -> bool:
    """Whether an objective of its own is at a limit, which then takes the place of the objective's value."""
    value = known.get(limit.measure.label)
    return value is not None and limit.scale * value + limit.offset >= -HELD


def _prices(one: Refined | None, first: str, columns: Mapping[str, str]) -> dict[str, float]:
    """Return the residual and the prices in the first objective by column; of another objective no prices."""
    if one is None:
        return {}
    named = {
        name.partition(" <= ")[0] if name not in columns else name: price
        for name, price in one.multipliers.items()
    }
    prices = {columns[name]: price for name, price in named.items() if name in columns}
    return {RESIDUAL: one.residual} | (prices if one.minimised == first else {})

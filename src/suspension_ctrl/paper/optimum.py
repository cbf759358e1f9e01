"""Table 5: the best struts at a suspension travel, refined and from a Pareto set, beside published values."""

from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from .. import checks
from ..desk.choosing import pick
from ..desk.refinement import least_of
from ..response.measures.vibration import ACC, DTL, SWS
from ..response.problem import RideProblem
from . import experiment, tables

if TYPE_CHECKING:
    import pandas as pd

    from ..search.population import Population
    from ..search.run import Run

TRAVEL = 0.0287
"""Suspension working space of Table 5 [m]."""

AT_LIMIT = 0.002
"""Largest distance of the travel from the limit, of a design picked for Table 5, as a share of the limit."""

KINDS = EXACT, PICKED = "exact", "picked"
"""Designs beside those of the paper, by the first word of their rows."""

_STARTS = 3  # designs of a run nearest to the limit, that are refined


def table5(problem: RideProblem, run: "Run", limit: float = TRAVEL) -> "pd.DataFrame":
    """Return Table 5: the paper's designs, the best at a travel `limit` [m], and designs picked from a run.

    Rows are left out where no design has the travel.
    """
    checks.positive("sws_limit", limit, "m")
    travel = run.objectives[:, problem.measures.index(SWS())]
    starts = run.designs[np.abs(travel - limit).argsort(kind="stable")[:_STARTS]]
    exact = {}
    for objective in (ACC(), DTL()):
        with suppress(ValueError):  # of a travel that no design has
            best = least_of(problem, objective.label, starts, {SWS().label: (limit, limit)})
            exact[f"{EXACT}, least {objective}"] = tuple(best.design.values())
    return _beside_published(problem, exact | _picked(problem, run, limit))


def table5_of_front(problem: RideProblem, run: "Population") -> "pd.DataFrame":
    """Return Table 5 without exact designs: the paper's, and those picked from a run at the paper's travel."""
    return _beside_published(problem, _picked(problem, run, TRAVEL))


def _picked(problem: RideProblem, run: "Population", limit: float) -> dict[str, tuple[float, ...]]:
    """Return the designs of a run with the least of a measure at a travel limit, by name."""
    found, within = {}, {SWS().label: ((1 - AT_LIMIT) * limit, limit)}
    for objective in (ACC(), DTL()):
        with suppress(ValueError):  # of a front that has no design so near the limit
            picked = pick(problem, run, minimise=objective.label, within=within)
            found[f"{PICKED}, least {objective}"] = tuple(picked.iloc[: len(problem.variables)].tolist())
    return found


def _beside_published(problem: RideProblem, designs: dict[str, tuple[float, ...]]) -> "pd.DataFrame":
    columns = experiment.table5()
    published = {"reference car": columns["reference"], "published optimum": columns["optimised"]}
    papers = {
        "reference car": experiment.reference_design(),
        "published optimum": experiment.optimised_design(),
    }
    return tables.beside_published(problem, papers | designs, published)

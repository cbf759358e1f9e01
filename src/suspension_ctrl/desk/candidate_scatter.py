"""Candidates over a scatter, as a small table."""

from typing import TYPE_CHECKING

import numpy as np

from ..quantities import column_headers
from ..response.measures.limits import Limit
from ..response.measures.measure import OwnMeasure
from ..response.measures.peak import Peak
from ..response.measures.robust import of_quantile
from ..response.problem import RideProblem
from ..response.scatter import Scatter, fits
from ..response.scattered import names_of
from ..vehicles.vehicle import coefficients_by_name
from .active import limit_text
from .candidate_slopes import candidate_slopes
from .scatter_table import sampled

if TYPE_CHECKING:
    import pandas as pd

_USUAL = {"spring": 0.05, "damper": 0.15}  # in production, where a problem has no scatter of its own
_LEVEL = 95.0
_SLOW = (Peak, OwnMeasure)


def scatter_for(problem: RideProblem) -> Scatter | None:
    """Return the scatter of a problem, else ±5 % of springs and ±15 % of dampers; None if there are neither.

    None too where peaks or functions of Python would take minutes for all samples.
    """
    judged = [*problem.measures, *(limit.measure for limit in problem.constraints)]
    if problem.scatter or any(isinstance(one, _SLOW) for one in judged):
        return problem.scatter
    known = names_of(problem.cases, problem.variables, coefficients_by_name(problem.struts, {}))
    usual = {name: share for name, share in _USUAL.items() if any(fits(name, one) for one in known)}
    return Scatter(usual) if usual else None


def candidate_scatter(problem: RideProblem, table: "pd.DataFrame", scatter: Scatter) -> "pd.DataFrame":
    """Return by candidate of a table the value of each measure that 95 % of the samples keep to, with its unit.

    By limit also the share of the samples beyond it [%].
    """
    import pandas as pd

    designs = table[column_headers(problem.variables, problem.units)].to_numpy(dtype=float)
    found = sampled(problem, designs, scatter)
    ordered, rows = np.sort(found.samples, axis=2), range(len(designs))
    columns: dict[str, object] = {"name": table["name"].to_list()}
    for k, one in enumerate(found.judged):
        if isinstance(one, Limit):
            columns[f"beyond {limit_text(one.nominal)} [%]"] = [found.beyond(k, design) for design in rows]
        else:
            level = 100 - _LEVEL if one.maximise else _LEVEL
            columns[f"q{level:g} {one.label} [{one.unit}]"] = ordered[:, k] @ of_quantile(scatter.samples, level)
    return pd.DataFrame(columns, index=table.index)


def parts_over_scatter(problem: RideProblem, table: "pd.DataFrame") -> dict[str, "pd.DataFrame"]:
    """Return tables of candidates over a scatter, of the problem or of production, and of what changes them."""
    titles = {}
    if scatter := scatter_for(problem):
        titles[_title(scatter)] = candidate_scatter(problem, table, scatter)
    titles["What changes each measure most, by 1 % more"] = candidate_slopes(problem, table)
    return {title: one.rename_axis("no.").reset_index() for title, one in titles.items()}


def _title(scatter: Scatter) -> str:
    spread = (f"{name} {100 * low:+g} to {100 * high:+g} %" for name, (low, high) in scatter.intervals.items())
    return f"Over a scatter of {', '.join(spread)}, {scatter.samples} samples, seed {scatter.seed}"

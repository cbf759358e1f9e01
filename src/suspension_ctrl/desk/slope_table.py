"""What 1 % more of each variable, coefficient and parameter does to the measures of a design, as a table."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real
from ..response.gradients.scores import with_jacobian
from ..response.mapped import slopes_of
from ..response.measures.limits import Limit
from ..response.measures.measure import Measure
from ..response.problem import RideProblem
from ..response.robust_scores import ScatteredScores
from ..response.scatter import Scatter
from ..response.scattered import Scattered, names_of
from ..vehicles.parameters import parameters_of
from ..vehicles.vehicle import AssembledVehicle, coefficients_by_name
from .candidate_table import Present, design_of, reaching
from .refinement import refine
from .scatter_table import nodes_at

if TYPE_CHECKING:
    import pandas as pd

STEP = 0.01
"""The change of each value, as a share of it."""

VARIABLE, COEFFICIENT, PARAMETER, LIMIT = "variable", "coefficient", "parameter", "limit"

_OPTIMUM = 1e-3  # largest share of an objective that a refined design may be better


class Source(NamedTuple):
    """What is changed: its name, its kind, its value and unit."""

    name: str
    kind: str
    value: float
    unit: str


class Slopes(NamedTuple):
    """Measures, then limits that are no objectives, their values (k,), and their changes (n, k) by each source."""

    judged: Sequence[Measure | Limit]
    nominal: Real
    sources: Sequence[Source]
    changes: Real

    @property
    def shares(self) -> Real:
        """Changes (n, k) over the values [%], NaN where a value is 0."""
        size = np.abs(self.nominal)
        return np.asarray(100 * self.changes / np.where(size > 0, size, np.nan))

    @property
    def labels(self) -> list[str]:
        """Names of the measures and limits."""
        return [str(one) if isinstance(one, Limit) else one.label for one in self.judged]


def sensitivity(problem: RideProblem, design: Present, *, minimise: str | None = None) -> "pd.DataFrame":
    """Return what 1 % more of each variable, coefficient and parameter does to the measures of a design.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like, or mapping of str to float
        Variables of the design, also outside the bounds.
    minimise : str, optional
        Objective of which the prices of limits are told.

    Returns
    -------
    DataFrame
        A row by name of each ``variable``, each other ``coefficient`` of a strut and each ``parameter`` of tyres,
        masses and loads, the largest change first: ``kind``, ``value``, ``unit``; of each measure, and of each
        limit that is no objective, the change in percent, ``ACC [%]``, then in its unit, ``ACC [m/s^2]``. Changes
        are exact derivatives, see `RideProblem.jacobian`, times 1 % of the value, of a variable at 0 times 1 % of
        its range. In each load case a parameter changes from its value there. A robust measure of the problem
        stands for that of the nominal vehicle.

        With `minimise` there is a row of each ``limit`` and bound that the design reaches, and of each other
        objective, held at its value: what a limit that is 1 % larger does to the least of the objective, by the
        multipliers of `refine`. A design that `refine` makes better by more than 0.1 % is no optimum and has no
        prices: ``attrs["note"]`` says so.

    Raises
    ------
    ValueError
        About the design or the objective, or with `minimise` as of `refine`.

    Examples
    --------
    The tyre does more for the tyre load than any part of the strut:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road = sc.Iso8608Road("C")
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds, band=(0.3, 20.0))
    >>> table = sc.sensitivity(problem, file.setting)
    >>> print(table[["kind", "ACC [%]", "SWS [%]", "DTL [%]"]].round(2))
                             kind  ACC [%]  SWS [%]  DTL [%]
    name
    installation_ratio  parameter     0.95    -1.00    -0.52
    body_mass           parameter    -0.98     0.44     0.02
    tyre_stiffness      parameter     0.38    -0.00     0.80
    damper               variable     0.35    -0.50    -0.26
    wheel_mass          parameter     0.12     0.06     0.44
    spring               variable     0.13     0.00     0.01
    """
    import pandas as pd

    found = slopes_at(problem, design)
    found, note = (found, "") if minimise is None else _with_prices(found, problem.nominal, design, minimise)
    index = pd.Index([one.name for one in found.sources], name="name")
    table = pd.DataFrame([one[1:] for one in found.sources], index=index, columns=list(Source._fields[1:]))
    units = [one.measure.unit if isinstance(one, Limit) else one.unit for one in found.judged]
    for label, column in zip(found.labels, found.shares.T, strict=True):
        table[f"{label} [%]"] = column
    for label, unit, column in zip(found.labels, units, found.changes.T, strict=True):
        table[f"{label} [{unit}]"] = column
    table.attrs |= {"note": note} if note else {}
    return table


def slopes_at(problem: RideProblem, design: Present) -> Slopes:
    """Return the changes of the measures of a design, the largest first; errors as of `sensitivity`."""
    checks.of_kind("problem", problem, RideProblem)
    x = design_of(problem, design, "design")
    wide = reaching(problem.nominal, x)
    known = names_of(wide.cases, wide.variables, coefficients_by_name(wide.struts, {}))
    judged = _judged(wide)
    scores = wide.scoring.scattered(judged, Scatter(dict.fromkeys(known, STEP), samples=1))
    z, values, jacobian = _derivatives(scores, x, nodes_at(scores, x[None], wide.nodes))
    own = slopes_of(scores.scattered.formulas, x[None])[0]
    steps = np.where(x == 0, np.subtract(wide.upper, wide.lower), x)
    others = [i for i, name in enumerate(scores.scattered.names) if name not in wide.variables]
    changes = STEP * np.hstack([jacobian @ own * steps, (jacobian * z)[:, others]]).T
    named = zip(wide.variables, x.tolist(), strict=True)
    sources = [Source(name, VARIABLE, value, wide.units[name]) for name, value in named]
    sources += [_source(wide, scores.scattered, i, float(z[i])) for i in others]
    return _ranked(Slopes(judged, values, sources, changes))


def _derivatives(scores: ScatteredScores, x: Real, nodes: int) -> tuple[Real, Real, Real]:
    """Return the values (v,) that may scatter at a design (d,), measures (k,) there, and derivatives (k, v)."""
    z = scores.scattered.formulas.of(x[None])
    ends = (1 - STEP) * z[0], np.where(z[0] == 0, STEP, (1 + STEP) * z[0])
    values, jacobian = with_jacobian(scores.scores, z, nodes, ends)
    return z[0], scores.signs * values[0], scores.signs[:, None] * jacobian[0]


def _judged(problem: RideProblem) -> list[Measure | Limit]:
    """Return the measures, and the limits that say more."""
    same = len(problem.cases) == 1 or problem.worst_case
    limits = (one for one in problem.constraints if not (same and one.measure in problem.measures))
    return [*problem.measures, *limits]


def _source(problem: RideProblem, scattered: Scattered, place: int, value: float) -> Source:
    """Return the coefficient or the parameter in a place of the values that may scatter."""
    name, fixed = scattered.names[place], coefficients_by_name(problem.struts, {})
    for one in problem.cases[0].vehicle.strut_coefficients:
        if one.name == name:
            return Source(name, COEFFICIENT, value, one.unit)
    vehicles = (case.vehicle for case in problem.cases if isinstance(case.vehicle, AssembledVehicle))
    parameter = next(known[name] for known in (parameters_of(one.assembly) for one in vehicles) if name in known)
    default = fixed.get(name, parameter.default) if name in scattered.relative else 1.0
    return Source(name, PARAMETER, value * default, parameter.unit)


def _with_prices(slopes: Slopes, problem: RideProblem, design: Present, minimise: str) -> tuple[Slopes, str]:
    """Return the slopes with those of the limits and bounds that hold the least of an objective, or why not."""
    checks.one_of("minimise", minimise, problem.objectives)
    x = design_of(problem, design, "design")
    values = dict(zip(problem.objectives, problem.evaluate(x[None])[0].tolist(), strict=False))
    best = refine(
        problem, x, minimise=minimise, within={name: one for name, one in values.items() if name != minimise}
    )
    gain = (values[minimise] - best.measures[minimise]) / abs(values[minimise])
    if gain > _OPTIMUM:
        return slopes, f"no prices: {minimise} could be {100 * gain:.1f} % less at the same other measures"
    sources = [Source(name, LIMIT, float(name.rpartition(" ")[2]), best.units[name]) for name in best.active]
    changes = np.full((len(sources), len(slopes.judged)), np.nan)
    column = problem.objectives.index(minimise)
    changes[:, column] = [STEP * one.value * best.multipliers[one.name] for one in sources]
    more = slopes._replace(sources=[*slopes.sources, *sources], changes=np.vstack([slopes.changes, changes]))
    return more, ""


def _ranked(slopes: Slopes) -> Slopes:
    """Return the slopes with the source of the largest change in percent first."""
    order = np.argsort(-np.nan_to_num(np.abs(slopes.shares)).max(axis=1), kind="stable")
    return slopes._replace(sources=[slopes.sources[i] for i in order], changes=slopes.changes[order])

"""What an active suspension could attain: fronts of optimal controllers and of skyhook, and the share taken."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .. import checks
from ..quantities import Real, column_headers, signal_unit
from ..response.controllers.active_suspension import EFFORT, ActiveSuspension
from ..response.controllers.within_limits import least_controlled
from ..response.measures.limits import Limit
from ..response.problem import RideProblem
from ..search.driver import minimise as search
from ..search.nsga2 import Nsga2
from .bound import LEAST, LQG, LQR, SKYHOOK, WITHIN
from .candidate_table import PRESENT, Present, design_of, reaching
from .halton import halton
from .refinement import least_of
from .skyhook_problems import takes_sky, with_sky

if TYPE_CHECKING:
    import pandas as pd

PASSIVE, ACTIVE = "passive optimum", "active optimum"
SHARE = "share [%]"

_RATIO = 100.0  # largest ratio of two weights
_POPULATION, _ITERATIONS = 100, 40
_SLACK = 1e-9  # share by which limits are above the measures of the present design, for rounding


def attainable(
    problem: RideProblem,
    *,
    present: Present | None = None,
    points: int = 64,
    sensors: Mapping[str, float] | None = None,
) -> "pd.DataFrame":
    """Return the front of an optimal active suspension of a ride problem, and that of skyhook.

    Actuators stand in place of the struts on wheels, on the vehicle, road and load case of the problem. The linear
    quadratic regulator with full information, of the vehicle, of the road under its first axle and of its delay to
    the others, has the least weighted sum of squares of the measures over all frequencies [1]_: with squares over
    those of a present design, no controller, linear or not, is below ``least``. Squares are convex over linear
    controllers, so that weights reach the whole front. Measures are those of the problem's own quadrature.

    Parameters
    ----------
    problem : RideProblem
        In one load case, with root mean squares as measures, such as ACC, SWS and DTL, and coefficients of struts
        as variables. Limits and scatter do not count.
    present : mapping of str to float, or (d,) array_like, optional
        Design with whose measures squares are compared; that in the middle of the bounds by default. Struts that
        stand on no wheel keep its coefficients.
    points : int
        Number of controllers with different weights.
    sensors : mapping of str to float, optional
        Responses that sensors read, each with the root mean square of its white noise within the band, such as
        ``{"body_acceleration": 0.05, "suspension_travel": 5e-4}``: for the linear quadratic Gaussian regulator
        (LQG), which knows vehicle and road by them alone. Its forces have white noise of 1 % of those of the
        present design.

    Returns
    -------
    DataFrame
        By ``controller``, ``LQR``, ``LQG`` and ``skyhook``, measures with units. Of LQR weights; ``least``, the
        criterion over all frequencies; ``within band``, its part in the band: what costs less there costs more
        beyond it. Where measures leave forces free, the squares of forces over those of the present design count
        too, by 1/1000. Of skyhook springs and dampers within their bounds, beside sky dampers of at most the
        largest bound of a damper, by NSGA-II. ``attrs`` has the measures of the present design; errors of the
        roads' shaping filters (``spectrum error``, relative, r.m.s. and largest, by track) and of the delays
        between axles (``delay error``, largest within the band); and the orders of both.

    Raises
    ------
    ValueError
        If the problem is not as above, the vehicle is no state space or its weighting no filter.

    References
    ----------
    .. [1] D. Hrovat, "Survey of advanced suspension developments and related optimal control applications",
       Automatica 33(10), 1997.

    Examples
    --------
    With these weights no controller has a criterion below 0.79 of that of the present design:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> table = sc.attainable(problem, present=file.setting, points=16)
    >>> print(table.loc[1, table.columns[4:]].to_frame().astype(float).round(2).T.to_string(index=False))
     ACC weight [-]  SWS weight [-]  DTL weight [-]  least [-]  within band [-]
               0.45            0.45             0.1       0.79             0.76
    """
    import pandas as pd

    checks.of_kind("problem", problem, RideProblem)
    problem = problem.nominal.replace(constraints=())
    table = optimal_controllers(problem, present, points, sensors or {})
    if takes_sky(problem):
        front = search(with_sky(problem), Nsga2(population=_POPULATION), iterations=_ITERATIONS, seed=1).front()
        sky = front[table.attrs["measures"]].assign(controller=SKYHOOK)
        attributes, table = table.attrs, pd.concat([table, sky], ignore_index=True)
        table.attrs.update(attributes)
    return table


def optimal_controllers(
    problem: RideProblem, present: Present | None, points: int, sensors: Mapping[str, float]
) -> "pd.DataFrame":
    """Return the table of `attainable` without skyhook, of a nominal problem without limits."""
    import pandas as pd

    checks.at_least("points", points, 1)
    design = _middle(problem) if present is None else design_of(problem, present)
    noise = _checked_sensors(problem, sensors)
    active = ActiveSuspension.of(reaching(problem, design), design, list(sensors))
    estimator = active.estimator(noise) if sensors else None
    names = list(problem.objectives)
    headers = column_headers(names, problem.units)
    rows = []
    for weights in _weights(len(names), points):
        factors = active.factors(weights)
        found = active.controlled(factors)
        least = found.regulator.least
        rows.append([LQR, *found.measures, *weights, least, factors @ found.mean_squares])
        if estimator:
            sensed = active.sensed(found.regulator, estimator, noise)
            rows.append([LQG, *sensed.measures, *weights, np.nan, factors @ sensed.mean_squares])
    labels = ["controller", *headers, *(f"{name} weight [-]" for name in names), LEAST, WITHIN]
    table = pd.DataFrame(rows, columns=labels)
    table = table.sort_values("controller", ascending=False, kind="stable", ignore_index=True)
    table.attrs.update(_attributes(active, headers))
    return table


def attained(problem: RideProblem, present: Present, *, minimise: str | None = None) -> "pd.DataFrame":
    """Return how much of what an active suspension could attain a passive one takes.

    That is the share in the reduction of one measure, from the present design to the optimal controller, with all
    other measures at most those of the present design.

    Parameters
    ----------
    problem : RideProblem
        As of `attainable`. Limits, scatter, catalogues and whole numbers do not count.
    present : mapping of str to float, or (d,) array_like
        The design of today.
    minimise : str, optional
        Name of the measure; the first of the problem by default.

    Returns
    -------
    DataFrame
        By ``present design``, ``passive optimum``, ``skyhook`` (if it can be had) and ``active optimum`` the
        measures with units, and the ``share`` of the reduction [%]. Passive ones are by `refine`.

    Raises
    ------
    ValueError
        As `attainable`, or if the measure is unknown or cannot be reduced.

    Examples
    --------
    Its springs and dampers take a sixth of what is attainable by comfort at the same travel and tyre load:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(file.vehicle, sc.Iso8608Road("C"), speed=20.0, bounds=file.bounds)
    >>> table = sc.attained(problem, file.setting)
    >>> table["share [%]"].round().to_dict()
    {'present design': 0.0, 'passive optimum': 16.0, 'skyhook': 21.0, 'active optimum': 100.0}
    """
    import pandas as pd

    checks.of_kind("problem", problem, RideProblem)
    problem = problem.nominal.replace(constraints=(), kinds={})
    names = list(problem.objectives)
    j = 0 if minimise is None else names.index(_known(minimise, names))
    design = design_of(problem, present)
    wide = reaching(problem, design)
    active = ActiveSuspension.of(wide, design)
    own = active.measures_of(active.present)
    others = [one for k, one in enumerate(problem.measures) if k != j]
    limits = [Limit(one, value * (1 + _SLACK)) for one, value in zip(others, np.delete(own, j), strict=True)]
    limited = problem.replace(constraints=limits)
    passive = np.array(list(least_of(limited, names[j], _inside(problem, design)[None]).design.values()))
    rows = {PRESENT: own, PASSIVE: problem.evaluate(passive[None])[0]}
    if takes_sky(problem):
        sky = with_sky(limited)
        without = np.append(passive, np.zeros(len(sky.variables) - design.size))
        best = least_of(sky, names[j], without[None]).measures
        rows[SKYHOOK] = np.array([best[name] for name in names])
    rows[ACTIVE] = least_controlled(active, j, own).measures
    table = pd.DataFrame(rows.values(), columns=column_headers(names, problem.units), index=list(rows))
    reduced = own[j] - table.iloc[:, j]
    if not reduced[ACTIVE] > 0:
        raise ValueError(f"present must leave {names[j]} to be reduced, got a design that has the least")
    return table.assign(**{SHARE: 100 * reduced / reduced[ACTIVE]}).rename_axis("suspension")


def _checked_sensors(problem: RideProblem, sensors: Mapping[str, float]) -> Real:
    """Return the noises (s,) of sensors; ValueError unless they are responses with positive numbers."""
    checks.mapped("sensors", sensors)
    for name, value in sensors.items():
        checks.one_of("sensors", name, problem.vehicle.meanings)
        checks.positive(f"noise of {name}", value, signal_unit(name))
    return np.array(list(sensors.values()), dtype=float)


def _weights(m: int, points: int) -> Real:
    """Return weights (points, m) of sum 1, ratios to the first evenly from 1/100 to 100 in the logarithm."""
    logarithms = (2 * halton(points, m - 1) - 1) * np.log(_RATIO)
    weights = np.exp(np.column_stack([np.zeros(points), logarithms]))
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


def _middle(problem: RideProblem) -> Real:
    return np.asarray((np.asarray(problem.lower) + problem.upper) / 2)


def _inside(problem: RideProblem, design: Real) -> Real:
    return np.clip(design, problem.lower, problem.upper)


def _known(name: str, names: list[str]) -> str:
    checks.one_of("minimise", name, names)
    return name


def _attributes(active: ActiveSuspension, headers: list[str]) -> dict[str, object]:
    """Return what the bound depends on beside the weights."""
    roads = active.roads
    return {
        "measures": headers,
        "present": active.measures_of(active.present).tolist(),
        "spectrum error": [(one.rms, one.largest) for one in roads.shapings],
        "spectrum orders": [len(one.filter.b) for one in roads.shapings],
        "delay error": roads.delay_error,
        "delay orders": list(roads.orders),
        "effort": EFFORT if active.effort.any() else 0.0,
    }

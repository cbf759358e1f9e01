"""From any design to the constrained optimum of one objective, with the prices of limits and a residual."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from .. import checks
from ..quantities import FrozenMapping, Real, Record, wrapped
from ..response.measures.terms import number_text
from ..response.problem import RideProblem
from ..tables.headers import shown_unit, shown_value
from .candidate_table import Present, design_of
from .choosing import Within, interval
from .crossing import crossed
from .descent import End, descended
from .programs import Named, Program, Row, Writer
from .smooth import atoms_of

if TYPE_CHECKING:
    import pandas as pd

_EQUAL = 1e-8  # relative difference of two values of one optimum
_ACTIVE = 1e-6
"""Largest distance of an active limit, as a share of it, and of an active bound, as a share of its range."""


@dataclass(frozen=True, eq=False, repr=False)
class Refined(Record):
    """A constrained optimum of one objective with its proof, see `refine`."""

    minimised: str  # objective
    design: Mapping[str, float]  # by variable
    measures: Mapping[str, float]  # objectives, and measures of limits in the worst load case
    multipliers: Mapping[str, float]  # derivative of the objective by each limit and active bound, in SI units
    residual: float
    active: tuple[str, ...]  # limits and bounds that the design reaches, as `multipliers` names them
    units: Mapping[str, str]  # of variables, measures, limits and bounds

    def prices(self) -> "pd.DataFrame":
        """Return the multipliers by limit and bound: ``price`` and ``unit``, in mm, kN and kN/m."""
        import pandas as pd

        rows = {name: self._price(name) for name in self.multipliers}
        return pd.DataFrame.from_dict(rows, orient="index", columns=["price", "unit"]).rename_axis("limit")

    def _price(self, name: str) -> tuple[float, str]:
        unit, factor = shown_unit(price_unit(self.units[self.minimised], self.units[name]))
        return factor * self.multipliers[name], unit

    def __repr__(self) -> str:
        def told(values: Mapping[str, float]) -> str:
            return ", ".join(f"{name} {shown_value(value, self.units[name])}" for name, value in values.items())

        prices = ", ".join("{}: {:.4g} {}".format(name, *self._price(name)) for name in self.active)
        parts = [told(self.design), told(self.measures), prices or "no active limit or bound"]
        return wrapped(f"Refined(least {self.minimised}, residual {self.residual:.1e}; {'; '.join(parts)})")


def price_unit(own: str, per: str) -> str:
    """Return the unit of the price of a limit, ``"m/s^2 per m"``."""
    return f"{own or '-'} per {per if per not in ('', '-') else 'unit'}"


def refine(problem: RideProblem, design: Present, *, minimise: str, within: Within | None = None) -> Refined:
    r"""Return the optimum of one objective that a descent reaches from a design, within limits and bounds.

    SLSQP descends with exact slopes; Newton's method on the active limits and bounds then solves the conditions of
    an optimum [1]_. From an optimum with variables on bounds it descends again with each on the opposite bound,
    where that is hardly worse. The optimum is local: from another design a descent may reach another.

    Parameters
    ----------
    problem : RideProblem
        Limits and bounds are its own. Whole numbers and values of a catalogue stay as they are.
    design : mapping of str to float, (d,) array_like, or Series
        By variable, in their order, or a row of a front. Outside the bounds the nearest design in them counts.
    minimise : str
        Name of an objective.
    within : mapping of str to float, text or pair of them, optional
        Further limits on objectives, as of `pick`: the largest value, or the least and the largest, in SI units or
        with a unit, ``{"SWS": "28.7mm"}``. Two equal ones hold the objective there.

    Returns
    -------
    Refined
        ``design`` by variable; ``measures``, the objectives and measures of limits; ``multipliers``: by limit and
        by active bound, ``"SWS <= 0.0287"``, ``"spring >= 1000"``, its price, the derivative of the objective by
        it [unit of the objective / unit of the limit], 0 of a limit that is not active; ``prices()``, these as a
        table in mm, kN and kN/m; ``active``, names of limits and bounds that the design reaches; ``residual`` [-].

    Raises
    ------
    ValueError
        If a name is unknown, no variable is real, a descent finds no design within the limits, or an objective of
        several wheels is held or has a least value.

    Notes
    -----
    With objective :math:`f` over its size, constraints :math:`g \le 0` over their limits, and variables :math:`x`
    from 0 to 1 between their bounds, the residual is the largest magnitude of

    .. math:: \nabla f + \sum_i \lambda_i \nabla g_i - \mu + \nu, \quad \max(g_i, 0), \quad \lambda_i g_i, \quad
        \mu_j x_j, \quad \nu_j (1 - x_j)

    with multipliers :math:`\lambda, \mu, \nu \ge 0` that make the first least: stationarity, feasibility and
    complementarity. At most 1e-8 is reached where measures are smooth: root mean squares, whose worst wheel and
    load case are told apart by slack variables, statics, roll and modes. A measure by a function may have a kink,
    as the peak in an event has, at which the residual remains large; its slopes, by differences, may take long.

    References
    ----------
    .. [1] J. Nocedal, S. J. Wright, "Numerical Optimization", 2nd edition, 2006, chapters 12 and 18.

    Examples
    --------
    Least discomfort of the paper's car at its travel: 1 mm more travel is worth 0.063 m/s^2.

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> problem = sc.RideProblem(
    ...     file.vehicle, road, speed=20.0, bounds=file.bounds, constraints=["SWS <= 28.7mm"]
    ... )
    >>> best = sc.refine(problem, file.setting, minimise="ACC")
    >>> {name: round(value) for name, value in best.design.items()}, best.residual < 1e-8
    ({'spring': 11801, 'damper': 1630}, True)
    >>> best.prices().round(3)
                   price          unit
    limit
    SWS <= 0.0287 -0.063  m/s^2 per mm
    """
    checks.of_kind("problem", problem, RideProblem)
    checks.one_of("minimise", minimise, problem.objectives)
    at = partial(program_of, problem, minimise=minimise, within=within or {})
    end = descended(at(design_of(problem, design, "design")))
    check_limits([end])
    return refined_at(crossed(end, at), minimise)


def least_of(problem: RideProblem, minimise: str, starts: Real, within: Within | None = None) -> Refined:
    """Return the best optimum that descents reach from starts (k, d); ValueError if none is within the limits.

    Of optima that are equal but for rounding it is the first, for all last bits of sums the same.
    """
    at = partial(program_of, problem, minimise=minimise, within=within or {})
    ends = [descended(at(start)) for start in starts]
    check_limits(ends)
    held = [end for end in ends if end.feasible]
    best = min(end.value for end in held)
    first = next(end for end in held if end.value <= best + _EQUAL * abs(best))
    return refined_at(crossed(first, at), minimise)


def check_limits(ends: Sequence[End]) -> None:
    """Raise ValueError if no end of several descents is within the limits."""
    if not any(end.feasible for end in ends):
        got = ", ".join(dict.fromkeys(row.limit.name for row in ends[0].program.rows if row.limit))
        raise ValueError(f"limits must be those of a design within the bounds, got {got}")


def program_of(problem: RideProblem, design: Real, minimise: str, within: Within) -> Program:
    """Return the program of one objective from a design (d,) within limits."""
    checks.mapped("within", within)
    writer, names = Writer(atoms_of(problem)), list(problem.objectives)
    objective = writer.objective(names.index(minimise))
    for name, given in within.items():
        checks.one_of("within", name, names)
        ends = interval(name, given, problem.units[name])
        row = writer.objective(names.index(name))
        if ends[0] > -np.inf and any(place >= writer.atoms.count for place in row.places):
            got = checks.shown(given)
            raise ValueError(f"within must be a largest value for {name}, the worst of several wheels, got {got}")
        writer.rows += _held(row, name, *ends, problem.units[name])
    return Program(writer, objective, design)


def _held(row: Row, name: str, low: float, high: float, unit: str) -> Iterator[Row]:
    """Yield the rows that hold an objective between two ends."""
    for end, sign, words in ((high, 1.0, "=" if low == high else "<="), (low, -1.0, ">=")):
        if np.isfinite(end) and (sign > 0 or low != high):
            limit = Named(f"{name} {words} {end:.6g}", unit, by_limit=-sign)
            yield replace(row.times(sign).plus(-sign * end), equal=low == high, limit=limit, size=abs(end) or 1.0)


def refined_at(end: End, minimise: str) -> Refined:
    """Return the optimum at the end of a descent to the least of an objective."""
    problem = end.program.atoms.problem
    values = problem.evaluate(end.design[np.newaxis])[0]
    measures = dict(zip(problem.objectives, values.tolist(), strict=False))
    for limit, g in zip(problem.constraints, values[len(measures) :].tolist(), strict=True):
        measures.setdefault(limit.measure.label, (g - limit.offset) / limit.scale)
    units = {limit.measure.label: limit.measure.unit for limit in problem.constraints} | dict(problem.units)
    multipliers, active = dict[str, float](), list[str]()
    for name, unit, price, reached in (*_limits(end), *_bounds(end)):
        multipliers[name] = multipliers.get(name, 0.0) + price
        units[name] = unit
        if reached and name not in active:
            active.append(name)
    return Refined(
        minimised=minimise,
        design=FrozenMapping(dict(zip(problem.variables, end.design.tolist(), strict=True))),
        measures=FrozenMapping(measures),
        multipliers=FrozenMapping(multipliers),
        residual=end.conditions.residual,
        active=tuple(active),
        units=FrozenMapping(units),
    )


def _limits(end: End) -> Iterator[tuple[str, str, float, bool]]:
    """Yield name, unit, price and whether it is reached of each row that holds a limit."""
    program, rows = end.program, end.program.at(end.z).rows
    for number, row in enumerate(program.rows):
        if row.limit:
            multiplier = end.conditions.multipliers[number] * program.sizes[0] / program.sizes[number]
            reached = row.equal or rows[number] >= -_ACTIVE
            yield row.limit.name, row.limit.unit, multiplier * row.limit.by_limit, bool(reached)


def _bounds(end: End) -> Iterator[tuple[str, str, float, bool]]:
    """Yield name, unit and price of each bound that the design reaches."""
    program, problem = end.program, end.program.atoms.problem
    stretch = program.atoms.box.stretch(end.design[np.newaxis])[0]
    for place, v in enumerate(program.free.tolist()):
        name, share = problem.variables[v], end.z[place]
        if min(share, 1 - share) <= _ACTIVE:
            sign, bound = ("<=", problem.upper[v]) if share > 0.5 else (">=", problem.lower[v])
            slope = end.conditions.gradient[place] if end.conditions.held[place] else 0.0
            price = slope * program.sizes[0] / stretch[v]
            yield f"{name} {sign} {number_text(bound)}", problem.units[name], float(price), True

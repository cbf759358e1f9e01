"""A design driven in time on random roads: measures linearised and simulated side by side."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import FrozenMapping, Real
from ..vehicles.assembly import ResponseName, label
from ..vehicles.networks import has_force_laws
from ..vehicles.vehicle import Vehicle
from .certificates import Certificate, Certified
from .linearisation import linearised
from .measures.gaussian import Bottoming, Lift, Topping
from .measures.limits import Limit
from .measures.measure import Measure
from .measures.terms import CaseMeasure, Term
from .parameters_at import without_parameters
from .problem import RideProblem
from .scores import Score, Scores
from .trips import Trip, random_profile, trip

_SHORTEST = 20.0  # s, of a trip
_COVERED = 0.95  # of the interval
_OF_DESIGN, _LONGER = "not of a drive, the value of the design alone", "of longer roads than these"


def certify(
    problem: RideProblem,
    design: ArrayLike,
    length: float = 20e3,
    seeds: Sequence[int] = range(8),
    *,
    lift_off: bool = False,
) -> Certificate:
    """Drive a design over random roads in time, and compare its measures with their linearised values.

    In each load case and for each seed the vehicle drives over a Gaussian road with the spectrum, the band and the
    coherence of the load case, in the steady state of one period: no transient counts. Vehicles with force laws
    are driven a second time on the same roads with an equivalent spring or damper in place of each law, see
    `linearised`.

    Parameters
    ----------
    problem : RideProblem
    design : (d,) array_like
        Variables of the design, within the bounds.
    length : float
        Length of each road, 20 s of driving at least in every load case [m].
    seeds : sequence of int
        Seeds of the roads, two or more.
    lift_off : bool
        Whether tyres may leave the road, as of `simulate`.

    Returns
    -------
    Certificate
        Prints as a table. ``to_frame()`` is a DataFrame by ``case`` and ``measure``: the ``linearised`` value, the
        mean of the ``simulated`` ones with its 95 % interval by Student's distribution over the seeds, ``low`` to
        ``high``, the ``equivalent`` vehicle's simulated mean, and whether the linearised value is ``outside`` the
        interval. To the objectives and limits of the problem it adds the share of time in which a tyre lifts off
        or would, strikes of stops of the struts, and with force laws the mean travel. Of robust measures it has
        those of the nominal vehicle.

        Root mean squares are about the mean, weighted by the lines of the simulated spectrum, beyond the band too.
        A function of spectra gets those of the band. Strikes and lift-off are counted, largest values are means
        over parts of the road, peaks are integrated over their events.

    Raises
    ------
    ValueError
        About a parameter, or a vehicle that has no response in time, such as one with measured stiffness.

    Examples
    --------
    A damper with more rebound than bump pulls the car down by as much as linearisation says:

    >>> import suspension_ctrl as sc
    >>> strut = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=750.0, rebound=2250.0))
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> bounds = {"spring": (10e3, 30e3)}
    >>> problem = sc.RideProblem(car, road, speed=20.0, bounds=bounds, band=(0.1, 20.0))
    >>> print(sc.certify(problem, [22e3], length=1000.0, seeds=range(3)))
    3 random roads of 1 km in each load case, simulated; 95 % intervals
    Design: spring 22000
    <BLANKLINE>
    Case 1, share 1: power law: Gd(1 cycle/m) = 5e-06 m^3, exponent 2.5; 20 m/s
    measure                 unit linearised simulated       low      high equivalent
    ACC                    m/s^2      2.26      2.273     2.183     2.363      2.248
    SWS                        m   0.02869    0.02872   0.02835    0.0291    0.02769
    DTL                        N      1365       1405      1362      1449       1362
    lift                       -   0.00457    0.00475   0.00199   0.00751      0.004
    mean travel                m  -0.01287   -0.01317  -0.01358  -0.01276   -0.01287
    """
    checks.of_kind("problem", problem, RideProblem)
    problem = problem.nominal
    x = checks.designs(np.atleast_2d(checks.reals("design must be", design)), len(problem.variables))
    if len(x) != 1:
        raise ValueError(f"design must be one design, got {len(x)}")
    checks.rows_within("design", x, problem.lower, problem.upper)
    roads = _Roads(float(length), _checked_seeds(seeds), lift_off)
    _check_length(problem, length)
    variables, (problem, values) = problem.variables, without_parameters(problem, x[0])
    measures = _measures(problem)
    scores = problem.scoring.scores_of(
        [Score(problem.scoring.in_cases(one), problem.worst_case, one.sign) for one in measures]
    )
    found = [_found(problem, scores, c, values, roads) for c in range(len(problem.cases))]
    rows = [row for c, values in enumerate(found) for row in _rows(str(c + 1), measures, scores.scores, values)]
    if len(found) > 1:
        rows += _rows_over_cases(problem, measures, scores, found)
    number = len(roads.seeds)
    return Certificate(
        title=f"{number} random roads of {length / 1e3:g} km in each load case, simulated; 95 % intervals",
        design=FrozenMapping(dict(zip(variables, x[0].tolist(), strict=True))),
        cases=tuple(f"share {case.share:g}: {case.describe()}" for case in problem.cases),
        rows=tuple(rows),
        limits=tuple(_verdict(limit, rows) for limit in problem.constraints),
        length=roads.length,
        seeds=roads.seeds,
    )


class _Roads(NamedTuple):
    """Random roads of a length [m], and whether tyres may leave them."""

    length: float
    seeds: tuple[int, ...]
    lift_off: bool


class _Found(NamedTuple):
    """Values of s measures and of the mean travel of q struts in a load case, of n seeds where simulated."""

    struts: tuple[str, ...]  # (q,), none without force laws
    linearised: Real  # (s + q,)
    simulated: Real  # (n, s + q)
    equivalent: Real  # (n, s + q), of the vehicle with an equivalent for each force law


def _found(problem: RideProblem, scores: Scores, c: int, design: Real, roads: _Roads) -> _Found:
    """Return linearised and simulated values of a design (v,) in a load case."""
    case, by_name = problem.cases[c], dict(zip(problem.variables, design.tolist(), strict=True))
    setting = case.vehicle.coefficients({**problem.struts, **by_name})
    vehicles: list[tuple[Vehicle, Mapping[str, float]]] = [(case.vehicle, setting)]
    struts: tuple[str, ...] = ()
    linear = scores.by_case(c, design, problem.nodes)
    if has_force_laws(case.vehicle.networks):
        equivalent = linearised(case.vehicle, setting, case.road, case.speed, band=problem.band)
        vehicles.append((equivalent, {}))
        struts = tuple(case.vehicle.struts)
        linear = np.append(linear, list(equivalent.mean_travel.values()))
    values = np.full((2, len(roads.seeds), linear.size), np.nan)
    responses = _responses(case.vehicle, scores.terms[c])
    for i, seed in enumerate(roads.seeds):
        profile = random_profile(case, problem.band, roads.length, seed)
        for v, (vehicle, own) in enumerate(vehicles):
            one = trip(vehicle, own, case.speed, profile, problem.band, responses, roads.lift_off)
            travels = [one.histories[name].mean() for name in _travels(case.vehicle, struts)]
            values[v, i] = [*_measured(scores, c, one, np.array(list(setting.values()))), *travels]
    for s, score in enumerate(scores.scores):
        if in_event := score.cases[c].in_event:
            for v, (vehicle, own) in enumerate(vehicles):
                values[v, :, s] = in_event(vehicle, own, roads.lift_off)
    return _Found(struts, linear, *values)


def _responses(vehicle: Vehicle, terms: Sequence[Term]) -> list[ResponseName]:
    """Return the different responses of a vehicle, of terms and the travels of its struts."""
    every = [*vehicle.responses, *(term.response for term in terms), *_travels(vehicle, vehicle.struts)]
    return list({label(name): name for name in every}.values())


def _travels(vehicle: Vehicle, struts: Sequence[str]) -> list[str]:
    """Return the travels of struts."""
    names = {str(one.where): name for name, one in vehicle.meanings.items() if one.kind == "travel"}
    return [names[strut] for strut in struts if strut in names]


def _measured(scores: Scores, c: int, one: Trip, coefficients: Real) -> Real:
    """Return the measures (s,) of a trip in a load case, NaN where they are not of a trip."""
    found = scores.roots(c, np.array([one.mean_square(term) for term in scores.terms[c]]))
    for s, score in enumerate(scores.scores):
        if score.by_function:
            in_trip = score.cases[c].in_trip
            found[s] = in_trip(one, coefficients) if in_trip else np.nan
    return found


def _measures(problem: RideProblem) -> list[Measure]:
    """Return the objectives, the measures of limits, and of all stops and tyres if the vehicles have them."""
    found = list(dict.fromkeys([*problem.measures, *(limit.measure for limit in problem.constraints)]))
    for one in (Bottoming(), Topping(), Lift()):
        with suppress(ValueError):
            problem.scoring.in_cases(one)
            found += [one] if one not in found else []
    return found


def _rows(case: str, measures: Sequence[Measure], scores: Sequence[Score], found: _Found) -> Iterator[Certified]:
    """Yield the rows of a load case."""
    names = [(one.label, one.unit) for one in measures] + [(f"mean travel {s}".strip(), "m") for s in found.struts]
    for s, (name, unit) in enumerate(names):
        one = scores[s].cases[int(case) - 1] if s < len(scores) else CaseMeasure()
        note = _OF_DESIGN if one.values and not (one.in_trip or one.in_event) else ""
        if not note and np.isnan(found.simulated[:, s]).any():
            note = _LONGER
        values = (float(found.linearised[s]), *_interval(found.simulated[:, s]))
        yield Certified(case, name, unit, *values, float(found.equivalent[:, s].mean()), note)


def _rows_over_cases(
    problem: RideProblem, measures: Sequence[Measure], scores: Scores, found: Sequence[_Found]
) -> Iterator[Certified]:
    """Yield the rows of the objectives over all load cases."""
    for s, one in enumerate(measures[: len(problem.measures)]):
        linear = scores.over_cases(s, np.array([case.linearised[s] for case in found]))
        seeds = [
            np.transpose([getattr(case, kind)[:, s] for case in found]) for kind in ("simulated", "equivalent")
        ]
        simulated, equivalent = (np.array([scores.over_cases(s, row) for row in rows]) for rows in seeds)
        yield Certified("all", one.label, one.unit, linear, *_interval(simulated), float(equivalent.mean()))


def _interval(values: Real) -> tuple[float, float, float]:
    """Return the mean of values (n,) and its interval by Student's distribution, none if all are equal."""
    from scipy.special import stdtrit

    mean, deviation = float(values.mean()), float(values.std(ddof=1))
    if not deviation > 0:
        return mean, np.nan, np.nan
    half = float(stdtrit(values.size - 1, (1 + _COVERED) / 2)) * deviation / np.sqrt(values.size)
    return mean, mean - half, mean + half


def _verdict(limit: Limit, rows: Sequence[Certified]) -> str:
    """Return a limit with its verdict by the worst of the load cases."""
    each = [row for row in rows if row.measure == limit.measure.label and row.case != "all"]
    values = [row.linearised if np.isnan(row.simulated) else row.simulated for row in each]
    worst = max(values, key=lambda value: limit.scale * value)
    met = "met" if limit.scale * worst + limit.offset <= 0 else "not met"
    return f"{limit} {limit.measure.unit}: {met}, {worst:.4g} in the worst load case"


def _checked_seeds(seeds: Sequence[int]) -> tuple[int, ...]:
    """Return the seeds; ValueError unless they are two or more different whole numbers."""
    found = tuple(checks.at_least("seeds", seed, 0) for seed in seeds)
    if len(set(found)) < max(2, len(found)):
        raise ValueError(f"seeds must be two or more that differ, got {checks.shown(list(found))}")
    return found


def _check_length(problem: RideProblem, length: float) -> None:
    """Raise ValueError unless the length is 20 s of driving in every load case."""
    checks.positive("length", length, "m")
    fastest = max(case.speed for case in problem.cases)
    if length < _SHORTEST * fastest:
        raise ValueError(f"length must be {_SHORTEST * fastest:g} m or more at {fastest:g} m/s, got {length:g} m")

"""Measures of a ride and limits on them, at any place of any vehicle, by their texts.

A measure is written as

- ``ACC``, ``ACC driver``, ``ACC (1.2, -0.4)``: weighted acceleration of the body's centre of gravity, of a seat,
  or of a point (x, y) of the body;
- ``SWS``, ``SWS front``, ``SWS driver``: travel of the strut, of several the largest, of all wheels, an axle or a
  corner, or of a seat;
- ``DTL``, ``DTL rear_left``: load of the tyre, likewise; ``DLC``: over its static load on struts in the middle of
  their ranges (dynamic load coefficient);
- a root sum of squares of any responses, each with a factor and a weighting of ISO 2631 or none:
  ``Wk driver_acceleration + 0.63 We roll_acceleration + 0.4 We pitch_acceleration``, where 0.63 and 0.4 m/rad are
  the factors of ISO 2631-1, 8.2.2.1, for roll and pitch of a seated person;
- ``roll_gradient``, ``roll_damping``, ``front_load_transfer``: see `handling`; with ``-`` in front more is better.

``comfort = ...`` gives any of them a name of its own. A limit is a measure up to a value, ``SWS <= 0.0287``; a
measure of handling, or a user's own, may also have a least, ``roll_damping >= 0.2``.
"""

import inspect
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .. import checks
from ..quantities import Real, Record, signal_unit
from ..vehicles.assembly import ResponseName, label
from ..vehicles.handling import check_cornering
from ..vehicles.vehicle import Vehicle, assembled
from . import weightings
from .load_case import LoadCase
from .weightings import Weighting

_LARGEST = 1e6  # of factors and coordinates: squares times those of any response are still finite
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_POINT = rf"\(\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\)"
_LIMIT = re.compile(rf"((?:(?![<>]=).)+)([<>]=)\s*({_NUMBER})\s*")
_KINDS = {"SWS": ("travel", "m"), "DTL": ("load", "N"), "DLC": ("load", "-")}


class Designs(NamedTuple):
    """Designs (p, v) in a load case, all their coefficients (p, c), and response spectra design by design."""

    values: Real
    coefficients: Real
    spectra: Callable[[], Iterator[tuple[Real, Mapping[str, Real]]]]


Values = Callable[[Designs], Any]
"""From designs to the values (p,) of a measure that is no mean square."""

_HANDLING = {"roll_gradient": ("deg/g", True), "roll_damping": ("-", False), "front_load_transfer": ("-", True)}
"""Methods of `Mechanics`: the unit, and whether it takes a `RollGeometry`."""


@dataclass(frozen=True, eq=False, repr=False)
class Measure(Record):
    """A measure of a user's own, to be less is better.

    Parameters
    ----------
    name, unit : str
        Its name, and its unit, ``"-"`` for none.
    function : callable
        Of two positional parameters, ``f(frequency, spectra)``: the value of a design from the one-sided spectra
        (n,) of its responses by name [unit^2/Hz] at the middles (n,) of 1000 equal parts of the band [Hz]. Of one,
        ``f(designs)``: the values (p,) of designs (p, d), the variables in their order. The mean over several load
        cases by their shares counts, or the worst.

    Examples
    --------
    The mean power that the damper dissipates. On a road of waviness 2 and over all frequencies it is pi^2 K_t
    Gd(n0) n0^2 V for any spring and damper:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> def heat(frequency, spectra):
    ...     rate = (2 * np.pi * frequency) ** 2 * spectra["suspension_travel"]
    ...     return 1500.0 * np.trapezoid(rate, frequency)
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> table = sc.ride(
    ...     car,
    ...     {"spring": 22e3, "damper": 1500.0},
    ...     sc.Iso8608Road("C"),
    ...     speed=20.0,
    ...     measures=["ACC", sc.Measure("heat", "W", heat)],
    ...     band=(0.1, 100.0),
    ... )
    >>> print(f"{table['value']['heat']:.0f} W, {np.pi**2 * 192e3 * 256e-6 * 0.1**2 * 20.0:.0f} W")
    97 W, 97 W
    """

    name: str
    unit: str
    function: Callable[..., Any]

    def __post_init__(self) -> None:
        if _positional(self.function) not in (1, 2):
            raise ValueError(
                f"function must take designs, or frequency and spectra, got {checks.shown(self.function)}"
            )

    def values(self, designs: Designs) -> Real:
        """Return its values (p,) of designs."""
        if _positional(self.function) == 1:
            found = np.asarray(self.function(designs.values.copy()), dtype=float)
        else:
            found = np.array([self.function(*one) for one in designs.spectra()], dtype=float)
        if found.shape != (len(designs.values),) or not np.isfinite(found).all():
            raise ValueError(
                f"measure {self.name} must return a finite number for each design, got {checks.shown(found)}"
            )
        return found


def _positional(function: object) -> int:
    """Return the number of positional parameters without default."""
    parameters = inspect.signature(function).parameters.values() if callable(function) else ()
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(p.kind in kinds and p.default is p.empty for p in parameters)


class Term(NamedTuple):
    """A response with its weighting and factor; its mean square is the integral of w^moment times the spectrum."""

    response: ResponseName
    weighting: Weighting | None = None
    factor: float = 1.0
    relative: bool = False  # over the static load of the tyre
    moment: int = 0

    @property
    def integral(self) -> "Term":
        """The term without its factors: what has to be integrated."""
        return self._replace(factor=1.0, relative=False)


class CaseMeasure(NamedTuple):
    """A measure in a load case: the `worst` of its terms, the root of the sum of their squares, or a function."""

    name: str
    unit: str
    terms: tuple[Term, ...] = ()
    worst: bool = False
    sign: float = 1.0  # -1 where more is better
    values: Values | None = None


class Limit(NamedTuple):
    """A limit on a measure: g = scale * measure + offset is the violation as a share of it, met where g <= 0."""

    measure: CaseMeasure
    scale: float
    offset: float


def name_of(measure: str | Measure) -> str:
    """Return the name of a measure: of a text what stands before ``=``, or all of it."""
    if isinstance(measure, Measure):
        return measure.name
    name = " ".join(measure.split("=", 1)[0].split()) if isinstance(measure, str) else ""
    if not name:
        raise ValueError(
            f"measure must be a text such as 'SWS front' or 'name = SWS front', got {checks.shown(measure)}"
        )
    return name


def case_measure(measure: str | Measure, case: LoadCase, weighting: Weighting | None) -> CaseMeasure:
    """Return a measure in a load case, where ACC has this weighting; ValueError if the text means nothing."""
    name = name_of(measure)
    if isinstance(measure, Measure):
        return CaseMeasure(name, measure.unit, values=measure.values)
    body = measure.split("=", 1)[-1].strip()
    sign = -1.0 if body.startswith("-") else 1.0
    body = body.removeprefix("-").strip()
    if body in _HANDLING:
        return CaseMeasure(name, _HANDLING[body][0], sign=sign, values=_handling(body, case))
    kind, _, where = body.partition(" ")
    if kind in _KINDS:
        return CaseMeasure(name, _KINDS[kind][1], _at_corners(kind, where.strip(), case.vehicle), True, sign)
    if kind == "ACC":
        return CaseMeasure(name, "m/s^2", (Term(_accelerated(where.strip(), case.vehicle), weighting),), sign=sign)
    terms = tuple(_term(part.strip(), case.vehicle) for part in re.split(r"\+(?![^(]{0,99}\))", body))
    if len({signal_unit(label(term.response)).removeprefix("rad").removeprefix("m") for term in terms}) > 1:
        raise ValueError(f"measure must be a sum of responses of one kind, got {checks.shown(body)}")
    unit = signal_unit(label(terms[0].response))  # factors carry further units
    return CaseMeasure(name, unit, terms, sign=sign)


def case_limit(text: str, case: LoadCase, weighting: Weighting | None, own: Sequence[str | Measure] = ()) -> Limit:
    """Return a limit in a load case, on a measure written out or one of the user's `own` by its name."""
    found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
    if not found or np.isinf(value := float(found[3])):
        raise ValueError(
            f"constraint must be like 'SWS <= 0.03' or 'roll_damping >= 0.2', got {checks.shown(text)}"
        )
    by_name = {measure.name: measure for measure in own if isinstance(measure, Measure)}
    limited = case_measure(by_name.get(found[1].strip(), found[1]), case, weighting)
    if limited.sign < 0:
        raise ValueError(f"constraint must limit a measure without - in front, got {checks.shown(text)}")
    if limited.terms and not (found[2] == "<=" and value > 0):
        raise ValueError(
            f"constraint on a measure of the ride must be <= a limit above zero, got {checks.shown(text)}"
        )
    scale = (1.0 if found[2] == "<=" else -1.0) / (abs(value) or 1.0)
    return Limit(limited, scale, -scale * value)


def _handling(name: str, case: LoadCase) -> Values:
    """Return a measure of handling as a function of designs."""
    vehicle = assembled(case.vehicle)
    check_cornering(name, vehicle.assembly)
    geometry = (case.roll_geometry,) if _HANDLING[name][1] else ()
    if None in geometry:
        raise ValueError(f"roll_geometry must be given in every load case for {name}, got None")
    function = getattr(vehicle.statics, name)
    return lambda designs: function(designs.coefficients, *geometry)


def _at_corners(kind: str, where: str, vehicle: Vehicle) -> tuple[Term, ...]:
    """Return the terms of a strut or tyre, of an axle's, or of all wheels if `where` is empty."""
    if kind == "DLC":
        assembled(vehicle)
    tyres = set(vehicle.tyres)
    found = {
        str(response.where): name
        for name, response in vehicle.meanings.items()
        if response.kind == _KINDS[kind][0] and (where or response.where in tyres)
    }
    axle = {f"{where}_left", f"{where}_right"} & tyres
    chosen = {end: name for end, name in found.items() if where in ("", end) or end in axle}
    if not found:
        raise ValueError(f"{kind} must be of a vehicle that has it by name, got one without")
    if not chosen:
        known = ", ".join(filter(None, found)) or "all wheels"
        raise ValueError(f"{kind} must be of one of {known}, got {checks.shown(where)}")
    return tuple(Term(name, relative=kind == "DLC") for name in chosen.values())


def _accelerated(where: str, vehicle: Vehicle) -> ResponseName:
    if point := re.fullmatch(_POINT, where):
        return _at_point(*point.groups())
    name = f"{where or 'body'}_acceleration"
    known = vehicle.meanings.items()
    vertical = [r for r, m in known if m.kind == "acceleration" and m.where not in ("pitch", "roll")]
    if name not in vertical:
        places = ", ".join(r.removesuffix("_acceleration") for r in vertical)
        raise ValueError(f"ACC must be of one of {places} or a point (x, y), got {checks.shown(where)}")
    return name


def _at_point(*texts: str) -> ResponseName:
    x, y = map(float, texts)
    checks.within("x of a point", x, -_LARGEST, _LARGEST)
    checks.within("y of a point", y, -_LARGEST, _LARGEST)
    return ("acceleration", x, y)


def _term(text: str, vehicle: Vehicle) -> Term:
    found = re.fullmatch(rf"(?:({_NUMBER})\s+)?(?:(\S+)\s+)?(\w+|acceleration\s*{_POINT})", text)
    if not found:
        known = "ACC, SWS, DTL, DLC, or terms like '0.4 We pitch_acceleration'"
        raise ValueError(f"measure must be {known}, got {checks.shown(text)}")
    number, weighting, response, *point = found.groups()
    factor = float(number or 1)
    if not 0 < factor <= _LARGEST:
        raise ValueError(f"factor of a response must be above 0 and up to {_LARGEST:g}, got {factor:g}")
    if weighting is not None:
        weightings.by_name(weighting)
        if "acceleration" not in response:
            raise ValueError(f"weighting must be of an acceleration, got {weighting} of {response}")
    if None not in point:
        return Term(_at_point(*point), weighting, factor)
    checks.one_of("response", response, vehicle.meanings)
    return Term(response, weighting, factor)

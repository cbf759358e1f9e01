"""What is judged of a ride, by name: discomfort, suspension travel, tyre load, at any place of any vehicle.

A measure is written as

- ``ACC``, ``ACC driver``, ``ACC (1.2, -0.4)``: weighted acceleration of the body's centre of gravity, of a seat,
  or of a point (x, y) of the body;
- ``SWS``, ``SWS front``, ``SWS driver``: travel of the strut, or of the one with the most of several, of all
  wheels, an axle or a corner, or of a seat;
- ``DTL``, ``DTL rear_left``: load of the tyre, likewise; ``DLC``: over its static load on struts in the middle of
  their ranges (dynamic load coefficient);
- a root sum of squares of any responses, each with a factor and a weighting of ISO 2631 or none:
  ``Wk driver_acceleration + 0.63 We roll_acceleration + 0.4 We pitch_acceleration``, where 0.63 and 0.4 m/rad are
  the factors of ISO 2631-1, 8.2.2.1, for roll and pitch of a seated person;
- ``roll_gradient``, ``roll_damping``, ``front_load_transfer``: see `handling`; with ``-`` in front more is better.

``comfort = ...`` gives any of them a name of its own.
"""

import re
from dataclasses import dataclass

from .. import checks
from ..quantities import signal_unit
from ..vehicles.assembly import ResponseName, label
from ..vehicles.handling import check_cornering
from ..vehicles.vehicle import Vehicle, assembled
from . import weightings
from .weightings import Weighting

HANDLING = {"roll_gradient": "deg/g", "roll_damping": "-", "front_load_transfer": "-"}
"""Measures of handling and their units."""

_LARGEST = 1e6
"""Beyond any factor and any point of a body; squares of such times those of any response are still numbers."""

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_POINT = rf"\(\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\)"
_KINDS = {"SWS": "travel", "DTL": "load", "DLC": "load"}
_TURNED = ("pitch", "roll")
_UNITS = {"ACC": "m/s^2", "SWS": "m", "DTL": "N", "DLC": "-"}


@dataclass(frozen=True)
class Term:
    """A response, its weighting of ISO 2631 and its factor; over the static load of a tyre if `relative`."""

    response: ResponseName
    weighting: Weighting | None = None
    factor: float = 1.0
    relative: bool = False


@dataclass(frozen=True)
class Measure:
    """What a text means on a vehicle.

    Parameters
    ----------
    name, unit : str
    terms : tuple of Term
        None for a measure of handling, whose name is `handling`.
    worst : bool
        Whether the largest of the terms counts, or the root of the sum of their squares.
    sign : float
        -1 where more is better.
    handling : str
    """

    name: str
    unit: str
    terms: tuple[Term, ...] = ()
    worst: bool = False
    sign: float = 1.0
    handling: str = ""


def name_of(text: str) -> str:
    """Return the name of the measure that is written so: what stands before ``=``, or all of it."""
    name = " ".join(text.split("=", 1)[0].split()) if isinstance(text, str) else ""
    if not name:
        raise ValueError(f"measure must be a text such as 'SWS front' or 'name = SWS front', got {text!r}")
    return name


def measure(text: str, vehicle: Vehicle, weighting: Weighting | None) -> Measure:
    """Return what a text means on this vehicle, where ACC has this weighting; ValueError if it means nothing."""
    name = name_of(text)
    body = text.split("=", 1)[-1].strip()
    sign = -1.0 if body.startswith("-") else 1.0
    body = body.removeprefix("-").strip()
    if body in HANDLING or body.startswith("DLC"):
        assembled(vehicle)
    if body in HANDLING:
        check_cornering(body, assembled(vehicle).assembly)
        return Measure(name, HANDLING[body], sign=sign, handling=body)
    kind, _, where = body.partition(" ")
    if kind in _KINDS:
        terms = _at_corners(kind, where.strip(), vehicle)
        return Measure(name, _UNITS[kind], terms, True, sign)
    if kind == "ACC":
        return Measure(name, _UNITS[kind], (Term(_accelerated(where.strip(), vehicle), weighting),), False, sign)
    terms = tuple(_term(part.strip(), vehicle) for part in re.split(r"\+(?![^(]*\))", body))
    if len({signal_unit(label(term.response)).removeprefix("rad").removeprefix("m") for term in terms}) > 1:
        raise ValueError(f"measure must be a sum of responses of one kind, got {body!r}")
    return Measure(name, signal_unit(label(terms[0].response)), terms, False, sign)  # factors carry further units


def _at_corners(kind: str, where: str, vehicle: Vehicle) -> tuple[Term, ...]:
    """Terms of the strut or tyre called `where`, or of the axle's if it is one; of all wheels if it is empty."""
    tyres = set(vehicle.tyres)
    found = {
        str(response.where): name
        for name, response in vehicle.meanings.items()
        if response.kind == _KINDS[kind] and (where or response.where in tyres)
    }
    axle = {f"{where}_left", f"{where}_right"} & tyres
    chosen = {end: name for end, name in found.items() if where in ("", end) or end in axle}
    if not found:
        raise ValueError(f"{kind} must be of a vehicle that has it by name, got one without")
    if not chosen:
        raise ValueError(
            f"{kind} must be of one of {', '.join(filter(None, found)) or 'all wheels'}, got {where!r}"
        )
    return tuple(Term(name, relative=kind == "DLC") for name in chosen.values())


def _accelerated(where: str, vehicle: Vehicle) -> ResponseName:
    if point := re.fullmatch(_POINT, where):
        return _at_point(point[1], point[2])
    name = f"{where or 'body'}_acceleration"
    vertical = [
        known
        for known, response in vehicle.meanings.items()
        if response.kind == "acceleration" and response.where not in _TURNED
    ]
    if name not in vertical:
        known = [r.removesuffix("_acceleration") for r in vertical]
        raise ValueError(f"ACC must be of one of {', '.join(known)} or a point (x, y), got {where!r}")
    return name


def _at_point(*texts: str) -> ResponseName:
    x, y = map(float, texts)
    for name, value in (("x", x), ("y", y)):
        checks.within(f"{name} of a point", value, -_LARGEST, _LARGEST)
    return ("acceleration", x, y)


def _term(text: str, vehicle: Vehicle) -> Term:
    found = re.fullmatch(rf"(?:({_NUMBER})\s+)?(?:(\S+)\s+)?(\w+|acceleration\s*{_POINT})", text)
    if not found:
        raise ValueError(
            f"measure must be ACC, SWS, DTL, DLC, or terms like '0.4 We pitch_acceleration', got {text!r}"
        )
    weighting, response = found[2], found[3]
    factor = float(found[1] or 1)
    if not 0 < factor <= _LARGEST:
        raise ValueError(f"factor of a response must be above 0 and up to {_LARGEST:g}, got {found[1]}")
    if weighting is not None:
        weightings.by_name(weighting)
        if "acceleration" not in response:
            raise ValueError(f"weighting must be of an acceleration, got {weighting} of {response}")
    if found[4] is not None:
        return Term(_at_point(found[4], found[5]), weighting, factor)
    checks.one_of("response", response, vehicle.meanings)
    return Term(response, weighting, factor)

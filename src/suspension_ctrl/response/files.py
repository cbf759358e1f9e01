"""Ride problems in TOML files, see `schema`: measures, limits, bounds, and load cases with vehicles and roads.

``vehicle`` and ``road`` of a case are tables, as in their own files, or texts: what `load_vehicle` and `load_road`
take, paths as seen from the problem's file.
"""

import warnings
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from os import PathLike
from typing import Any, cast

from .. import checks
from ..documents import Mistakes, Table, document, keyed
from ..quantities import unit
from ..roads.files import KINDS as ROADS
from ..roads.files import load_road, read_road
from ..roads.spectra import Iso8608Road
from ..schema.keys import BAD, bad, keys_of
from ..schema.reading import read
from ..schema.writing import content, toml
from ..tables import write_text
from ..vehicles.files import (
    VehicleFile,
    check_units,
    coefficient_table,
    load_vehicle,
    mounted,
    numbered,
    read_coefficients,
    read_vehicle,
    vehicle_table,
)
from ..vehicles.handling import RollGeometry
from ..vehicles.mounted import Part, Payload, Seat
from ..vehicles.unit_slips import UnitSlipWarning, slip_of
from ..vehicles.vehicle import assembled, coefficients_by_name
from . import weightings
from .bands import BAND, OwnBand
from .event_files import IN_FILES
from .load_case import Drive, LoadCase
from .measures.limits import Limit
from .measures.measure import Measure
from .problem import RideProblem
from .scores import NODES


@dataclass(frozen=True, kw_only=True)
class CaseDocument:
    """A load case.

    Parameters
    ----------
    vehicle, road : str or table
        Path, or name in the package, of a vehicle; path, or class of ISO 8608, of a road; or a table as in a file.
    speed : float
        Vehicle speed [m/s].
    share : float
        How much of the time; cases count by their shares of the sum [-].
    payload : array of tables
        Loads fixed to the body.
    roll_geometry : table
        Heights for cornering; those of the vehicle's file if not given.
    """

    vehicle: str | Mapping[str, Any]
    road: str | Mapping[str, Any]
    speed: float = field(metadata=unit("m/s"))
    share: float = field(default=1.0, metadata=unit(""))
    payload: tuple[Payload, ...] = ()
    roll_geometry: RollGeometry | None = None


@dataclass(frozen=True, kw_only=True)
class Document:
    """Keys of a problem file.

    Parameters
    ----------
    title : str
        A line about the problem.
    measures, constraints : array of str
        Objectives, and limits on measures.
    weighting : str
        Weighting of ``ACC``.
    band : (float, float)
        Frequencies over which the spectra are integrated [Hz]; 0 to 20 Hz, of measured roads as far as known.
    worst_case : bool
        Whether an objective is the worst load case, in place of the mean square over them.
    nodes : int
        Quadrature nodes; found if not given.
    bounds : table
        Lowest and highest value of each coefficient that varies; those of the first case's vehicle if not given.
    kinds : table
        By the keys of ``bounds``: "integer", "log", "fixed" or an array of values.
    struts : table
        Coefficients that do not vary; those of the first case's vehicle if not given.
    seats : array of tables
        Seats that are put on the vehicle of every case.
    events : table
        Events of every case by name, for measures such as ``peak front_travel bump``.
    cases : array of tables
        The load cases.
    """

    title: str = ""
    measures: tuple[str, ...]
    constraints: tuple[str, ...] = ()
    weighting: str = "Wk"
    band: tuple[float, float] | None = field(default=None, metadata=unit("Hz"))
    worst_case: bool = False
    nodes: int | None = field(default=None, metadata=unit("", 2, NODES[-1]))
    bounds: Mapping[str, Any] = field(default_factory=dict)
    kinds: Mapping[str, Any] = field(default_factory=dict)
    struts: Mapping[str, Any] = field(default_factory=dict)
    seats: tuple[Seat, ...] = field(default=(), metadata={"most": 50})
    events: Mapping[str, Drive] = field(default_factory=dict, metadata=IN_FILES)
    cases: tuple[CaseDocument, ...]


def load_problem(path: str | PathLike[str], *, allow_outside: bool = False) -> RideProblem:
    """Return the problem of a TOML file, `allow_outside` as in `load_road`.

    Raises
    ------
    ValueError
        That lists the mistakes of the file, each with file, line, key and value.
    OSError
        If it, or a file that it names, cannot be read.

    Examples
    --------
    The bounds are those of the vehicle's file where the problem has none:

    >>> from pathlib import Path
    >>> import suspension_ctrl as sc
    >>> text = '''
    ... measures = ["ACC", "DTL"]
    ... constraints = ["SWS <= 0.03"]
    ...
    ... [[cases]]
    ... vehicle = "yuen_ramli_2010"
    ... road = "C"
    ... speed_m_per_s = 20.0
    ... '''
    >>> _ = Path("comfort.toml").write_text(text)
    >>> problem = sc.load_problem("comfort.toml")
    >>> dict(problem.bounds)
    {'spring': (1000.0, 30000.0), 'damper': (1000.0, 5000.0)}
    """
    with document(checks.path_of("path", path), allow_outside) as table:
        return _problem(table)


def save_problem(path: str | PathLike[str], problem: RideProblem) -> None:
    """Write a file that `load_problem` reads as `problem`, vehicles and roads in it; ValueError if it cannot.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file, road = sc.load_vehicle("yuen_ramli_2010"), sc.load_road("C")
    >>> problem = sc.RideProblem(file.vehicle, road, speed=20.0, bounds=file.bounds)
    >>> sc.save_problem("problem.toml", problem)
    >>> sc.load_problem("problem.toml") == problem
    True
    """
    if not isinstance(problem, RideProblem):
        raise ValueError(f"problem must be a RideProblem, got {checks.shown(problem)}")
    if any(case.events != problem.cases[0].events for case in problem.cases):
        raise ValueError("events must be the same in all load cases of a file, got others")
    vehicle, bounds, weighting = problem.cases[0].vehicle, problem.bounds, cast(str, problem.weighting)
    order = [name for name in vehicle.variables if name in bounds]
    if list(bounds) != order:
        raise ValueError(f"bounds must be in the vehicle's order, {', '.join(order)}, got {', '.join(bounds)}")
    problem = problem.replace(struts=coefficients_by_name(problem.struts, {}))
    file = Document(
        measures=tuple(map(str, problem.measures)),
        constraints=tuple(map(str, problem.constraints)),
        weighting=weighting,
        band=None if isinstance(problem.band, OwnBand) else problem.band,
        worst_case=problem.worst_case,
        nodes=problem.nodes if type(problem.nodes) is int else None,  # those that were found are of a subclass
        bounds=coefficient_table(vehicle, bounds),
        kinds=coefficient_table(vehicle, problem.kinds),
        struts=coefficient_table(vehicle, problem.struts),
        events=dict(problem.events),
        cases=tuple(map(_case_document, problem.cases)),
    )
    write_text(checks.path_of("path", path), toml(content(file), problem, _problem))


def _case_document(case: LoadCase) -> CaseDocument:
    vehicle = assembled(case.vehicle)
    return CaseDocument(
        vehicle=vehicle_table(VehicleFile(vehicle=vehicle, unusual=slip_of(vehicle) is not None)),
        road=content(case.road, ROADS),
        speed=case.speed,
        share=case.share,
        roll_geometry=case.roll_geometry,
    )


def _problem(table: Table) -> RideProblem:
    mistakes = Mistakes()
    values = read(table, keys_of(Document), mistakes)
    if values["cases"] == ():
        mistakes.note("cases must be an array of tables, one at least, got none")
    if not values["cases"] or BAD in (values["cases"], values.get("seats")):
        mistakes.settle()
    seats, documents = numbered("seats", values), enumerate(values["cases"], start=1)
    given = [_case(one, table.inner(f"cases[{i}]", {}), seats, mistakes) for i, one in documents]
    apart, events = ("title", "seats", "cases", "events"), values.get("events", {})
    values = {name: value for name, value in values.items() if name not in apart and not bad(value)}
    cases = [replace(case, events={} if bad(events) else events) for _, case in filter(None, given) if case]
    _check(values, cases, mistakes)
    if given[0]:
        values |= _coefficients(values, *given[0], mistakes)
    mistakes.settle()
    with keyed("", {"band": "band_Hz", "f": "band_Hz"}):  # f of a road that is not known there
        return _usual(cases, values, any(one[0].unusual for one in given if one))


def _usual(cases: Sequence[LoadCase], values: Mapping[str, Any], unusual: bool) -> RideProblem:
    """Return the problem; ValueError about a likely slip of units, unless a vehicle may be unusual."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore" if unusual else "error", UnitSlipWarning)
        try:
            return RideProblem(cases=cases, **values)
        except UnitSlipWarning as slip:
            raise ValueError(str(slip)) from None


def _case(
    one: CaseDocument, table: Table, seats: Mapping[str, Part], mistakes: Mistakes
) -> tuple[VehicleFile, LoadCase | None] | None:
    """Return the vehicle of a case, None if it cannot be read, and the case, None if a part does not fit."""
    if bad(one):
        return None
    file = _vehicle(one.vehicle, table, mistakes)
    vehicle = BAD if bad(file) else mounted(file.vehicle, seats, "", mistakes)
    vehicle = mounted(vehicle, numbered("payload", vars(one)), table.name, mistakes)
    road = _road(one.road, table, mistakes)
    if bad(vehicle):
        return None if bad(file) else (file, None)
    geometry = one.roll_geometry or file.roll_geometry
    return file, LoadCase(vehicle=vehicle, road=road, speed=one.speed, share=one.share, roll_geometry=geometry)


def _vehicle(given: str | Mapping[str, Any], table: Table, mistakes: Mistakes) -> VehicleFile:
    """Return the vehicle of the case in a table, `BAD` if there is none."""
    if isinstance(given, str):
        with mistakes.noted(f"{table.name}vehicle: "):
            return load_vehicle(table.folder.named(given), allow_outside=table.folder.allow_outside)
        return BAD
    file = read_vehicle(table.inner("vehicle", given), mistakes)
    if not bad(file):
        with mistakes.noted(f"{table.name}vehicle: "):
            check_units(file)
    return file


def _road(given: str | Mapping[str, Any], table: Table, mistakes: Mistakes) -> Any:
    """Return the road of the case in a table; for a wrong one class C, so that measures are checked as well."""
    with mistakes.noted(f"{table.name}road: " if isinstance(given, str) else ""):
        if isinstance(given, str):
            return load_road(table.folder.named(given), allow_outside=table.folder.allow_outside)
        return read_road(table.inner("road", given))
    return Iso8608Road("C")


def _check(values: Mapping[str, Any], cases: Sequence[LoadCase], mistakes: Mistakes) -> None:
    """Note mistakes in band, weighting, measures and limits."""
    with mistakes.noted():
        checks.interval("band_Hz", values.get("band", BAND), "Hz")
    weighting, measures = values.get("weighting", "Wk"), list[Measure]()
    with mistakes.noted():
        weightings.checked(weighting)
        for name in ("measures", "constraints"):
            for i, text in enumerate(values.get(name, ()), start=1):
                with mistakes.noted(f"{name}[{i}]: "):
                    judged = Limit.parse(text, measures) if name == "constraints" else Measure.parse(text)
                    measures += [judged] if isinstance(judged, Measure) else []
                    for case in cases:
                        judged.in_case(case, weighting)


def _coefficients(
    values: Mapping[str, Any], file: VehicleFile, case: LoadCase | None, mistakes: Mistakes
) -> dict[str, Any]:
    """Return bounds, kinds and struts by coefficient; without tables those of the vehicle's file."""

    def table(name: str, form: Any, given: Collection[str] = ()) -> dict[str, Any]:
        vehicle = case.vehicle if case else file.vehicle
        inner = Table(f"{name}.", values[name])
        return read_coefficients(inner, vehicle, form, mistakes, given, others=case is None)

    bounds = table("bounds", tuple[float, float]) if "bounds" in values else dict(file.bounds)
    if not bounds:
        needed = "given, one at least, where the first case's vehicle has none"
        mistakes.note(f"bounds must be {needed}, got none")
    struts = table("struts", float, bounds) if "struts" in values else file.setting
    return {
        "bounds": bounds,
        "kinds": table("kinds", str | tuple[float, ...]) if "kinds" in values else {},
        "struts": {name: value for name, value in struts.items() if name not in bounds},
    }

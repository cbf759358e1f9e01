"""Load cases in problem files: a case takes vehicle, road and speed from the top of the file where it has none.

``vehicle`` and ``road`` are tables, as in their own files, or texts: what `load_vehicle` and `load_road` take,
paths as seen from the problem's file.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from ..documents import Mistakes, Table
from ..quantities import unit
from ..roads.files import load_road, read_road
from ..roads.spectra import Iso8608Road
from ..schema.keys import BAD, bad
from ..vehicles.files import VehicleFile, check_units, load_vehicle, mounted, numbered, read_vehicle
from ..vehicles.handling import RollGeometry
from ..vehicles.mounted import Part, Payload
from .load_case import LoadCase

_TOP = "as at the top of the file"
FROM_TOP: Mapping[str, Any] = {"vehicle": _TOP, "road": _TOP, "speed_m_per_s": 1.0}
"""Keys of a case that the top of a file may give for all, with values that stand for it."""


@dataclass(frozen=True, kw_only=True)
class CaseDocument:
    """A load case.

    Parameters
    ----------
    vehicle, road : str or table
        Path, or name in the package, of a vehicle; path, or class of ISO 8608, of a road; or a table as in a file.
        Those at the top of the file if not given.
    speed : float
        Vehicle speed; that at the top of the file if not given [m/s].
    share : float
        How much of the time; cases count by their shares of the sum [-].
    payload : array of tables
        Loads fixed to the body; those at the top of the file if not given.
    roll_geometry : table
        Heights for cornering; those at the top or of the vehicle's file if not given.
    """

    vehicle: str | Mapping[str, Any]
    road: str | Mapping[str, Any]
    speed: float = field(metadata=unit("m/s"))
    share: float = field(default=1.0, metadata=unit(""))
    payload: tuple[Payload, ...] = ()
    roll_geometry: RollGeometry | None = None


class Case(NamedTuple):
    """A load case of a file, None if a part does not fit, and its vehicle's file."""

    file: VehicleFile
    case: LoadCase | None


class _Top(NamedTuple):
    """Values at the top of a file for cases without their own, `BAD` after a mistake."""

    file: VehicleFile
    road: Any
    speed: float
    payload: Mapping[str, Part]
    roll_geometry: RollGeometry | None


def given_at(table: Mapping[str, Any], key: str) -> bool:
    """Whether a table has a key of `FROM_TOP`, or the same with a unit in its value."""
    return key in table or (key == "speed_m_per_s" and "speed" in table)


def filled(table: Table) -> Table:
    """Return the table of a file with stand-ins in its cases for what the top gives."""
    cases, content = table.content.get("cases"), table.content
    if not isinstance(cases, list):
        return table
    shared = {key: value for key, value in FROM_TOP.items() if given_at(content, key)}
    complete = [
        {**{key: value for key, value in shared.items() if not given_at(case, key)}, **case}
        if isinstance(case, dict)
        else case
        for case in cases
    ]
    return table._replace(content={**content, "cases": complete})


def read_cases(table: Table, values: Mapping[str, Any], mistakes: Mistakes) -> list[Case | None]:
    """Return the cases of a file with these values, None for one that cannot be read; one case without any."""
    seats, top = numbered("seats", values), _top(table, values, mistakes)
    if "cases" not in table.content:
        return [_case(CaseDocument(vehicle=_TOP, road=_TOP, speed=1.0), Table("", {}), top, seats, mistakes)]
    pairs = zip(values["cases"], table.content["cases"], strict=True)
    return [
        _case(one, table.inner(f"cases[{i}]", own), top, seats, mistakes) if isinstance(own, dict) else None
        for i, (one, own) in enumerate(pairs, start=1)
    ]


def _top(table: Table, values: Mapping[str, Any], mistakes: Mistakes) -> _Top:
    vehicle, road = values.get("vehicle", BAD), values.get("road", BAD)
    geometry = values.get("roll_geometry")
    return _Top(
        file=BAD if bad(vehicle) else _vehicle(vehicle, table, mistakes),
        road=Iso8608Road("C") if bad(road) else _road(road, table, mistakes),
        speed=values.get("speed", 1.0),
        payload=numbered("payload", values),
        roll_geometry=None if bad(geometry) else geometry,
    )


def _case(
    one: CaseDocument, table: Table, top: _Top, seats: Mapping[str, Part], mistakes: Mistakes
) -> Case | None:
    """Return a case, by the table that its file has for it."""
    if bad(one):
        return None
    own = {key for key in FROM_TOP if given_at(table.content, key)}
    file = _vehicle(one.vehicle, table, mistakes) if "vehicle" in own else top.file
    vehicle = BAD if bad(file) else mounted(file.vehicle, seats, "", mistakes)
    payload = numbered("payload", vars(one)) or top.payload
    vehicle = mounted(vehicle, payload, table.name if one.payload else "", mistakes)
    road = _road(one.road, table, mistakes) if "road" in own else top.road
    if bad(vehicle):
        return None if bad(file) else Case(file, None)
    speed = one.speed if "speed_m_per_s" in own else top.speed
    geometry = one.roll_geometry or top.roll_geometry or file.roll_geometry
    case = LoadCase(vehicle=vehicle, road=road, speed=speed, share=one.share, roll_geometry=geometry)
    return Case(file, case)


def _vehicle(given: str | Mapping[str, Any], table: Table, mistakes: Mistakes) -> VehicleFile:
    """Return the vehicle in a table, `BAD` if there is none."""
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
    """Return the road in a table; for a wrong one class C, so that measures are checked as well."""
    with mistakes.noted(f"{table.name}road: " if isinstance(given, str) else ""):
        if isinstance(given, str):
            return load_road(table.folder.named(given), allow_outside=table.folder.allow_outside)
        return read_road(table.inner("road", given))
    return Iso8608Road("C")

"""Vehicles from TOML files: masses and lengths, struts and their bounds, seats, bending, roll geometry.

``kind`` is ``quarter-car``, ``half-car`` or ``full-car``; ``name`` and ``source`` are texts. The other keys are
parameters of `QuarterCar`, `HalfCar` or `FullCar` with their units (see `toml_tables`), and the tables

- ``[flexible_body]``: frequencies_Hz, damping_ratios, and ``[[flexible_body.shapes]]`` of position_m and
  shape_per_sqrt_kg;
- ``[[seats]]``: mass_kg, spring_N_per_m, damper_N_s_per_m, and if wanted position_m and name;
- ``[struts]``: the coefficients, of a quarter car spring_N_per_m and damper_N_s_per_m, of others by strut in
  ``[struts.front]`` and so on, and beside those anti-roll bars, front_antiroll_N_m_per_rad;
- ``[bounds]``: likewise, the lowest and the highest value of those that are to vary;
- ``[roll_geometry]``: the parameters of `RollGeometry`.

Only ``[struts]`` has to be there. Files that come with the package are known by their names alone.
"""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any

from .. import checks, datafiles
from ..documents import Table, keyed, naming, read_toml
from ..quantities import key_of, unit_of
from .assembly import Position
from .cars import FullCar, HalfCar, QuarterCar
from .handling import RollGeometry
from .mounted import FlexibleBody, Seat
from .vehicle import Vehicle

_KINDS = {"quarter-car": QuarterCar, "half-car": HalfCar, "full-car": FullCar}
_TEXTS = ("kind", "name", "source")
_TABLES = ("flexible_body", "seats", "struts", "bounds", "roll_geometry")
_SEAT = {"mass_kg": "mass", "spring_N_per_m": "spring", "damper_N_s_per_m": "damper"}
_SEAT_WANTED = {"position_m": "position", "name": "name"}
_BENDING = {"frequencies_Hz": "frequencies", "damping_ratios": "damping_ratios", "shapes": "shapes"}
_SHAPE = {"position_m": "position", "shape_per_sqrt_kg": "shape"}


@dataclass(frozen=True, kw_only=True)
class VehicleFile:
    """What a file says.

    Parameters
    ----------
    name, source : str
        What it is called and where its numbers are from.
    vehicle : Vehicle
        With its seats and its elastic modes.
    struts : mapping of str to float
        Coefficients of the struts by name.
    bounds : mapping of str to (float, float)
        By name, the bounds of those that are to vary; empty if the file has none.
    roll_geometry : RollGeometry or None
        If the file has one.
    """

    name: str
    source: str
    vehicle: Vehicle
    struts: Mapping[str, float]
    bounds: Mapping[str, tuple[float, float]]
    roll_geometry: RollGeometry | None


def load_vehicle(text: str) -> VehicleFile:
    """Return the vehicle that a text names.

    Parameters
    ----------
    text : str
        The path of a TOML file (see `vehicle_files`), or the name of one that comes with the package,
        ``"yuen_ramli_2010"``.

    Returns
    -------
    VehicleFile
        What the file says.

    Raises
    ------
    ValueError
        If it is neither, or naming the file and the key if the file does not hold a vehicle.
    OSError
        If the file cannot be read.
    """
    path = Path(text)
    if path.suffix != ".toml":
        known = datafiles.stems("vehicles")
        if text not in known:
            raise ValueError(
                f"vehicle must be one of {', '.join(known)} or the path of a .toml file, got {text!r}"
            )
        path = datafiles.path(f"vehicles/{text}.toml")
    with naming(path):
        return _read(read_toml(path))


def _read(table: Table) -> VehicleFile:
    checks.one_of("kind", table.content.get("kind"), tuple(_KINDS))
    texts = [table.text(name) for name in _TEXTS]
    vehicle = _vehicle(table, _KINDS[texts[0]])
    struts = read_struts(table.table("struts").flat(), vehicle)
    bounds = read_bounds(table.table("bounds").flat(), vehicle)
    geometry = read_roll_geometry(table)
    return VehicleFile(
        name=texts[1], source=texts[2], vehicle=vehicle, struts=struts, bounds=bounds, roll_geometry=geometry
    )


def _vehicle(table: Table, kind: type[Any]) -> Vehicle:
    """Return the vehicle with what is on it."""
    vehicle: Vehicle = _made(table, kind, beside=(*_TEXTS, *_TABLES))
    if "flexible_body" in table.content:
        body = table.table("flexible_body")
        with keyed(body.name, _BENDING | {"shapes.position_m": "position"}):
            vehicle = _flexible_body(body).on(vehicle)
    return with_seats(vehicle, table)


def with_seats(vehicle: Vehicle, table: Table) -> Vehicle:
    """Return the vehicle with the seats of the array ``seats`` in a table."""
    for seat in table.tables("seats"):
        with keyed(seat.name, _SEAT | _SEAT_WANTED):
            vehicle = _seat(seat).on(vehicle)
    return vehicle


def _made(table: Table, kind: type[Any], beside: tuple[str, ...] = ()) -> Any:
    """Make a dataclass of numbers from a table that may have further keys `beside` its own."""
    keys = {key_of(field.name, unit_of(field.name)): field.name for field in fields(kind)}
    optional = [field.name for field in fields(kind) if field.default is not MISSING]
    table.check_keys(
        keys | dict(zip(beside, beside, strict=True)), [key for key in keys if keys[key] not in optional]
    )
    with keyed(table.name, keys):
        return kind(**{name: table.number(key) for key, name in keys.items() if key in table.content})


def read_roll_geometry(table: Table) -> RollGeometry | None:
    """Return what the table ``roll_geometry`` in a table says, None if there is none."""
    if "roll_geometry" not in table.content:
        return None
    geometry: RollGeometry = _made(table.table("roll_geometry"), RollGeometry)
    return geometry


def _flexible_body(table: Table) -> FlexibleBody:
    table.check_keys(_BENDING, _BENDING)
    shapes: dict[Position, tuple[float, ...]] = {}
    for point in table.tables("shapes"):
        point.check_keys(_SHAPE, _SHAPE)
        position = point.pair("position_m")
        if position in shapes:
            raise ValueError(f"{point.name}position_m must be that of no other shape, got {position}")
        shapes[position] = point.numbers("shape_per_sqrt_kg")
    if not shapes:
        raise ValueError(f"{table.name}shapes must be an array of tables, one at least, got none")
    return FlexibleBody(
        frequencies=table.numbers("frequencies_Hz"), damping_ratios=table.numbers("damping_ratios"), shapes=shapes
    )


def _seat(table: Table) -> Seat:
    table.check_keys(_SEAT | _SEAT_WANTED, _SEAT)
    values: dict[str, Any] = {name: table.number(key) for key, name in _SEAT.items()}
    if "position_m" in table.content:
        values["position"] = table.pair("position_m")
    if "name" in table.content:
        values["name"] = table.text("name")
    return Seat(**values)


def _coefficients(vehicle: Vehicle) -> dict[str, str]:
    """Return the names of a vehicle's coefficients by their keys."""
    return {key_of(parameter.name, parameter.unit): parameter.name for parameter in vehicle.parameters}


def read_struts(table: Table, vehicle: Vehicle) -> dict[str, float]:
    """Return the coefficients of a flat table by name; all must be there but those that have defaults."""
    coefficients = _coefficients(vehicle)
    default = {parameter.name: parameter.default for parameter in vehicle.parameters}
    table.check_keys(coefficients, [key for key, name in coefficients.items() if default[name] is None])
    struts = {name: table.number(key) for key, name in coefficients.items() if key in table.content}
    with keyed(table.name, coefficients):
        vehicle.coefficients(struts)
    return struts


def read_bounds(table: Table, vehicle: Vehicle) -> dict[str, tuple[float, float]]:
    """Return the bounds in a flat table of coefficients by name, in the vehicle's order."""
    table.check_keys(_coefficients(vehicle))
    bounds = {}
    for parameter in vehicle.parameters:
        key = key_of(parameter.name, parameter.unit)
        if key in table.content:
            bounds[parameter.name] = table.pair(key)
            checks.interval(table.name + key, bounds[parameter.name], parameter.unit)
            check = checks.not_negative if parameter.default == 0 else checks.positive
            check(table.name + key, bounds[parameter.name][0], parameter.unit)
    return bounds

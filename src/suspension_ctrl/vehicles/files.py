"""Vehicles from TOML files: masses and lengths, struts and their bounds, seats, bending, roll geometry.

``kind`` is ``quarter-car``, ``half-car`` or ``full-car``; ``name`` and ``source`` are texts. The other keys are
parameters of `QuarterCar`, `HalfCar` or `FullCar` with their units (see `documents`), and the tables

- ``[struts]``, required: the coefficients, of a quarter car spring_N_per_m and damper_N_s_per_m, of others by
  strut in ``[struts.front]`` and so on, and beside those anti-roll bars, front_antiroll_N_m_per_rad;
- ``[bounds]``: likewise, the lowest and the highest value of the coefficients that vary;
- ``[[seats]]`` and ``[roll_geometry]``: the parameters of `Seat` and `RollGeometry`;
- ``[flexible_body]``: frequencies_Hz, damping_ratios, and ``[[flexible_body.shapes]]`` of position_m and
  shape_per_sqrt_kg.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike

from .. import checks, datafiles
from ..documents import Table, keyed, made, naming, read_toml
from ..quantities import FrozenMapping, Record, key_of
from .assembly import Position, StrutParameter
from .cars import FullCar, HalfCar, QuarterCar
from .handling import RollGeometry
from .mounted import FlexibleBody, Seat
from .vehicle import AssembledVehicle, Vehicle

_KINDS: dict[str, type[AssembledVehicle]] = {"quarter-car": QuarterCar, "half-car": HalfCar, "full-car": FullCar}
_TABLES = ("flexible_body", "seats", "struts", "bounds", "roll_geometry")
_SHAPE = {"position_m": "position", "shape_per_sqrt_kg": "shape"}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class VehicleFile(Record):
    """The content of a vehicle file; coefficients and bounds in the units of the struts' parameters."""

    name: str
    source: str  # origin of the numbers
    vehicle: AssembledVehicle  # with its seats and its elastic modes
    setting: Mapping[str, float]  # coefficients of the struts by name
    bounds: Mapping[str, tuple[float, float]]  # of the coefficients that vary, by name
    roll_geometry: RollGeometry | None = None

    def __post_init__(self) -> None:
        self._keep(setting=FrozenMapping(self.setting), bounds=FrozenMapping(self.bounds))


def load_vehicle(source: str | PathLike[str]) -> VehicleFile:
    """Return the vehicle of a file.

    Parameters
    ----------
    source : str or path-like
        The path of a TOML file, or the name of one that comes with the package, ``"yuen_ramli_2010"``.

    Raises
    ------
    ValueError
        If it is neither, or about a key of the file; OSError if it cannot be read.

    Examples
    --------
    A vehicle, the setting of its struts and the bounds of a search:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> file.setting["front.damper"], file.bounds["front.damper"]  # N s/m
    (2000.0, (1000.0, 4000.0))
    >>> file.vehicle.modes(file.setting)["name"].to_list()
    ['heave', 'roll', 'pitch', 'rear wheel hop', 'rear wheel tramp', 'front wheel hop', 'front wheel tramp']
    """
    path = datafiles.named("vehicle", "vehicles", source)
    with naming(path):
        return _read(read_toml(path))


def _read(table: Table) -> VehicleFile:
    kind, name, source = table.choice("kind", _KINDS), table.text("name"), table.text("source")
    vehicle = made(table, kind, beside=("kind", "name", "source", *_TABLES))
    if "flexible_body" in table.content:
        body = table.table("flexible_body")
        with keyed(body.name, {"shapes.position_m": "position", "shapes": "shapes"}):
            vehicle = made(body, FlexibleBody, beside=["shapes"], shapes=_shapes(body)).on(vehicle)
    vehicle = with_seats(vehicle, table)
    return VehicleFile(
        name=name,
        source=source,
        vehicle=vehicle,
        setting=read_setting(table.table("struts").flat(), vehicle),
        bounds=read_bounds(table.table("bounds").flat(), vehicle),
        roll_geometry=read_roll_geometry(table),
    )


def with_seats(vehicle: AssembledVehicle, table: Table) -> AssembledVehicle:
    """Return the vehicle with the seats of the array ``seats`` in a table."""
    for seat in table.tables("seats", most=50):
        with keyed(seat.name, {"name": "name", "position_m": "position"}):
            vehicle = made(seat, Seat).on(vehicle)
    return vehicle


def read_roll_geometry(table: Table) -> RollGeometry | None:
    """Return the roll geometry in a table, None if there is none."""
    return made(table.table("roll_geometry"), RollGeometry) if "roll_geometry" in table.content else None


def _shapes(body: Table) -> dict[Position, tuple[float, ...]]:
    shapes: dict[Position, tuple[float, ...]] = {}
    for point in body.tables("shapes", most=1000):
        point.check_keys(_SHAPE, _SHAPE)
        position = point.pair("position_m")
        if position in shapes:
            raise ValueError(f"{point.name}position_m must be that of no other shape, got {position}")
        shapes[position] = point.numbers("shape_per_sqrt_kg")
    if not shapes:
        raise ValueError(f"{body.name}shapes must be an array of tables, one at least, got none")
    return shapes


def _by_key(vehicle: Vehicle) -> dict[str, StrutParameter]:
    return {key_of(parameter.name, parameter.unit): parameter for parameter in vehicle.parameters}


def read_setting(table: Table, vehicle: Vehicle) -> dict[str, float]:
    """Return the coefficients of a flat table by name; required are those without defaults."""
    known = _by_key(vehicle)
    names = {key: parameter.name for key, parameter in known.items()}
    table.check_keys(names, [key for key, parameter in known.items() if parameter.default is None])
    setting = {name: table.number(key) for key, name in names.items() if key in table.content}
    with keyed(table.name, names):
        vehicle.coefficients(setting)
    return setting


def read_bounds(table: Table, vehicle: Vehicle) -> dict[str, tuple[float, float]]:
    """Return the bounds in a flat table of coefficients by name, in the vehicle's order."""
    known = _by_key(vehicle)
    table.check_keys({key: parameter.name for key, parameter in known.items()})
    bounds = {key: table.pair(key) for key in known if key in table.content}
    for key, pair in bounds.items():
        checks.interval(table.name + key, pair, known[key].unit, equal=True)
        known[key].check(table.name + key, pair[0])
    return {known[key].name: pair for key, pair in bounds.items()}


def read_kinds(table: Table, vehicle: Vehicle) -> dict[str, str | tuple[float, ...]]:
    """Return the kinds in a flat table of coefficients by name: texts, or arrays of a catalogue's values."""
    known = _by_key(vehicle)
    table.check_keys({key: parameter.name for key, parameter in known.items()})
    texts = {key for key, value in table.content.items() if isinstance(value, str)}
    return {known[key].name: table.text(key) if key in texts else table.numbers(key) for key in table.content}

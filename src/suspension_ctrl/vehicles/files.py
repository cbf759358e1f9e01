"""Vehicles in TOML files, see `schema`: parameters of a car, seats and bending, struts, bounds, roll geometry.

In ``[struts]`` and ``[bounds]`` a coefficient ``front.spring`` has the key ``front.spring_N_per_m``.
"""

from collections.abc import Collection, Mapping
from contextlib import suppress
from dataclasses import MISSING, dataclass, field, fields
from functools import reduce
from os import PathLike
from typing import Any

from .. import checks, datafiles
from ..documents import Mistakes, Table, document
from ..quantities import FrozenMapping, Record, key_of
from ..schema.keys import BAD, KIND, Key, bad, keys_of
from ..schema.reading import constructed, fields_named, kind_of, read
from ..schema.writing import content, toml
from ..tables import write_text
from .cars import FullCar, HalfCar, QuarterCar
from .frequencies import Derived
from .handling import RollGeometry
from .mounted import FlexibleBody, Mounted, Part, Payload, Seat
from .parameters import Place
from .plant_files import PlantFile, read_plant
from .rigid_bodies import RigidBodies
from .strut_files import UNREAD
from .unit_slips import slip_of
from .vehicle import AssembledVehicle, Vehicle

KINDS: dict[str, type[AssembledVehicle] | type[PlantFile]] = {
    "quarter-car": QuarterCar, "half-car": HalfCar, "full-car": FullCar, "plant": PlantFile,
    "rigid-bodies": RigidBodies,
}  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class VehicleFile(Record):
    """The content of a vehicle file.

    Parameters
    ----------
    vehicle : Vehicle
        With its seats and its elastic modes.
    setting : mapping of str to float, optional
        Coefficients of the struts by name.
    bounds : mapping of str to (float, float), optional
        Bounds of the coefficients that a search varies.
    roll_geometry : RollGeometry, optional
    name, source : str, optional
        Name of the vehicle, and origin of its numbers.
    unusual : bool
        Whether its frequencies and ratios may be those of no usual vehicle: units are not judged by them.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=400, wheel_mass=40, tyre_stiffness=200e3)
    >>> sc.VehicleFile(vehicle=car, bounds={"spring": (10e3, 40e3), "damper": (500, 4000)}).bounds["damper"]
    (500, 4000)
    """

    vehicle: Vehicle
    setting: Mapping[str, float] = FrozenMapping({})
    bounds: Mapping[str, tuple[float, float]] = FrozenMapping({})
    roll_geometry: RollGeometry | None = None
    name: str = ""
    source: str = ""
    unusual: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.vehicle, Vehicle):
            raise ValueError(f"vehicle must be a Vehicle, got {checks.shown(self.vehicle)}")
        for name in ("setting", "bounds"):
            checks.mapped(name, getattr(self, name))
        self._keep(setting=FrozenMapping(self.setting), bounds=FrozenMapping(self.bounds))


@dataclass(frozen=True, kw_only=True)
class Document:
    """Keys of a vehicle beside the parameters of the car.

    Parameters
    ----------
    name, source : str
        Name of the vehicle, and origin of its numbers.
    flexible_body, seats, payload, roll_geometry : table, array of tables, array of tables, table
        Elastic modes of the body, seats with their occupants, loads on the body, and heights for cornering.
    struts, bounds : table
        Coefficients of the struts; lowest and highest value of those that a search varies.
    unusual : bool
        Whether frequencies and ratios may be those of no usual vehicle: units are not judged by them.
    """

    name: str = ""
    source: str = ""
    unusual: bool = False
    flexible_body: FlexibleBody | None = None
    seats: tuple[Seat, ...] = field(default=(), metadata={"most": 50})
    payload: tuple[Payload, ...] = ()
    struts: Mapping[str, Any] = field(default_factory=dict)
    bounds: Mapping[str, Any] = field(default_factory=dict)
    roll_geometry: RollGeometry | None = None


def load_vehicle(source: str | PathLike[str], *, allow_outside: bool = False) -> VehicleFile:
    """Return the vehicle of a file.

    Parameters
    ----------
    source : str or path-like
        The path of a TOML file, or the name of one that comes with the package, ``"yuen_ramli_2010"``.
    allow_outside : bool
        Whether the file may name files of elements that are neither beside it nor below, links resolved.

    Raises
    ------
    ValueError
        If it is neither, or about the keys of the file, a line each, or if frequencies and ratios of the vehicle
        show a number in another unit; OSError if it cannot be read.

    Examples
    --------
    A vehicle, the setting of its struts and the bounds of a search:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> file.setting["front.damper"], file.bounds["front.damper"]  # N s/m
    (2000.0, (1000.0, 4000.0))
    >>> file.vehicle.modes(file.setting)["name"].to_list()
    ['heave', 'roll', 'pitch', 'rear wheel tramp', 'rear wheel hop', 'front wheel hop', 'front wheel tramp']
    """
    with document(datafiles.named("vehicle", "vehicles", source), allow_outside) as table:
        mistakes = Mistakes()
        file = read_vehicle(table, mistakes)
        mistakes.settle()
        check_units(file)
        return file


def check_units(file: VehicleFile) -> None:
    """Raise ValueError if a number of a vehicle that is not unusual seems to be in another unit."""
    if not file.unusual:
        middles = {name: (low + high) / 2 for name, (low, high) in file.bounds.items()}
        for values in (file.setting, middles):
            vehicle, given = file.vehicle, None
            with suppress(ValueError):  # of values that are not complete
                vehicle, given = file.vehicle.at(values)
            if line := slip_of(vehicle, given):
                raise ValueError(f"{line}; unusual = true allows it")


def save_vehicle(path: str | PathLike[str], file: VehicleFile) -> None:
    """Write a file that `load_vehicle` reads as `file`; ValueError if a file cannot hold it.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=400, wheel_mass=40, tyre_stiffness=200e3)
    >>> sc.save_vehicle("mine.toml", sc.VehicleFile(vehicle=car, setting={"spring": 20e3, "damper": 1500}))
    >>> from pathlib import Path
    >>> print(Path("mine.toml").read_text())
    kind = "quarter-car"
    body_mass_kg = 400
    wheel_mass_kg = 40
    tyre_stiffness_N_per_m = 200000.0
    <BLANKLINE>
    [struts]
    spring_N_per_m = 20000.0
    damper_N_s_per_m = 1500
    <BLANKLINE>
    """
    if not isinstance(file, VehicleFile):
        raise ValueError(f"file must be a VehicleFile, got {checks.shown(file)}")
    text = toml(vehicle_table(file), file, lambda table: read_vehicle(table, Mistakes()))
    write_text(checks.path_of("path", path), text)


def read_vehicle(table: Table, mistakes: Mistakes) -> VehicleFile:
    """Return the vehicle in a table, `BAD` if it cannot be made."""
    before, kind = len(mistakes), kind_of(KINDS, table, mistakes)
    if bad(kind):
        return BAD
    values = read(table, {**KIND, **keys_of(kind), **keys_of(Document)}, mistakes)
    sound = len(mistakes) == before  # else numbers that stand in cause further errors
    unread = {one.name: UNREAD for one in keys_of(kind).values() if one.own and bad(values.get(one.name))}
    made = constructed(kind, values | unread, table.name, mistakes if sound else Mistakes())
    car = _plant(made, table, mistakes) if isinstance(made, PlantFile) else made
    parts = {"flexible_body": values["flexible_body"]} if "flexible_body" in values else {}
    parts |= numbered("seats", values) | numbered("payload", values)
    vehicle = mounted(car, parts, table.name, mistakes if sound or "flexible_body" not in values else Mistakes())
    partial = bool(unread) or bad(vehicle, values.get("seats"), values.get("payload"))  # unknown coefficients
    for name, own, form in (("struts", "setting", float), ("bounds", "bounds", tuple[float, float])):
        if not bad(car) and isinstance(values.get(name), dict):
            known = car if bad(vehicle) else vehicle
            inner = table.inner(name, values.pop(name))
            values[own] = read_coefficients(inner, known, form, mistakes, others=partial)
    if partial or bad(*values.values()):
        return BAD
    return VehicleFile(
        vehicle=vehicle, **{one.name: values[one.name] for one in fields(VehicleFile) if one.name in values}
    )


def _plant(file: PlantFile, table: Table, mistakes: Mistakes) -> Vehicle:
    """Return the plant of a file without the struts that its model includes."""
    plant = read_plant(file, table, mistakes)
    if bad(plant) or not file.included:
        return plant
    known, inner = [one.name for one in plant.strut_coefficients], table.inner("included", file.included)
    before, included = len(mistakes), read_coefficients(inner, plant, float, mistakes, given=known)
    return BAD if len(mistakes) > before else plant.without(included)


def numbered(name: str, values: Mapping[str, Any]) -> dict[str, Part]:
    """Return the parts in the array `name` of a table's values by their keys, ``seats[1]``."""
    parts = values.get(name, ())
    return {} if parts is BAD else {f"{name}[{i}]": part for i, part in enumerate(parts, start=1)}


def mounted(vehicle: Vehicle, parts: Mapping[str, Part], name: str, mistakes: Mistakes) -> Vehicle:
    """Return the vehicle with parts by their keys in the table `name`, `BAD` if one does not fit."""
    for key, part in parts.items():
        if bad(vehicle, part):
            return BAD
        on: Vehicle = BAD
        with mistakes.noted(), fields_named(type(part), f"{name}{key}."):
            on = part.on(vehicle)
        vehicle = on
    return vehicle


def vehicle_table(file: VehicleFile) -> dict[str, Any]:
    """Return the table that `read_vehicle` reads as `file`."""
    vehicle, parts = file.vehicle, list[Part]()
    while isinstance(vehicle, Mounted):
        parts.insert(0, vehicle.part)
        vehicle = vehicle.vehicle
    beside = Document(
        name=file.name,
        source=file.source,
        unusual=file.unusual,
        flexible_body=next((part for part in parts if isinstance(part, FlexibleBody)), None),
        seats=tuple(part for part in parts if isinstance(part, Seat)),
        payload=tuple(part for part in parts if isinstance(part, Payload)),
        struts=coefficient_table(file.vehicle, file.setting),
        bounds=coefficient_table(file.vehicle, file.bounds),
        roll_geometry=file.roll_geometry,
    )
    return content(vehicle, KINDS) | content(beside)


def read_coefficients(
    table: Table,
    vehicle: Vehicle,
    kind: Any,
    mistakes: Mistakes,
    given: Collection[str] = (),
    others: bool = False,
) -> dict[str, Any]:
    """Return values by name in the order of `variables`; `given` ones need none, `others` may be there.

    A coefficient needs none either if a frequency or a ratio stands in its place.
    """
    flat = table.flat()
    given = [
        *given,
        *(one.replaces for one in vehicle.variables.values() if _replaces(one, [*flat.content, *given])),
    ]
    keys = [_key(one, kind, one.name in given) for one in vehicle.variables.values()]
    values = read(flat, {one.key: one for one in keys}, mistakes, others)
    return {one.name: values[one.name] for one in keys if one.name in values}


def _replaces(variable: Any, keys: Collection[str]) -> bool:
    """Whether a frequency or a ratio stands in place of a coefficient."""
    names = {variable.name, key_of(variable.name, variable.unit)}
    return isinstance(variable, Derived) and not names.isdisjoint(keys)


def _key(coefficient: Any, kind: Any, given: bool) -> Key:
    optional = given or kind is not float or coefficient.default is not None or isinstance(coefficient, Derived)

    def check(name: str, value: Any) -> None:
        if isinstance(value, tuple):
            checks.interval(name, value, coefficient.unit, equal=True, signed=isinstance(coefficient, Place))
        coefficient.check(name, value[0] if isinstance(value, tuple) else value)

    name, unit = coefficient.name, coefficient.unit
    return Key(key_of(name, unit), name, kind, unit, None if optional else MISSING, check)


def coefficient_table(vehicle: Vehicle, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the table that `read_coefficients` reads."""
    found: dict[str, Any] = {}
    for coefficient in vehicle.variables.values():
        if coefficient.name in values:
            value = values[coefficient.name]
            *tables, last = key_of(coefficient.name, coefficient.unit).split(".")
            place = reduce(lambda outer, name: outer.setdefault(name, {}), tables, found)
            place[last] = list(value) if isinstance(value, tuple) else value
    return found

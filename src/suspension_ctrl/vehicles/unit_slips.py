"""Slips of units: a body in tonnes, a spring in N/mm, a wheelbase in millimetres."""

import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from math import log
from typing import Any, NamedTuple

from ..quantities import quantity
from .plausibility import Figure, figures_of
from .struts import Strut
from .vehicle import AssembledVehicle, Vehicle

_TAKEN_FOR = {  # units that are used, the usual one first
    "kg": ("t",),
    "m": ("mm", "cm"),
    "kg m^2": ("t m^2", "kg mm^2"),
    "N/m": ("N/mm", "lbf/in"),
    "N s/m": ("N s/mm", "lbf s/in"),
}
_SELDOM, _SEVERAL = 0.5, 1.5  # distances of a seldom taken unit, and of a slip in each further kind of number


class UnitSlipWarning(UserWarning):
    """A vehicle is none of this world, or one of its numbers is in another unit.

    Examples
    --------
    A body of 317.5 kg in tonnes:

    >>> import warnings
    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=0.3175, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", sc.UnitSlipWarning)
    ...     try:
    ...         table = sc.ride(car, {"spring": 22e3, "damper": 1500.0}, sc.Iso8608Road("C"), speed=20.0)
    ...     except sc.UnitSlipWarning as warning:
    ...         print(warning)
    body_mass must be in kg, got 0.3175 as if in t: wheels over body in mass of 143, usual are 0.003 to 3
    """


class _Number(NamedTuple):
    """A number of a vehicle or of its struts' setting."""

    name: str
    unit: str
    value: float


class _Slip(NamedTuple):
    """Numbers that may be in other units."""

    numbers: tuple[_Number, ...]
    units: Mapping[str, str]  # taken for, by unit
    rarity: float

    def factor(self, name: str) -> float:
        """Factor that corrects the number of this name, 1 of others."""
        unit = next((one.unit for one in self.numbers if one.name == name), None)
        return 1.0 if unit is None else quantity("unit", f"1 {self.units[unit]}", unit)

    def __str__(self) -> str:
        names, values = [one.name for one in self.numbers], [f"{one.value:g}" for one in self.numbers]
        right = dict.fromkeys(one.unit for one in self.numbers)
        taken = (self.units[unit] for unit in right)
        got = f"{_listed(values)} as if in {' and '.join(taken)}"
        return f"{_listed(names)} must be in {' and '.join(right)}, got {got}"


def _listed(texts: list[str]) -> str:
    return ", ".join(texts) if len(texts) <= 4 else f"{', '.join(texts[:3])} ... {texts[-1]}"


def slip_of(vehicle: Vehicle, values: Mapping[str, float] | None = None) -> str | None:
    """Return a line about the units of a vehicle with these values of its struts, None if nothing is strange."""
    if not isinstance(vehicle, AssembledVehicle):
        return None
    strange = [one for one in figures_of(vehicle, values) if not one.plausible]
    if not strange:
        return None
    likely = min(_explanations(vehicle, values), key=lambda found: found[0], default=None)
    if likely is None:
        return f"units of the vehicle must be of one kind, got {strange[0]}"
    return f"{likely[1]}: {strange[0]}"


def warn_of_slip(vehicle: Vehicle, values: Mapping[str, float] | None = None, caller: int = 3) -> None:
    """Warn of a likely slip of units, at the `caller` so many calls up from here."""
    if line := slip_of(vehicle, values):
        warnings.warn(line, UnitSlipWarning, stacklevel=caller)


def refuse_slip(vehicle: Vehicle, values: Mapping[str, float] | None = None) -> None:
    """Raise ValueError about a likely slip of units."""
    if line := slip_of(vehicle, values):
        raise ValueError(line)


def _explanations(
    vehicle: AssembledVehicle, values: Mapping[str, float] | None
) -> Iterator[tuple[tuple[float, int], _Slip]]:
    """Yield the slips after whose correction nothing is strange, each with its distance and its size."""
    settings = list(_settings(vehicle, values or {}))
    own = [one for one in _numbers(vehicle) if one.name not in {other.name for other in settings}]
    numbers = [*own, *settings]
    for slip in _slips(numbers, settings):
        try:
            other = _scaled(vehicle, slip)
            setting = None if values is None else {name: v * slip.factor(name) for name, v in values.items()}
            found: list[Figure] = figures_of(other, setting)
        except ValueError:
            continue
        if all(one.plausible for one in found):
            distance = sum(one.distance for one in found) + slip.rarity + _unlike(numbers, slip)
            yield (distance, len(slip.numbers)), slip


def _unlike(numbers: list[_Number], slip: _Slip) -> float:
    """Distance of corrected numbers of one kind, of the front and the rear axle, from each other."""
    kinds: dict[str, list[float]] = {}
    for one in numbers:
        kinds.setdefault(_kind(one), []).append(abs(one.value) * slip.factor(one.name))
    return sum(log(max(values) / min(values)) ** 2 for values in kinds.values())


def _slips(numbers: list[_Number], settings: list[_Number]) -> Iterator[_Slip]:
    """Yield every number alone, equal ones, those of a name, of a unit, and stiffnesses with dampers."""
    groups: dict[tuple[_Number, ...], None] = {}
    for one in numbers:
        its = [other for other in numbers if other.unit == one.unit]
        like = [other for other in its if _kind(other) == _kind(one)]
        equal = [other for other in like if other.value == one.value]  # axles of a tridem
        groups |= dict.fromkeys([tuple(its), tuple(like), tuple(equal), (one,)])
    rates = [tuple(one for one in some if one.unit in ("N/m", "N s/m")) for some in (numbers, settings)]
    for group in [*groups, *rates]:
        unit = {one.unit for one in group}
        for i in range(min((len(_TAKEN_FOR[one]) for one in unit), default=0)):
            rarity = _SELDOM * i + _SEVERAL * (len({_kind(one) for one in group}) - 1)
            yield _Slip(group, {one: _TAKEN_FOR[one][i] for one in unit}, rarity)


def _kind(number: _Number) -> str:
    """Name without the axle or the strut: ``wheel_mass``, ``spring``, ``cg_to``."""
    return number.name.rpartition(".")[2].removeprefix("front_").removeprefix("rear_").split("_to_")[0]


def _numbers(record: Any, prefix: str = "") -> Iterator[_Number]:
    """Yield the numbers with units of a record and of the records in it."""
    for one in fields(record):
        value, unit = getattr(record, one.name), one.metadata.get("unit")
        numbers = [number for number in _row(value) if number]
        if unit in _TAKEN_FOR and numbers:
            yield _Number(f"{prefix}{one.name}", unit, float(numbers[0]))
        for name, inner in _records(one.name, value):
            yield from _numbers(inner, f"{prefix}{name}.")


def _row(value: Any) -> tuple[float, ...]:
    """Return a number, or the numbers of a place, nothing for another value."""
    row = value if isinstance(value, tuple) else (value,)
    return row if all(isinstance(number, int | float) and number is not True for number in row) else ()


def _records(name: str, value: Any) -> Iterable[tuple[str, Any]]:
    """Return the records in the value of a field, without struts, by their names."""
    if isinstance(value, tuple):
        return [
            (f"{name}.{getattr(one, 'name', '') or i}", one) for i, one in enumerate(value) if is_dataclass(one)
        ]
    if is_dataclass(value) and not isinstance(value, Strut):
        return [(getattr(value, "name", "") or name, value)]
    return []


def _settings(vehicle: Vehicle, values: Mapping[str, float]) -> Iterator[_Number]:
    for one in vehicle.strut_coefficients:
        if one.unit in _TAKEN_FOR and values.get(one.name):
            yield _Number(one.name, one.unit, values[one.name])


def _scaled(record: Any, slip: _Slip, prefix: str = "") -> Any:
    """Return the record with corrected numbers."""
    changes: dict[str, Any] = {}
    for one in fields(record):
        value = getattr(record, one.name)
        if one.metadata.get("unit") in _TAKEN_FOR and _row(value):
            scaled = tuple(number * slip.factor(f"{prefix}{one.name}") for number in _row(value))
            changes[one.name] = scaled if isinstance(value, tuple) else scaled[0]
        inner = [_scaled(found, slip, f"{prefix}{name}.") for name, found in _records(one.name, value)]
        if inner:
            changes[one.name] = tuple(inner) if isinstance(value, tuple) else inner[0]
    return replace(record, **changes)

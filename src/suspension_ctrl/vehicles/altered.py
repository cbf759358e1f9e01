"""Vehicles with other values of their parameters, with springs, dampers and tyres for frequencies and ratios."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .. import checks
from ..quantities import FrozenMapping, Real, Record
from .assembly import Assembly
from .formulas import Sheet
from .frequencies import Derived, corners_of, derived_of, loads_on, resolve, unsprung
from .parameters import Inertia, LoadMass, Parameter, Place, Ratio, parameters_of
from .vehicle import AssembledVehicle, Vehicle


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Altered(Record, AssembledVehicle):
    """A vehicle with other values of some of its parameters."""

    vehicle: AssembledVehicle
    values: Mapping[str, float]

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        assembly, known = self.vehicle.assembly, parameters_of(self.vehicle.assembly)
        for name, value in self.values.items():
            assembly = known[name].changed(assembly, value)
        return assembly


def further_variables(assembly: Assembly) -> dict[str, Parameter | Derived]:
    """Return what may vary beside the coefficients of the struts, by name."""
    return {**parameters_of(assembly), **derived_of(assembly)}


def altered(vehicle: AssembledVehicle, values: Mapping[str, float]) -> tuple[AssembledVehicle, dict[str, float]]:
    """Return the vehicle with the parameters among values by name, and the coefficients.

    Frequencies and damping ratios become springs, dampers and tyres. ValueError for a wrong one.
    """
    return with_parameters(vehicle, plain_values(vehicle, values))


def plain_values(vehicle: Vehicle, values: Mapping[str, float]) -> dict[str, float]:
    """Return values by name with springs, dampers and tyres in place of frequencies and damping ratios."""
    if not isinstance(vehicle, AssembledVehicle):
        return dict(values)
    check_variables("setting", vehicle, values)
    derived = derived_of(vehicle.assembly)
    changed, rest = with_parameters(vehicle, values)
    if not (wanted := [name for name in rest if name in derived]):
        return dict(values)
    for name in wanted:
        derived[name].check(name, rest[name])
    sheet, slots = sheet_of(changed.assembly, changed.assembly, (), rest)
    replaced = [derived[name].replaces for name in wanted]
    found = sheet.formulas([slots[name] for name in replaced]).of(np.zeros((1, 0)))[0]
    _check_reached(derived, wanted, found)
    plain = {name: value for name, value in values.items() if name not in derived}
    return {**plain, **dict(zip(replaced, found.tolist(), strict=True))}


def with_parameters(
    vehicle: AssembledVehicle, values: Mapping[str, float]
) -> tuple[AssembledVehicle, dict[str, float]]:
    """Return the vehicle with the parameters among values, and the other values."""
    parameters = parameters_of(vehicle.assembly)
    given = {name: value for name, value in values.items() if name in parameters}
    for name, value in given.items():
        parameters[name].check(name, value)
    given = {name: float(value) for name, value in given.items()}
    rest = {name: value for name, value in values.items() if name not in given}
    return (Altered(vehicle=vehicle, values=FrozenMapping(given)) if given else vehicle), rest


def check_variables(parameter: str, vehicle: AssembledVehicle, values: Iterable[str]) -> None:
    """Raise ValueError about a name that the vehicle does not have, and about two that stand for the same."""
    known, given = vehicle.variables, list(values)
    for name in given:
        checks.one_of(parameter, name, known)
        one = known[name]
        if isinstance(one, Derived) and one.replaces in given:
            raise ValueError(f"{parameter} must have {one.replaces} or {name} in its place, got both")


def _check_reached(derived: Mapping[str, Derived], names: Iterable[str], found: Real) -> None:
    """Raise ValueError unless what stands in place of frequencies and ratios is above zero."""
    for one, value in zip((derived[name] for name in names), found.tolist(), strict=True):
        if not value > 0:
            needed = f"within reach of springs and tyres, {one.replaces} above zero"
            raise ValueError(f"{one.name} must be {needed}, got {value:g} for it")


class Slots(dict[str, int]):
    """Slots by name; a constant gets its slot when it is asked for."""

    def __init__(self, sheet: Sheet, constants: Mapping[str, float], variables: Sequence[str]) -> None:
        super().__init__({name: i for i, name in enumerate(variables)})
        self._sheet, self._constants = sheet, constants

    def __missing__(self, name: str) -> int:
        if name not in self._constants:
            raise ValueError(f"setting must have {name}, got none")
        self[name] = self._sheet.constant(self._constants[name])
        return self[name]


def sheet_of(
    assembly: Assembly,
    reference: Assembly,
    variables: Sequence[str],
    fixed: Mapping[str, float],
    relative: Iterable[str] = (),
) -> tuple[Sheet, Slots]:
    """Return formulas in the making, and the slots of all coefficients and parameters, at variables in this order.

    Frequencies and ratios are those of the reference, as without the payload of another load case. Variables that
    are `relative` are parameters over those of the assembly.
    """
    sheet, parameters, derived = Sheet(len(variables)), parameters_of(assembly), derived_of(reference)
    usual = {one.name: one.default for one in assembly.strut_coefficients if one.default is not None}
    slots = Slots(sheet, {**usual, **{name: one.default for name, one in parameters.items()}, **fixed}, variables)
    for name in relative:
        if name in parameters:
            slots[name] = sheet.sum((parameters[name].default, {slots[name]: 1.0}))
    by_corner: dict[str, dict[str, int]] = {}
    for name in (*variables, *fixed):
        if one := derived.get(name):
            by_corner.setdefault(one.corner, {})[one.kind] = slots[name]
    for name, given in by_corner.items():
        corner, own = corners_of(reference)[name], parameters_of(reference)
        _check_alone(reference, variables, corner.spring)
        masses = {one: _share(reference, own[one], corner.tyres) for one in variables if one in own}
        moving = {one: share for one, share in masses.items() if share}
        stays = corner.mass - sum(share * own[one].default for one, share in moving.items())
        mass = sheet.sum(*((share, {slots[one]: 1.0}) for one, share in moving.items()), constant=stays)
        wheel = next((one for one in variables if _is_wheel(reference, own.get(one), corner.tyres)), None)
        at_wheel = sheet.constant(corner.wheel) if wheel is None else slots[wheel]
        slots |= resolve(sheet, corner, mass, at_wheel, slots, given)
    return sheet, slots


def plain_sheet(
    vehicle: Vehicle, variables: Sequence[str], fixed: Mapping[str, float]
) -> tuple[Sheet, Slots, dict[str, str]]:
    """Return formulas in the making, slots by name, and what stands for each frequency and ratio."""
    if not isinstance(vehicle, AssembledVehicle):
        usual = {one.name: one.default for one in vehicle.strut_coefficients if one.default is not None}
        sheet = Sheet(len(variables))
        return sheet, Slots(sheet, {**usual, **fixed}, variables), {}
    check_variables("setting", vehicle, [*variables, *fixed])
    reference, rest = with_parameters(vehicle, fixed)
    derived = derived_of(reference.assembly)
    sheet, slots = sheet_of(reference.assembly, reference.assembly, variables, rest)
    return sheet, slots, {name: derived[name].replaces for name in (*variables, *rest) if name in derived}


def _check_alone(assembly: Assembly, variables: Sequence[str], spring: str) -> None:
    """Raise ValueError if a place or a ratio varies beside frequencies of a corner."""
    for name, one in parameters_of(assembly).items():
        own = isinstance(one, Ratio) and spring in one.coefficients
        if name in variables and (own or isinstance(one, Place)):
            raise ValueError(f"bounds must have {name} or frequencies in place of rates, got both")


def _share(assembly: Assembly, one: Parameter, tyres: Sequence[str]) -> float:
    """Return how much of a mass stands on a wheel beside that of the wheel."""
    loads = loads_on(assembly, tyres)
    if loads is None or not isinstance(one, Inertia | LoadMass):
        return 0.0
    still = {*assembly.inertias, *unsprung(assembly)}
    ends = [link.upper for link in one.links(assembly) if link.upper not in still]
    return float(sum(loads @ assembly.shape(end) for end in ends))


def _is_wheel(assembly: Assembly, one: Parameter | None, tyres: Sequence[str]) -> bool:
    wheels = {link.upper for link in assembly.tyres if link.name in tyres}
    return isinstance(one, Inertia) and wheels <= set(one.coordinates)

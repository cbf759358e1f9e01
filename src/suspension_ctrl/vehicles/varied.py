"""Vehicles with ports for parameters that vary."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..quantities import FrozenMapping, Real, Record
from .added_ports import AddedPorts, added
from .altered import Slots, check_variables, plain_values, sheet_of, with_parameters
from .assembly import Assembly, ResponseName
from .formulas import Formulas, Sheet
from .frequencies import derived_of
from .parameters import LoadMass, Parameter, Place, Ported, Ratio, parameters_of
from .state_matrices import StateMatrices
from .vehicle import AssembledVehicle, Struts, Vehicle

_FLOOR = ("displacement", "velocity", "acceleration")
_OF_PLACE = ("suspension_travel", "suspension_travel_rate", *(f"floor_{kind}" for kind in _FLOOR))
"""Responses of a seat that depend on its place beside those of its port."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Varied(Record, AssembledVehicle):
    """A vehicle with further ports, of which the coefficients are formulas of the variables of a design.

    Values of coefficients, frequencies and ratios that do not vary are `fixed`. Variables that are `relative` are
    parameters over those of the vehicle, without effect on a vehicle that lacks them.
    """

    vehicle: AssembledVehicle
    reference: AssembledVehicle  # with its frequencies and ratios
    names: tuple[str, ...]
    fixed: Mapping[str, float]
    relative: tuple[str, ...] = ()

    @property
    def assembly(self) -> Assembly:
        """Masses and links, with a strut for every port."""
        return self._ported[0]

    @property
    def formulas(self) -> Formulas:
        """Coefficients that vary (p, w) by designs (p, v)."""
        return self._ported[1]

    @property
    def varying(self) -> tuple[str, ...]:
        """Names of these coefficients."""
        return self._ported[2]

    @property
    def has_frequencies(self) -> bool:
        """Whether frequencies or damping ratios stand in place of rates."""
        return not derived_of(self.reference.assembly).keys().isdisjoint((*self.names, *self.fixed))

    @property
    def loading(self) -> tuple[str, ...]:
        """Names of the coefficients of payload, which moves the mean positions of struts."""
        return tuple(added(name) for name, one in self._parameters.items() if isinstance(one, LoadMass))

    def with_design(self, design: Real) -> tuple[AssembledVehicle, dict[str, float]]:
        """Return the vehicle without ports and its coefficients at a design (v,)."""
        given = dict(zip(self.names, design.tolist(), strict=True))
        shares = {name: given.pop(name) for name in self.relative}
        values = {**self.fixed, **given}
        plain = plain_values(self.reference, values) if self.has_frequencies else values
        own = {
            name: share * self._parameters[name].default
            for name, share in shares.items()
            if name in self._parameters
        }
        return self.vehicle.at({**plain, **own})

    def bare(self, responses: Sequence[ResponseName] | None = None) -> StateMatrices:
        """Return `plant` as matrices."""
        places = [one for one in self._parameters.values() if isinstance(one, Place)]
        moved = {f"{one.strut}_{response}": one.name for one in places for response in _OF_PLACE}
        for name in self.responses if responses is None else responses:
            if name in moved:
                got = f"{moved[str(name)]} among the variables"
                raise ValueError(f"{name} must be of a seat in a fixed place, got {got}")
        return super().bare(responses)

    @cached_property
    def _parameters(self) -> dict[str, Parameter]:
        """Parameters that vary."""
        known = parameters_of(self.vehicle.assembly)
        derived = derived_of(self.reference.assembly)
        replaced = [derived[name].replaces for name in (*self.names, *self.fixed) if name in derived]
        return {name: known[name] for name in (*self.names, *replaced) if name in known}

    @cached_property
    def _ported(self) -> tuple[Assembly, Formulas, tuple[str, ...]]:
        """Masses and links, formulas, and the names of the coefficients that vary."""
        base = self.vehicle.assembly
        sheet, slots = sheet_of(base, self.reference.assembly, self.names, self.fixed, self.relative)
        slots |= self._by_ratio(sheet, slots)
        ports = AddedPorts(base)
        for one in self._parameters.values():
            if isinstance(one, Ported):
                ports.add(one, sheet.sum((1.0, {slots[one.name]: 1.0}), constant=-one.default))
        self._place(sheet, slots, ports)
        known = {one.name: slots[one.name] for one in base.strut_coefficients if slots.get(one.name) is not None}
        varying = {**known, **ports.slots}
        return ports.assembly(), sheet.formulas(list(varying.values())), tuple(varying)

    def _by_ratio(self, sheet: Sheet, slots: Slots) -> dict[str, int]:
        """Return the slots of coefficients times the square of a ratio that varies over that of the vehicle."""
        found = {}
        for one in self._parameters.values():
            if isinstance(one, Ratio):
                if any(network.prefix == one.prefix for network in self.vehicle.networks):
                    needed = "of springs, dampers and inerters in parallel to vary"
                    raise ValueError(f"{one.name} must be {needed}, got a strut with others")
                for name in one.coefficients:
                    product = {slots[name]: 1.0, slots[one.name]: 2.0}
                    found[name] = sheet.sum((one.default**-2, product))
        return found

    def _place(self, sheet: Sheet, slots: Slots, ports: AddedPorts) -> None:
        """Add ports of pitch and roll for seats with places that vary.

        A seat moved by dx and dy extends its strut by dx pitch - dy roll more.
        """
        places = [one for one in self._parameters.values() if isinstance(one, Place)]
        for strut in dict.fromkeys(one.strut for one in places):
            axes = sorted((one for one in places if one.strut == strut), key=lambda one: one.axis)
            moved = [sheet.sum((1.0, {slots[one.name]: 1.0}), constant=-one.default) for one in axes]
            ports.turn(strut, axes[0].body, [one.axis for one in axes], moved, sheet, slots)


def ported(
    vehicle: Vehicle,
    names: Sequence[str],
    fixed: Mapping[str, float],
    first: Vehicle,
    relative: Sequence[str] = (),
) -> Vehicle:
    """Return the vehicle with ports for the variables among `names` that are no coefficients, itself without any.

    Frequencies and damping ratios are those of the `first` vehicle. Further variables are `relative`.
    """
    given = [*names, *fixed]
    plain = {one.name for one in vehicle.strut_coefficients}
    if not (isinstance(vehicle, AssembledVehicle) and isinstance(first, AssembledVehicle)):
        return vehicle
    if plain >= {*given} and not relative:
        return vehicle
    check_variables("setting", first, given)
    changed, rest = with_parameters(vehicle, fixed)
    reference, _ = with_parameters(first, fixed)
    values = {name: float(value) for name, value in rest.items()}
    return Varied(
        vehicle=changed,
        reference=reference,
        names=(*names, *relative),
        fixed=FrozenMapping(values),
        relative=tuple(relative),
    )


def setting_of(vehicle: Vehicle, design: Mapping[str, float], fixed: Struts) -> dict[str, float]:
    """Return all coefficients by name at a design, those of ports too, with values that do not vary."""
    if not isinstance(vehicle, Varied):
        return vehicle.coefficients({**fixed, **design})
    values = np.array([[design[name] for name in vehicle.names]])
    found = vehicle.formulas.of(values)[0]
    own = vehicle.with_design(values[0])[1]  # which checks all
    known = {one.name: own.get(one.name, 0.0) for one in vehicle.strut_coefficients}
    return known | dict(zip(vehicle.varying, found.tolist(), strict=True))

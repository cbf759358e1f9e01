"""Parameters of a vehicle that vary beside the coefficients of its struts: tyres, masses, seat places, ratios.

A changed tyre is a further spring or damper beside it, a changed mass a further inertia between the inertial frame
and its place: ports of the plant with the value minus that of the vehicle.
"""

import re
from abc import ABC, abstractmethod
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, replace

from .. import checks
from ..quantities import Record
from .assembly import Assembly, End, Link, joined, turning

_SIDE = re.compile("_(left|right)(?=_|$)")
_WHAT = {"stiffness": (0, "N/m"), "damping": (1, "N s/m")}  # of a tyre: order of the derivative, unit


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Parameter(Record, ABC):
    """A parameter: its name, its unit, and the value that the vehicle has."""

    name: str
    unit: str
    default: float

    @abstractmethod
    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with another value."""

    def check(self, name: str, value: float) -> None:
        """Raise ValueError about `name` unless this parameter may have the value."""
        (checks.not_negative if self.default == 0 else checks.positive)(name, value, self.unit)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Ported(Parameter):
    """A parameter with ports of its own."""

    order: int  # of the derivative of a port's deflection: 0 stiffness, 1 damping, 2 inertia

    @abstractmethod
    def links(self, assembly: Assembly, /) -> list[Link]:
        """Return a strut for each place of the parameter."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class TyreParameter(Ported):
    """Stiffness or damping of the tyres of an axle."""

    tyres: tuple[str, ...]
    what: str

    def check(self, name: str, value: float) -> None:
        """Raise ValueError about `name` unless a tyre may have the value."""
        (checks.not_negative if self.order else checks.positive)(name, value, self.unit)

    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with other tyres."""
        new = float(value)
        other = [
            one._replace(damping=new) if self.order else one._replace(stiffness=new) for one in assembly.tyres
        ]
        pairs = zip(assembly.tyres, other, strict=True)
        return replace(assembly, tyres=tuple(b if a.name in self.tyres else a for a, b in pairs))

    def links(self, assembly: Assembly, /) -> list[Link]:
        """Return a strut beside each tyre."""
        what = f"tyre_{self.what}"
        return [
            Link(joined(one.name, what), one.lower, one.upper) for one in assembly.tyres if one.name in self.tyres
        ]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Inertia(Ported):
    """Masses or moments of inertia of coordinates."""

    coordinates: tuple[str, ...]

    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with other masses."""
        new = dict.fromkeys(self.coordinates, float(value))
        masses, inertias = (
            {name: new.get(name, before) for name, before in given.items()}
            for given in (assembly.masses, assembly.inertias)
        )
        return replace(assembly, masses=masses, inertias=inertias)

    def links(self, _assembly: Assembly, /) -> list[Link]:
        """Return a strut from the inertial frame to each coordinate."""
        return [Link(f"{name}_inertia", None, name) for name in self.coordinates]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LoadMass(Ported):
    """Mass of a load on the body, by its number."""

    number: int

    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with another load."""
        loads = list(assembly.payload)
        loads[self.number] = (float(value), loads[self.number][1])
        return replace(assembly, payload=tuple(loads))

    def links(self, assembly: Assembly, /) -> list[Link]:
        """Return a strut from the inertial frame to the load."""
        return [Link(f"{self.name.replace('.', '_')}_inertia", None, assembly.payload[self.number][1])]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Place(Parameter):
    """Coordinate x or y of a seat's place on the body."""

    strut: str
    body: str
    axis: int

    def check(self, name: str, value: float) -> None:
        """Raise ValueError about `name` unless it is a coordinate of a point."""
        checks.within(name, value, -1e6, 1e6)

    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with the seat at another place."""
        struts = list(assembly.struts)
        index = [one.name for one in struts].index(self.strut)
        *body, x, y = _point(struts[index].lower)
        lower = (float(value), y) if self.axis == 0 else (x, float(value))
        struts[index] = struts[index]._replace(lower=lower if body == ["body"] else (self.body, *lower))
        return replace(assembly, struts=tuple(struts))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Ratio(Parameter):
    """Installation ratio of a strut: its deflection over that of the wheel."""

    coefficients: tuple[str, ...]
    prefix: str

    def changed(self, assembly: Assembly, value: float) -> Assembly:
        """Return the vehicle with another ratio."""
        coefficients = (
            replace(one, gain=one.gain * (value / self.default) ** 2, ratio=float(value))
            if one.name in self.coefficients
            else one
            for one in assembly.strut_coefficients
        )
        networks = (
            one._replace(strut=replace(one.strut, installation_ratio=float(value)))
            if one.prefix == self.prefix
            else one
            for one in assembly.networks
        )
        return replace(assembly, strut_coefficients=tuple(coefficients), networks=tuple(networks))


def parameters_of(assembly: Assembly) -> dict[str, Parameter]:
    """Return the parameters of a vehicle by name; a coefficient of the same name comes first."""
    taken = {one.name for one in assembly.strut_coefficients}
    every = (*_tyres(assembly), *_inertias(assembly), *_loads(assembly), *_places(assembly), *_ratios(assembly))
    return {one.name: one for one in every if one.name not in taken}


def alike(values: Mapping[str, Hashable]) -> dict[str, list[str]]:
    """Return names by what they have in common: left and right of an axle where their values are equal."""
    groups: dict[str, list[str]] = {}
    for name in values:
        groups.setdefault(_SIDE.sub("", name, 1), []).append(name)
    found: dict[str, list[str]] = {}
    for common, names in groups.items():
        same = len({values[name] for name in names}) == 1
        found |= {common: names} if same else {name: [name] for name in names}
    return found


def _tyres(assembly: Assembly) -> Iterator[Parameter]:
    for what, (order, unit) in _WHAT.items():
        values = {one.name: float(getattr(one, what)) for one in assembly.tyres}
        for common, names in alike(values).items():
            name = joined(common, f"tyre_{what}")
            yield TyreParameter(
                name=name, unit=unit, default=values[names[0]], tyres=tuple(names), what=what, order=order
            )


def _inertias(assembly: Assembly) -> Iterator[Parameter]:
    inertias = {name: value for name, value in assembly.inertias.items() if not name.startswith("bending_")}
    for unit, values, what in (("kg", assembly.masses, "mass"), ("kg m^2", inertias, "inertia")):
        for common, names in alike(values).items():
            name = f"{common}.mass" if common in assembly.seats else f"{common}_{what}"
            if values[names[0]] > 0:
                yield Inertia(name=name, unit=unit, default=values[names[0]], coordinates=tuple(names), order=2)


def _loads(assembly: Assembly) -> Iterator[Parameter]:
    for number, (mass, _) in enumerate(assembly.payload):
        name = "payload.mass" if number == 0 else f"payload_{number + 1}.mass"
        yield LoadMass(name=name, unit="kg", default=mass, number=number, order=2)


def _point(end: End) -> tuple[str, float, float]:
    """Return body and place of a point."""
    if not isinstance(end, tuple):
        raise ValueError(f"end must be a point of a body, got {end}")
    return end if len(end) == 3 else ("body", *end)


def _places(assembly: Assembly) -> Iterator[Parameter]:
    for seat, point in () if assembly.bending else assembly.seats.items():
        body, *place = _point(point)
        for axis, (letter, angle) in enumerate((("x", "pitch"), ("y", "roll"))):
            if turning(body, angle) in assembly.inertias:
                name, value = f"{seat}.{letter}", place[axis]
                yield Place(name=name, unit="m", default=value, strut=seat, body=body, axis=axis)


def _ratios(assembly: Assembly) -> Iterator[Parameter]:
    by_prefix: dict[str, list[str]] = {}
    ratios: dict[str, float] = {}
    for one in assembly.strut_coefficients:
        if one.ratio is not None:
            by_prefix.setdefault(one.prefix, []).append(one.name)
            ratios[one.prefix] = one.ratio
    for prefix, names in by_prefix.items():
        name, ratio = f"{prefix}installation_ratio", ratios[prefix]
        yield Ratio(name=name, unit="", default=ratio, coefficients=tuple(names), prefix=prefix)

"""Masses and links of a vehicle: coordinates, responses, and their shares in displacements.

Axes as in ISO 8855: x forward, y to the left, z up from the centre of gravity of the body; pitch is positive nose
down, roll positive left side up. Deflections are positive in extension, forces in tension.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from .. import checks
from ..quantities import FrozenMapping, Real, Record, frozen_array, unit
from .struts import Strut

Position = tuple[float, float]  # a point (x, y) of the body [m]
ONE_WHEEL: FrozenMapping[str, Position] = FrozenMapping({"": (0.0, 0.0)})
"""Contact of one wheel without a name."""
ResponseName = str | tuple[str, float, float]
"""One of a vehicle's named responses, or ``("acceleration", x, y)``, vertical, at a point of the body."""
BodyPoint = tuple[str, float, float]  # body by name, and point (x, y) from its centre of gravity [m]
End = str | Position | BodyPoint | None
"""End of a link: a coordinate or a road by name, a point of ``body`` or of another body, or the inertial frame."""
GRAVITY = 9.80665  # m/s^2, standard acceleration
_RESERVED = ("responses", "road", "speed")  # keywords of functions that take struts by name
_SAME_PLACE = 1e-3  # m
_NOTHING = 1e-9  # of the largest share, rounding
_NONE: FrozenMapping[Any, Any] = FrozenMapping({})


def label(response: ResponseName) -> str:
    """Return the name of a response as a signal of python-control, without dots."""
    point = response_point(response)
    return str(response) if point is None else "acceleration_at_{}_{}_mm".format(*(round(1e3 * x) for x in point))


def response_point(response: ResponseName) -> Position | None:
    """Return the point of the body of an acceleration that is given by its place."""
    if isinstance(response, tuple) and len(response) == 3 and response[0] == "acceleration":
        return float(response[1]), float(response[2])
    return None


def point_of(body: str, position: Position) -> Position | BodyPoint:
    """Return a point of a body, `position` from its centre of gravity."""
    return position if body == "body" else (body, *position)


def _body_of(end: End) -> str:
    """Return the body or the coordinate at an end, "" of the inertial frame."""
    if isinstance(end, tuple):
        return end[0] if len(end) == 3 else "body"
    return end or ""


def turning(body: str, motion: str) -> str:
    """Return the coordinate of the ``pitch`` or ``roll`` of a body."""
    return motion if body == "body" else f"{body}_{motion}"


def turns(coordinate: End) -> bool:
    """Whether a coordinate is an angle."""
    return isinstance(coordinate, str) and coordinate.rpartition("_")[2] in ("pitch", "roll")


def joined(*parts: str) -> str:
    """Return the parts that are not empty, joined by underscores."""
    return "_".join(part for part in parts if part)


def check_strut_names(parameter: str, names: Iterable[str]) -> None:
    """Raise ValueError if a strut has the name of another keyword."""
    for name in names:
        if name in _RESERVED:
            raise ValueError(f"{parameter} must not be called {', '.join(_RESERVED)}, got {checks.shown(name)}")


class Link(NamedTuple):
    """A spring and a damper in parallel between two ends; a strut has its ends alone, the lower may be a road."""

    name: str
    lower: End
    upper: End
    stiffness: float = 0.0  # N/m
    damping: float = 0.0  # N s/m


class Response(NamedTuple):
    """A kind of response at an end, a strut or a tyre; a ``signal`` is of unknown kind.

    Of an end ``displacement``, ``velocity``, ``acceleration`` and ``jerk``; of a strut ``travel``, ``travel_rate``
    and ``strut_force``; of a tyre ``load`` and ``tyre_deflection``.
    """

    kind: str
    where: End


@dataclass(frozen=True, eq=False, repr=False)
class StrutCoefficient(Record):
    """A coefficient of the struts; required if it has no default, and above zero unless its default is 0."""

    name: str
    unit: str
    gain: Real  # (q, q), tension of each strut by a derivative of each deflection, at a coefficient of 1
    order: int  # of the derivative: 0 springs, 1 dampers, 2 inerters and masses
    default: float | None = None
    prefix: str = ""  # of the names of its strut, ``front.``
    ratio: float | None = None  # installation ratio of its strut as a whole, None of a bar

    def __post_init__(self) -> None:
        self._keep(gain=frozen_array(self.gain))

    def check(self, name: str, value: float) -> None:
        """Raise ValueError about `name` unless this coefficient may have the value."""
        (checks.not_negative if self.default == 0 else checks.positive)(name, value, self.unit)


class Network(NamedTuple):
    """A strut without plain springs and dampers, at each port with a share of 1; names begin with the prefix."""

    strut: Strut
    prefix: str
    share: tuple[float, ...]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Assembly(Record):
    """The masses and links of a vehicle; coordinates and wheels by name."""

    masses: Mapping[str, float] = field(metadata=unit("kg"))  # that move vertically, bodies at their centres
    inertias: Mapping[str, float] = _NONE  # ``pitch``, ``cab_roll`` [kg m^2]; elastic modes of modal mass 1 [-]
    contacts: Mapping[str, Position] = field(metadata=unit("m"))  # where each tyre touches ``<tyre>_road``
    tyres: tuple[Link, ...]  # from their roads to wheels; a contact without one has a strut on its road
    struts: tuple[Link, ...]
    strut_coefficients: tuple[StrutCoefficient, ...]
    responses: Mapping[str, Response]
    networks: tuple[Network, ...] = ()
    supports: tuple[Link, ...] = ()  # further springs and dampers, the same for every design
    bending: Mapping[Position, Mapping[str, float]] = _NONE  # by point, its share of each mode [kg^-1/2]
    payload: tuple[tuple[float, Position | BodyPoint], ...] = ()  # masses [kg] fixed to points of bodies
    joints: tuple[tuple[End, End], ...] = ()  # ends of equal displacement

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            self._keep(**{name: FrozenMapping(value) if isinstance(value, Mapping) else tuple(value)})
        stand = {strut.lower for strut in self.struts}
        needed = {tyre: road for tyre, road in zip(self.contacts, self.roads, strict=True) if road not in stand}
        given = {tyre.name: tyre.lower for tyre in self.tyres}
        named = dict(zip(self.contacts, self.roads, strict=True))
        if len(given) < len(self.tyres) or not needed.items() <= given.items() <= named.items():
            names = checks.listing(needed) or "those of contacts"
            raise ValueError(f"tyres must be {names}, each from its road, got {self.tyres}")
        check_strut_names("struts", (strut.name for strut in self.struts))
        for end in (*(end for strut in self.struts for end in strut[1:3]), *(place for _, place in self.payload)):
            if isinstance(end, tuple) and len(end) == 2:
                self._bending_at(end)

    @cached_property
    def roads(self) -> tuple[str, ...]:
        """Names of the roads."""
        return tuple(joined(tyre, "road") for tyre in self.contacts)

    @cached_property
    def movements(self) -> tuple[str, ...]:
        """Names of all masses and inertias."""
        return (*self.masses, *self.inertias)

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates: of the movements those that no joint determines from the others."""
        return tuple(name for name, row in zip(self.movements, self._determined, strict=True) if not row)

    @cached_property
    def inertia(self) -> Real:
        """Mass or inertia of each of the movements (m,), payload included."""
        inertia = np.array([*self.masses.values(), *self.inertias.values()], dtype=float)
        return frozen_array(inertia + sum(mass * self._shares(place) ** 2 for mass, place in self.payload))

    @cached_property
    def displacements(self) -> Real:
        """Movements by unit of each coordinate (m, n)."""
        return frozen_array(self._reduction[0])

    @property
    def _determined(self) -> list[bool]:
        """Whether joints determine each of the movements."""
        return self._reduction[1]

    @cached_property
    def _reduction(self) -> tuple[Real, list[bool]]:
        """`displacements` by elimination of a movement per joint, massless ones first, and the eliminated."""
        reduction, free = np.eye(len(self.movements)), np.ones(len(self.movements), dtype=bool)
        massless = np.array([*self.masses.values(), *self.inertias.values()]) == 0
        turning = np.arange(len(self.movements)) >= len(self.masses)
        for one, other in self.joints:
            row = (self._shares(one) - self._shares(other)) @ reduction
            can = free & (np.abs(row) > _NOTHING * max(1.0, np.abs(row).max()))
            if not can.any():
                raise ValueError(f"joints must each hold a movement that is free, got {one} and {other}")
            last = max(np.flatnonzero(can), key=lambda i: (massless[i], not turning[i], i))
            reduction -= np.outer(reduction[:, last], row / row[last])
            reduction[:, last], free[last] = 0.0, False
        return reduction[:, free], (~free).tolist()

    @cached_property
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of every response by name: `responses`, then others of coordinates, floors, struts and tyres."""
        wheels, further = [tyre.upper for tyre in self.tyres], dict[str, Response]()
        ends: dict[str, End] = {name: name for name in (*self.masses, *sorted(filter(turns, self.inertias)))}
        floors = {f"{seat}_floor": point for seat, point in self.seats.items()}
        for name, end in (ends | floors | ends).items():
            jerk = () if _body_of(end) in wheels else ("jerk",)
            kinds = ("displacement", "velocity", "acceleration", *jerk)
            further |= {f"{name}_{kind}": Response(kind, end) for kind in kinds}
        for strut in self.struts:
            further[joined(strut.name, "suspension_travel_rate")] = Response("travel_rate", strut.name)
            further[joined(strut.name, "strut_force")] = Response("strut_force", strut.name)
        for tyre in self.tyres:
            further[joined(tyre.name, "tyre_deflection")] = Response("tyre_deflection", tyre.name)
        return FrozenMapping({**self.responses, **further, **self.responses})

    @cached_property
    def seats(self) -> Mapping[str, Position | BodyPoint]:
        """Point of a body below each mass that stands there on a strut of its own name."""
        wheels = {tyre.upper for tyre in self.tyres}
        own = (strut for strut in self.struts if strut.name == strut.upper and strut.upper not in wheels)
        return FrozenMapping({strut.name: strut.lower for strut in own if isinstance(strut.lower, tuple)})

    def body_below(self, end: End) -> str:
        """Return the body or the coordinate at an end, of a seat the body on which it stands."""
        name = _body_of(end)
        return self.body_below(self.seats[name]) if name in self.seats else name

    @cached_property
    def mass_matrix(self) -> Real:
        """Masses and inertias (n, n) of the coordinates, payload included."""
        matrix = np.diag(np.array([*self.masses.values(), *self.inertias.values()], dtype=float))
        if self.joints:
            matrix = self.displacements.T @ matrix @ self.displacements
        for mass, position in self.payload:
            matrix += mass * np.outer(self.shape(position), self.shape(position))
        return frozen_array(matrix)

    @cached_property
    def weights(self) -> Real:
        """Mass that loads each coordinate by gravity (n,): kg, or kg m of one that turns the body."""
        weights = np.array([self.masses.get(name, 0.0) for name in self.movements]) @ self.displacements
        return frozen_array(weights + sum(mass * self.shape(position) for mass, position in self.payload))

    @cached_property
    def standing(self) -> Real:
        """Share (r, q) of the tension of each strut in the load on each road: 1 of a strut that stands on it."""
        return frozen_array(-self.elongations(self.struts)[1].T)

    @cached_property
    def unsprung(self) -> frozenset[str]:
        """Names of the masses on tyres: wheels, axles and beams, but not the body."""
        return frozenset(map(_body_of, (tyre.upper for tyre in self.tyres))) - {"body", ""}

    @property
    def sprung_mass(self) -> float:
        """Mass carried by the wheels, payload included [kg]."""
        sprung = sum(mass for name, mass in self.masses.items() if name not in self.unsprung)
        return sprung + sum(mass for mass, _ in self.payload)

    @cached_property
    def wheel_struts(self) -> tuple[str, ...]:
        """Names of the struts on wheels, axles, beams and roads, without seats."""
        below = {*self.unsprung, *self.roads}
        return tuple(one.name for one in self.struts if _body_of(one.lower) in below and one.upper != one.name)

    def shape(self, end: End) -> Real:
        """Return the share (n,) of each coordinate in the displacement of an end."""
        return np.asarray(self._shares(end) @ self.displacements) if self.joints else self._shares(end)

    def _shares(self, end: End) -> Real:
        """Return the share (m,) of each of the movements in the displacement of an end."""
        shares: Mapping[str, float] = {}
        if isinstance(end, str):
            shares = {end: 1.0}
        elif end is not None:
            body, x, y = end if len(end) == 3 else ("body", *end)
            shares = {body: 1.0, turning(body, "pitch"): -x, turning(body, "roll"): y}
            shares |= self._bending_at((x, y)) if body == "body" else {}
        return np.array([shares.get(name, 0.0) for name in self.movements])

    def acceleration_of(self, name: ResponseName) -> Real:
        """Return the share (n,) of the acceleration of each coordinate in a response."""
        if point := response_point(name):
            return self.shape(point)
        kind, where = self.meanings[str(name)]
        return self.shape(where if kind == "acceleration" else None)

    def _bending_at(self, position: Position) -> Mapping[str, float]:
        for known, shares in self.bending.items():
            if np.hypot(known[0] - position[0], known[1] - position[1]) < _SAME_PLACE:
                return shares
        if self.bending:
            raise ValueError(f"position must be one with known mode shapes, {list(self.bending)}, got {position}")
        return {}

    def elongations(self, links: Sequence[Link]) -> tuple[Real, Real]:
        """Return the elongation of links by unit of each coordinate (l, n) and by metre of each road (l, r)."""
        by_coordinate = [self.shape(link.upper) - self.shape(link.lower) for link in links]
        by_road = [[-float(link.lower == road) for road in self.roads] for link in links]
        shape = len(links), len(self.coordinates)
        return np.reshape(by_coordinate, shape), np.reshape(by_road, (len(links), len(self.roads)))

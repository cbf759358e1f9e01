"""Equations of motion of masses and links, assembled into a python-control model with a port for every strut.

Axes as in ISO 8855: x forward, y to the left, z up from the centre of gravity of the body; pitch is positive nose
down, roll positive left side up. Deflections are positive in extension, forces in tension.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import control
import numpy as np

from .. import checks
from ..quantities import FrozenMapping, Real, Record, frozen_array, unit
from .struts import Strut

Position = tuple[float, float]  # a point (x, y) of the body [m]
ResponseName = str | tuple[str, float, float]
"""One of a vehicle's named responses, or ``("acceleration", x, y)``, vertical, at a point of the body."""
End = str | Position | None
"""End of a link: a coordinate or a road by name, a point of the body, or the inertial frame."""
GRAVITY = 9.80665  # m/s^2, standard acceleration
_RESERVED = ("responses", "road", "speed")  # keywords of functions that take struts by name
_SAME_PLACE = 1e-3  # m
_NONE: FrozenMapping[Any, Any] = FrozenMapping({})


def label(response: ResponseName) -> str:
    """Return the name of a response as a signal of python-control, without dots."""
    point = _point_of(response)
    return str(response) if point is None else "acceleration_at_{}_{}_mm".format(*(round(1e3 * x) for x in point))


def _point_of(response: ResponseName) -> Position | None:
    if isinstance(response, tuple) and len(response) == 3 and response[0] == "acceleration":
        return float(response[1]), float(response[2])
    return None


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

    masses: Mapping[str, float] = field(metadata=unit("kg"))  # that move vertically, ``body`` at its centre
    inertias: Mapping[str, float] = _NONE  # ``pitch``, ``roll`` [kg m^2] and elastic modes, of modal mass 1 [-]
    contacts: Mapping[str, Position] = field(metadata=unit("m"))  # where each tyre touches ``<tyre>_road``
    tyres: tuple[Link, ...]  # from their roads to wheels; a contact without one has a strut on its road
    struts: tuple[Link, ...]
    strut_coefficients: tuple[StrutCoefficient, ...]
    responses: Mapping[str, Response]
    networks: tuple[Network, ...] = ()
    supports: tuple[Link, ...] = ()  # further springs and dampers, the same for every design
    bending: Mapping[Position, Mapping[str, float]] = _NONE  # by point, its share of each mode [kg^-1/2]
    payload: tuple[tuple[float, Position], ...] = ()  # masses [kg] fixed to points of the body

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            self._keep(**{name: FrozenMapping(value) if isinstance(value, Mapping) else tuple(value)})
        stand = {strut.lower for strut in self.struts}
        needed = {tyre: road for tyre, road in zip(self.contacts, self.roads, strict=True) if road not in stand}
        given = {tyre.name: tyre.lower for tyre in self.tyres}
        named = dict(zip(self.contacts, self.roads, strict=True))
        if len(given) < len(self.tyres) or not needed.items() <= given.items() <= named.items():
            names = ", ".join(needed) or "those of contacts"
            raise ValueError(f"tyres must be {names}, each from its road, got {self.tyres}")
        check_strut_names("struts", (strut.name for strut in self.struts))
        for end in (*(end for strut in self.struts for end in strut[1:3]), *(place for _, place in self.payload)):
            if isinstance(end, tuple):
                self._bending_at(end)

    @cached_property
    def roads(self) -> tuple[str, ...]:
        """Names of the roads."""
        return tuple(joined(tyre, "road") for tyre in self.contacts)

    @cached_property
    def coordinates(self) -> tuple[str, ...]:
        """Names of the coordinates."""
        return (*self.masses, *self.inertias)

    @cached_property
    def meanings(self) -> Mapping[str, Response]:
        """Meaning of every response by name: `responses`, then others of coordinates, struts and tyres."""
        wheels, further = [tyre.upper for tyre in self.tyres], dict[str, Response]()
        for end in (*self.masses, *(name for name in ("pitch", "roll") if name in self.inertias)):
            kinds = ("displacement", "velocity", "acceleration", *(("jerk",) if end not in wheels else ()))
            further |= {f"{end}_{kind}": Response(kind, end) for kind in kinds}
        for strut in self.struts:
            further[joined(strut.name, "suspension_travel_rate")] = Response("travel_rate", strut.name)
            further[joined(strut.name, "strut_force")] = Response("strut_force", strut.name)
        for tyre in self.tyres:
            further[joined(tyre.name, "tyre_deflection")] = Response("tyre_deflection", tyre.name)
        return FrozenMapping({**self.responses, **further, **self.responses})

    @cached_property
    def mass_matrix(self) -> Real:
        """Masses and inertias (n, n) of the coordinates, payload included."""
        matrix = np.diag(np.array([*self.masses.values(), *self.inertias.values()], dtype=float))
        for mass, position in self.payload:
            matrix += mass * np.outer(self.shape(position), self.shape(position))
        return frozen_array(matrix)

    @cached_property
    def weights(self) -> Real:
        """Mass that loads each coordinate by gravity (n,): kg, or kg m of one that turns the body."""
        weights = np.array([self.masses.get(name, 0.0) for name in self.coordinates])
        return frozen_array(weights + sum(mass * self.shape(position) for mass, position in self.payload))

    @cached_property
    def standing(self) -> Real:
        """Share (r, q) of the tension of each strut in the load on each road: 1 of a strut that stands on it."""
        return frozen_array(-self.elongations(self.struts)[1].T)

    @property
    def sprung_mass(self) -> float:
        """Mass carried by the wheels, payload included [kg]."""
        wheels = [tyre.upper for tyre in self.tyres]
        return sum(m for name, m in self.masses.items() if name not in wheels) + sum(m for m, _ in self.payload)

    def shape(self, end: End) -> Real:
        """Return the share (n,) of each coordinate in the displacement of an end."""
        shares: Mapping[str, float] = {}
        if isinstance(end, str):
            shares = {end: 1.0}
        elif end is not None:
            shares = {"body": 1.0, "pitch": -end[0], "roll": end[1], **self._bending_at(end)}
        return np.array([shares.get(name, 0.0) for name in self.coordinates])

    def acceleration_of(self, name: ResponseName) -> Real:
        """Return the share (n,) of the acceleration of each coordinate in a response."""
        if point := _point_of(name):
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

    def plant(self, responses: Sequence[ResponseName]) -> control.StateSpace:
        """Return the vehicle without its struts; `Vehicle.plant` names the inputs and outputs.

        With coordinates z, roads x and tensions F of struts, links extend by E z + R x and struts by P z. The
        masses M move by ``M z'' = -E^T (k (E z + R x) + c (E z' + R x')) - P^T F``; of struts on a road, -S x too.
        """
        checks.listed("responses", responses)
        n, r, q = len(self.coordinates), len(self.roads), len(self.struts)
        motion, tension = self._motion()
        rows = {label(name): self._row(name, motion, tension) for name in responses}
        if len(rows) < len(responses):
            raise ValueError(
                f"responses must differ, points by a millimetre or more, got {checks.shown(list(responses))}"
            )
        p, s = self.elongations(self.struts)
        columns = np.eye(2 * n + 2 * r + q)
        z, rate, x, x_rate = np.split(columns[: 2 * (n + r)], [n, 2 * n, 2 * n + r])
        ports = p @ z + s @ x, p @ rate + s @ x_rate
        moved, read = np.vstack([rate, motion]), np.vstack([*rows.values(), *ports])
        damped = tension[: len(self.tyres), 2 * n + r : 2 * n + 2 * r].any() or s.any()
        kept = np.delete(np.arange(2 * n, 2 * n + 2 * r + q), [] if damped else slice(r, 2 * r))
        states = np.arange(2 * n).reshape(2, n).T.ravel()  # a coordinate and its rate beside each other
        matrices = moved[np.ix_(states, states)], moved[np.ix_(states, kept)], read[:, states], read[:, kept]
        labels = [f"{name}_{what}" for name in self.coordinates for what in ("displacement", "velocity")]
        rates = [f"{road}_rate" for road in self.roads if damped]
        inputs = [*self.roads, *rates, *(joined(strut.name, "strut") for strut in self.struts)]
        names = [joined(strut.name, end) for end in ("deflection", "deflection_rate") for strut in self.struts]
        return control.ss(*matrices, states=labels, inputs=inputs, outputs=[*rows, *names], name="plant")

    def _motion(self) -> tuple[Real, Real]:
        """Accelerations (n, c) and tensions of tyres and supports (l, c) by z, z', x, x' and F, c in all."""
        links = [*self.tyres, *self.supports]
        e, road = self.elongations(links)
        p, _ = self.elongations(self.struts)
        k, c = (np.array([getattr(link, name) for link in links])[:, None] for name in ("stiffness", "damping"))
        tension = np.hstack([k * e, c * e, k * road, c * road])
        inverse = np.linalg.inv(self.mass_matrix).astype(float)
        return -inverse @ np.hstack([e.T @ tension, p.T]), np.pad(tension, ((0, 0), (0, len(p))))

    def _row(self, name: ResponseName, motion: Real, tension: Real) -> Real:
        """Return a response (c,) by the columns of `_motion`; ValueError if the plant does not have it."""
        if point := _point_of(name):
            return np.asarray(self.shape(point) @ motion)
        checks.one_of("response", name, self.meanings)
        kind, where = self.meanings[str(name)]
        if kind == "jerk":
            raise ValueError(f"response must be one of a plant, of closed(responses=[...]) a jerk too, got {name}")
        n, r, columns = len(motion), len(self.roads), np.eye(motion.shape[1])
        displacement, velocity, x, x_rate = np.split(columns[: 2 * (n + r)], [n, 2 * n, 2 * n + r])
        if kind in ("displacement", "velocity", "acceleration"):
            moved = {"displacement": displacement, "velocity": velocity, "acceleration": motion}[kind]
            return np.asarray(self.shape(where) @ moved)
        if kind == "load":
            tyre = sum(tension[i] for i, link in enumerate(self.tyres) if link.name == where)
            return np.asarray(tyre + self.standing[list(self.contacts).index(str(where))] @ columns[2 * (n + r) :])
        links = self.struts if kind in ("travel", "travel_rate", "strut_force") else self.tyres
        index = [link.name for link in links].index(str(where))
        if kind == "strut_force":
            return columns[index - len(self.struts)]
        by_coordinate, by_road = self.elongations(links)
        moved, road = (velocity, x_rate) if kind == "travel_rate" else (displacement, x)
        return np.asarray(by_coordinate[index] @ moved + by_road[index] @ road)

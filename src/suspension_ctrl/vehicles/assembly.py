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

Position = tuple[float, float]
"""A point (x, y) of the body [m]."""

ResponseName = str | tuple[str, float, float]
"""One of a vehicle's named responses, or ``("acceleration", x, y)``, vertical, at a point of the body."""

End = str | Position | None
"""Where a link ends: a coordinate or a road by name, a point of the body, or the inertial frame."""

GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2]."""

_RESERVED = ("responses", "road", "speed")
"""Keywords of functions that take struts by name."""
_SAME_PLACE = 1e-3  # m
_NONE: FrozenMapping[Any, Any] = FrozenMapping({})


def label(response: ResponseName) -> str:
    """Return the name of a response as a signal of python-control, without dots."""
    if isinstance(response, str):
        return response
    return "acceleration_at_{}_{}_mm".format(*(round(1e3 * x) for x in response[1:]))


def joined(*parts: str) -> str:
    """Return the parts that are not empty, joined by underscores."""
    return "_".join(part for part in parts if part)


def check_strut_names(parameter: str, names: Iterable[str]) -> None:
    """Raise ValueError if a strut has the name of another keyword."""
    for name in names:
        if name in _RESERVED:
            raise ValueError(f"{parameter} must not be called {', '.join(_RESERVED)}, got {name!r}")


class Link(NamedTuple):
    """A spring [N/m] and a damper [N s/m] in parallel between two ends; of a strut only the ends count."""

    name: str
    lower: End
    upper: End
    stiffness: float = 0.0
    damping: float = 0.0


class Response(NamedTuple):
    """The ``acceleration`` of an end, ``travel`` of a strut or ``load`` of a tyre; ``signal``: of unknown kind."""

    kind: str
    where: End


@dataclass(frozen=True, eq=False, repr=False)
class StrutParameter(Record):
    """A coefficient of the struts; required if it has no default.

    The gain (q, q) is the tension of each strut by deflection of each (`order` 0), its rate (1) or its second
    derivative (2, inerters and masses), at a coefficient of 1.
    """

    name: str
    unit: str
    gain: Real
    order: int
    default: float | None = None

    def __post_init__(self) -> None:
        self._keep(gain=frozen_array(self.gain))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Assembly(Record):
    """The masses and links of a vehicle.

    Parameters
    ----------
    masses : mapping of str to float
        Coordinates that move vertically, and their masses [kg]; ``body`` is the body's centre of gravity.
    inertias : mapping of str to float
        The others: ``pitch`` and ``roll`` [kg m^2] and elastic modes, of modal mass 1 [-].
    contacts : mapping of str to Position
        By tyre, the point where it touches its road, ``<tyre>_road``.
    tyres, struts : sequence of Link
        A tyre from its road to a wheel, in the order of `contacts`.
    parameters : sequence of StrutParameter
    responses : mapping of str to Response
    supports : sequence of Link
        Further springs and dampers that no design changes.
    bending : mapping of Position to mapping of str to float
        By point of the body, the share of each elastic mode in its displacement [kg^-1/2]; empty if rigid.
    payload : sequence of (float, Position)
        Masses fixed to points of the body [kg].

    Raises
    ------
    ValueError
        If tyres and contacts differ, a strut has the name of a keyword, or mode shapes at a strut or a payload
        are unknown.
    """

    masses: Mapping[str, float] = field(metadata=unit("kg"))
    inertias: Mapping[str, float] = _NONE
    contacts: Mapping[str, Position] = field(metadata=unit("m"))
    tyres: tuple[Link, ...]
    struts: tuple[Link, ...]
    parameters: tuple[StrutParameter, ...]
    responses: Mapping[str, Response]
    supports: tuple[Link, ...] = ()
    bending: Mapping[Position, Mapping[str, float]] = _NONE
    payload: tuple[tuple[float, Position], ...] = ()

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            self._keep(**{name: FrozenMapping(value) if isinstance(value, Mapping) else tuple(value)})
        if [tyre[:2] for tyre in self.tyres] != list(zip(self.contacts, self.roads, strict=True)):
            raise ValueError(f"tyres must be {', '.join(self.contacts)}, each from its road, got {self.tyres}")
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

        With coordinates z and roads x, links of stiffness k and damping c that are E z + R x longer, and struts
        under tensions F that are P z longer, the masses M move by
        ``M z'' = -E^T (k (E z + R x) + c (E z' + R x')) - P^T F``.
        ValueError if a response is unknown, or given twice.
        """
        n, r, q = len(self.coordinates), len(self.roads), len(self.struts)
        motion, tension = self._motion()
        rows = {label(name): self._row(name, motion, tension) for name in responses}
        if len(rows) < len(responses):
            raise ValueError(f"responses must differ, points by a millimetre or more, got {list(responses)}")
        p, _ = self.elongations(self.struts)
        z, rate = np.eye(n, 2 * n + 2 * r + q), np.eye(n, 2 * n + 2 * r + q, n)
        moved, read = np.vstack([rate, motion]), np.vstack([*rows.values(), p @ z, p @ rate])
        damped = tension[: len(self.tyres), 2 * n + r : 2 * n + 2 * r].any()
        kept = np.delete(np.arange(2 * n, 2 * n + 2 * r + q), [] if damped else slice(r, 2 * r))
        states = np.arange(2 * n).reshape(2, n).T.ravel()  # a coordinate and its rate beside each other
        names = [strut.name for strut in self.struts]
        return control.ss(
            moved[np.ix_(states, states)],
            moved[np.ix_(states, kept)],
            read[:, states],
            read[:, kept],
            states=[f"{z}_{what}" for z in self.coordinates for what in ("displacement", "velocity")],
            inputs=[
                *self.roads,
                *(f"{road}_rate" for road in self.roads if damped),
                *(joined(strut, "strut") for strut in names),
            ],
            outputs=[*rows, *(joined(name, end) for end in ("deflection", "deflection_rate") for name in names)],
            name="plant",
        )

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
        """Return a response (c,) by the columns of `_motion`; ValueError if the vehicle does not have it."""
        if isinstance(name, tuple) and len(name) == 3 and name[0] == "acceleration":
            return np.asarray(self.shape((float(name[1]), float(name[2]))) @ motion)
        checks.one_of("response", name, self.responses)
        kind, where = self.responses[str(name)]
        if kind == "acceleration":
            return np.asarray(self.shape(where) @ motion)
        if kind == "load":
            return tension[[tyre.name for tyre in self.tyres].index(str(where))]
        strut = self.struts[[strut.name for strut in self.struts].index(str(where))]
        return np.pad(self.elongations([strut])[0][0], (0, motion.shape[1] - len(motion)))

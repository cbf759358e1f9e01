"""Vehicles of rigid bodies: trucks with trailers, cabs on mounts, axles, walking beams.

The parts stand at places (x, y) in the axes of the vehicle, x forward and y to the left. A part between two bodies
joins the points that both have at its place.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from .. import checks
from ..quantities import Checked
from .assembly import (
    Assembly,
    End,
    Link,
    Network,
    Position,
    Response,
    StrutCoefficient,
    joined,
    point_of,
    turning,
)
from .body_parts import (
    PARTS,
    AntiRollBar,
    Between,
    BodyPoint,
    Joint,
    RigidBody,
    Support,
    Suspension,
    Wheel,
)
from .elements import Damper, Spring
from .networks import placed
from .struts import Strut, parallel
from .vehicle import AssembledVehicle, anti_roll_bar

GROUND = "ground"
"""Name of the inertial frame."""


def _names(parts: Sequence[RigidBody | Wheel | Between | Joint | AntiRollBar | BodyPoint]) -> str:
    """Return the names of parts, for the repr."""
    return f"({', '.join(str(getattr(part, 'name', '')) or part.__class__.__name__ for part in parts)})"


_NAMED = {"show": _names}
_SPRING_AND_DAMPER = parallel(Spring(), Damper())
_PLACE = (0.0, 0.0)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RigidBodies(Checked, AssembledVehicle):
    """A vehicle of rigid bodies, wheels, struts and joints, in axes x forward and y to the left.

    The bodies heave, pitch and roll. Joints are exact: a coordinate less for each. One of the bodies may be called
    ``body``: seats, payload and points of acceleration stand on it by default.

    Parameters
    ----------
    bodies : sequence of RigidBody
        Bodies, and masses that do not turn.
    wheels : sequence of Wheel
        Contacts with the road, with a mass of their own or on a body.
    suspensions : sequence of Suspension
        Struts with their places.
    supports : sequence of Support
        Springs and dampers of constant values.
    joints : sequence of Joint
        Pins and fifth wheels.
    anti_roll_bars : sequence of AntiRollBar
        Bars between two struts.
    points : sequence of BodyPoint
        Points of acceleration.

    Raises
    ------
    ValueError
        If a name is given twice or unknown, a strut has no ends, or a body without mass is free.

    Examples
    --------
    A tractor and a trailer in their plane; the fifth wheel carries the trailer's front:

    >>> import suspension_ctrl as sc
    >>> from suspension_ctrl.vehicles import body_parts as parts
    >>> truck = sc.RigidBodies(
    ...     bodies=[
    ...         parts.RigidBody(mass=6e3, pitch_inertia=12e3),
    ...         parts.RigidBody(name="trailer", mass=20e3, pitch_inertia=150e3, position=(-7.0, 0.0)),
    ...     ],
    ...     wheels=[
    ...         parts.Wheel(name="front", position=(1.3, 0.0), mass=600.0, tyre_stiffness=1.8e6),
    ...         parts.Wheel(name="rear", position=(-2.3, 0.0), mass=1000.0, tyre_stiffness=3.6e6),
    ...         parts.Wheel(name="trailer", position=(-10.0, 0.0), mass=1500.0, tyre_stiffness=6e6),
    ...     ],
    ...     suspensions=[
    ...         parts.Suspension(name="front"),
    ...         parts.Suspension(name="rear"),
    ...         parts.Suspension(name="trailer", upper="trailer"),
    ...     ],
    ...     joints=[parts.Joint(lower="body", upper="trailer", position=(-1.8, 0.0))],
    ... )
    >>> setting = {"front": (400e3, 10e3), "rear": (1e6, 20e3), "trailer": (2e6, 40e3)}
    >>> table = sc.ride(truck, setting, sc.Iso8608Road("B"), speed=20.0, measures=["ACC", "ACC trailer"])
    >>> table["value"].head(2).round(2).to_list()
    [0.44, 0.45]
    """

    bodies: tuple[RigidBody, ...] = field(metadata=_NAMED)
    wheels: tuple[Wheel, ...] = field(metadata=_NAMED)
    suspensions: tuple[Suspension, ...] = field(metadata=_NAMED)
    supports: tuple[Support, ...] = field(default=(), metadata=_NAMED)
    joints: tuple[Joint, ...] = field(default=(), metadata=_NAMED)
    anti_roll_bars: tuple[AntiRollBar, ...] = field(default=(), metadata=_NAMED)
    points: tuple[BodyPoint, ...] = field(default=(), metadata=_NAMED)

    def __post_init__(self) -> None:
        for one in self._fields():
            parts, kind = getattr(self, one.name), PARTS[one.name]
            if not (isinstance(parts, Sequence) and all(isinstance(part, kind) for part in parts)):
                raise ValueError(f"{one.name} must be a list of {kind.__name__}, got {checks.shown(parts)}")
            self._keep(**{one.name: tuple(parts)})
        _check_distinct(self)
        _ = self.assembly  # parts that do not fit are refused here

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        wheels = {joined(one.name, "wheel"): one.mass for one in self.wheels if one.mass is not None}
        inertias = {name: value for body in self.bodies for name, value in body.inertias.items()}
        coefficients, networks = self._coefficients()
        assembly = Assembly(
            masses={body.name: body.mass for body in self.bodies} | wheels,
            inertias=inertias,
            contacts={one.name: one.position for one in self.wheels},
            tyres=tuple(self._tyre(one) for one in self.wheels if one.tyre_stiffness is not None),
            struts=tuple(self._strut(i, one) for i, one in enumerate(self.suspensions, start=1)),
            strut_coefficients=coefficients,
            networks=networks,
            responses=self._responses(inertias),
            supports=tuple(self._support(i, one) for i, one in enumerate(self.supports, start=1)),
            joints=tuple(pair for i, one in enumerate(self.joints, start=1) for pair in self._pairs(i, one)),
        )
        _check_masses(assembly)
        return assembly

    def _end(self, key: str, name: str, position: Position) -> End:
        """Return the point of a body at a place, a wheel or the inertial frame; ValueError naming the key."""
        bodies = {body.name: body for body in self.bodies}
        wheels = [joined(one.name, "wheel") for one in self.wheels if one.mass is not None]
        if name == GROUND:
            return None
        checks.one_of(key, name, (*bodies, *wheels, GROUND))
        if name in wheels:
            return name
        (x, y), body = bodies[name].position, bodies[name]
        return point_of(name, (position[0] - x, position[1] - y)) if body.inertias else name

    def _tyre(self, wheel: Wheel) -> Link:
        end = self._end("carrier", wheel.upper, wheel.position)
        return Link(
            wheel.name, joined(wheel.name, "road"), end, float(wheel.tyre_stiffness or 0.0), wheel.tyre_damping
        )

    def _strut(self, number: int, one: Suspension) -> Link:
        """Return a strut, by default over the wheel of its name."""
        key, place = f"suspensions[{number}]", self._place(one)
        roads = [joined(wheel.name, "road") for wheel in self.wheels]
        name = one.lower or next((wheel.upper for wheel in self.wheels if wheel.name == one.name), "")
        if not name:
            raise ValueError(f"{key}.lower must be given where no wheel has the name of the strut, got none")
        lower = name if name in roads else self._end(f"{key}.lower", name, place)
        return Link(one.name, lower, self._end(f"{key}.upper", one.upper, place))

    def _place(self, one: Suspension) -> Position:
        """Return the place (x, y) of a strut, by default that of the wheel of its name [m]."""
        if one.position is not None:
            return one.position
        return next((wheel.position for wheel in self.wheels if wheel.name == one.name), _PLACE)

    def _support(self, number: int, one: Support) -> Link:
        key, place = f"supports[{number}]", one.position or _PLACE
        lower, upper = (self._end(f"{key}.{which}", getattr(one, which), place) for which in ("lower", "upper"))
        return Link(one.name, lower, upper, one.stiffness, one.damping)

    def _pairs(self, number: int, one: Joint) -> Iterator[tuple[End, End]]:
        """Yield the ends of equal displacement of a joint."""
        key, names = f"joints[{number}]", (one.lower, one.upper)
        lower, upper = (
            self._end(f"{key}.{w}", name, one.position) for w, name in zip(("lower", "upper"), names, strict=True)
        )
        yield lower, upper
        if one.roll:
            rolls = [turning(name, "roll") for name in names]
            rolling = [name for body in self.bodies for name in body.inertias]
            if not set(rolls) <= set(rolling):
                raise ValueError(f"{key}.roll must be of two bodies that roll, got {', '.join(names)}")
            yield rolls[0], rolls[1]

    def _coefficients(self) -> tuple[tuple[StrutCoefficient, ...], tuple[Network, ...]]:
        """Return coefficients and networks of the struts, then of anti-roll bars."""
        coefficients, networks = list[StrutCoefficient](), list[Network]()
        for prefix, strut in self._struts().items():
            own = placed(strut, prefix, [float(one.prefix == prefix) for one in self.suspensions])
            coefficients += own[0]
            networks += own[1]
        places = [one.name for one in self.suspensions]
        for i, bar in enumerate(self.anti_roll_bars, start=1):
            for name in bar.struts:
                checks.one_of(f"anti_roll_bars[{i}].struts", name, places)
            left, right = map(places.index, bar.struts)
            across = abs(self._place(self.suspensions[left])[1] - self._place(self.suspensions[right])[1])
            checks.positive(f"anti_roll_bars[{i}].struts, distance across", across, "m")
            difference = np.zeros(len(places))
            difference[[left, right]] = 1.0, -1.0
            coefficients.append(anti_roll_bar(bar.name, difference.tolist(), across))
        return tuple(coefficients), tuple(networks)

    def _struts(self) -> Mapping[str, Strut]:
        """Return the strut by the beginning of its coefficients' names."""
        found: dict[str, Strut] = {}
        for i, one in enumerate(self.suspensions, start=1):
            if one.strut is not None and found.setdefault(one.prefix, one.strut) != one.strut:
                raise ValueError(
                    f"suspensions[{i}].strut must be that of others with coefficients {one.prefix}, got another"
                )
        return {one.prefix: found.get(one.prefix, _SPRING_AND_DAMPER) for one in self.suspensions}

    def _responses(self, inertias: Mapping[str, float]) -> Mapping[str, Response]:
        """Return the responses of `responses`: accelerations of bodies and points, travels and tyre loads."""
        where: dict[str, End] = {name: name for name in (*(body.name for body in self.bodies), *inertias)}
        where |= {
            one.name: self._end(f"points[{i}].body", one.body, one.position)
            for i, one in enumerate(self.points, start=1)
        }
        accelerations = {f"{name}_acceleration": Response("acceleration", end) for name, end in where.items()}
        travels = [one.name for one in self.suspensions]
        return (
            accelerations
            | {joined(name, "suspension_travel"): Response("travel", name) for name in travels}
            | {joined(one.name, "tyre_load"): Response("load", one.name) for one in self.wheels}
        )


def _check_distinct(vehicle: RigidBodies) -> None:
    """Raise ValueError if two parts have one name."""
    movements = [
        *(name for body in vehicle.bodies for name in (body.name, *body.inertias)),
        *(joined(one.name, what) for one in vehicle.wheels for what in ("wheel", "road")),
        *(one.name for one in vehicle.points),
        GROUND,
    ]
    struts = [one.name for one in vehicle.suspensions]
    bars = [*{one.prefix for one in vehicle.suspensions}, *(bar.name for bar in vehicle.anti_roll_bars)]
    for kind, names in (("bodies, wheels and points", movements), ("suspensions", struts), ("coefficients", bars)):
        if twice := [name for name in names if names.count(name) > 1]:
            raise ValueError(f"{kind} must have names of their own, got {checks.shown(twice[0])} twice")
    for name, parts in (("bodies", vehicle.bodies), ("wheels", vehicle.wheels), ("suspensions", struts)):
        if not parts:
            raise ValueError(f"{name} must be one or more, got none")


def _check_masses(assembly: Assembly) -> None:
    """Raise ValueError if a coordinate has no inertia."""
    try:
        np.linalg.cholesky(assembly.mass_matrix)
    except np.linalg.LinAlgError:
        free = [name for name, value in zip(assembly.movements, assembly.inertia, strict=True) if value == 0]
        names = checks.listing(one for one in free if one in assembly.coordinates) or checks.listing(free)
        raise ValueError(
            f"bodies must have mass and inertia where no joint moves them, got 0 of {names}"
        ) from None

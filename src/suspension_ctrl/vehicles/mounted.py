"""What can be put on a vehicle: seats with their occupants, payload, and elastic modes of the body."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import checks
from .assembly import Assembly, Link, Position, Response
from .vehicle import Car, Vehicle, spring_and_damper


class Part(ABC):
    """Something that can be put on a vehicle."""

    @abstractmethod
    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this part on it."""

    def on(self, vehicle: Vehicle) -> "Mounted":
        """Return the vehicle with this part on it."""
        return Mounted(vehicle=vehicle, part=self)


@dataclass(frozen=True, kw_only=True)
class Mounted(Car):
    """A vehicle with a part on it.

    Parameters
    ----------
    vehicle : Vehicle
    part : Seat, Payload or FlexibleBody
    """

    vehicle: Vehicle
    part: Part

    def __post_init__(self) -> None:
        assembly = self.assembly()
        assembly.elongations(assembly.struts)  # whether a body that bends has shapes at each,
        assembly.mass_matrix()  # and where loads lie

    def assembly(self) -> Assembly:
        """Return the vehicle taken apart."""
        return self.part.added_to(self.vehicle.assembly())


@dataclass(frozen=True, kw_only=True)
class Seat(Part):
    """A seat with its occupant: a mass on a spring and a damper of its own, on any vehicle.

    Its responses are ``<name>_acceleration`` and ``<name>_suspension_travel``; ``<name>.spring`` and
    ``<name>.damper`` are coefficients like those of other struts, with these values where they are not given.

    Parameters
    ----------
    mass : float
        Of the occupant and the moving part of the seat [kg].
    spring : float
        Stiffness [N/m].
    damper : float
        Damping coefficient [N s/m].
    position : (float, float)
        Where it stands from the body's centre of gravity, x forward and y to the left [m]; what a vehicle does
        not do, as a half car does not roll, makes no difference there.
    name : str
        By which several seats are told apart: letters, digits and underscores.

    Raises
    ------
    ValueError
        If a parameter is out of range, or the vehicle has something of that name already or bends in a way that
        is not known where the seat stands.
    """

    mass: float
    spring: float
    damper: float
    position: Position = (0.0, 0.0)
    name: str = "seat"

    def __post_init__(self) -> None:
        checks.positive("mass", self.mass, "kg")
        checks.positive("spring", self.spring, "N/m")
        checks.positive("damper", self.damper, "N s/m")
        checks.position("position", self.position)
        if not (isinstance(self.name, str) and self.name.isidentifier()):
            raise ValueError(f"name must be of letters, digits and underscores, got {self.name!r}")

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this seat."""
        coefficients = (parameter.name.split(".")[0] for parameter in assembly.parameters)
        struts = (strut.name for strut in assembly.struts)
        if self.name in {"pitch", "roll", *assembly.coordinates, *assembly.contacts, *struts, *coefficients}:
            raise ValueError(f"name must be one that the vehicle does not have yet, got {self.name!r}")
        others = len(assembly.struts)
        parameters = [p._replace(gain=np.pad(p.gain, (0, 1))) for p in assembly.parameters]
        own = spring_and_damper(self.name, [0.0] * others + [1.0], (self.spring, self.damper))
        seated = replace(
            assembly,
            masses={**assembly.masses, self.name: self.mass},
            struts=[*assembly.struts, Link(self.name, self.position, self.name)],
            parameters=[*parameters, *own],
            responses={
                **assembly.responses,
                f"{self.name}_acceleration": Response("acceleration", self.name),
                f"{self.name}_suspension_travel": Response("travel", self.name),
            },
        )
        seated.elongations(seated.struts)  # whether there is a shape where it stands
        return seated


@dataclass(frozen=True, kw_only=True)
class Payload(Part):
    """A load fixed to the body.

    Parameters
    ----------
    mass : float
        [kg].
    position : (float, float)
        Where it lies from the body's centre of gravity without it, x forward and y to the left [m]. Coordinates
        stay those of that point.

    Raises
    ------
    ValueError
        If the mass is not finite and above zero, or the position is not two numbers.
    """

    mass: float
    position: Position = (0.0, 0.0)

    def __post_init__(self) -> None:
        checks.positive("mass", self.mass, "kg")
        checks.position("position", self.position)

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this load."""
        return replace(assembly, payload=[*assembly.payload, (self.mass, self.position)])


@dataclass(frozen=True, kw_only=True)
class FlexibleBody(Part):
    """Elastic modes of a free body, beside its rigid motion; put it on a vehicle before seats.

    Parameters
    ----------
    frequencies : (k,) sequence of float
        Natural frequencies [Hz].
    damping_ratios : (k,) sequence of float
        [-].
    shapes : mapping of (float, float) to (k,) sequence of float
        By point of the body, x forward and y to the left of its centre of gravity [m], the vertical displacement
        in each mode at a modal mass of 1 [kg^-1/2]: at all struts, and wherever else a seat is to stand, a load to
        lie or an acceleration to be known. Elastic modes of a free body leave its centre of gravity and its
        principal axes in their places, so that the rigid coordinates stay those of the mean motion.

    Raises
    ------
    ValueError
        If the parts do not fit together, a frequency is not above zero or a damping ratio not from 0 to 1; from
        `on`, if the vehicle bends already or a strut stands where no shapes are given.
    """

    frequencies: Sequence[float]
    damping_ratios: Sequence[float]
    shapes: Mapping[Position, Sequence[float]]

    def __post_init__(self) -> None:
        modes = len(self.frequencies)
        for frequency in self.frequencies:
            checks.positive("frequencies", frequency, "Hz")
        for ratio in self.damping_ratios:
            checks.within("damping_ratios", ratio, 0, 1)
        for position, shape in self.shapes.items():
            checks.position("shapes", position)
            if len(shape) != modes or not np.isfinite(shape).all():
                raise ValueError(
                    f"shapes must be {modes} finite numbers at each point, got {shape!r} at {position}"
                )
        if modes == 0 or len(self.damping_ratios) != modes:
            raise ValueError(
                f"frequencies and damping_ratios must be of one length, 1 or more, got {modes} and "
                f"{len(self.damping_ratios)}"
            )

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with a body that bends like this."""
        if assembly.bending:
            raise ValueError(f"vehicle must have a rigid body, got one with modes at {list(assembly.bending)}")
        names = [f"bending_{i + 1}" for i in range(len(self.frequencies))]
        if taken := set(names) & set(assembly.coordinates):
            raise ValueError(f"vehicle must have nothing called {', '.join(names)}, got {', '.join(taken)}")
        omega = 2 * np.pi * np.asarray(self.frequencies, dtype=float)
        damping = 2 * omega * np.asarray(self.damping_ratios, dtype=float)
        return replace(
            assembly,
            inertias={**assembly.inertias, **dict.fromkeys(names, 1.0)},
            supports=[
                *assembly.supports,
                *(Link(name, None, name, w**2, c) for name, w, c in zip(names, omega, damping, strict=True)),
            ],
            bending={place: dict(zip(names, shape, strict=True)) for place, shape in self.shapes.items()},
        )

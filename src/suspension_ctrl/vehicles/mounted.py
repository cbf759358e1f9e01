"""Parts on a vehicle: seats with their occupants, payload, and elastic modes of the body."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from .. import checks
from ..quantities import Checked, FrozenMapping, Record, unit
from .assembly import Assembly, Link, Position, Response, check_strut_names, point_of
from .elements import Damper, Spring
from .networks import placed
from .strut_files import STRUT
from .struts import Strut, parallel
from .vehicle import AssembledVehicle, Vehicle, assembled


class Part(Checked, ABC):
    """A part for a vehicle."""

    @abstractmethod
    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this part on it; ValueError if the part does not fit."""

    def on(self, vehicle: Vehicle) -> "Mounted":
        """Return the vehicle with this part on it; ValueError if the part does not fit."""
        return Mounted(vehicle=assembled(vehicle), part=self)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Mounted(Record, AssembledVehicle):
    """A vehicle with a seat, a payload or a flexible body."""

    vehicle: AssembledVehicle
    part: Part

    def __post_init__(self) -> None:
        _ = self.assembly  # a part that does not fit is refused here

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        return self.part.added_to(self.vehicle.assembly)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Seat(Part):
    """A seat with its occupant: a mass on a spring and a damper of its own, on any vehicle or on another seat.

    Its responses are ``<name>_acceleration`` and ``<name>_suspension_travel``, that of the floor below it
    ``<name>_floor_acceleration``; ``<name>.spring`` and ``<name>.damper`` are coefficients of a strut, with these
    values as defaults.

    Parameters
    ----------
    mass : float
        Occupant and moving part of the seat, > 0 [kg].
    spring, damper : float
        Stiffness [N/m] and damping coefficient [N s/m], > 0.
    strut : Strut, optional
        In place of spring and damper.
    position : (float, float)
        Place from the body's centre of gravity, x forward and y to the left [m]; on a flexible body one with known
        mode shapes.
    name : str
        Letters, digits and underscores; none that the vehicle has already.
    stands_on : str
        Body, or seat, by name.

    Examples
    --------
    A seat isolates above its own resonance. Weighted acceleration of the floor under the driver, and of the
    driver:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> seat = sc.Seat(mass=75.0, spring=15.7e3, damper=650.0, position=(0.2, 0.4), name="driver")
    >>> table = sc.ride(
    ...     seat.on(file.vehicle),
    ...     file.setting,
    ...     sc.Iso8608Road("C"),
    ...     speed=20.0,
    ...     measures=["ACC (0.2, 0.4)", "ACC driver"],
    ... )
    >>> print(table["value"].head(2).round(2).to_list(), table["unit"].iloc[0])
    [0.82, 0.35] m/s^2
    """

    mass: float = field(metadata=unit("kg"))
    spring: float | None = field(default=None, metadata={**unit("N/m"), "instead": "strut"})
    damper: float | None = field(default=None, metadata={**unit("N s/m"), "instead": "strut"})
    position: Position = field(default=(0.0, 0.0), metadata=unit("m"))
    name: str = "seat"
    strut: Strut | None = field(default=None, metadata=STRUT)
    stands_on: str = "body"

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(position=checks.position("position", self.position))
        if not (isinstance(self.name, str) and self.name.isidentifier()):
            raise ValueError(f"name must be of letters, digits and underscores, got {checks.shown(self.name)}")
        check_strut_names("name", [self.name])
        for name, text in (("spring", "N/m"), ("damper", "N s/m")):
            if self.strut is None:
                checks.positive(name, getattr(self, name), text)
            elif getattr(self, name) is not None:
                raise ValueError(f"{name} must be part of the strut if there is one, got {getattr(self, name)}")

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this seat on it."""
        coefficients = (one.name.split(".")[0] for one in assembly.strut_coefficients)
        struts = [strut.name for strut in assembly.struts]
        checks.one_of("stands_on", self.stands_on, assembly.masses)
        if self.name in {"pitch", "roll", *assembly.movements, *assembly.roads, *struts, *coefficients}:
            raise ValueError(f"name must be one that the vehicle does not have yet, got {checks.shown(self.name)}")
        padded = [replace(p, gain=np.pad(p.gain, (0, 1))) for p in assembly.strut_coefficients]
        strut = self.strut or parallel(Spring(value=self.spring), Damper(value=self.damper))
        own, networks = placed(strut, self.name, [*[0.0] * len(struts), 1.0])
        others = (one._replace(share=(*one.share, 0.0)) for one in assembly.networks)
        kinds = {"acceleration": "acceleration", "suspension_travel": "travel"}
        responses = {f"{self.name}_{what}": Response(kind, self.name) for what, kind in kinds.items()}
        return replace(
            assembly,
            masses={**assembly.masses, self.name: self.mass},
            struts=(*assembly.struts, Link(self.name, point_of(self.stands_on, self.position), self.name)),
            strut_coefficients=(*padded, *own),
            networks=(*others, *networks),
            responses={**assembly.responses, **responses},
        )


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Payload(Part):
    """A load fixed to the body.

    Parameters
    ----------
    mass : float
        Above zero [kg].
    position : (float, float)
        Place from the centre of gravity of the unladen body, x forward and y to the left [m]; coordinates of the
        body stay those of this point.
    stands_on : str
        Body by name.

    Examples
    --------
    A load of 250 kg near the rear axle lowers the frequencies of the body:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("minaker_half")
    >>> laden = sc.Payload(mass=250.0, position=(-1.5, 0.0)).on(file.vehicle)
    >>> for vehicle in (file.vehicle, laden):
    ...     print(vehicle.modes(file.setting)["frequency [Hz]"].head(2).round(2).to_list())  # heave, pitch
    [0.89, 1.12]
    [0.89, 0.98]
    """

    mass: float = field(metadata=unit("kg"))
    position: Position = field(default=(0.0, 0.0), metadata=unit("m"))
    stands_on: str = "body"

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(position=checks.position("position", self.position))

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this load on it."""
        checks.one_of("stands_on", self.stands_on, assembly.masses)
        place = point_of(self.stands_on, self.position)
        return replace(assembly, payload=(*assembly.payload, (self.mass, place)))


@dataclass(frozen=True)
class Shape:
    """Mode shapes of a point in a file.

    Parameters
    ----------
    position : (float, float)
        Place of the point from the body's centre of gravity, x forward and y to the left [m].
    shape : (k,) sequence of float
        Vertical displacement in each mode at a modal mass of 1 [kg^-1/2].
    """

    position: Position = field(metadata=unit("m"))
    shape: tuple[float, ...] = field(metadata={"key": "shape_per_sqrt_kg"})


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FlexibleBody(Part):
    """Elastic modes of a free body, beside its rigid motion; put it on a rigid vehicle before seats.

    Parameters
    ----------
    frequencies, damping_ratios : (k,) sequence of float
        Natural frequencies, > 0 [Hz], and as many damping ratios, 0 to 1 [-].
    shapes : mapping of (float, float) to (k,) sequence of float
        Vertical displacement in each mode at a modal mass of 1 [kg^-1/2], by point of the body, x forward and y
        to the left of its centre of gravity [m]: all struts, further seats, payloads and points of acceleration.
        Free elastic modes do not move the centre of gravity and the principal axes of the body: the rigid
        coordinates stay those of the mean motion.

    Examples
    --------
    A bending mode of the body at 25 Hz, its shape given at the centre of gravity and over both axles. The struts
    and tyres hardly change its frequency:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("minaker_half")
    >>> shapes = {(0.0, 0.0): (-0.02,), (1.189, 0.0): (0.025,), (-1.696, 0.0): (0.03,)}  # kg^-1/2
    >>> car = sc.FlexibleBody(frequencies=(25.0,), damping_ratios=(0.03,), shapes=shapes).on(file.vehicle)
    >>> print(car.modes(file.setting)[["name", "frequency [Hz]"]].round(1).to_string(index=False))
               name  frequency [Hz]
              heave             0.9
              pitch             1.1
    front wheel hop            13.0
     rear wheel hop            13.1
          bending 1            25.0
    """

    frequencies: tuple[float, ...] = field(metadata=unit("Hz"))
    damping_ratios: tuple[float, ...]
    shapes: Mapping[Position, tuple[float, ...]] = field(
        metadata={"unit": "kg^-1/2", "key": "shapes", "rows": Shape}
    )

    def __post_init__(self) -> None:
        modes, ratios = np.shape(self.frequencies), np.shape(self.damping_ratios)
        if modes != ratios or len(modes) != 1 or modes == (0,):
            got = f"shapes {modes} and {ratios}"
            raise ValueError(f"frequencies and damping_ratios must be of one length, 1 or more, got {got}")
        for frequency, ratio in zip(self.frequencies, self.damping_ratios, strict=True):
            checks.positive("frequencies", frequency, "Hz")
            checks.within("damping_ratios", ratio, 0, 1)
        if not isinstance(self.shapes, Mapping):
            raise ValueError(f"shapes must be a mapping of points to amplitudes, got {checks.shown(self.shapes)}")
        shapes = {checks.position("shapes", at): tuple(map(float, shape)) for at, shape in self.shapes.items()}
        for place, shape in shapes.items():
            if np.shape(shape) != modes or not np.isfinite(shape).all():
                raise ValueError(f"shapes must be {modes[0]} finite numbers at each point, got {shape} at {place}")
        frequencies, damping_ratios = (tuple(map(float, x)) for x in (self.frequencies, self.damping_ratios))
        self._keep(frequencies=frequencies, damping_ratios=damping_ratios, shapes=FrozenMapping(shapes))

    def added_to(self, assembly: Assembly) -> Assembly:
        """Return the vehicle with this flexible body."""
        if assembly.bending:
            raise ValueError(f"vehicle must have a rigid body, got one with modes at {list(assembly.bending)}")
        names = [f"bending_{i + 1}" for i in range(len(self.frequencies))]
        if taken := set(names) & set(assembly.movements):
            free, got = checks.listing(names), checks.listing(taken)
            raise ValueError(f"vehicle must have nothing called {free}, got {got}")
        omega = 2 * np.pi * np.asarray(self.frequencies, dtype=float)
        damping = 2 * omega * np.asarray(self.damping_ratios, dtype=float)
        supports = [Link(name, None, name, w**2, c) for name, w, c in zip(names, omega, damping, strict=True)]
        return replace(
            assembly,
            inertias={**assembly.inertias, **dict.fromkeys(names, 1.0)},
            supports=(*assembly.supports, *supports),
            bending={at: FrozenMapping(dict(zip(names, shape, strict=True))) for at, shape in self.shapes.items()},
        )

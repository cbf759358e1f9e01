"""Quarter, half and full car."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ..quantities import Checked, unit
from .assembly import Assembly, Link, Position, Response, StrutCoefficient
from .elements import Damper, Spring
from .feedback import System
from .networks import placed
from .strut_files import STRUT
from .struts import Strut, parallel
from .vehicle import AssembledVehicle, anti_roll_bar

SPRING_AND_DAMPER = parallel(Spring(), Damper())
"""The strut of an axle that is not given another."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class QuarterCar(Checked, AssembledVehicle):
    """Two-degree-of-freedom quarter vehicle model [1]_, equations (1) and (2).

    Parameters
    ----------
    body_mass, wheel_mass : float
        Mass of the body on this wheel, M_b, and of the wheel, M_w, above zero [kg].
    tyre_stiffness, tyre_damping : float
        Vertical stiffness, K_t, above zero [N/m], and damping of the tyre, zero or more [N s/m].
    strut : Strut
        A spring beside a damper by default; its coefficients are those of its elements.

    References
    ----------
    .. [1] T. J. Yuen and R. Ramli, "Comparison of computational efficiency of MOEA/D and NSGA-II for
       passive vehicle suspension optimization", 2010.

    Examples
    --------
    The body bounces on spring and tyre in series, the wheel hops between spring and tyre:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> print(car.modes({"spring": 22e3, "damper": 1500.0})[["name", "frequency [Hz]"]].round(2).to_string())
            name  frequency [Hz]
    0      heave            1.25
    1  wheel hop           10.94
    """

    body_mass: float = field(metadata=unit("kg"))
    wheel_mass: float = field(metadata=unit("kg"))
    tyre_stiffness: float = field(metadata=unit("N/m"))
    tyre_damping: float = field(default=0.0, metadata=unit("N s/m"))
    strut: Strut = field(default=SPRING_AND_DAMPER, metadata=STRUT)

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        coefficients, networks = placed(self.strut, "", [1.0])
        return Assembly(
            masses={"wheel": self.wheel_mass, "body": self.body_mass},
            contacts={"": (0.0, 0.0)},
            tyres=(Link("", "road", "wheel", self.tyre_stiffness, self.tyre_damping),),
            struts=(Link("", "wheel", (0.0, 0.0)),),
            strut_coefficients=tuple(coefficients),
            networks=tuple(networks),
            responses={
                "body_acceleration": Response("acceleration", "body"),
                "suspension_travel": Response("travel", ""),
                "tyre_load": Response("load", ""),
            },
        )

    def closed(self, setting: Any = None, /, *damper: Any, **others: Any) -> System:
        """Return the vehicle with its strut: ``closed(K_s, C_s)`` [N/m, N s/m], or as `Vehicle.closed`."""
        return super().closed((setting, *damper) if damper else setting, **others)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class _TwoAxleCar(Checked, AssembledVehicle):
    """A body on a front and a rear axle."""

    body_mass: float = field(metadata=unit("kg"))
    pitch_inertia: float = field(metadata=unit("kg m^2"))
    front_wheel_mass: float = field(metadata=unit("kg"))
    rear_wheel_mass: float = field(metadata=unit("kg"))
    front_tyre_stiffness: float = field(metadata=unit("N/m"))
    rear_tyre_stiffness: float = field(metadata=unit("N/m"))
    cg_to_front: float = field(metadata=unit("m"))
    cg_to_rear: float = field(metadata=unit("m"))
    front_tyre_damping: float = field(default=0.0, metadata=unit("N s/m"))
    rear_tyre_damping: float = field(default=0.0, metadata=unit("N s/m"))
    front_strut: Strut = field(default=SPRING_AND_DAMPER, metadata=STRUT)
    rear_strut: Strut = field(default=SPRING_AND_DAMPER, metadata=STRUT)

    def _assembly(
        self, corners: Mapping[str, Position], inertias: Mapping[str, float], bars: Sequence[StrutCoefficient] = ()
    ) -> Assembly:
        """Return the body on a wheel under each of its corners, named by axle and side, with anti-roll bars."""
        shares = {axle: [float(corner.startswith(axle)) for corner in corners] for axle in ("front", "rear")}
        front, rear = (placed(getattr(self, f"{axle}_strut"), axle, share) for axle, share in shares.items())
        mass, stiffness, damping = (
            {corner: float(getattr(self, f"{corner.split('_')[0]}_{what}")) for corner in corners}
            for what in ("wheel_mass", "tyre_stiffness", "tyre_damping")
        )
        wheels = {f"{corner}_wheel": mass[corner] for corner in corners}
        accelerations = {f"{name}_acceleration": Response("acceleration", name) for name in ("body", *inertias)}
        travels = {f"{corner}_suspension_travel": Response("travel", corner) for corner in corners}
        loads = {f"{corner}_tyre_load": Response("load", corner) for corner in corners}
        return Assembly(
            masses={"body": self.body_mass, **wheels},
            inertias=inertias,
            contacts=corners,
            tyres=tuple(Link(c, f"{c}_road", f"{c}_wheel", stiffness[c], damping[c]) for c in corners),
            struts=tuple(Link(corner, f"{corner}_wheel", position) for corner, position in corners.items()),
            strut_coefficients=(*front[0], *rear[0], *bars),
            networks=(*front[1], *rear[1]),
            responses=accelerations | travels | loads,
        )


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class HalfCar(_TwoAxleCar):
    """Four-degree-of-freedom half car: heave and pitch of the body, a front and a rear wheel.

    Masses and stiffnesses are those of one side of a car, or of a whole car with an axle as one wheel. All values
    are above zero, a tyre's damping zero or more.

    Parameters
    ----------
    body_mass, front_wheel_mass, rear_wheel_mass : float
        Masses of the body and of each wheel [kg].
    pitch_inertia : float
        Moment of inertia of the body about the lateral axis through its centre of gravity [kg m^2].
    front_tyre_stiffness, rear_tyre_stiffness, front_tyre_damping, rear_tyre_damping : float
        Vertical stiffness [N/m] and damping [N s/m].
    cg_to_front, cg_to_rear : float
        Distance of the axles from the centre of gravity [m].
    front_strut, rear_strut : Strut
        A spring beside a damper by default; coefficients are called ``front.spring`` and the like.

    Examples
    --------
    With a pitch inertia of mass times both distances (dynamic index 1) the axles are decoupled: the front road
    does not load the rear tyre.

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> for index in (1.0, 0.8):
    ...     car = sc.HalfCar(
    ...         body_mass=600.0,
    ...         pitch_inertia=index * 600.0 * 1.2 * 1.5,
    ...         front_wheel_mass=40.0,
    ...         rear_wheel_mass=40.0,
    ...         front_tyre_stiffness=190e3,
    ...         rear_tyre_stiffness=190e3,
    ...         cg_to_front=1.2,
    ...         cg_to_rear=1.5,
    ...     )
    ...     closed = car.closed(front=(20e3, 1500.0), rear=(22e3, 1500.0))
    ...     load = abs(closed["rear_tyre_load", "front_road"](2j * np.pi * 1.5))  # at 1.5 Hz
    ...     print(f"index {index}: {load / 1e3:.1f} N/mm")
    index 1.0: 0.0 N/mm
    index 0.8: 8.6 N/mm
    """

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        return self._assembly(
            {"front": (self.cg_to_front, 0.0), "rear": (-self.cg_to_rear, 0.0)},
            {"pitch": self.pitch_inertia},
        )


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FullCar(_TwoAxleCar):
    """Seven-degree-of-freedom full car: heave, pitch and roll of the body, four wheels; left and right are alike.

    An anti-roll bar of stiffness k [N m/rad] on an axle of track t [m] adds the tension k (z_left - z_right)/t^2
    of the travels z [m] to the left strut, and the opposite to the right strut. All values are above zero, a
    tyre's damping zero or more.

    Parameters
    ----------
    body_mass, front_wheel_mass, rear_wheel_mass : float
        Masses of the body and of one wheel [kg].
    roll_inertia, pitch_inertia : float
        Moments of inertia of the body about its longitudinal and its lateral axis [kg m^2].
    front_tyre_stiffness, rear_tyre_stiffness, front_tyre_damping, rear_tyre_damping : float
        Vertical stiffness [N/m] and damping [N s/m] of one tyre.
    cg_to_front, cg_to_rear : float
        Distance of the axles from the centre of gravity [m].
    front_track, rear_track : float
        Distance between left and right wheel [m], the centre of gravity midway. Struts stand over the wheels.
    front_strut, rear_strut : Strut
        Left and right alike; a spring beside a damper by default. Coefficients are called ``front.spring`` and the
        like.

    Examples
    --------
    An anti-roll bar acts in roll; heave and pitch keep their frequencies:

    >>> import suspension_ctrl as sc
    >>> car = sc.FullCar(
    ...     body_mass=1040.0,
    ...     roll_inertia=1180.0,
    ...     pitch_inertia=1580.0,
    ...     front_wheel_mass=53.0,
    ...     rear_wheel_mass=76.0,
    ...     front_tyre_stiffness=200e3,
    ...     rear_tyre_stiffness=200e3,
    ...     cg_to_front=1.5,
    ...     cg_to_rear=1.5,
    ...     front_track=1.8,
    ...     rear_track=1.8,
    ... )
    >>> for bar in (0.0, 25e3):  # N m/rad
    ...     modes = car.modes({"front": (10e3, 2000.0), "rear": (13e3, 2000.0), "front_antiroll": bar})
    ...     print(modes.set_index("name")["frequency [Hz]"][["heave", "roll", "pitch"]].round(2).to_dict())
    {'heave': 1.01, 'roll': 0.87, 'pitch': 1.27}
    {'heave': 1.01, 'roll': 1.1, 'pitch': 1.27}
    """

    roll_inertia: float = field(metadata=unit("kg m^2"))
    front_track: float = field(metadata=unit("m"))
    rear_track: float = field(metadata=unit("m"))

    @cached_property
    def assembly(self) -> Assembly:
        """Masses and links."""
        axles = {"front": (self.cg_to_front, self.front_track), "rear": (-self.cg_to_rear, self.rear_track)}
        sides = {"left": 0.5, "right": -0.5}
        return self._assembly(
            {f"{axle}_{side}": (x, y * t) for axle, (x, t) in axles.items() for side, y in sides.items()},
            {"roll": self.roll_inertia, "pitch": self.pitch_inertia},
            [
                anti_roll_bar("front_antiroll", [1.0, -1.0, 0.0, 0.0], self.front_track),
                anti_roll_bar("rear_antiroll", [0.0, 0.0, 1.0, -1.0], self.rear_track),
            ],
        )

"""Quarter, half and full car."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import control

from .assembly import Assembly, Link, Position, Response
from .vehicle import Car, Vehicle, anti_roll_bar, check_parameters, spring_and_damper


@dataclass(frozen=True, kw_only=True)
class QuarterCar(Vehicle):
    """Two-degree-of-freedom quarter vehicle model [1]_, equations (1) and (2).

    Parameters
    ----------
    body_mass : float
        Mass of the body on this wheel, M_b [kg].
    wheel_mass : float
        Mass of the wheel, M_w [kg].
    tyre_stiffness : float
        Vertical stiffness of the tyre, K_t [N/m].
    tyre_damping : float
        Vertical damping of the tyre [N s/m].

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero; a tyre may have no damping.

    References
    ----------
    .. [1] T. J. Yuen and R. Ramli, "Comparison of computational efficiency of MOEA/D and NSGA-II for
       passive vehicle suspension optimization", 2010.
    """

    body_mass: float
    wheel_mass: float
    tyre_stiffness: float
    tyre_damping: float = 0.0

    def __post_init__(self) -> None:
        check_parameters(self)

    def assembly(self) -> Assembly:
        """Return the vehicle taken apart."""
        return Assembly(
            masses={"wheel": self.wheel_mass, "body": self.body_mass},
            contacts={"road": (0.0, 0.0)},
            tyres=[Link("", "road", "wheel", self.tyre_stiffness, self.tyre_damping)],
            struts=[Link("", "wheel", (0.0, 0.0))],
            parameters=spring_and_damper("", [1.0]),
            responses={
                "body_acceleration": Response("acceleration", "body"),
                "suspension_travel": Response("travel", ""),
                "tyre_load": Response("load", ""),
            },
        )

    def closed(self, spring: float, damper: float) -> control.StateSpace:
        """Return the vehicle with its strut.

        Parameters
        ----------
        spring : float
            Spring stiffness K_s [N/m].
        damper : float
            Damping coefficient C_s [N s/m].

        Returns
        -------
        control.StateSpace
            From ``road`` [m] to ``body_acceleration`` [m/s^2], ``suspension_travel`` [m] and
            ``tyre_load`` [N].

        Raises
        ------
        ValueError
            If a coefficient is not finite and above zero.
        """
        return self.with_struts({"spring": spring, "damper": damper})


@dataclass(frozen=True, kw_only=True)
class HalfCar(Car):
    """Four-degree-of-freedom half car: heave and pitch of the body, a front and a rear wheel.

    Masses and stiffnesses are those of what the model stands for: one side of a car, or a whole axle to a wheel.

    Parameters
    ----------
    body_mass : float
        [kg].
    pitch_inertia : float
        Moment of inertia of the body about the lateral axis through its centre of gravity [kg m^2].
    front_wheel_mass, rear_wheel_mass : float
        [kg].
    front_tyre_stiffness, rear_tyre_stiffness : float
        Vertical stiffness [N/m].
    cg_to_front, cg_to_rear : float
        Distance of the axles from the centre of gravity [m].
    front_tyre_damping, rear_tyre_damping : float
        Vertical damping [N s/m].

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero; tyres may have no damping.
    """

    body_mass: float
    pitch_inertia: float
    front_wheel_mass: float
    rear_wheel_mass: float
    front_tyre_stiffness: float
    rear_tyre_stiffness: float
    cg_to_front: float
    cg_to_rear: float
    front_tyre_damping: float = 0.0
    rear_tyre_damping: float = 0.0

    def __post_init__(self) -> None:
        check_parameters(self)

    def assembly(self) -> Assembly:
        """Return the vehicle taken apart."""
        corners = {"front": (self.cg_to_front, 0.0), "rear": (-self.cg_to_rear, 0.0)}
        return Assembly(
            masses={
                "body": self.body_mass,
                "front_wheel": self.front_wheel_mass,
                "rear_wheel": self.rear_wheel_mass,
            },
            inertias={"pitch": self.pitch_inertia},
            parameters=[*spring_and_damper("front", [1.0, 0.0]), *spring_and_damper("rear", [0.0, 1.0])],
            **_Corners.of(self, corners, ("body", "pitch"))._asdict(),
        )


@dataclass(frozen=True, kw_only=True)
class FullCar(Car):
    """Seven-degree-of-freedom full car: heave, pitch and roll of the body, four wheels; left and right are alike.

    Parameters
    ----------
    body_mass : float
        [kg].
    roll_inertia, pitch_inertia : float
        Moments of inertia of the body about the longitudinal and the lateral axis through its centre of gravity
        [kg m^2].
    front_wheel_mass, rear_wheel_mass : float
        Mass of one wheel [kg].
    front_tyre_stiffness, rear_tyre_stiffness : float
        Vertical stiffness of one tyre [N/m].
    cg_to_front, cg_to_rear : float
        Distance of the axles from the centre of gravity [m].
    front_track, rear_track : float
        Distance between left and right wheel [m], the centre of gravity midway. Struts stand over the wheels.
    front_tyre_damping, rear_tyre_damping : float
        Vertical damping of one tyre [N s/m].

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero; tyres may have no damping.

    Notes
    -----
    An anti-roll bar of stiffness k [N m/rad] resists the difference of the travels of an axle's struts over its
    track t, an angle: it pulls with k/t^2 times that difference on the one side and pushes on the other.
    """

    body_mass: float
    roll_inertia: float
    pitch_inertia: float
    front_wheel_mass: float
    rear_wheel_mass: float
    front_tyre_stiffness: float
    rear_tyre_stiffness: float
    cg_to_front: float
    cg_to_rear: float
    front_track: float
    rear_track: float
    front_tyre_damping: float = 0.0
    rear_tyre_damping: float = 0.0

    def __post_init__(self) -> None:
        check_parameters(self)

    def assembly(self) -> Assembly:
        """Return the vehicle taken apart."""
        half = {"front": self.front_track / 2, "rear": self.rear_track / 2}
        place = {"front": self.cg_to_front, "rear": -self.cg_to_rear}
        corners = {
            f"{axle}_{side}": (place[axle], sign * half[axle])
            for axle in ("front", "rear")
            for side, sign in (("left", 1), ("right", -1))
        }
        wheels = {f"{corner}_wheel": getattr(self, f"{corner.split('_')[0]}_wheel_mass") for corner in corners}
        return Assembly(
            masses={"body": self.body_mass, **wheels},
            inertias={"roll": self.roll_inertia, "pitch": self.pitch_inertia},
            parameters=[
                *spring_and_damper("front", [1.0, 1.0, 0.0, 0.0]),
                *spring_and_damper("rear", [0.0, 0.0, 1.0, 1.0]),
                anti_roll_bar("front_antiroll", [1.0, -1.0, 0.0, 0.0], self.front_track),
                anti_roll_bar("rear_antiroll", [0.0, 0.0, 1.0, -1.0], self.rear_track),
            ],
            **_Corners.of(self, corners, ("body", "roll", "pitch"))._asdict(),
        )


class _Corners(NamedTuple):
    """What a body on a wheel at each of its corners has: parts of an `Assembly`."""

    contacts: Mapping[str, Position]
    tyres: Sequence[Link]
    struts: Sequence[Link]
    responses: Mapping[str, Response]

    @classmethod
    def of(cls, vehicle: Vehicle, corners: Mapping[str, Position], body: Sequence[str]) -> "_Corners":
        """Put wheels under the corners of a vehicle whose body has these coordinates."""

        def tyre(corner: str) -> Link:
            axle = corner.split("_")[0]
            properties = (getattr(vehicle, f"{axle}_tyre_{what}") for what in ("stiffness", "damping"))
            return Link(corner, f"{corner}_road", f"{corner}_wheel", *properties)

        return cls(
            contacts={f"{corner}_road": position for corner, position in corners.items()},
            tyres=[tyre(corner) for corner in corners],
            struts=[Link(corner, f"{corner}_wheel", position) for corner, position in corners.items()],
            responses={
                **{f"{coordinate}_acceleration": Response("acceleration", coordinate) for coordinate in body},
                **{f"{corner}_suspension_travel": Response("travel", corner) for corner in corners},
                **{f"{corner}_tyre_load": Response("load", corner) for corner in corners},
            },
        )

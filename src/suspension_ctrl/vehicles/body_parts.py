"""Parts of a vehicle of rigid bodies, see `rigid_bodies`: bodies, wheels, and what joins them."""

from dataclasses import dataclass, field

from .. import checks
from ..quantities import Checked, unit
from .assembly import Position, joined, turning, turns
from .strut_files import STRUT
from .struts import Strut

_PLACE = (0.0, 0.0)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RigidBody(Checked):
    """A rigid body, or a mass that does not turn.

    Parameters
    ----------
    name : str
        Name of its vertical motion; angles are ``<name>_pitch`` and ``<name>_roll``, of ``body`` ``pitch`` and
        ``roll``.
    mass : float
        Zero of a massless beam that joints move [kg].
    pitch_inertia, roll_inertia : float, optional
        Moments of inertia about the lateral and the longitudinal axis through the centre of gravity, zero of a
        massless beam; without one the body does not turn about this axis [kg m^2].
    position : (float, float)
        Centre of gravity [m].
    """

    name: str = "body"
    mass: float = field(metadata=unit("kg", 0.0, 1e9))
    pitch_inertia: float | None = field(default=None, metadata=unit("kg m^2", 0.0, 1e12))
    roll_inertia: float | None = field(default=None, metadata=unit("kg m^2", 0.0, 1e12))
    position: Position = field(default=_PLACE, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(position=checks.position("position", self.position))
        _check_name(self.name)
        if turns(self.name):
            raise ValueError(f"name must not end like an angle, _pitch or _roll, got {checks.shown(self.name)}")

    @property
    def inertias(self) -> dict[str, float]:
        """Moments of inertia by coordinate."""
        values = {"roll": self.roll_inertia, "pitch": self.pitch_inertia}
        return {turning(self.name, motion): float(one) for motion, one in values.items() if one is not None}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Wheel(Checked):
    """A contact with the road.

    Parameters
    ----------
    name : str
        Names are ``<name>_wheel``, ``<name>_road``, ``<name>_tyre_load``; of one wheel it may be empty.
    position : (float, float)
        Where it touches the road [m].
    mass : float, optional
        Mass of the wheel [kg].
    carrier : str, optional
        In place of a mass of its own the body, an axle or a beam, on which the tyre acts.
    tyre_stiffness : float, optional
        Vertical stiffness [N/m]; without one, and without mass and carrier, a strut stands on ``<name>_road``.
    tyre_damping : float
        Damping of the tyre [N s/m].
    """

    name: str = ""
    position: Position = field(default=_PLACE, metadata=unit("m"))
    mass: float | None = field(default=None, metadata=unit("kg"))
    carrier: str = ""
    tyre_stiffness: float | None = field(default=None, metadata=unit("N/m"))
    tyre_damping: float = field(default=0.0, metadata=unit("N s/m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(position=checks.position("position", self.position))
        if self.name:
            _check_name(self.name)
        for name, value, text in (("mass", self.mass, "kg"), ("tyre_stiffness", self.tyre_stiffness, "N/m")):
            if value is not None:
                checks.positive(name, value, text)
        if self.mass is not None and self.carrier:
            raise ValueError(f"mass must be part of the carrier if there is one, got {self.mass}")
        if (self.tyre_stiffness is None) == (self.mass is not None or bool(self.carrier)):
            got = f"{self.tyre_stiffness} with mass {self.mass} and carrier {checks.shown(self.carrier)}"
            raise ValueError(f"tyre_stiffness must stand with a mass or a carrier, or neither, got {got}")

    @property
    def upper(self) -> str:
        """Name of the mass or body on the tyre."""
        return self.carrier or joined(self.name, "wheel")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Between(Checked):
    """A part between two bodies.

    Parameters
    ----------
    name : str
        Name of the part.
    lower, upper : str
        Bodies, wheels like ``front_wheel``, ``ground``, or as the lower end a road like ``front_road``.
    position : (float, float)
        Place of the part [m].
    """

    name: str = ""
    lower: str = ""
    upper: str = "body"
    position: Position | None = field(default=None, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.position is not None:
            self._keep(position=checks.position("position", self.position))
        if self.name:
            _check_name(self.name)


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Suspension(Between):
    """A strut with its place: elements whose coefficients vary.

    Parameters
    ----------
    name : str
        Names are ``<name>_suspension_travel``, ``<name>_strut_force``; a strut over a wheel has its name.
    lower, upper : str
        Bodies, wheels like ``front_wheel``, ``ground``, or as the lower end a road like ``front_road``; by default
        the wheel of this name, or its carrier, and ``body``.
    position : (float, float), optional
        Place of the strut; that of the wheel by default [m].
    coefficients : str
        Beginning of the names of coefficients, ``<coefficients>.spring``; struts that share it are alike. By
        default the name of the strut.
    strut : Strut, optional
        A spring beside a damper by default; of struts that share coefficients one has it, or all have the same.
    """

    coefficients: str = ""
    strut: Strut | None = field(default=None, metadata=STRUT)

    @property
    def prefix(self) -> str:
        """Beginning of the names of its coefficients."""
        return self.coefficients or self.name


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Support(Between):
    """A spring beside a damper of constant values, such as a mount of a cab.

    Parameters
    ----------
    name : str
        Name of the mount, which may be empty.
    lower, upper : str
        Bodies, wheels like ``front_wheel``, or ``ground``.
    position : (float, float), optional
        Place of the mount, the origin by default [m].
    stiffness, damping : float
        Zero or more [N/m], [N s/m].
    """

    stiffness: float = field(default=0.0, metadata=unit("N/m"))
    damping: float = field(default=0.0, metadata=unit("N s/m"))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Joint(Checked):
    """A joint of equal vertical displacement of two bodies at a place: a pin, or a fifth wheel.

    Parameters
    ----------
    lower, upper : str
        Bodies, wheels like ``front_wheel``, or ``ground``.
    position : (float, float)
        Place of the joint [m].
    roll : bool
        Whether the bodies roll together, as on a fifth wheel; they pitch freely.
    """

    lower: str
    upper: str
    position: Position = field(default=_PLACE, metadata=unit("m"))
    roll: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        self._keep(position=checks.position("position", self.position))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class AntiRollBar(Checked):
    """A torsion bar between two struts, with a coefficient of its name [N m/rad], 0 by default.

    Parameters
    ----------
    name : str
        Name of the coefficient.
    struts : (str, str)
        Names of the left and the right strut; their distance across is the length of the bar.
    """

    name: str
    struts: tuple[str, ...]

    def __post_init__(self) -> None:
        _check_name(self.name)
        checks.listed("struts", self.struts)
        if len(set(self.struts)) != 2:
            raise ValueError(f"struts must be two, left and right, got {checks.shown(self.struts)}")
        self._keep(struts=tuple(self.struts))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BodyPoint(Checked):
    """A point of a body with a response ``<name>_acceleration``.

    Parameters
    ----------
    name : str
        Name of the point, as in the measure ``ACC <name>``.
    body : str
        The body.
    position : (float, float)
        Place of the point [m].
    """

    name: str
    body: str = "body"
    position: Position = field(default=_PLACE, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        _check_name(self.name)
        self._keep(position=checks.position("position", self.position))


PARTS: dict[str, type] = {
    "bodies": RigidBody, "wheels": Wheel, "suspensions": Suspension, "supports": Support, "joints": Joint,
    "anti_roll_bars": AntiRollBar, "points": BodyPoint,
}  # fmt: skip


def _check_name(name: object) -> None:
    """Raise ValueError unless a name is an identifier."""
    if not (isinstance(name, str) and name.isidentifier()):
        raise ValueError(f"name must be of letters, digits and underscores, got {checks.shown(name)}")

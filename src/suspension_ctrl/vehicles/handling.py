"""Statics and roll of a vehicle on its struts: static tyre loads, roll gradient, load transfer, roll damping.

In steady cornering the moment m h a_y about the roll axis, h below the body's centre of gravity, and the moment of
the leaning weight roll the body. Springs, bars and tyres carry this elastic part of the lateral load transfer;
forces through the roll centres and at the wheels carry the rest (W. F. Milliken and D. L. Milliken, "Race Car
Vehicle Dynamics", SAE 1995, chapter 18).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .. import checks
from ..quantities import Checked, Real, unit
from .assembly import GRAVITY, Assembly, Network

TOPPLED = 180.0  # deg/g, roll gradient of a body that its struts and tyres do not hold upright
_AXLES, _SIDES = ("front", "rear"), ("left", "right")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RollGeometry(Checked):
    """Heights of a vehicle for cornering.

    Parameters
    ----------
    roll_arm : float
        Height of the body's centre of gravity above the roll axis, also of its occupants and payload, > 0 [m].
    front_roll_centre, rear_roll_centre, wheel_centre : float
        Height of the roll centres, -10 to 10 m, and of the centres of the wheels, > 0, above the ground [m].

    Examples
    --------
    The anti-roll bar at the front against the lean in a steady curve, in degrees per g:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> heights = sc.RollGeometry(roll_arm=0.45, front_roll_centre=0.05, rear_roll_centre=0.1, wheel_centre=0.3)
    >>> case = sc.LoadCase(vehicle=file.vehicle, road=sc.Iso8608Road("C"), speed=20.0, roll_geometry=heights)
    >>> problem = sc.RideProblem(
    ...     cases=[case],
    ...     measures=["roll_gradient", "ACC"],
    ...     bounds={"front_antiroll": (0.0, 50e3)},
    ...     struts={"front": (10e3, 2000.0), "rear": (13e3, 2000.0)},
    ... )
    >>> bars = [[0.0], [25e3], [50e3]]  # N m/rad
    >>> problem.evaluate(bars)[:, 0].round(1).tolist()
    [8.7, 5.2, 3.9]
    """

    roll_arm: float = field(metadata=unit("m"))
    front_roll_centre: float = field(metadata=unit("m", -10, 10))
    rear_roll_centre: float = field(metadata=unit("m", -10, 10))
    wheel_centre: float = field(metadata=unit("m"))


def check_roll(measure: str, assembly: Assembly) -> None:
    """Raise ValueError about a measure unless the body rolls."""
    if "roll" not in assembly.coordinates:
        coordinates = checks.listing(assembly.coordinates)
        raise ValueError(f"{measure} must be of a vehicle that rolls, got one with {coordinates}")


def check_cornering(measure: str, assembly: Assembly) -> None:
    """Raise ValueError about a measure unless the body rolls on the wheels of two axles."""
    check_roll(measure, assembly)
    corners = [f"{axle}_{side}" for axle in _AXLES for side in _SIDES]
    wheels = {f"{corner}_wheel" for corner in corners}
    if set(assembly.contacts) != set(corners) or not wheels <= set(assembly.coordinates):
        needed, got = f"tyres {', '.join(corners)} on wheels of these names", checks.listing(assembly.contacts)
        if set(assembly.contacts) == set(corners):
            got += f" on {checks.listing(sorted(assembly.unsprung)) or 'the body'}"
        raise ValueError(f"{measure} must be of a vehicle with {needed}, got tyres {got}")


def weighted_sum(weights: Real, arrays: Real) -> Real:
    """Return the sum over v (p, ...) of weights (p, v) times arrays (v, ...), for each p as if alone."""
    # A product of matrices takes sums in an order that depends on p.
    result = np.zeros((len(weights), *arrays.shape[1:]))
    for weight, array in zip(weights.T, arrays, strict=True):
        result += np.multiply.outer(weight, array)
    return result


class Lean(NamedTuple):
    """Displacements (p, n) on level ground and at 1 g to the left, each with its stiffness matrices (p, n, n)."""

    level: Real
    stiffness: Real
    displacement: Real
    leaning: Real  # minus the moment of the leaning weight


class Mechanics(NamedTuple):
    """Matrices of a vehicle with n coordinates, t tyres and v coefficients of struts.

    A spring that is a force law has its slope about the static position.
    """

    assembly: Assembly
    stiffness: Real  # (n, n), of tyres and supports
    damping: Real
    by_stiffness: Real  # (v, n, n), of the struts for coefficients of 1
    by_damping: Real
    elongation: Real  # (q, n), of each strut by coordinate
    springs: Real  # (v, q, q), tensions of the struts by their elongations, of springs for coefficients of 1
    tyre_loads: Real  # (t, n), tension of each tyre by coordinate, without struts on its road

    @classmethod
    def of(cls, assembly: Assembly) -> "Mechanics":
        """Return the matrices of a vehicle."""
        links = [*assembly.tyres, *assembly.supports]
        e, _ = assembly.elongations(links)
        p, _ = assembly.elongations(assembly.struts)
        k, c = (np.array([getattr(link, name) for link in links])[:, None] for name in ("stiffness", "damping"))
        springs, dampers = (
            np.array([one.gain * (one.order == order) for one in assembly.strut_coefficients]) for order in (0, 1)
        )
        loads = np.zeros((len(assembly.contacts), e.shape[1]))
        loads[[list(assembly.contacts).index(tyre.name) for tyre in assembly.tyres]] = (k * e)[
            : len(assembly.tyres)
        ]
        stiff, damp = (np.array([p.T @ gain @ p for gain in gains]) for gains in (springs, dampers))
        return cls(assembly, e.T @ (k * e), e.T @ (c * e), stiff, damp, p, springs, loads)

    def stiffness_of(self, coefficients: Real) -> Real:
        """Return the stiffness matrices (p, n, n) of designs with these coefficients (p, v)."""
        total, p = self.stiffness + weighted_sum(coefficients, self.by_stiffness), self.elongation
        for network, stiffness in self._networks(coefficients):
            total = total + np.multiply.outer(stiffness, p.T * network.share @ p)
        return total

    def _networks(self, coefficients: Real) -> Iterator[tuple[Network, Real]]:
        """Yield each network with its stiffness (p,)."""
        names = [one.name for one in self.assembly.strut_coefficients]
        for network in self.assembly.networks:
            own = dict(zip((name.removeprefix(network.prefix) for name in names), coefficients.T, strict=True))
            yield network, np.broadcast_to(network.strut.static_stiffness(own), len(coefficients))

    def loads(self, coefficients: Real, displacement: Real) -> Real:
        """Return the tension (p, t) on each road at displacements (p, n)."""
        loads = (self.tyre_loads @ displacement[..., None])[..., 0]
        if self.assembly.standing.any():
            loads = loads + (self.standing_loads(coefficients) @ displacement[..., None])[..., 0]
        return np.asarray(loads)

    def standing_loads(self, coefficients: Real) -> Real:
        """Return the tension (p, t, n) on each road of struts that stand on it, by coordinate."""
        struts = weighted_sum(coefficients, self.springs)
        for network, stiffness in self._networks(coefficients):
            struts = struts + np.multiply.outer(stiffness, np.diag(network.share))
        return np.asarray(self.assembly.standing @ struts @ self.elongation)

    def displacement(self, coefficients: Real, mass: Real) -> Real:
        """Return the displacement (p, n) by the weight of masses (n,) [kg, kg m] on springs alone."""
        return _sunk(self.stiffness_of(coefficients), mass)

    def static_loads(self, coefficients: Real) -> Real:
        """Return the load (p, t) of each tyre on level ground [N]."""
        return -self.loads(coefficients, self.displacement(coefficients, self.assembly.weights))

    def roll_gradient(self, coefficients: Real, geometry: RollGeometry) -> Real:
        """Return the roll angle (p,) per lateral acceleration [deg/g], at most 180: the body topples."""
        return self.roll_at(self.lean(coefficients, geometry))

    def roll_at(self, lean: Lean) -> Real:
        """Return the roll gradient (p,) of bodies that lean."""
        roll = np.degrees(lean.displacement[:, self.assembly.coordinates.index("roll")])
        topples = np.linalg.eigvalsh(lean.leaning)[:, 0] <= 0
        return np.where(topples, TOPPLED, np.minimum(roll, TOPPLED))

    def front_load_transfer(self, coefficients: Real, geometry: RollGeometry) -> Real:
        """Return the share (p,) of the front axle in the lateral load transfer [-], void if the body topples."""
        loads = self.loads(coefficients, self.lean(coefficients, geometry).displacement)
        front, rear = loads[:, self.left].T
        return front / (front + rear)

    @property
    def left(self) -> list[int]:
        """Places of the left tyres of the two axles."""
        return [list(self.assembly.contacts).index(f"{axle}_left") for axle in _AXLES]

    def roll_damping(self, coefficients: Real) -> Real:
        """Return the damping ratio (p,) of the mode with most of its kinetic energy in roll, 1 if overdamped."""
        n = len(self.assembly.coordinates)
        k = self.stiffness_of(coefficients)
        c = self.damping + weighted_sum(coefficients, self.by_damping)
        inverse = np.linalg.inv(self.assembly.mass_matrix)
        a = np.zeros((len(coefficients), 2 * n, 2 * n))
        a[:, :n, n:], a[:, n:, :n], a[:, n:, n:] = np.eye(n), -inverse @ k, -inverse @ c
        poles, vectors = np.linalg.eig(a)
        energy = np.diag(self.assembly.mass_matrix)[:, None] * np.abs(vectors[:, n:]) ** 2
        share = energy[:, self.assembly.coordinates.index("roll")] / energy.sum(axis=1)
        pole = np.take_along_axis(poles, share.argmax(axis=1)[:, None], axis=1)[:, 0]
        return np.asarray(-pole.real / np.abs(pole))

    def lean(self, coefficients: Real, geometry: RollGeometry) -> Lean:
        """Return how the body leans: its weight turns it, forces at roll centres turn the axles."""
        stiffness, roll = self.stiffness_of(coefficients), self.assembly.coordinates.index("roll")
        level = _sunk(stiffness, self.assembly.weights)
        load, by_tyre = self.cornering(geometry)
        load = load + weighted_sum(-self.loads(coefficients, level), by_tyre.T)
        leaning = stiffness.copy()
        leaning[:, roll, roll] -= self.assembly.sprung_mass * GRAVITY * geometry.roll_arm
        lean = np.asarray(np.linalg.solve(leaning, load[..., None])[..., 0], dtype=float)
        return Lean(level, stiffness, lean, leaning)

    def cornering(self, geometry: RollGeometry) -> tuple[Real, Real]:
        """Return the load (n,) on the coordinates at 1 g, and what static tyre loads add to it (n, t)."""
        coordinates, tyres = self.assembly.coordinates, list(self.assembly.contacts)
        load, by_tyre = np.zeros(len(coordinates)), np.zeros((len(coordinates), len(tyres)))
        load[coordinates.index("roll")] = self.assembly.sprung_mass * GRAVITY * geometry.roll_arm
        for axle, centre in zip(_AXLES, (geometry.front_roll_centre, geometry.rear_roll_centre), strict=True):
            corners = [f"{axle}_{side}" for side in _SIDES]
            wheels = [coordinates.index(f"{corner}_wheel") for corner in corners]
            weight = 2 * self.assembly.weights[wheels[0]] * GRAVITY
            (_, y), (_, other) = (self.assembly.contacts[corner] for corner in corners)
            for wheel, arm in zip(wheels, (y - other, other - y), strict=True):
                load[wheel] = weight * (geometry.wheel_centre - centre) / arm
                by_tyre[wheel, [tyres.index(corner) for corner in corners]] = centre / arm
        return load, by_tyre


def _sunk(stiffness: Real, mass: Real) -> Real:
    """Return the displacement (p, n) by the weight of masses (n,) on springs with matrices (p, n, n)."""
    try:
        found = np.linalg.solve(stiffness, -GRAVITY * mass[:, None])[..., 0]
    except np.linalg.LinAlgError:
        raise ValueError("struts must have a spring that carries the vehicle, got none") from None
    return np.asarray(found, dtype=float)

"""Equations of motion of masses and links, assembled into a python-control model with a port for every strut.

Axes as in ISO 8855: x forward, y to the left, z up from the centre of gravity of the body; pitch is positive nose
down, roll positive left side up. Deflections are positive in extension, forces in tension.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import control
import numpy as np
from numpy.typing import NDArray

from .. import checks

ResponseName = str | tuple[str, float, float]
"""One of a vehicle's named responses, or ``("acceleration", x, y)``, vertical, at a point of the body."""


def label(response: ResponseName) -> str:
    """Return the name of a response as a signal of python-control, which has no dots."""
    if isinstance(response, str):
        return response
    return "acceleration_at_{}_{}_mm".format(*(round(1e3 * x) for x in response[1:]))


def joined(*parts: str) -> str:
    """Return the parts that are not empty, joined by underscores."""
    return "_".join(part for part in parts if part)


Position = tuple[float, float]
"""A point (x, y) of the body [m]."""

End = str | Position | None
"""Where a link ends: a coordinate or a road by name, a point of the body, or nothing that moves."""

_SAME_PLACE = 1e-3  # m
GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2]."""


class Link(NamedTuple):
    """A spring [N/m] and a damper [N s/m] in parallel between two ends; as a strut only its ends count."""

    name: str
    lower: End
    upper: End
    stiffness: float = 0.0
    damping: float = 0.0


class StrutParameter(NamedTuple):
    """A coefficient of the struts, by name.

    Parameters
    ----------
    name, unit : str
    gain : (q, q) ndarray
        Tension of each strut by deflection of each (`order` 0) or its rate (`order` 1), at a coefficient of 1.
    order : int
    default : float, optional
        What it is where it is not given; it has to be given if None.
    """

    name: str
    unit: str
    gain: NDArray[np.float64]
    order: int
    default: float | None = None


class Response(NamedTuple):
    """What is to be known of a vehicle: ``acceleration`` of an end, ``travel`` of a strut, ``load`` of a tyre."""

    kind: str
    where: End


@dataclass(frozen=True, kw_only=True)
class Assembly:
    """A vehicle taken apart.

    Parameters
    ----------
    masses : mapping of str to float
        Coordinates that move up and down, and what weighs on them [kg]; ``body`` is the body's centre of gravity.
    inertias : mapping of str to float
        The others: ``pitch`` and ``roll`` [kg m^2] and elastic modes, whose modal mass is 1 [-].
    contacts : mapping of str to Position
        Where each road input touches the ground.
    tyres : sequence of Link
        From a road to a wheel.
    struts : sequence of Link
    parameters : sequence of StrutParameter
    responses : mapping of str to Response
    supports : sequence of Link
        Springs and dampers that no design changes, but for tyres.
    bending : mapping of Position to mapping of str to float
        By point of the body, the share of each elastic mode in its displacement [kg^-1/2]; empty if rigid.
    payload : sequence of (float, Position)
        Masses fixed to points of the body [kg].
    """

    masses: Mapping[str, float]
    inertias: Mapping[str, float] = field(default_factory=dict)
    contacts: Mapping[str, Position]
    tyres: Sequence[Link]
    struts: Sequence[Link]
    parameters: Sequence[StrutParameter]
    responses: Mapping[str, Response]
    supports: Sequence[Link] = ()
    bending: Mapping[Position, Mapping[str, float]] = field(default_factory=dict)
    payload: Sequence[tuple[float, Position]] = ()

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates."""
        return [*self.masses, *self.inertias]

    def mass_matrix(self) -> NDArray[np.float64]:
        """Return the masses and inertias (n, n) of the coordinates, payload included."""
        matrix = np.diag(np.array([*self.masses.values(), *self.inertias.values()], dtype=float))
        for mass, position in self.payload:
            matrix += mass * np.outer(self.shape(position), self.shape(position))
        return matrix

    def weights(self) -> NDArray[np.float64]:
        """Return the mass that weighs on each coordinate (n,): kg, or kg m where it turns the body."""
        weights = np.array([self.masses.get(name, 0.0) for name in self.coordinates])
        return weights + sum(
            (mass * self.shape(position) for mass, position in self.payload), np.zeros_like(weights)
        )

    def sprung_mass(self) -> float:
        """Return the mass of all that the wheels carry, payload included [kg]."""
        wheels = [tyre.upper for tyre in self.tyres]
        carried = sum(mass for name, mass in self.masses.items() if name not in wheels)
        return carried + sum(mass for mass, _ in self.payload)

    def shape(self, end: End) -> NDArray[np.float64]:
        """Return the share (n,) of each coordinate in the displacement of an end."""
        shares: Mapping[str, float] = {}
        if isinstance(end, str):
            shares = {end: 1.0}
        elif end is not None:
            shares = {"body": 1.0, "pitch": -end[0], "roll": end[1], **self._bending_at(end)}
        return np.array([shares.get(name, 0.0) for name in self.coordinates])

    def _bending_at(self, position: Position) -> Mapping[str, float]:
        if not self.bending:
            return {}
        for known, shares in self.bending.items():
            if np.hypot(known[0] - position[0], known[1] - position[1]) < _SAME_PLACE:
                return shares
        raise ValueError(f"position must be one with known mode shapes, {list(self.bending)}, got {position}")

    def elongations(self, links: Sequence[Link]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the elongation of links by unit of each coordinate (l, n) and by metre of each road (l, r)."""
        by_coordinate = [self.shape(link.upper) - self.shape(link.lower) for link in links]
        by_road = [[-float(link.lower == road) for road in self.contacts] for link in links]
        return (
            np.reshape(by_coordinate, (len(links), len(self.coordinates))),
            np.reshape(by_road, (len(links), len(self.contacts))),
        )

    def plant(self, responses: Sequence[ResponseName]) -> control.StateSpace:
        """Return the vehicle without its struts.

        With coordinates z and roads x, links of stiffness k and damping c that are E z + R x longer, and struts
        under tensions F that are P z longer, the masses M move by
        ``M z'' = -E^T (k (E z + R x) + c (E z' + R x')) - P^T F``.

        Parameters
        ----------
        responses : sequence of str or tuple
            Which responses, in which order.

        Returns
        -------
        control.StateSpace
            Inputs: roads [m], where a tyre is damped their rates [m/s], struts [N]; outputs: the responses,
            deflections [m] of the struts and their rates [m/s].

        Raises
        ------
        ValueError
            If a response is none of the vehicle's, or there twice.
        """
        links = [*self.tyres, *self.supports]
        e, road = self.elongations(links)
        p, _ = self.elongations(self.struts)
        k, c = (np.array([getattr(link, name) for link in links]) for name in ("stiffness", "damping"))
        n, r, q = len(self.coordinates), len(self.contacts), len(self.struts)
        # columns: coordinates, their rates, roads, their rates, struts
        tension = np.hstack([k[:, None] * e, c[:, None] * e, k[:, None] * road, c[:, None] * road])
        inverse = np.linalg.inv(self.mass_matrix())
        motion = -inverse @ np.hstack([e.T @ tension, p.T])
        rows = {
            "travel": np.pad(p, ((0, 0), (0, n + 2 * r + q))),
            "load": np.pad(tension[: len(self.tyres)], ((0, 0), (0, q))),
        }
        outputs = {}
        for name, (kind, where) in self.resolved(responses).items():
            if kind == "acceleration":
                outputs[label(name)] = self.shape(where) @ motion
            else:
                outputs[label(name)] = rows[kind][_index(self.struts if kind == "travel" else self.tyres, where)]
        for strut, row in zip(self.struts, p, strict=True):
            outputs[joined(strut.name, "deflection")] = np.pad(row, (0, n + 2 * r + q))
        for strut, row in zip(self.struts, p, strict=True):
            outputs[joined(strut.name, "deflection_rate")] = np.pad(row, (n, 2 * r + q))
        if len(outputs) < len(responses) + 2 * q:
            raise ValueError(f"responses must differ, points by a millimetre or more, got {list(responses)}")
        read = np.array(list(outputs.values()))
        kept = np.arange(2 * n, 2 * n + 2 * r + q)
        rates = [f"{name}_rate" for name in self.contacts]
        if not (c[:, None] * road).any():
            kept, rates = np.delete(kept, slice(r, 2 * r)), []
        states = np.arange(2 * n).reshape(2, n).T.ravel()  # a coordinate and its rate beside each other
        moved = np.vstack([np.eye(n, 2 * n + 2 * r + q, n), motion])
        return control.ss(
            moved[np.ix_(states, states)],
            moved[np.ix_(states, kept)],
            read[:, states],
            read[:, kept],
            states=[f"{z}_{what}" for z in self.coordinates for what in ("displacement", "velocity")],
            inputs=[*self.contacts, *rates, *(joined(strut.name, "strut") for strut in self.struts)],
            outputs=list(outputs),
        )

    def resolved(self, responses: Sequence[ResponseName]) -> dict[ResponseName, Response]:
        """Return what each response is; ValueError for one that the vehicle does not have."""
        found: dict[ResponseName, Response] = {}
        for name in responses:
            if isinstance(name, tuple) and len(name) == 3 and name[0] == "acceleration":
                found[name] = Response("acceleration", (float(name[1]), float(name[2])))
            else:
                checks.one_of("response", name, self.responses)
                found[name] = self.responses[str(name)]
        return found


def _index(links: Sequence[Link], where: End) -> int:
    return [link.name for link in links].index(str(where))

"""Equations of motion of masses and links as a state space with a port for every strut."""

from collections.abc import Sequence

import numpy as np

from .. import checks
from ..quantities import Real
from .assembly import Assembly, ResponseName, joined, label, response_point
from .state_matrices import StateMatrices


def plant_of(assembly: Assembly, responses: Sequence[ResponseName]) -> StateMatrices:
    """Return the vehicle without its struts; `Vehicle.plant` names the inputs and outputs.

    With coordinates z, roads x and tensions F of struts, links extend by E z + R x and struts by P z. The
    masses M move by ``M z'' = -E^T (k (E z + R x) + c (E z' + R x')) - P^T F``; of struts on a road, -S x too.
    """
    checks.listed("responses", responses)
    n, r, q = len(assembly.coordinates), len(assembly.roads), len(assembly.struts)
    motion, tension = _motion(assembly)
    rows = {label(name): _row(assembly, name, motion, tension) for name in responses}
    if len(rows) < len(responses):
        raise ValueError(
            f"responses must differ, points by a millimetre or more, got {checks.shown(list(responses))}"
        )
    p, s = assembly.elongations(assembly.struts)
    columns = np.eye(2 * n + 2 * r + q)
    z, rate, x, x_rate = np.split(columns[: 2 * (n + r)], [n, 2 * n, 2 * n + r])
    ports = p @ z + s @ x, p @ rate + s @ x_rate
    moved, read = np.vstack([rate, motion]), np.vstack([*rows.values(), *ports])
    damped = tension[: len(assembly.tyres), 2 * n + r : 2 * n + 2 * r].any() or s.any()
    kept = np.delete(np.arange(2 * n, 2 * n + 2 * r + q), [] if damped else slice(r, 2 * r))
    states = np.arange(2 * n).reshape(2, n).T.ravel()  # a coordinate and its rate beside each other
    matrices = moved[np.ix_(states, states)], moved[np.ix_(states, kept)], read[:, states], read[:, kept]
    labels = [f"{name}_{what}" for name in assembly.coordinates for what in ("displacement", "velocity")]
    rates = [f"{road}_rate" for road in assembly.roads if damped]
    inputs = [*assembly.roads, *rates, *(joined(strut.name, "strut") for strut in assembly.struts)]
    names = [joined(strut.name, end) for end in ("deflection", "deflection_rate") for strut in assembly.struts]
    return StateMatrices(*matrices, labels, inputs, [*rows, *names], "plant")


def _motion(assembly: Assembly) -> tuple[Real, Real]:
    """Accelerations (n, c) and tensions of tyres and supports (l, c) by z, z', x, x' and F, c in all."""
    links = [*assembly.tyres, *assembly.supports]
    e, road = assembly.elongations(links)
    p, _ = assembly.elongations(assembly.struts)
    k, c = (np.array([getattr(link, name) for link in links])[:, None] for name in ("stiffness", "damping"))
    tension = np.hstack([k * e, c * e, k * road, c * road])
    inverse = np.linalg.inv(assembly.mass_matrix).astype(float)
    return -inverse @ np.hstack([e.T @ tension, p.T]), np.pad(tension, ((0, 0), (0, len(p))))


def _row(assembly: Assembly, name: ResponseName, motion: Real, tension: Real) -> Real:
    """Return a response (c,) by the columns of `_motion`; ValueError if the plant does not have it."""
    if point := response_point(name):
        return np.asarray(assembly.shape(point) @ motion)
    checks.one_of("response", name, assembly.meanings)
    kind, where = assembly.meanings[str(name)]
    if kind == "jerk":
        raise ValueError(f"response must be one of a plant, of closed(responses=[...]) a jerk too, got {name}")
    n, r, columns = len(motion), len(assembly.roads), np.eye(motion.shape[1])
    displacement, velocity, x, x_rate = np.split(columns[: 2 * (n + r)], [n, 2 * n, 2 * n + r])
    if kind in ("displacement", "velocity", "acceleration"):
        moved = {"displacement": displacement, "velocity": velocity, "acceleration": motion}[kind]
        return np.asarray(assembly.shape(where) @ moved)
    if kind == "load":
        tyre = sum(tension[i] for i, link in enumerate(assembly.tyres) if link.name == where)
        return np.asarray(
            tyre + assembly.standing[list(assembly.contacts).index(str(where))] @ columns[2 * (n + r) :]
        )
    links = assembly.struts if kind in ("travel", "travel_rate", "strut_force") else assembly.tyres
    index = [link.name for link in links].index(str(where))
    if kind == "strut_force":
        return columns[index - len(assembly.struts)]
    by_coordinate, by_road = assembly.elongations(links)
    moved, road = (velocity, x_rate) if kind == "travel_rate" else (displacement, x)
    return np.asarray(by_coordinate[index] @ moved + by_road[index] @ road)

"""Equations of motion of a vehicle in time, with struts of any kind and tyres that may lift off."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import control
import numpy as np
from scipy.linalg import block_diag

from ...quantities import Integer, Real
from ...vehicles.assembly import GRAVITY, Assembly, ResponseName
from ...vehicles.handling import Mechanics
from ...vehicles.vehicle import AssembledVehicle, Vehicle
from .system import Equations


class Outputs(NamedTuple):
    """Outputs ``y = c x + d z + e z' + f F + g`` of v states, r roads, their rates and tensions of q networks."""

    c: Real  # (m, v)
    d: Real  # (m, r)
    e: Real  # (m, r)
    f: Real  # (m, q)
    g: Real  # (m,)

    def of(self, states: Real, road: Real, rate: Real, tension: Real) -> Real:
        """Return the outputs (k, m) of states (k, v), roads and rates (k, r) and tensions (k, q)."""
        return np.asarray(states @ self.c.T + road @ self.d.T + rate @ self.e.T + tension @ self.f.T + self.g)

    def rows(self, chosen: Integer) -> "Outputs":
        """Return some of the outputs."""
        return Outputs(*(matrix[chosen] for matrix in self))


class Tyres(NamedTuple):
    """The t tyres that may lift off: all or none."""

    tension: Outputs
    static: Real  # (t,), load on level ground [N]
    on_states: Real  # (v, t), effect of a tension
    on_responses: Real  # (m, t)

    @classmethod
    def none(cls, states: int, responses: int) -> "Tyres":
        """Return no tyres."""
        none = np.zeros((0, 0))
        return cls(
            Outputs(none, none, none, none, np.zeros(0)),
            np.zeros(0),
            np.zeros((states, 0)),
            np.zeros((responses, 0)),
        )


def checked_model(system: object) -> control.StateSpace:
    """Return a state-space model in continuous time; ValueError about another."""
    if not (isinstance(system, control.StateSpace) and system.isctime(strict=True)):
        got = f"{type(system).__name__} with dt = {getattr(system, 'dt', None)}"
        raise ValueError(f"closed must be a state-space model in continuous time, got {got}")
    return system


def roads_of(closed: object) -> list[str]:
    """Return the roads that drive a model, see `checked_model`."""
    model = checked_model(closed)
    roads = [name for name in model.input_labels if not name.endswith("_rate")]
    if model.input_labels not in (roads, [*roads, *(f"{road}_rate" for road in roads)]):
        raise ValueError(f"closed must be driven by roads and their rates, got {model.input_labels}")
    return roads


def equations_of(matrices: tuple[Real, Real, Real, Real], r: int, q: int) -> tuple[Equations, Outputs]:
    """Return equations and outputs of A, B, C, D; inputs are r roads, their rates, a constant 1 and q tensions."""
    (a, b, c, d), last = matrices, matrices[1].shape[1] - q
    ports, standing = slice(len(c) - 2 * q, None), d[len(c) - 2 * q : len(c) - q, :r]
    if q and (d[ports] != np.pad(block_diag(standing, standing), ((0, 0), (0, d.shape[1] - 2 * r)))).any():
        raise ValueError("deflections must depend on roads by their heights alone and on no tension, got others")
    nothing = np.zeros(0)
    parts = (a, b[:, :r], b[:, r : last - 1], b[:, last:], b[:, last - 1], c[ports], standing)
    a, b, g, f, constant, c_ports, standing = (np.array(part, order="C") for part in parts)
    outputs = Outputs(c, d[:, :r], d[:, r : last - 1], d[:, last:], d[:, last - 1])
    none = np.zeros((0, len(a)))
    return Equations(
        a, b, g, f, constant, c_ports, standing, none, nothing, nothing, nothing, none.T.copy()
    ), outputs


def matrices_of(
    system: control.StateSpace, r: int, q: int, on_states: Real, on_outputs: Real
) -> tuple[Real, Real, Real, Real]:
    """Return A, B, C, D of a model with r roads, their rates or none, and q ports, with inputs as above.

    The constant 1 acts on states (v,) and outputs (m,).
    """
    b, d = system.B, system.D
    last, none = b.shape[1] - q, (np.zeros((len(b), r)), np.zeros((len(d), r)))
    g, e = (b[:, r:last], d[:, r:last]) if last > r else none
    b = np.hstack([b[:, :r], g, on_states[:, None], b[:, last:]])
    return system.A, b, system.C, np.hstack([d[:, :r], e, on_outputs[:, None], d[:, last:]])


def lifting(equations: Equations, tyres: Tyres) -> Equations:
    """Return the equations with tyres that lift off."""
    c, d, e, *_ = tyres.tension
    return equations._replace(
        load=np.array(c),
        by_road=np.array(np.diag(d)),
        by_rate=np.array(np.diag(e)),
        static=tyres.static,
        push=np.array(tyres.on_states, order="C"),
    )


def loads_of(vehicle: Vehicle) -> list[str]:
    """Return the loads of all tyres in their order, nothing if one is unknown."""
    loads = {str(meaning.where): name for name, meaning in vehicle.meanings.items() if meaning.kind == "load"}
    known = isinstance(vehicle, AssembledVehicle) and set(vehicle.tyres) <= set(loads)
    return [loads[tyre] for tyre in vehicle.tyres] if known else []


def static_loads(vehicle: AssembledVehicle, values: Mapping[str, float], *, laden: bool) -> Real:
    """Return the load of each tyre (t,) [N] at these coefficients, with or without payload."""
    assembly = vehicle.assembly if laden else replace(vehicle.assembly, payload=())
    return np.asarray(Mechanics.of(assembly).static_loads(np.array([list(values.values())]))[0])


def payload(assembly: Assembly, states: int, responses: Sequence[ResponseName]) -> tuple[Real, Real]:
    """Return what the weight of the payload adds to derivatives of states (v,) and to responses (m,)."""
    weight, on_states = np.zeros(len(assembly.coordinates)), np.zeros(states)
    for mass, place in assembly.payload:
        weight += mass * assembly.shape(place)
    on_states[1::2] = -GRAVITY * np.linalg.solve(assembly.mass_matrix, weight)
    shares = [assembly.acceleration_of(name) for name in responses]
    return on_states, np.array(shares).reshape(-1, len(weight)) @ on_states[1::2]

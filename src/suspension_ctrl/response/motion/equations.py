"""Equations of motion of a vehicle in time, with struts of any kind and tyres that may lift off."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import control
import numpy as np

from ...quantities import Real
from ...vehicles.assembly import GRAVITY, Assembly, ResponseName
from ...vehicles.feedback import around, gains_by_order
from ...vehicles.handling import Mechanics
from ...vehicles.networks import Program
from ...vehicles.vehicle import AssembledVehicle, Vehicle, assembled
from .system import Equations
from .trees import Numbers, Tree, numbers_of, tree_of


class Outputs(NamedTuple):
    """Outputs ``y = c x + d z + e z' + f F`` of v states, r roads, their rates and the tensions of q networks."""

    c: Real  # (m, v)
    d: Real  # (m, r)
    e: Real  # (m, r)
    f: Real  # (m, q)

    def of(self, states: Real, road: Real, rate: Real, tension: Real) -> Real:
        """Return the outputs (k, m) of states (k, v), roads and rates (k, r) and tensions (k, q)."""
        return np.asarray(states @ self.c.T + road @ self.d.T + rate @ self.e.T + tension @ self.f.T)

    def rows(self, chosen: Sequence[int] | slice) -> "Outputs":
        """Return some of the outputs."""
        return Outputs(*(matrix[chosen] for matrix in self))


class Tyres(NamedTuple):
    """The t tyres whose loads are known: all or none."""

    names: tuple[str, ...]
    tension: Outputs
    static: Real  # (t,), load on level ground [N]
    on_states: Real  # (v, t), effect of a tension
    on_responses: Real  # (m, t)

    @classmethod
    def none(cls, states: int, responses: int) -> "Tyres":
        """Return no tyres."""
        nothing = Outputs(*np.zeros((4, 0, 0)))
        return cls((), nothing, np.zeros(0), np.zeros((states, 0)), np.zeros((responses, 0)))


class Motion(NamedTuple):
    """A vehicle in time."""

    equations: Equations
    tree: Tree
    numbers: Numbers
    responses: Outputs
    tyres: Tyres

    @classmethod
    def of(
        cls,
        vehicle: Vehicle,
        values: Mapping[str, float],
        responses: Sequence[ResponseName] | None = None,
        lift_off: bool = False,
    ) -> "Motion":
        """Return the equations for all coefficients by name; ValueError if an element has no response in time."""
        names = list(vehicle.responses if responses is None else responses)
        loads, q = loads_of(vehicle), len(vehicle.struts)
        if lift_off and not loads:
            raise ValueError("lift_off must be of a vehicle with masses and loads of all tyres, got another")
        every = list(dict.fromkeys([*names, *loads]))
        plant, program = checked_model(vehicle.plant(every)), Program.of(vehicle.networks, list(values))
        tree = tree_of(vehicle.networks, program, plant.nstates)
        numbers = numbers_of(program, tree, np.array(list(values.values())))
        gains = gains_by_order(vehicle.strut_coefficients, values, q)
        for port, inertance in enumerate(numbers.inertance[:q].tolist()):
            gains[2, port, port] += inertance
        equations, outputs = _matrices(around(plant, gains), len(vehicle.contact_points), q)
        read = outputs.rows([every.index(name) for name in names])
        tyres = Tyres.none(len(equations.a), len(names))
        if loads:
            tension = outputs.rows([every.index(name) for name in loads])
            by_road = np.diag(tension.d)
            static = static_loads(assembled(vehicle), values)
            tyres = Tyres(vehicle.tyres, tension, static, equations.b / by_road, read.d / by_road)
            if tree.kind.size:
                equations = equations._replace(constant=_payload(assembled(vehicle).assembly, plant.nstates))
        return cls(_lifting(equations, tyres) if lift_off else equations, tree, numbers, read, tyres)

    @property
    def states(self) -> int:
        """Number of states."""
        return len(self.equations.a) + self.tree.states

    @classmethod
    def of_model(cls, closed: control.StateSpace) -> "Motion":
        """Return the equations of a model from roads to responses."""
        roads = len(roads_of(closed))
        equations, outputs = _matrices(closed, roads, 0)
        program = Program.of((), ())
        tree = tree_of((), program, closed.nstates)
        tyres = Tyres.none(closed.nstates, closed.noutputs)
        return cls(equations, tree, numbers_of(program, tree, np.zeros(0)), outputs, tyres)


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


def _matrices(system: control.StateSpace, r: int, q: int) -> tuple[Equations, Outputs]:
    """Return equations and outputs of a model with r roads, their rates or none, and q ports."""
    a, b, c, d = system.A, system.B, system.C, system.D
    last = b.shape[1] - q
    g, e = (m[:, r:last] if last > r else np.zeros((len(m), r)) for m in (b, d))
    ports = slice(len(c) - 2 * q, None)
    if q and (d[ports].any() or e[ports].any()):
        raise ValueError("deflections must depend on roads and tensions through states alone, got others")
    outputs, nothing = Outputs(c, d[:, :r], e, d[:, last:]), np.zeros(0)
    no_load = (np.zeros((0, len(a))), nothing, nothing, nothing, np.zeros((len(a), 0)))
    return Equations(a, b[:, :r], g, b[:, last:], np.zeros(len(a)), c[ports], *no_load), outputs


def _lifting(equations: Equations, tyres: Tyres) -> Equations:
    """Return the equations with tyres that lift off."""
    c, d, e, _ = tyres.tension
    return equations._replace(
        load=c, by_road=np.diag(d), by_rate=np.diag(e), static=tyres.static, push=tyres.on_states
    )


def loads_of(vehicle: Vehicle) -> list[str]:
    """Return the loads of all tyres in their order, nothing if one is unknown."""
    loads = {str(meaning.where): name for name, meaning in vehicle.meanings.items() if meaning.kind == "load"}
    known = isinstance(vehicle, AssembledVehicle) and set(vehicle.tyres) <= set(loads)
    return [loads[tyre] for tyre in vehicle.tyres] if known else []


def static_loads(vehicle: AssembledVehicle, values: Mapping[str, float]) -> Real:
    """Return the load of each tyre (t,) [N] at these coefficients, with networks without payload."""
    assembly = replace(vehicle.assembly, payload=()) if vehicle.networks else vehicle.assembly
    return np.asarray(Mechanics.of(assembly).static_loads(np.array([list(values.values())]))[0])


def _payload(assembly: Assembly, states: int) -> Real:
    """Return the acceleration of the states (v,) by the weight of the payload."""
    weight, constant = np.zeros(len(assembly.coordinates)), np.zeros(states)
    for mass, place in assembly.payload:
        weight += mass * assembly.shape(place)
    constant[1::2] = -GRAVITY * np.linalg.solve(assembly.mass_matrix, weight)
    return constant

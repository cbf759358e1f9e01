"""A vehicle ready to be driven: what does not depend on a design, and its motion with one."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import control
import numpy as np

from ...quantities import Integer, Real
from ...vehicles.assembly import ResponseName
from ...vehicles.feedback import fed_back, gains_by_order
from ...vehicles.networks import INERTER, Program, has_force_laws
from ...vehicles.vehicle import Vehicle, assembled
from .equations import (
    Outputs,
    Tyres,
    checked_model,
    equations_of,
    lifting,
    loads_of,
    matrices_of,
    payload,
    roads_of,
    static_loads,
)
from .system import Equations
from .trees import Tree, tree_of


class Motion(NamedTuple):
    """A vehicle with the struts of one design in time."""

    equations: Equations
    program: Program
    tree: Tree
    values: Real  # (c,), coefficients of the struts
    responses: Outputs
    tyres: Tyres

    @property
    def states(self) -> int:
        """Number of states."""
        return len(self.equations.a) + self.tree.states

    @classmethod
    def of_model(cls, closed: control.StateSpace) -> "Motion":
        """Return the motion of a model from roads to responses."""
        roads, program, nothing = len(roads_of(closed)), Program.of((), ()), np.zeros(closed.nstates)
        equations, outputs = equations_of(
            matrices_of(closed, roads, 0, nothing, np.zeros(closed.noutputs)), roads, 0
        )
        tyres = Tyres.none(closed.nstates, closed.noutputs)
        return cls(equations, program, tree_of((), program, closed.nstates), np.zeros(0), outputs, tyres)


class Drivable(NamedTuple):
    """A vehicle without its struts in time, and the trees of its networks; `motion` adds a design."""

    vehicle: Vehicle
    plant: tuple[Real, Real, Real, Real]
    gains: Real  # (c, 3, q, q), by order, of unit coefficients
    program: Program
    tree: Tree
    read: Integer  # (m,), rows of the responses
    loads: Integer  # (t,), rows of the tensions of tyres that may lift off

    @classmethod
    def of(
        cls, vehicle: Vehicle, responses: Sequence[ResponseName] | None = None, lift_off: bool = False
    ) -> "Drivable":
        """Return a vehicle in time; ValueError if an element has no response in time."""
        names = list(vehicle.responses if responses is None else responses)
        known, q = loads_of(vehicle), len(vehicle.struts)
        if lift_off and not known:
            raise ValueError("lift_off must be of a vehicle with masses and loads of all tyres, got another")
        if lift_off and any((assembled(vehicle).assembly.standing @ one.share).any() for one in vehicle.networks):
            raise ValueError(
                "lift_off must be of a vehicle with springs and dampers alone on its roads, got others"
            )
        loads = known if lift_off else []
        every = list(dict.fromkeys([*names, *loads]))
        system = checked_model(vehicle.plant(every))
        program = Program.of(vehicle.networks, [one.name for one in vehicle.strut_coefficients])
        tree = tree_of(vehicle.networks, program, system.nstates)
        on_states, on_outputs = np.zeros(system.nstates), np.zeros(system.noutputs)
        if known and vehicle.networks:
            on_states, on_outputs[: len(every)] = payload(assembled(vehicle).assembly, system.nstates, every)
        gains = np.array([gains_by_order([one], {one.name: 1.0}, q) for one in vehicle.strut_coefficients])
        for i in np.flatnonzero((tree.kind == INERTER) & (tree.linear_slot < q)).tolist():
            port = tree.linear_slot[i]
            gains[tree.coefficient[i], 2, port, port] += tree.linear_ratio[i] ** 2
        read, at = (np.array([every.index(name) for name in rows], dtype=int) for rows in (names, loads))
        plant = matrices_of(system, len(vehicle.contact_points), q, on_states, on_outputs)
        return cls(vehicle, plant, gains, program, tree, read, at)

    def motion(self, values: Real) -> Motion:
        """Return the motion with coefficients (c,) of the struts."""
        q = self.gains.shape[2]
        matrices = fed_back(self.plant, np.tensordot(values, self.gains, 1))
        equations, outputs = equations_of(matrices, len(self.vehicle.contact_points), q)
        responses, tyres = outputs.rows(self.read), Tyres.none(len(equations.a), len(self.read))
        if self.loads.size:
            tension = outputs.rows(self.loads)
            by_road, names = np.diag(tension.d), [one.name for one in self.vehicle.strut_coefficients]
            by_name = dict(zip(names, values.tolist(), strict=True))
            static = static_loads(assembled(self.vehicle), by_name, laden=not self.vehicle.networks)
            tyres = Tyres(tension, static, equations.b / by_road, responses.d / by_road)
            equations = lifting(equations, tyres)
        return Motion(equations, self.program, self.tree, values, responses, tyres)


def integrated(vehicle: Vehicle, lift_off: bool) -> bool:
    """Whether a vehicle is integrated in time: networks then count from the static position without payload."""
    return lift_off or has_force_laws(vehicle.networks)


def motion_of(
    vehicle: Vehicle,
    values: Mapping[str, float],
    responses: Sequence[ResponseName] | None = None,
    lift_off: bool = False,
) -> Motion:
    """Return the motion of a vehicle with coefficients by name; ValueError also if no spring carries it."""
    if loads_of(vehicle):
        static_loads(assembled(vehicle), values, laden=True)
    return Drivable.of(vehicle, responses, lift_off).motion(np.array(list(values.values())))

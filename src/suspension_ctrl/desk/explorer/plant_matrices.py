"""Masses, springs and dampers of a vehicle as matrices, from which a page computes modes and static loads."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ...quantities import Integer, Real
from ...response.mean_squares import varying
from ...vehicles.added_ports import added
from ...vehicles.assembly import Assembly
from ...vehicles.handling import Mechanics
from ...vehicles.modes import motions_of
from ...vehicles.parameters import Ported, parameters_of
from ...vehicles.varied import Varied
from ...vehicles.vehicle import AssembledVehicle, Vehicle


class PlantMatrices(NamedTuple):
    """Vehicle with n coordinates, m movements, t tyres and q struts with c coefficients, of which w vary.

    Matrices without struts, and what a coefficient at 1 adds to them.
    """

    setting: Real  # (c,)
    variable: Integer  # (w,), the coefficient of each that varies
    order: Integer  # (c,), 0 of those that add to stiffness, 1 to damping, 2 to mass
    mass: Real  # (n, n)
    damping: Real  # (n, n)
    stiffness: Real  # (n, n)
    by: Real  # (c, n, n)
    struts: Real  # (q, n), deflections by coordinate
    displacements: Real  # (m, n), movements by coordinate
    inertia: Real  # (m,), mass or moment of inertia of each of the movements
    inertia_by: Real  # (c, m)
    weights: Real  # (n,), mass that loads each coordinate by gravity [kg, kg m]
    weights_by: Real  # (c, n)
    loads: Real  # (t, n), tension on each road by coordinate [N/m]
    loads_by: Real  # (c, t, n)
    sprung: Real  # (1,), mass on the wheels [kg]
    sprung_by: Real  # (c, 1)
    names: tuple[str, ...]  # (k,), of motions
    motions: Real  # (k, m)

    @classmethod
    def of(
        cls, vehicle: AssembledVehicle, setting: Mapping[str, float], variables: Sequence[str]
    ) -> "PlantMatrices":
        """Return the matrices of a vehicle with all coefficients (c,), in a load case with these variables."""
        assembly, names = vehicle.assembly, list(setting)
        coefficients = {one.name: one for one in assembly.strut_coefficients}
        mechanics = vehicle.statics
        ends, _ = assembly.elongations(assembly.struts)
        inertia, weights, loads, sprung = _by_parameters(vehicle, names)
        motions = motions_of(assembly)
        return cls(
            setting=np.array(list(setting.values()), dtype=float),
            variable=np.array([names.index(name) for name in varying(vehicle, variables)], dtype=np.int64),
            order=np.array([coefficients[name].order for name in names], dtype=np.int64),
            mass=np.asarray(assembly.mass_matrix),
            damping=mechanics.damping,
            stiffness=mechanics.stiffness,
            by=np.array([ends.T @ coefficients[name].gain @ ends for name in names]),
            struts=ends,
            displacements=np.asarray(assembly.displacements),
            inertia=np.asarray(assembly.inertia),
            inertia_by=inertia,
            weights=np.asarray(assembly.weights),
            weights_by=weights,
            loads=mechanics.tyre_loads,
            loads_by=loads,
            sprung=np.array([assembly.sprung_mass]),
            sprung_by=sprung,
            names=tuple(motions),
            motions=np.array(list(motions.values())),
        )


def plant_matrices(
    vehicle: Vehicle, setting: Mapping[str, float], variables: Sequence[str]
) -> PlantMatrices | None:
    """Return the matrices of a vehicle of masses and links, None of a plant."""
    return PlantMatrices.of(vehicle, setting, variables) if isinstance(vehicle, AssembledVehicle) else None


def _by_parameters(vehicle: AssembledVehicle, names: Sequence[str]) -> list[Real]:
    """Return what coefficients (c,) at 1 add to inertia (c, m), weights (c, n), tyre loads (c, t, n), mass (c, 1).

    These are linear in masses and tyres that vary; the mass is that on the wheels.
    """
    base = vehicle.vehicle.assembly if isinstance(vehicle, Varied) else vehicle.assembly
    before = _numbers(base)
    by = [np.zeros((len(names), *one.shape)) for one in before]
    for name, one in parameters_of(base).items() if isinstance(vehicle, Varied) else ():
        if isinstance(one, Ported) and added(name) in names:
            after = _numbers(one.changed(base, one.default + 1.0))
            for total, new, old in zip(by, after, before, strict=True):
                total[names.index(added(name))] = new - old
    ends, _ = base.elongations(base.struts)
    for coefficient in base.strut_coefficients:  # of struts that stand on a road
        gain = coefficient.gain * (coefficient.order == 0)
        by[2][names.index(coefficient.name)] += base.standing @ gain @ ends
    return by


def _numbers(assembly: Assembly) -> list[Real]:
    loads, sprung = Mechanics.of(assembly).tyre_loads, np.array([assembly.sprung_mass])
    return [np.asarray(assembly.inertia), np.asarray(assembly.weights), loads, sprung]

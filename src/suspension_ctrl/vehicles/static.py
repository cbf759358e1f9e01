"""Static position of a vehicle on level ground, by name."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..quantities import Real, signal_unit
from .assembly import GRAVITY, Assembly, joined
from .handling import Mechanics

if TYPE_CHECKING:
    import pandas as pd

_STEP = 1e-8  # m, of deflections for slopes
_NEAR, _BALANCE = 1e-13, 1e-9  # change of a displacement, of itself; what remains of a load
_ROUNDING = 1e-13  # of the largest displacement


def static_of(statics: Mechanics, values: Mapping[str, float]) -> "pd.DataFrame":
    """Return `Vehicle.static` at coefficients by name."""
    import pandas as pd

    rows = list(_rows(statics, values))
    index = pd.Index([name for name, _ in rows], name="name")
    units = [signal_unit(name) for name, _ in rows]
    return pd.DataFrame({"value": [float(value) for _, value in rows], "unit": units}, index=index)


def _rows(statics: Mechanics, values: Mapping[str, float]) -> Iterator[tuple[str, float]]:
    """Yield loads of wheels, deflections of tyres and struts, and displacements of bodies and wheels."""
    assembly = statics.assembly
    at, loads = _position(statics, values)
    at = np.where(np.abs(at) > _ROUNDING * np.abs(at).max(), at, 0.0)
    for wheel, load in zip(assembly.contacts, loads, strict=True):
        yield joined(wheel, "wheel_load"), load
    tyres, struts = (assembly.elongations(links)[0] @ at for links in (assembly.tyres, assembly.struts))
    for tyre, deflection in zip(assembly.tyres, tyres, strict=True):
        yield joined(tyre.name, "tyre_deflection"), deflection
    for strut, deflection in zip(assembly.struts, struts, strict=True):
        yield joined(strut.name, "deflection"), deflection
    for name, displacement in zip(assembly.movements, assembly.displacements @ at, strict=True):
        yield f"{name}_displacement", displacement


def _position(statics: Mechanics, values: Mapping[str, float]) -> tuple[Real, Real]:
    """Return the static displacement (n,) and the load (t,) of each tyre.

    Force laws count from the position without payload, so only a payload moves them along their curves.
    """
    assembly, coefficients = statics.assembly, np.array([list(values.values())])
    unladen = replace(assembly, payload=()).weights
    sunk = _sunk(statics, values, assembly.weights - unladen)
    at = statics.displacement(coefficients, unladen)[0] + sunk
    beyond = _beyond(assembly, values, assembly.elongations(assembly.struts)[0] @ sunk)
    return at, -statics.loads(coefficients, at[None])[0] - assembly.standing @ beyond


def _sunk(statics: Mechanics, values: Mapping[str, float], mass: Real) -> Real:
    """Return the displacement (n,) by a payload (n,) [kg, kg m] from the position without it."""
    assembly, coefficients = statics.assembly, np.array([list(values.values())])
    stiffness, (p, _) = statics.stiffness_of(coefficients)[0], assembly.elongations(assembly.struts)
    linear, load = statics.displacement(coefficients, mass)[0], GRAVITY * mass
    if not (assembly.networks and load.any()):
        return linear
    from scipy.optimize import root

    def imbalance(at: Real) -> Real:
        return stiffness @ at + p.T @ _beyond(assembly, values, p @ at) + load

    def slope(at: Real) -> Real:
        low, high = (_beyond(assembly, values, p @ at + step) for step in (-_STEP, _STEP))
        return stiffness + p.T * ((high - low) / (2 * _STEP)) @ p

    found = np.asarray(root(imbalance, linear, jac=slope, options={"xtol": _NEAR}).x)
    if not np.abs(imbalance(found)).max() < _BALANCE * np.abs(load).max():
        raise ValueError("payload must be one that the struts can carry, got none in equilibrium")
    return found


def _beyond(assembly: Assembly, values: Mapping[str, float], deflections: Real) -> Real:
    """Return the tension (q,) of networks beyond that by their slopes, at changes of deflection (q,)."""
    found = np.zeros(len(deflections))
    for network in assembly.networks:
        own = {name.removeprefix(network.prefix): value for name, value in values.items()}
        slope = float(network.strut.static_stiffness(own))
        for i in np.flatnonzero(network.share).tolist():
            found[i] += network.strut.static_tension(own, deflections[i]) - slope * deflections[i]
    return found

"""Derivatives of roll gradient and load transfer by the coefficients of struts.

A displacement x under a load f, K x = f, changes by dx, K dx = df - dK x.
"""

import numpy as np

from ..quantities import Real
from .handling import TOPPLED, Mechanics, RollGeometry


def roll_gradient_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry) -> Real:
    """Return the derivatives (p, v) of `Mechanics.roll_gradient`, 0 where the body topples; without networks."""
    _, slopes = _lean_slopes(statics, coefficients, geometry)
    stands = statics.roll_gradient(coefficients, geometry) < TOPPLED
    roll = statics.assembly.coordinates.index("roll")
    return np.where(stands[:, None], np.degrees(slopes[:, roll]), 0.0)


def front_load_transfer_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry) -> Real:
    """Return the derivatives (p, v) of `Mechanics.front_load_transfer`; without networks."""
    lean, slopes = _lean_slopes(statics, coefficients, geometry)
    front, rear = statics.loads(coefficients, lean)[:, statics.left, None].transpose(1, 0, 2)
    by_front, by_rear = _load_slopes(statics, coefficients, lean, slopes)[:, statics.left].transpose(1, 0, 2)
    return np.asarray((by_front * rear - front * by_rear) / (front + rear) ** 2)


def _lean_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry) -> tuple[Real, Real]:
    """Return the displacement (p, n) at 1 g and its derivatives (p, n, v)."""
    level = statics.displacement(coefficients, statics.assembly.weights)
    sinking = _solved(statics.stiffness_of(coefficients), -_spring_forces(statics, level))
    by_load = -_load_slopes(statics, coefficients, level, sinking)
    _, by_tyre = statics.cornering(geometry)
    lean = statics.lean(coefficients, geometry)
    forces = by_tyre @ by_load - _spring_forces(statics, lean)
    return lean, _solved(statics.leaning(coefficients, geometry), forces)


def _solved(matrices: Real, right: Real) -> Real:
    """Return the solutions (p, n, v) of equations with matrices (p, n, n)."""
    return np.asarray(np.linalg.solve(matrices, right), dtype=float)


def _load_slopes(statics: Mechanics, coefficients: Real, displacement: Real, slopes: Real) -> Real:
    """Return the derivatives (p, t, v) of `Mechanics.loads` by those (p, n, v) of displacements (p, n)."""
    found, standing = statics.tyre_loads @ slopes, statics.assembly.standing
    if standing.any():
        by_spring = standing @ statics.springs @ statics.elongation  # (v, t, n)
        found = found + statics.standing_loads(coefficients) @ slopes
        found += np.einsum("vtn,pn->ptv", by_spring, displacement)
    return np.asarray(found)


def _spring_forces(statics: Mechanics, displacement: Real) -> Real:
    """Return the derivatives (p, n, v) of forces of the struts at displacements (p, n)."""
    return np.einsum("vij,pj->piv", statics.by_stiffness, displacement)

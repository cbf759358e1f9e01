"""Derivatives of roll gradient and load transfer by the coefficients of struts.

A displacement x under a load f, K x = f, changes by dx, K dx = df - dK x.
"""

import numpy as np

from ..quantities import Real
from .handling import TOPPLED, Lean, Mechanics, RollGeometry


def with_roll_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry) -> tuple[Real, Real]:
    """Return `Mechanics.roll_gradient` (p,) and its derivatives (p, v), 0 where the body topples.

    Of struts without networks.
    """
    lean = statics.lean(coefficients, geometry)
    values, slopes = statics.roll_at(lean), _lean_slopes(statics, coefficients, geometry, lean)
    roll = np.degrees(slopes[:, statics.assembly.coordinates.index("roll")])
    return values, np.where(values[:, None] < TOPPLED, roll, 0.0)


def with_transfer_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry) -> tuple[Real, Real]:
    """Return `Mechanics.front_load_transfer` (p,) and its derivatives (p, v), of struts without networks."""
    lean = statics.lean(coefficients, geometry)
    slopes = _lean_slopes(statics, coefficients, geometry, lean)
    front, rear = statics.loads(coefficients, lean.displacement)[:, statics.left].T
    changes = _load_slopes(statics, coefficients, lean.displacement, slopes)[:, statics.left]
    by_front, by_rear = changes.swapaxes(0, 1)
    both = (front + rear)[:, None]
    return front / (front + rear), (by_front * rear[:, None] - front[:, None] * by_rear) / both**2


def _lean_slopes(statics: Mechanics, coefficients: Real, geometry: RollGeometry, lean: Lean) -> Real:
    """Return the derivatives (p, n, v) of the displacement at 1 g."""
    sinking = _solved(lean.stiffness, -_spring_forces(statics, lean.level))
    by_load = -_load_slopes(statics, coefficients, lean.level, sinking)
    _, by_tyre = statics.cornering(geometry)
    return _solved(lean.leaning, by_tyre @ by_load - _spring_forces(statics, lean.displacement))


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

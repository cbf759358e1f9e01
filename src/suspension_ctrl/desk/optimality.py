"""Conditions of an optimum (Karush, Kuhn, Tucker): multipliers, scaled residual, Newton's method on active rows.

Source: J. Nocedal, S. J. Wright, "Numerical Optimization", 2nd edition, 2006, chapter 12, and for Newton 18.1.
"""

from typing import NamedTuple

import numpy as np

from ..quantities import Bool, Real
from .programs import Program, Values

EXACT = 1e-8
"""Largest scaled residual of an optimum."""

_GOAL = 1e-12  # residual at which Newton's method ends
_NEAR = 1e-5  # distance from 0 of rows, and from bounds of variables, that may be active
_STEPS = 12
_APART = 1e-6  # of the box: slopes at points so far apart give second derivatives to about 1e-6
_FARTHEST = 0.1  # of the box, that a step may go


class Conditions(NamedTuple):
    """Multipliers of the rows and bounds, and how far a point is from an optimum."""

    multipliers: Real  # (r,), 1 of the objective
    gradient: Real  # (n,) slopes of the Lagrangian without bounds, positive at an active lower bound
    held: Bool  # (n,), variables on an active bound
    residual: float


def conditions(program: Program, z: Real, at: Values) -> Conditions:
    """Return the conditions at a point (n,): the multipliers leave the least slope of the Lagrangian.

    The residual is the largest of: slopes of the Lagrangian (stationarity), rows above 0 (feasibility), and
    products of multipliers with rows and with distances from bounds (complementarity).
    """
    from scipy.optimize import nnls

    rows, slopes = at
    lower, upper = z - program.lower, program.upper - z
    near = np.flatnonzero(program.equal | (rows > -_NEAR))
    near = near[near > 0]
    equal = near[program.equal[near]]
    identity = np.eye(z.size)
    low, high = np.flatnonzero(lower < _NEAR), np.flatnonzero(upper < _NEAR)
    columns = np.hstack([slopes[near].T, -slopes[equal].T, -identity[:, low], identity[:, high]])
    found = nnls(columns, -slopes[0])[0] if columns.shape[1] else np.empty(0)
    multipliers = np.zeros(len(rows))
    multipliers[0] = 1.0
    multipliers[near] += found[: near.size]
    multipliers[equal] -= found[near.size : near.size + equal.size]
    gradient = multipliers @ slopes
    bounds = np.zeros((2, z.size))
    bounds[0, low], bounds[1, high] = np.split(found[near.size + equal.size :], [low.size])
    parts = [gradient - bounds[0] + bounds[1], np.where(program.equal, np.abs(rows), np.maximum(rows, 0.0))[1:]]
    parts += [(multipliers * rows)[1:], bounds[0, low] * lower[low], bounds[1, high] * upper[high]]
    residual = max(float(np.abs(part).max(initial=0.0)) for part in parts)
    return Conditions(multipliers, gradient, np.asarray(bounds.sum(axis=0) > 0), residual)


def polished(program: Program, z: Real) -> tuple[Real, Conditions]:
    """Return the point (n,) of least residual that Newton's method reaches, with its conditions."""
    best, found = z, conditions(program, z, program.at(z))
    now = found
    for _ in range(_STEPS):
        if found.residual <= _GOAL:
            break
        z = np.clip(z + _step(program, z, now), program.lower, program.upper)
        now = conditions(program, z, program.at(z))
        if now.residual < found.residual:
            best, found = z, now
    return best, found


def _step(program: Program, z: Real, now: Conditions) -> Real:
    """Return the step (n,) of Newton's method for variables and multipliers of the active rows.

    The Hessian of the Lagrangian is by differences of its exact slopes.
    """
    rows, slopes = program.at(z)
    active = np.flatnonzero((now.multipliers != 0) | (rows > 0) | program.equal)
    active, free = active[active > 0], np.flatnonzero(~now.held)
    a = slopes[np.ix_(active, free)]
    whole = np.block([[_hessian(program, z, now)[np.ix_(free, free)], a.T], [a, np.zeros((active.size,) * 2)]])
    found = np.linalg.lstsq(whole, -np.append(now.gradient[free], rows[active]), rcond=1e-13)[0]
    step = np.where(now.held, _to_bound(program, z), 0.0)
    step[free] = found[: free.size]
    return np.asarray(step * min(1.0, _FARTHEST / max(float(np.abs(step).max()), _FARTHEST)))


def _to_bound(program: Program, z: Real) -> Real:
    """Return the step (n,) to the nearest bounds, 0 where there are none."""
    lower, upper = program.lower - z, program.upper - z
    step = np.where(np.abs(lower) < np.abs(upper), lower, upper)
    return np.where(np.isfinite(step), step, 0.0)


def _hessian(program: Program, z: Real, now: Conditions) -> Real:
    """Return the second derivatives (n, n) of the Lagrangian, by steps into the box."""
    steps = np.where(z + _APART > program.upper, -_APART, _APART)
    every = program.many(z + np.diag(steps))
    differences = np.array([now.multipliers @ at.slopes - now.gradient for at in every]) / steps[:, np.newaxis]
    return np.asarray((differences + differences.T) / 2)

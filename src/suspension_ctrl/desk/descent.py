"""The least of a program: SLSQP with exact slopes, then Newton's method on its conditions."""

from typing import Any, NamedTuple

import numpy as np

from ..quantities import Bool, Real
from .optimality import EXACT, Conditions, conditions, polished
from .programs import Program

HELD = 1e-8
"""Largest row above 0 of a design within its limits, as a share of the limit."""

_ROUNDS = 4  # descents, each from the end of the one before it
_NEAR = 1e-2  # rows that Newton's method brings to 0
_NEARER = 0.5  # of the excess before, that a round leaves where it comes nearer


class End(NamedTuple):
    """Where a descent ends."""

    program: Program
    z: Real  # (n,)
    conditions: Conditions

    @property
    def design(self) -> Real:
        """The design (d,)."""
        return self.program.design(self.z)

    @property
    def feasible(self) -> bool:
        """Whether all rows are held."""
        return excess_of(self.program, self.z) <= HELD

    @property
    def value(self) -> float:
        """The objective."""
        return float(self.program.at(self.z).rows[0] * self.program.sizes[0])


def descended(program: Program) -> End:
    """Return the end of a descent from the start of the program, the one of least residual of a few rounds.

    It ends early where all rows are held with a residual of an optimum, or where rows come no nearer to 0.
    """
    z = program.start
    excess, best = excess_of(program, z), None
    for _ in range(_ROUNDS):
        z = _slsqp(program, z)
        program.resize(z)
        before, excess = excess, excess_of(program, z)
        if excess <= _NEAR:
            z, found = polished(program, z)
        else:
            found = conditions(program, z, program.at(z))
        if best is None or found.residual < best.conditions.residual:
            best = End(program, z, found)
        if found.residual <= EXACT or _NEARER * before < excess > _NEAR:
            break
    assert best is not None
    return best


def excess_of(program: Program, z: Real) -> float:
    """Return the largest row above 0 at a point (n,), or beside 0 if it is `equal`."""
    rows = program.at(z).rows[1:]
    return float(np.where(program.equal[1:], np.abs(rows), rows).max(initial=0.0))


def _slsqp(program: Program, start: Real) -> Real:
    """Return the point (n,) where SLSQP ends."""
    from scipy.optimize import minimize

    limits = [_limit(program, kind, which) for kind, which in (("eq", program.equal), ("ineq", ~program.equal))]
    bounds = list(zip(program.lower, program.upper, strict=True))
    settings: dict[str, Any] = {"method": "SLSQP", "bounds": bounds, "options": {"ftol": 1e-12, "maxiter": 100}}
    settings["constraints"] = [limit for limit in limits if limit]

    def both(z: Real) -> tuple[float, Real]:
        rows, slopes = program.at(z)
        return float(rows[0]), slopes[0]

    found = minimize(both, start, jac=True, **settings)
    return np.clip(found.x, program.lower, program.upper)


def _limit(program: Program, kind: str, which: Bool) -> dict[str, Any]:
    """Return rows as a constraint of SLSQP, which is at least 0; empty if there are none."""
    rows = np.flatnonzero(which[1:]) + 1

    def room(z: Real) -> Real:
        return -program.at(z).rows[rows]

    def slopes(z: Real) -> Real:
        return -program.at(z).slopes[rows]

    return {"type": kind, "fun": room, "jac": slopes} if rows.size else {}

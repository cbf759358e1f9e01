"""The optimal controller of least measure within limits on the others.

The squares of the measures are convex over all linear controllers. So weights of terms, multipliers of the limits,
reach every point of the front, and the search is over their logarithms.
"""

from collections.abc import Iterator
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from ...quantities import Integer, Real
from .active_suspension import ActiveSuspension, Controlled

_ALIKE = 1e-9  # relative difference of mean squares, of left and right
_LOWEST = 1e-6  # added to each multiplier: without weight a motion may be left undamped
_REACH = 8.0  # of logarithms of multipliers
_STEP = 1e-4  # of a logarithm, in difference quotients: squares are smooth to 1e-9
HELD = 1e-4
"""Tolerance of a limit, as a share of it."""


class _Group(NamedTuple):
    """Terms of a measure that share a multiplier: all of a sum, of the worst wheel those that are alike."""

    measure: int
    terms: Integer


def least_controlled(active: ActiveSuspension, measure: int, limits: Real) -> Controlled:
    """Return the controller of least `measure` with all others at most `limits` (m,).

    ValueError if the search does not end within the limits.
    """
    from scipy.optimize import minimize

    groups = list(_groups(active))
    own = np.array([one.measure == measure for one in groups])
    scale = np.array([_square(active, one, active.present) for one in groups])
    wanted = np.log(limits[[one.measure for one in groups]] ** 2)
    size = 2 * np.log(active.measures_of(active.present)[measure])
    known: dict[bytes, Controlled] = {}

    def controlled(x: Real) -> Controlled:
        key = x[:-1].tobytes()
        if key not in known:
            multipliers = np.exp(x[:-1]) + _LOWEST
            parts = multipliers / multipliers.sum() / scale
            factors = np.zeros(active.squares.shape[1])
            for part, one in zip(parts, groups, strict=True):
                factors[one.terms] += part * active.squares[one.measure, one.terms]
            known[key] = active.controlled(factors)
        return known[key]

    def room(x: Real) -> Real:
        """Return the logarithmic distance of the groups' squares from the slack variable, or from their limits."""
        squares = np.array([_square(active, one, controlled(x).mean_squares) for one in groups])
        return np.where(own, x[-1] + size, wanted) - np.log(squares)

    settings: dict[str, Any] = {"method": "SLSQP", "constraints": [{"type": "ineq", "fun": room}]}
    settings |= {"bounds": [(-_REACH, _REACH)] * len(groups) + [(None, None)]}
    settings |= {"options": {"eps": _STEP, "ftol": 1e-8, "maxiter": 60}}
    found = minimize(itemgetter(-1), np.zeros(len(groups) + 1), **settings)
    if room(found.x)[~own].min(initial=0.0) < -2 * HELD:
        raise ValueError(f"limits must be attainable by a controller, got {limits.tolist()}")
    return controlled(found.x)


def _groups(active: ActiveSuspension) -> Iterator[_Group]:
    """Yield the groups of terms by measure."""
    for j, score in enumerate(active.scores.scores):
        terms = np.flatnonzero(active.squares[j])
        if not score.cases[0].largest:
            yield _Group(j, terms)
            continue
        while terms.size:
            alike = np.isclose(active.present[terms], active.present[terms[0]], rtol=_ALIKE, atol=0.0)
            yield _Group(j, terms[alike])
            terms = terms[~alike]


def _square(active: ActiveSuspension, group: _Group, mean_squares: Real) -> float:
    """Return the square of a measure, of the worst wheel in the group."""
    parts = active.squares[group.measure, group.terms] * mean_squares[group.terms]
    return float(parts.max() if active.scores.scores[group.measure].cases[0].largest else parts.sum())

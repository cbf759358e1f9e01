"""Which designs meet their constraints, and how those that do not compare with others.

Values of designs are arrays (n, m + c): m objectives to be minimised, then c constraints g, met where g <= 0.
A feasible design is better than an infeasible one, and of two infeasible ones that with the smaller violation.

References
----------
K. Deb, "An efficient constraint handling method for genetic algorithms", Computer Methods in Applied Mechanics and
Engineering 186, 2000.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray


class InfeasibleWarning(UserWarning):
    """A search ended without a design that meets all constraints."""


@njit(cache=True, inline="always")  # MOEA/D-DRA calls it for each comparison
def violation_of(value: NDArray[np.float64], m: int) -> float:
    """Return the sum of max(0, g) over the constraints among the values (m + c,) of a design."""
    violation = 0.0
    for j in range(m, value.size):
        violation += max(0.0, value[j])
    return violation


@njit(cache=True)
def violations(values: NDArray[np.float64], m: int) -> NDArray[np.float64]:
    """Return `violation_of` each design (n,), from values (n, m + c)."""
    found = np.empty(values.shape[0])
    for i in range(values.shape[0]):
        found[i] = violation_of(values[i], m)
    return found


@njit(cache=True)
def any_feasible(values: NDArray[np.float64], m: int) -> bool:
    """Whether any of the designs with these values (n, m + c) meets all constraints."""
    for value in values:  # noqa: SIM110  numba compiles no generator
        if violation_of(value, m) == 0.0:
            return True
    return False


def feasible_objectives(values: NDArray[np.float64], m: int) -> NDArray[np.float64]:
    """Return the objectives (k, m) of the feasible designs among values (n, m + c)."""
    if values.shape[1] == m:
        return values
    return values[violations(values, m) == 0, :m]


@njit(cache=True)
def lower_ideal(ideal: NDArray[np.float64], value: NDArray[np.float64], found: bool) -> bool:
    """Take the values (m + c,) of a design into the ideal point (m,), in place.

    The ideal point is that of the feasible designs alone, as soon as one has been `found`; until then it is that
    of all. The least values of infeasible designs may be far from any that a feasible one can have. Returns
    whether a feasible design has been found by now.
    """
    feasible = violation_of(value, ideal.size) == 0.0
    for j in range(ideal.size):
        if feasible and not found:
            ideal[j] = value[j]
        elif feasible or not found:
            ideal[j] = min(ideal[j], value[j])
    return found or feasible


@njit(cache=True)
def ideal_with(ideal: NDArray[np.float64], values: NDArray[np.float64], found: bool) -> NDArray[np.float64]:
    """Return the ideal point (m,) with further values (n, m + c) taken in, one by one as `lower_ideal` does."""
    lowered = ideal.copy()
    for i in range(values.shape[0]):
        found = lower_ideal(lowered, values[i], found)
    return lowered


_BEYOND = 1e-3
"""How far beyond the worst feasible value infeasible designs are spread, in ranges or magnitudes of it: little, so
that no range overflows, yet so much that even 1e9 ranks of violation stay apart in double precision."""


def constrained(values: NDArray[np.float64], m: int) -> NDArray[np.float64]:
    """Return objectives (n, m) among which dominance is the constrained dominance of values (n, m + c).

    Those of feasible designs are their own. Those of an infeasible one are all beyond the worst of any feasible
    design, the farther the higher its violation ranks: it is dominated by every feasible design and by every
    infeasible one of smaller violation. Ranks in place of violations, so that none is lost in a large objective.

    References
    ----------
    K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm:
    NSGA-II", IEEE Trans. Evol. Comput. 6(2), 2002, section VI.
    """
    if values.shape[1] == m:
        return values
    violation, objectives = violations(values, m), values[:, :m].copy()
    infeasible = violation > 0
    if not infeasible.any():
        return objectives
    worst, reach = np.zeros(m), np.ones(m)
    if not infeasible.all():
        feasible = objectives[~infeasible]
        worst = feasible.max(axis=0)
        size = np.maximum(np.ptp(feasible, axis=0), np.abs(worst))
        reach = np.where(size > 0, np.maximum(_BEYOND * size, np.sqrt(np.finfo(float).tiny)), 1.0)
    levels, rank = np.unique(violation[infeasible], return_inverse=True)
    objectives[infeasible] = worst + reach * ((rank + 1) / levels.size)[:, np.newaxis]
    return objectives

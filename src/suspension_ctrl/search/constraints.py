"""Constraints: the values (n, m + c) of designs are m objectives, then c constraints g, met if g <= 0.

A feasible design is better than an infeasible one, a smaller violation better than a larger one (K. Deb, "An
efficient constraint handling method for genetic algorithms", Computer Methods in Applied Mechanics and Engineering
186, 2000).
"""

import numpy as np

from ..compiled import uncounted
from ..quantities import Real


class InfeasibleWarning(UserWarning):
    """A search ended without a design that meets all constraints.

    Examples
    --------
    No design within these bounds keeps the travel below 5 mm on class D:

    >>> import warnings
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("yuen_ramli_2010")
    >>> problem = sc.RideProblem(
    ...     file.vehicle, sc.Iso8608Road("D"), speed=20.0, bounds=file.bounds, constraints=["SWS <= 0.005"]
    ... )
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     run = sc.minimise(problem, sc.Nsga2(population=20), iterations=5, seed=1)
    >>> caught[0].category.__name__, int(run.feasible.sum())
    ('InfeasibleWarning', 0)
    """


@uncounted(forceinline=True)
def violation_of(value: Real, m: int) -> float:
    """Return the sum of max(0, g) over the constraints among the values (m + c,) of a design."""
    violation = 0.0
    for j in range(m, value.size):
        if value[j] > 0.0:
            violation += value[j]
    return violation


def violations(values: Real, m: int) -> Real:
    """Return the violation (n,) of each design, from values (n, m + c)."""
    return np.maximum(values[:, m:], 0.0).sum(axis=1)


def any_feasible(values: Real, m: int) -> bool:
    """Whether a design meets all constraints, from values (n, m + c)."""
    return bool((violations(values, m) == 0).any()) if values.shape[1] > m else len(values) > 0


def feasible_objectives(values: Real, m: int) -> Real:
    """Return the objectives (k, m) of the feasible designs among values (n, m + c)."""
    if values.shape[1] == m:
        return values
    return values[violations(values, m) == 0, :m]


def ideal_with(ideal: Real, values: Real, has_feasible: bool) -> Real:
    """Return the ideal point (m,) updated by values (n, m + c).

    `has_feasible` says whether `ideal` is of feasible designs. From the first feasible design on, only feasible
    ones count, as the least values of infeasible designs may be far out of reach.
    """
    feasible = feasible_objectives(values, ideal.size)
    if len(feasible):
        least: Real = np.ascontiguousarray(feasible.T).min(axis=1)  # numpy is slow along short rows
        return np.minimum(ideal, least) if has_feasible else least
    return ideal if has_feasible else np.minimum(ideal, values[:, : ideal.size].min(axis=0, initial=np.inf))


_BEYOND = 1e-3
"""Range of the objectives of infeasible designs, beyond the worst feasible value, over the feasible range: small,
so that nothing overflows, and large enough to distinguish 1e9 ranks in double precision."""


def constrained(values: Real, m: int) -> Real:
    """Return objectives (n, m) whose dominance is the constrained dominance of values (n, m + c).

    Objectives of infeasible designs are replaced: they lie beyond the worst feasible ones, in the order of the
    ranks of their violations (a violation itself may vanish beside a large objective).

    K. Deb, A. Pratap, S. Agarwal, T. Meyarivan, "A fast and elitist multiobjective genetic algorithm: NSGA-II",
    IEEE Trans. Evol. Comput. 6(2), 2002, section VI.
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

"""Replacement of partners by a child in MOEA/D-DRA, after each child and over a whole sweep."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..quantities import Integer, Real
from .constraints import violation_of
from .operators import draw_below


class ReplaceWorse(NamedTuple):
    """Replacement of at most `limit` partners of larger violation or, if both are feasible, larger g(F | lambda).

    The rule for constraints is from H. Jain, K. Deb, "An evolutionary many-objective optimization algorithm
    using reference-point based nondominated sorting approach, part II", IEEE Trans. Evol. Comput. 18(4), 2014.
    """

    limit: int

    @compilable()
    def __call__(
        self,
        rng: np.random.Generator,
        child: Real,
        child_values: Real,
        partners: Integer,
        designs: Real,
        values: Real,
        weights: Real,
        ideal: Real,
    ) -> None:
        """Update the ideal point (m,), then replace partners by a child (d,) of values (m + c,), in place."""
        n, m = weights.shape
        kept = Kept(np.empty(n), np.full(m, np.nan), partners, np.empty(m), np.empty_like(partners))
        replace(rng, child, child_values, partners, designs, values, weights, ideal, self.limit, kept)


class Kept(NamedTuple):
    """Costs that hold from one replacement to the next if nothing else changes the population, and work space."""

    costs: Real  # (N,) `cost_of` individuals at the ideal point `known`
    known: Real  # (m,) NaN: none
    everyone: Integer  # (N,)
    gaps: Real  # (m,) work space, |F - z| of the child
    worse: Integer  # (k,) work space, indices of those that the child betters


class ReplaceInSweep(NamedTuple):
    """`ReplaceWorse` in sweeps, within which nothing else changes the population."""

    limit: int
    kept: Kept

    @classmethod
    def of(cls, verb: ReplaceWorse, everyone: Integer, known: Real) -> "ReplaceInSweep":
        """Return the verb for a population (N,), whose costs are known at an ideal point (m,), NaN: not yet."""
        return cls(
            verb.limit, Kept(np.empty(everyone.size), known, everyone, np.empty_like(known), everyone.copy())
        )

    @uncounted()
    def __call__(
        self,
        rng: np.random.Generator,
        child: Real,
        child_values: Real,
        partners: Integer,
        designs: Real,
        values: Real,
        weights: Real,
        ideal: Real,
    ) -> None:
        """Do what `ReplaceWorse` does."""
        replace(rng, child, child_values, partners, designs, values, weights, ideal, self.limit, self.kept)


@uncounted()
def replace(
    rng: np.random.Generator,
    child: Real,
    child_values: Real,
    partners: Integer,
    designs: Real,
    values: Real,
    weights: Real,
    ideal: Real,
    limit: int,
    kept: Kept,
) -> None:
    """Update ideal point, population and what is kept by a child (d,) with values (m + c,), in place."""
    violation = violation_of(child_values, ideal.size)
    lower_ideal(ideal, child_values, violation == 0.0, values)
    moved = False
    for j in range(ideal.size):
        moved |= kept.known[j] != ideal[j]
        kept.known[j], kept.gaps[j] = ideal[j], abs(child_values[j] - ideal[j])
    if moved:
        for i in kept.everyone:
            kept.costs[i] = cost_of(values[i], weights[i], ideal)
    count = find_worse(violation, partners, values, weights, kept)
    # Drawing `limit` of the worse partners equals taking the first ones in a random order of all partners.
    fewest = count - limit if count > limit else 0
    for left in range(count, fewest, -1):
        drawn = draw_below(rng, left)
        i = kept.worse[drawn]
        kept.worse[drawn] = kept.worse[left - 1]
        for v in range(child.size):
            designs[i, v] = child[v]
        for j in range(child_values.size):
            values[i, j] = child_values[j]
        kept.costs[i] = cost_of(child_values, weights[i], ideal)


@uncounted()
def find_worse(violation: float, partners: Integer, values: Real, weights: Real, kept: Kept) -> int:
    """Put partners that a child of this violation and these gaps betters into `kept.worse`; return their count."""
    m, costs, worse, gaps = weights.shape[1], kept.costs, kept.worse, kept.gaps
    # Without branches, which a processor would guess wrongly: whoever is compared is written to the end. Indices
    # have no sign, which numba would test. A loop over objectives would double the time of two or three.
    count, first, second, last = np.uint64(0), gaps[0], gaps[1], gaps[m - 1]
    if violation == 0.0 and m <= 3:
        for k in range(partners.size):
            i = np.uint64(partners[k])
            a, b, c = weights[i, 0] * first, weights[i, 1] * second, weights[i, m - 1] * last
            a = b if b > a else a
            a = c if c > a else a
            worse[count] = i
            count += np.uint64(a < costs[i])
        return int(count)
    for k in range(partners.size):
        i = np.uint64(partners[k])
        better = violation == 0.0 or violation < violation_of(values[i], m)
        if violation == 0.0:
            for j in range(m):
                better &= weights[i, j] * gaps[j] < costs[i]
        worse[count] = i
        count += np.uint64(better)
    return int(count)


@uncounted()
def lower_ideal(ideal: Real, child: Real, feasible: bool, values: Real) -> None:
    """Update the ideal point (m,) by a child's values (m + c,), in place, as `ideal_with` does."""
    has_feasible, i = False, 0
    while not has_feasible and i < values.shape[0]:
        has_feasible = violation_of(values[i], ideal.size) == 0.0
        i += 1
    for j in range(ideal.size):
        if (feasible and not has_feasible) or (feasible == has_feasible and child[j] < ideal[j]):
            ideal[j] = child[j]


@uncounted()
def cost_of(value: Real, weight: Real, ideal: Real) -> float:
    """Return g(F | lambda) of values (m + c,) by a weight (m,), as `tchebycheff` does; infinite if infeasible."""
    if violation_of(value, ideal.size) > 0.0:
        return np.inf
    cost = 0.0
    for j in range(ideal.size):
        g = weight[j] * abs(value[j] - ideal[j])
        cost = g if g > cost else cost
    return cost

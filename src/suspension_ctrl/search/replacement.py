"""Replacement of partners by a child in MOEA/D-DRA, after each child and over a whole sweep."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, uncounted
from ..quantities import Bool, Integer, Real
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
        words = np.empty(0, dtype=np.int64)
        kept = Kept(
            np.empty(n), np.full(m, np.nan), partners, np.empty(m), np.empty_like(partners), False, words,
            words.view(np.bool_),
        )  # fmt: skip
        replace(rng, child, child_values, partners, designs, values, weights, ideal, self.limit, kept)


class Kept(NamedTuple):
    """Costs that hold from one replacement to the next if nothing else changes the population, and work space."""

    costs: Real  # (N,) `cost_of` individuals at the ideal point `known`
    known: Real  # (m,) NaN: none
    everyone: Integer  # (N,) individuals with costs
    gaps: Real  # (m,) work space, |F - z| of the child
    worse: Integer  # (k,) work space, indices of those that the child betters
    ordered: bool  # whether as many partners as there are individuals are 0 to N - 1
    words: Integer  # (n,) work space, eight marks in each
    marks: Bool  # (8 n,) the same memory, whom of 0 to N - 1 the child betters; false from N on

    @classmethod
    def of(cls, everyone: Integer, known: Real, ordered: bool) -> "Kept":
        """Return work space for a population, whose costs are known at an ideal point (m,)."""
        n, m = everyone.size, known.size
        words = np.zeros(-(-n // 8), dtype=np.int64)
        worse = np.empty(n + 8, dtype=np.int64)
        return cls(
            np.empty(n), known, everyone, np.empty(m), worse, ordered, words, words.view(np.bool_)
        )  # fmt: skip


class ReplaceInSweep(NamedTuple):
    """`ReplaceWorse` in sweeps, within which nothing else changes the population."""

    limit: int
    kept: Kept

    @classmethod
    def of(cls, verb: ReplaceWorse, everyone: Integer, known: Real, ordered: bool) -> "ReplaceInSweep":
        """Return the verb for a population (N,), whose costs are known at an ideal point (m,), NaN: not yet.

        `ordered` says that a mating range of N partners is `everyone`.
        """
        return cls(verb.limit, Kept.of(everyone, known, ordered))

    @uncounted(forceinline=True)
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


@uncounted(forceinline=True)
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
    keep_costs(child_values, values, weights, ideal, kept)
    if kept.ordered and violation == 0.0 and ideal.size <= 3 and partners.size == kept.costs.size:
        mark_better(weights, kept.costs, kept.gaps, kept.marks)
        count = marked(kept.words, kept.marks, kept.worse)
    else:
        count = find_worse(violation, partners, values, weights, kept.costs, kept.gaps, kept.worse)
    # Drawing `limit` of the worse partners equals taking the first ones in a random order of all partners.
    fewest = count - limit if count > limit else 0
    for left in range(count, fewest, -1):
        drawn = np.uint64(draw_below(rng, left))
        i = np.uint64(kept.worse[drawn])
        kept.worse[drawn] = kept.worse[left - 1]
        for v in range(child.size):
            designs[i, v] = child[v]
        for j in range(child_values.size):
            values[i, j] = child_values[j]
        kept.costs[i] = cost_of(child_values, weights[i], ideal)


@uncounted(forceinline=True)
def keep_costs(child_values: Real, values: Real, weights: Real, ideal: Real, kept: Kept) -> None:
    """Put the gaps of a child to the ideal point (m,) into what is kept, and all costs if that has moved."""
    moved = False
    for j in range(ideal.size):
        moved |= kept.known[j] != ideal[j]
        kept.known[j], kept.gaps[j] = ideal[j], abs(child_values[j] - ideal[j])
    if moved and kept.ordered:
        costs_of_all(values, weights, ideal, kept.costs)
    elif moved:
        for i in kept.everyone:
            kept.costs[i] = cost_of(values[i], weights[i], ideal)


@uncounted(forceinline=True)
def find_worse(
    violation: float, partners: Integer, values: Real, weights: Real, costs: Real, gaps: Real, worse: Integer
) -> np.int64:
    """Put partners (k,) that a child of this violation and these gaps betters into `worse`; return their count."""
    m = weights.shape[1]
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
        return np.int64(count)  # `int` is a function that numba compiles
    for k in range(partners.size):
        i = np.uint64(partners[k])
        better = violation == 0.0 or violation < violation_of(values[i], m)
        if violation == 0.0:
            for j in range(m):
                better &= weights[i, j] * gaps[j] < costs[i]
        worse[count] = i
        count += np.uint64(better)
    return np.int64(count)


@uncounted(forceinline=True)
def mark_better(weights: Real, costs: Real, gaps: Real, marks: Bool) -> None:
    """Mark who of all (N,) has a larger cost than a feasible child of two or three objectives, several at once."""
    last = weights.shape[1] - 1
    a, b, c = gaps[0], gaps[1], gaps[last]
    for i in range(costs.size):
        cost = costs[i]
        marks[i] = (weights[i, 0] * a < cost) & (weights[i, 1] * b < cost) & (weights[i, last] * c < cost)


@uncounted(forceinline=True)
def marked(words: Integer, marks: Bool, found: Integer) -> np.int64:
    """Put the indices of marks (8 n,) in words (n,), none of which most have, into `found`; return their count."""
    count = np.uint64(0)
    for w in range(words.size):
        if words[w] != 0:
            for i in range(8 * w, 8 * w + 8):
                found[count] = i
                count += np.uint64(marks[i])
    return np.int64(count)


@uncounted(forceinline=True)
def lower_ideal(ideal: Real, child: Real, feasible: bool, values: Real) -> None:
    """Update the ideal point (m,) by a child's values (m + c,), in place, as `ideal_with` does."""
    has_feasible, i = False, 0
    while not has_feasible and i < values.shape[0]:
        has_feasible = violation_of(values[i], ideal.size) == 0.0
        i += 1
    for j in range(ideal.size):
        if (feasible and not has_feasible) or (feasible == has_feasible and child[j] < ideal[j]):
            ideal[j] = child[j]


@uncounted(forceinline=True)
def cost_of(value: Real, weight: Real, ideal: Real) -> float:
    """Return g(F | lambda) of values (m + c,) by a weight (m,), as `tchebycheff` does; infinite if infeasible."""
    if violation_of(value, ideal.size) > 0.0:
        return np.inf
    cost = 0.0
    for j in range(ideal.size):
        g = weight[j] * abs(value[j] - ideal[j])
        cost = g if g > cost else cost
    return cost


@uncounted(forceinline=True)
def costs_of_all(values: Real, weights: Real, ideal: Real, costs: Real) -> None:
    """Put what `cost_of` returns for values (N, m + c) by weights (N, m) into `costs` (N,), several at once."""
    m = ideal.size
    for i in range(costs.size):
        costs[i] = 0.0
    for j in range(m):
        least = ideal[j]
        for i in range(costs.size):
            g = weights[i, j] * abs(values[i, j] - least)
            costs[i] = g if g > costs[i] else costs[i]
    if values.shape[1] > m:
        for i in range(costs.size):
            if violation_of(values[i], m) > 0.0:
                costs[i] = np.inf

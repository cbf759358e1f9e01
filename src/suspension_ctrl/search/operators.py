"""Variation operators on real designs in a box, compiled; all random numbers come from the given generator."""

from math import log
from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Bool, Integer, Real


def sample_uniform(rng: np.random.Generator, size: int, lower: Real, upper: Real) -> Real:
    """Return designs (size, d) drawn uniformly from the box."""
    # The numbers of rng.uniform in a tenth of its time with arrays as bounds.
    return lower + (upper - lower) * rng.random((size, lower.size))


@uncounted(forceinline=True)
def draw_below(rng: np.random.Generator, count: int) -> np.int64:
    """Return a whole number drawn uniformly from 0 to count - 1."""
    return np.int64(rng.random() * count)


def crowded_tournament(rng: np.random.Generator, rank: Integer, crowding: Real, size: int) -> Integer:
    """Return `size` winners of tournaments of shuffled pairs out of ranks (n,): lower rank, then larger crowding.

    It is the crowded comparison of Deb et al. 2002; in a pass over the population everyone takes part once.
    """
    pairs = rank.size // 2
    passes = [rng.permutation(rank.size)[: 2 * pairs] for _ in range(-(-size // pairs))]
    a, b = np.concatenate(passes)[: 2 * size].reshape(-1, 2).T
    return ranked_winners(a, b, rank, crowding)


@compiled()
def ranked_winners(a: Integer, b: Integer, rank: Integer, crowding: Real) -> Integer:
    """Return the winners (k,) of tournaments of a (k,) and b (k,): a where they tie."""
    winners = np.empty(a.size, dtype=np.int64)
    for k in range(a.size):
        one, other = a[k], b[k]
        b_wins = rank[other] < rank[one] or (rank[other] == rank[one] and crowding[other] > crowding[one])
        winners[k] = other if b_wins else one
    return winners


def simulated_binary_crossover(
    rng: np.random.Generator, parents: Real, lower: Real, upper: Real, eta: float, probability: float
) -> Real:
    """Return children (n, d) of consecutive parents (n, d) by bounded SBX; the last of an odd number is copied.

    K. Deb, R. B. Agrawal, Complex Systems 9, 1995, in the bounded form of Deb's NSGA-II code: a pair mates with
    `probability`, then each variable is recombined with probability 1/2.
    """
    pairs, variables = parents.shape[0] // 2, parents.shape[1]
    mates = rng.random(pairs) < probability
    return recombined(parents, mates, rng.random((pairs, variables, 3)), lower, upper, eta)


@compiled()
def recombined(parents: Real, mates: Bool, draws: Real, lower: Real, upper: Real, eta: float) -> Real:
    """Return children (n, d) by draws (n // 2, d, 3): recombination of a variable, spread, order of the pair."""
    children = parents.copy()
    for pair in range(mates.size):
        if not mates[pair]:
            continue
        first = 2 * pair
        for v in range(parents.shape[1]):
            one, other = parents[first, v], parents[first + 1, v]
            low, high = min(one, other), max(one, other)
            if draws[pair, v, 0] < 0.5 or high - low <= 1e-14 * (upper[v] - lower[v]):
                continue
            u = draws[pair, v, 1]
            down = sbx_spread(u, (low - lower[v]) / (high - low), eta)
            up = sbx_spread(u, (upper[v] - high) / (high - low), eta)
            a = max(lower[v], 0.5 * (low + high - down * (high - low)))
            b = min(upper[v], 0.5 * (low + high + up * (high - low)))
            swap = draws[pair, v, 2] < 0.5
            children[first, v] = b if swap else a
            children[first + 1, v] = a if swap else b
    return children


@compilable()
def sbx_spread(u: float, room: float, eta: float) -> float:
    """Return the spread factor of SBX for the draw u; `room` is the distance to the bound over the parents'."""
    alpha = 2.0 - (1.0 + 2.0 * room) ** -(eta + 1.0)
    inside = u * alpha if u <= 1.0 / alpha else 1.0 / (2.0 - u * alpha)
    return float(inside ** (1.0 / (eta + 1.0)))


def polynomial_mutation(
    rng: np.random.Generator, designs: Real, lower: Real, upper: Real, eta: float, probability: float
) -> Real:
    """Return mutants (n, d) of designs (n, d) by polynomial mutation of each variable with `probability`.

    K. Deb, M. Goyal, "A combined genetic adaptive search (GeneAS) for engineering design", 1996, in the bounded
    form of Deb's NSGA-II code.
    """
    mutates = rng.random(designs.shape) < probability
    return mutated(designs, mutates, rng.random(designs.shape), lower, upper, eta)


@compiled()
def mutated(designs: Real, mutates: Bool, draws: Real, lower: Real, upper: Real, eta: float) -> Real:
    """Return mutants (n, d) of designs (n, d) where `mutates` (n, d) is true, by draws (n, d)."""
    mutants = designs.copy()
    for i in range(designs.shape[0]):
        for v in range(designs.shape[1]):
            if mutates[i, v]:
                mutants[i, v] = mutated_value(designs[i, v], draws[i, v], lower[v], upper[v], eta)
    return mutants


@uncounted(forceinline=True)
def mutated_value(value: float, u: float, lower: float, upper: float, eta: float) -> float:
    """Return the polynomial mutation of a value in its bounds for the draw u."""
    width = upper - lower
    if u < 0.5:
        rest = (1.0 - (value - lower) / width) ** (eta + 1.0)
        step = (2.0 * u + (1.0 - 2.0 * u) * rest) ** (1.0 / (eta + 1.0)) - 1.0
    else:
        rest = (1.0 - (upper - value) / width) ** (eta + 1.0)
        step = 1.0 - (2.0 * (1.0 - u) + (2.0 * u - 1.0) * rest) ** (1.0 / (eta + 1.0))
    mutant = value + step * width  # no min and max: numba compiles these functions for each caller
    return lower if mutant < lower else upper if mutant > upper else mutant


class MutateDesign(NamedTuple):
    """Polynomial mutation of one design: each variable changes with the same probability p."""

    lower: Real
    upper: Real
    eta: float
    stride: float  # -1 / log(1 - p)

    @classmethod
    def of(cls, lower: Real, upper: Real, eta: float, probability: float) -> "MutateDesign":
        """Return the verb for a probability from 0 to 1."""
        with np.errstate(divide="ignore"):
            return cls(lower, upper, eta, float(-1.0 / np.log1p(-np.float64(probability))))

    @compilable()
    def __call__(self, rng: np.random.Generator, design: Real) -> Real:
        """Return the design (d,), mutated in place."""
        mutate_design(self, rng, design)
        return design


class DifferentialChild(NamedTuple):
    """Differential evolution with CR = 1: x_i + scale (x_r2 - x_r3)."""

    scale: float

    @compilable()
    def __call__(self, rng: np.random.Generator, designs: Real, i: int, partners: Integer) -> Real:
        """Return a child (d,) of individual i; r2 and r3 are different and drawn from `partners`."""
        child = np.empty(designs.shape[1])
        differ(self, rng, designs, i, partners, child)
        return child


class RedrawOutside(NamedTuple):
    """Repair: a variable out of bounds is drawn between the bound and `reach` of the way to the parent's value."""

    lower: Real
    upper: Real
    reach: float

    @compilable()
    def __call__(self, rng: np.random.Generator, child: Real, parent: Real) -> Real:
        """Return the child (d,) of a parent (d,), repaired in place."""
        redraw_outside(self, rng, child, parent)
        return child


@uncounted()
def mutate_design(verb: MutateDesign, rng: np.random.Generator, design: Real) -> None:
    """Mutate a design (d,) in place."""
    # The number of variables up to the next that changes is drawn, geometric: the floor of an exponential number.
    v = 0
    while True:
        skipped = verb.stride * -log(1.0 - rng.random())
        if not skipped < design.size - v:  # NaN with a probability of zero, of 0 times infinity
            return
        v += int(skipped)
        design[v] = mutated_value(design[v], rng.random(), verb.lower[v], verb.upper[v], verb.eta)
        v += 1


@uncounted()
def differ(
    verb: DifferentialChild, rng: np.random.Generator, designs: Real, i: int, partners: Integer, child: Real
) -> None:
    """Put a child of individual i into `child` (d,)."""
    first, second = draw_below(rng, partners.size), draw_below(rng, partners.size - 1)
    second += second >= first
    one, other = partners[first], partners[second]
    for v in range(child.size):
        child[v] = designs[i, v] + verb.scale * (designs[one, v] - designs[other, v])


@uncounted()
def redraw_outside(verb: RedrawOutside, rng: np.random.Generator, child: Real, parent: Real) -> None:
    """Repair a child (d,) of a parent (d,) in place."""
    for v in range(child.size):
        if child[v] < verb.lower[v]:
            child[v] = verb.lower[v] + verb.reach * rng.random() * (parent[v] - verb.lower[v])
        elif child[v] > verb.upper[v]:
            child[v] = verb.upper[v] - verb.reach * rng.random() * (verb.upper[v] - parent[v])

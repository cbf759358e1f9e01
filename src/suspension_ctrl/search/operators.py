"""Variation operators on real designs in a box, compiled; all random numbers come from the given generator."""

from math import log
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..compiled import compilable, filling, uncounted
from ..quantities import Integer, Real


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
    half = rank.size // 2
    passes = [rng.permutation(rank.size)[: 2 * half] for _ in range(-(-size // half))]
    return winners_of(np.concatenate(passes)[: 2 * size].reshape(-1, 2), rank, crowding)


def winners_of(pairs: Integer, rank: Integer, crowding: Real) -> Integer:
    """Return the winners (k,) of tournaments of pairs (k, 2): the first where they tie."""
    winners = np.empty(len(pairs), dtype=np.int64)
    fill_winners(pairs, rank, crowding, winners)
    return winners


@filling()
def fill_winners(pairs: Integer, rank: Integer, crowding: Real, winners: Integer) -> None:
    """Fill in the winners (k,) of pairs (k, 2), without branches, which would be as good as random."""
    for k in range(winners.size):
        one, other = pairs[k, 0], pairs[k, 1]
        less_crowded = (rank[other] == rank[one]) & (crowding[other] > crowding[one])
        winners[k] = pairs[k, np.int64((rank[other] < rank[one]) | less_crowded)]


def simulated_binary_crossover(
    rng: np.random.Generator, parents: Real, lower: Real, upper: Real, eta: float, probability: float
) -> Real:
    """Return children (n, d) of consecutive parents (n, d) by bounded SBX; the last of an odd number is copied.

    K. Deb, R. B. Agrawal, Complex Systems 9, 1995, in the bounded form of Deb's NSGA-II code: a pair mates with
    `probability`, then each variable is recombined with probability 1/2.
    """
    children, (n, d) = parents.copy(), parents.shape
    mates, draws = rng.random(n // 2), rng.random((n // 2, d, 3))
    places, alphas = np.empty((2, n // 2 * d + 1), dtype=np.int32), np.empty((2, n // 2 * d))
    recombine(children, mates, probability, draws, lower, upper, eta, places, alphas)
    return children


@filling()
def recombine(
    children: Real,
    mates: Real,
    probability: float,
    draws: Real,
    lower: Real,
    upper: Real,
    eta: float,
    places: NDArray[np.int32],
    alphas: Real,
) -> None:
    """Replace pairs of parents (n, d) that mate, by draws (n // 2,), by children; the last two are room.

    Draws (n // 2, d, 3) are for the recombination of a variable, the spread and the order of the pair. What is
    recombined is collected first: powers take half as long without branches between them that are as good as
    random, and without waiting for one another.
    """
    count = 0
    for pair in range(mates.size):
        for v in range(children.shape[1]):
            places[0, count], places[1, count] = 2 * pair, v
            gap = abs(children[2 * pair, v] - children[2 * pair + 1, v])
            mixes = (mates[pair] < probability) & (draws[pair, v, 0] >= 0.5)
            count += mixes & (gap > 1e-14 * (upper[v] - lower[v]))
    for k in range(count):
        i, v = places[0, k], places[1, k]
        low, high = in_order(children[i, v], children[i + 1, v])
        alphas[0, k] = sbx_alpha((low - lower[v]) / (high - low), eta)
        alphas[1, k] = sbx_alpha((upper[v] - high) / (high - low), eta)
    for k in range(count):
        i, v = places[0, k], places[1, k]
        low, high = in_order(children[i, v], children[i + 1, v])
        u, swaps = draws[i // 2, v, 1], draws[i // 2, v, 2] < 0.5
        a = 0.5 * (low + high - sbx_spread(u, alphas[0, k], eta) * (high - low))
        b = 0.5 * (low + high + sbx_spread(u, alphas[1, k], eta) * (high - low))
        a, b = a if a > lower[v] else lower[v], b if b < upper[v] else upper[v]
        children[i, v], children[i + 1, v] = (b, a) if swaps else (a, b)


@uncounted(forceinline=True)
def in_order(one: float, other: float) -> tuple[float, float]:
    """Return two values in ascending order."""
    return (one, other) if one < other else (other, one)


@uncounted(forceinline=True)
def sbx_alpha(room: float, eta: float) -> float:
    """Return alpha of SBX; `room` is the distance to the bound over that of the parents."""
    return float(2.0 - (1.0 + 2.0 * room) ** -(eta + 1.0))


@uncounted(forceinline=True)
def sbx_spread(u: float, alpha: float, eta: float) -> float:
    """Return the spread factor of SBX for the draw u."""
    near = u <= 1.0 / alpha
    return float(((u * alpha if near else 1.0) / (1.0 if near else 2.0 - u * alpha)) ** (1.0 / (eta + 1.0)))


def polynomial_mutation(
    rng: np.random.Generator, designs: Real, lower: Real, upper: Real, eta: float, probability: float
) -> Real:
    """Return mutants (n, d) of designs (n, d) by polynomial mutation of each variable with `probability`.

    K. Deb, M. Goyal, "A combined genetic adaptive search (GeneAS) for engineering design", 1996, in the bounded
    form of Deb's NSGA-II code.
    """
    mutants, draws = designs.copy(), rng.random((2, *designs.shape))
    places, rests = np.empty((2, designs.size + 1), dtype=np.int32), np.empty(designs.size)
    mutate(mutants, draws, probability, lower, upper, eta, places, rests)
    return mutants


@filling()
def mutate(
    mutants: Real,
    draws: Real,
    probability: float,
    lower: Real,
    upper: Real,
    eta: float,
    places: NDArray[np.int32],
    rests: Real,
) -> None:
    """Mutate designs (n, d) in place by draws (2, n, d), of the choice and the step; the last two are room.

    What mutates is collected first, as in `recombine`.
    """
    count = 0
    for i in range(mutants.shape[0]):
        for v in range(mutants.shape[1]):
            places[0, count], places[1, count] = i, v
            count += draws[0, i, v] < probability
    for k in range(count):
        i, v = places[0, k], places[1, k]
        rests[k] = mutation_rest(mutants[i, v], draws[1, i, v], lower[v], upper[v], eta)
    for k in range(count):
        i, v = places[0, k], places[1, k]
        mutants[i, v] = mutated_by(mutants[i, v], draws[1, i, v], lower[v], upper[v], eta, rests[k])


@uncounted(forceinline=True)
def mutated_value(value: float, u: float, lower: float, upper: float, eta: float) -> float:
    """Return the polynomial mutation of a value in its bounds for the draw u."""
    return mutated_by(value, u, lower, upper, eta, mutation_rest(value, u, lower, upper, eta))


@uncounted(forceinline=True)
def mutation_rest(value: float, u: float, lower: float, upper: float, eta: float) -> float:
    """Return the power in polynomial mutation for the draw u, by its bound on the side of the step."""
    return float((1.0 - (value - lower if u < 0.5 else upper - value) / (upper - lower)) ** (eta + 1.0))


@uncounted(forceinline=True)
def mutated_by(value: float, u: float, lower: float, upper: float, eta: float, rest: float) -> float:
    """Return the polynomial mutation of a value for the draw u, by `mutation_rest`."""
    share, width = u if u < 0.5 else 1.0 - u, upper - lower
    step = (2.0 * share + (1.0 - 2.0 * share) * rest) ** (1.0 / (eta + 1.0)) - 1.0
    step = step if u < 0.5 else -step
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

"""Variation operators: inside the box always, and distributed as their definitions say."""

import random

import numpy as np
import pytest
from deap import tools
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import ks_2samp, kstest

from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.search import operators

LOWER, UPPER = np.array([-1.0, 0.0, 10.0]), np.array([1.0, 5.0, 11.0])
P_LIMIT = 1e-4  # of a test with a fixed seed, which so fails only when the code or numpy's stream changes


@st.composite
def populations(draw):
    n = draw(st.integers(1, 9))
    unit = st.floats(0, 1)
    rows = [[draw(unit) for _ in LOWER] for _ in range(n)]
    return LOWER + np.array(rows) * (UPPER - LOWER)


@given(populations(), st.integers(0, 2**32), st.sampled_from([0.5, 20.0, 100.0]))
def test_children_stay_in_the_box_and_parents_unchanged(parents, seed, eta):
    before = parents.copy()
    rng = np.random.default_rng(seed)
    for children in (
        operators.simulated_binary_crossover(rng, parents, LOWER, UPPER, eta, 1.0),
        operators.polynomial_mutation(rng, parents, LOWER, UPPER, eta, 1.0),
        operators.sample_uniform(rng, parents.shape[0], LOWER, UPPER),
    ):
        assert children.shape == parents.shape
        assert ((children >= LOWER) & (children <= UPPER)).all()
    np.testing.assert_array_equal(parents, before)


@given(populations(), st.integers(0, 2**32), st.floats(0.1, 3), st.sampled_from([0.0, 0.25, 1.0]))
def test_repair_brings_children_back_between_bound_and_parent(designs, seed, scale, reach):
    """Within a fraction of the way from the bound, to the last bit, as every rounding is monotonous."""
    rng = np.random.default_rng(seed)
    n = designs.shape[0]
    child = call_compiled(
        operators.DifferentialChild(scale), rng, np.vstack([designs, designs[:1]]), 0, np.arange(n + 1)
    )
    child += rng.normal(0, 5, child.size)
    repaired = call_compiled(operators.RedrawOutside(LOWER, UPPER, reach), rng, child.copy(), designs[0])
    inside = (child >= LOWER) & (child <= UPPER)
    np.testing.assert_array_equal(repaired[inside], child[inside])
    below, above = child < LOWER, child > UPPER
    assert (repaired >= LOWER).all()
    assert (repaired <= UPPER).all()
    assert (repaired <= LOWER + reach * (designs[0] - LOWER))[below].all()
    assert (repaired >= UPPER - reach * (UPPER - designs[0]))[above].all()


@pytest.mark.parametrize(("low", "high", "eta"), [(0.2, 0.7, 20.0), (0.05, 0.9, 1.0), (0.4, 0.95, 3.0)])
def test_crossover_is_distributed_as_deaps(low, high, eta):
    """In the middle of the box, and where its bounds cut the spread."""
    box = np.array([0.0]), np.array([1.0])
    parents = np.tile([[low], [high]], (10_000, 1))
    ours = operators.simulated_binary_crossover(np.random.default_rng(3), parents, *box, eta, 1.0)
    random.seed(3)
    deaps = [
        child[0]
        for _ in range(10_000)
        for child in tools.cxSimulatedBinaryBounded([low], [high], eta=eta, low=0.0, up=1.0)
    ]
    assert ks_2samp(ours[:, 0], deaps).pvalue > P_LIMIT
    sums = ours.reshape(-1, 2).sum(axis=1), np.reshape(deaps, (-1, 2)).sum(axis=1)
    assert ks_2samp(*sums).pvalue > P_LIMIT


@pytest.mark.parametrize(("value", "eta"), [(0.1, 20.0), (0.5, 1.0), (0.97, 3.0)])
def test_mutation_is_distributed_as_deaps(value, eta):
    box = np.array([0.0]), np.array([1.0])
    ours = operators.polynomial_mutation(np.random.default_rng(4), np.full((20_000, 1), value), *box, eta, 1.0)
    random.seed(4)
    deaps = [tools.mutPolynomialBounded([value], eta=eta, low=0.0, up=1.0, indpb=1.0)[0][0] for _ in range(20_000)]
    assert ks_2samp(ours[:, 0], deaps).pvalue > P_LIMIT


@pytest.mark.parametrize("probability", [0.0, 0.3, 1.0])
def test_variables_of_a_design_mutate_independently(probability):
    """Each of the eight subsets of three variables as often as it should, to five standard errors."""
    rng, n = np.random.default_rng(7), 4000
    verb = operators.MutateDesign.of(LOWER, UPPER, 20.0, probability)
    designs = np.array([call_compiled(verb, rng, (LOWER + UPPER) / 2) for _ in range(n)])
    subset = (designs != (LOWER + UPPER) / 2) @ [1, 2, 4]
    each = np.array([1 - probability, probability])
    expected = n * np.einsum("i,j,k->ijk", each, each, each).ravel()
    error = np.sqrt(expected * (1 - expected / n))
    assert (np.abs(np.bincount(subset, minlength=8) - expected) <= 5 * error).all()


def test_probabilities_are_kept():
    rng = np.random.default_rng(5)
    designs = np.full((20000, 3), 0.5)
    box = np.zeros(3), np.ones(3)
    mutated = (operators.polynomial_mutation(rng, designs, *box, 20.0, 0.25) != designs).mean()
    assert mutated == pytest.approx(0.25, abs=5 * np.sqrt(0.25 * 0.75 / 60000))  # five standard errors
    parents = np.tile([[0.2, 0.2, 0.2], [0.8, 0.8, 0.8]], (10000, 1))
    crossed = (operators.simulated_binary_crossover(rng, parents, *box, 20.0, 0.6) != parents).mean()
    assert crossed == pytest.approx(0.3, abs=5 * np.sqrt(0.3 * 0.7 / 10000))  # pairs 0.6, variables 1/2


def test_variables_are_exchanged_between_children_by_even_chance():
    """Of 2000 pairs: half the variables recombine, and in half of these the first child has the larger value."""
    parents = np.tile([[0.2, 0.3], [0.6, 0.5]], (2000, 1))
    children = operators.simulated_binary_crossover(
        np.random.default_rng(1), parents, np.zeros(2), np.ones(2), 20.0, 1.0
    )
    larger = children[::2] > children[1::2]
    assert larger.mean(axis=0) == pytest.approx([0.25, 0.25], abs=5 * np.sqrt(0.25 * 0.75 / 2000))
    assert larger.all(axis=1).mean() == pytest.approx(1 / 16, abs=5 * np.sqrt(15 / 256 / 2000))


def test_a_last_parent_without_a_mate_is_copied():
    parents = np.random.default_rng(0).random((5, 2))
    children = operators.simulated_binary_crossover(
        np.random.default_rng(1), parents, np.zeros(2), np.ones(2), 20.0, 1.0
    )
    np.testing.assert_array_equal(children[4], parents[4])


def test_differential_evolution_draws_two_different_partners_evenly():
    rng = np.random.default_rng(6)
    designs = np.array([[0.0], [1.0], [10.0], [100.0]])
    children = [
        call_compiled(operators.DifferentialChild(1.0), rng, designs, 0, np.array([1, 2, 3]))[0]
        for _ in range(6000)
    ]
    differences, counts = np.unique(children, return_counts=True)
    np.testing.assert_array_equal(differences, [-99, -90, -9, 9, 90, 99])
    assert (np.abs(counts - 1000) < 5 * np.sqrt(1000)).all()


def test_tournaments_give_everyone_the_same_chances():
    """Each pass pairs everyone once; the best of all wins every time, the worst never."""
    winners = operators.crowded_tournament(np.random.default_rng(0), np.arange(6), np.zeros(6), 3000)
    counts = np.bincount(winners, minlength=6)
    assert counts[0] == 1000
    assert counts[5] == 0


def test_tournaments_between_equals_go_to_the_less_crowded():
    rank = np.zeros(2, dtype=int)
    winners = operators.crowded_tournament(np.random.default_rng(0), rank, np.array([0.2, 0.7]), 50)
    assert (winners == 1).all()
    draws = operators.crowded_tournament(np.random.default_rng(0), rank, np.array([0.2, 0.2]), 4000)
    assert draws.mean() == pytest.approx(0.5, abs=5 * 0.5 / np.sqrt(4000))


def test_a_lower_rank_beats_the_less_crowded():
    """Also where it does not dominate: the crowded comparison is by rank."""
    rank, crowding = np.array([1, 0]), np.array([np.inf, 0.1])
    assert (operators.crowded_tournament(np.random.default_rng(0), rank, crowding, 50) == 1).all()


def test_samples_are_uniform_in_the_box():
    sample = operators.sample_uniform(np.random.default_rng(9), 4000, LOWER, UPPER)
    for column, low, high in zip(sample.T, LOWER, UPPER, strict=True):
        assert kstest(column, "uniform", args=(low, high - low)).pvalue > P_LIMIT


@given(st.integers(1, 2**40))
def test_draws_stay_below_the_count(count):
    """Also for the largest number that a generator returns, 1 - 2^-53."""
    assert 0 <= int((1 - 2.0**-53) * count) < count
    assert 0 <= operators.draw_below(np.random.default_rng(count), count) < count

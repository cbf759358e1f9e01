"""The steps of MOEA/D-DRA, each against its definition."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.search import decomposition
from suspension_ctrl.search.neighbours import neighbourhoods


def chosen_by(rng, utility, corners, size):
    return call_compiled(decomposition.ByTournament(10), rng, utility, corners, size)


@pytest.mark.parametrize("m", [2, 3, 4])
@pytest.mark.parametrize("n", [20, 105])
def test_weights_lie_on_the_simplex_and_begin_with_its_corners(n, m):
    weights = decomposition.weight_vectors(n, m)
    assert weights.shape == (n, m)
    assert (weights >= 0).all()
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=1e-12)
    np.testing.assert_array_equal(weights[:m], np.eye(m))


def test_weights_are_evenly_spread():
    """Each new one is farthest from the others, so no two are closer than the radius that is left uncovered.

    But for the holes between the n = 5000 candidates, on the simplex of area A: sqrt(A log(n) / (pi n)).
    """
    weights = decomposition.weight_vectors(200, 3)
    distance = np.linalg.norm(weights[:, None] - weights[None], axis=2) + 2 * np.eye(200)
    sample = np.random.default_rng(0).dirichlet(np.ones(3), 2000)
    uncovered = np.linalg.norm(sample[:, None] - weights[None], axis=2).min(axis=1).max()
    hole = np.sqrt(np.sqrt(3) / 2 * np.log(5000) / (np.pi * 5000))
    assert distance.min() >= uncovered - hole
    # Anyone's nearest neighbour is within two radii of what is left uncovered, or a candidate would lie between.
    assert distance.min(axis=1).max() <= 2 * (distance.min() + hole)


def test_two_objectives_get_a_near_regular_row_of_weights():
    first = np.sort(decomposition.weight_vectors(33, 2)[:, 0])
    gaps = np.diff(first)
    assert gaps.max() / gaps.min() < 2.2  # halving intervals leaves two sizes, and the candidates are finite


def test_equal_sizes_give_equal_weights_that_cannot_be_changed():
    weights = decomposition.weight_vectors(30, 3).copy()
    decomposition.weight_vectors.cache_clear()
    np.testing.assert_array_equal(decomposition.weight_vectors(30, 3), weights)
    with pytest.raises(ValueError, match="read-only"):
        decomposition.weight_vectors(30, 3)[0, 0] = 2.0


vectors = st.lists(st.floats(0, 100), min_size=3, max_size=3).map(np.array)


@given(vectors, vectors, vectors)
def test_tchebycheff_is_equation_14(f, weight, ideal):
    g = decomposition.tchebycheff(np.stack([f, ideal]), np.stack([weight, weight]), ideal)
    assert g.tolist() == [max(w * abs(a - z) for w, a, z in zip(weight, f, ideal, strict=True)), 0.0]


@given(st.integers(15, 120), st.integers(0, 2**32))
def test_corners_and_different_others_are_chosen(n, seed):
    utility = np.random.default_rng(seed).random(n)
    corners = np.array([n - 1, 0, 7])  # wherever they stand
    chosen = chosen_by(np.random.default_rng(seed), utility, corners, n // 5)
    assert chosen.size == n // 5
    assert np.unique(chosen).size == chosen.size
    np.testing.assert_array_equal(chosen[:3], corners)
    assert ((chosen >= 0) & (chosen < n)).all()


def test_higher_utilities_are_chosen_more_often():
    utility = np.linspace(0.0, 1.0, 100)
    rng = np.random.default_rng(0)
    counts = np.zeros(100)
    for _ in range(500):
        counts[chosen_by(rng, utility, np.array([0, 1, 2]), 20)[3:]] += 1
    assert counts[80:].mean() > 4 * counts[40:60].mean()
    all_equal = [chosen_by(rng, np.ones(100), np.array([0]), 20)[1:] for _ in range(2000)]
    share = np.bincount(np.ravel(all_equal), minlength=100)[1:]
    assert (np.abs(share - 38000 / 99) < 5 * np.sqrt(38000 / 99)).all()  # ties fall evenly


def test_everyone_can_be_chosen():
    """As many as there are: the last tournaments have a single candidate."""
    chosen = chosen_by(np.random.default_rng(0), np.ones(9), np.array([0, 1]), 9)
    np.testing.assert_array_equal(np.sort(chosen), np.arange(9))


def test_mating_range_is_the_neighbourhood_with_its_probability():
    near = neighbourhoods(50, 3, 5)
    rng = np.random.default_rng(1)
    mating_range = decomposition.MatingRange(0.9, np.arange(50))
    sizes = np.array([call_compiled(mating_range, rng, 7, near).size for _ in range(4000)])
    assert set(sizes) == {5, 50}
    assert (sizes == 5).mean() == pytest.approx(0.9, abs=5 * np.sqrt(0.09 / 4000))


def test_utilities_follow_relative_progress_at_the_present_ideal_point():
    """By hand, weights 1, ideal 0, threshold 0.001: progress 1/2, 0.0005, 0, backwards, and from g = 0."""
    before = np.array([[2.0, 1.0], [2.0, 1.0], [2.0, 1.0], [2.0, 1.0], [0.0, 0.0]])
    after = np.array([[1.0, 1.0], [1.999, 1.0], [2.0, 0.5], [3.0, 1.0], [0.0, 0.0]])
    updated = decomposition.updated_utility(np.full(5, 0.8), before, after, np.ones((5, 2)), np.zeros(2), 0.001)
    np.testing.assert_allclose(updated, [1.0, 0.8 * 0.975, 0.8 * 0.95, 0.8 * 0.95, 0.8 * 0.95], rtol=1e-9)


def test_utilities_of_infeasible_designs_follow_their_violation():
    """By hand, threshold 0.001: violation halved, met at last, as it was, down by 0.0005; g is worse in all."""
    before = np.array([[1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, 1.0, 2.0]])
    after = np.array([[9.0, 9.0, 1.0], [9.0, 9.0, -1.0], [9.0, 9.0, 2.0], [9.0, 9.0, 1.999]])
    updated = decomposition.updated_utility(np.full(4, 0.8), before, after, np.ones((4, 2)), np.zeros(2), 0.001)
    np.testing.assert_allclose(updated, [1.0, 1.0, 0.8 * 0.95, 0.8 * 0.975], rtol=1e-9)


@given(st.integers(0, 2**32))
def test_utilities_stay_between_zero_and_one(seed):
    rng = np.random.default_rng(seed)
    utility = rng.uniform(0.01, 1, 8)
    updated = decomposition.updated_utility(
        utility, rng.random((8, 3)), rng.random((8, 3)), rng.random((8, 3)), rng.normal(0, 1, 3), 0.001
    )
    assert ((updated > 0) & (updated <= 1)).all()
    assert (updated[updated < 1] >= 0.95 * utility[updated < 1]).all()

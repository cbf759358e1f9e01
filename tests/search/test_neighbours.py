"""Neighbourhoods of weight vectors against all distances."""

import numpy as np
import pytest

from suspension_ctrl.search.decomposition import weight_vectors
from suspension_ctrl.search.neighbours import blocks, least, neighbourhoods, winding


@pytest.mark.parametrize(
    ("size", "m", "count"), [(60, 3, 6), (300, 2, 30), (640, 3, 64), (200, 4, 20), (40, 2, 40)]
)
def test_neighbourhoods_hold_the_nearest_and_begin_with_oneself(size, m, count):
    weights, near = weight_vectors(size, m), neighbourhoods(size, m, count)
    np.testing.assert_array_equal(near[:, 0], np.arange(size))
    distance = np.linalg.norm(weights[:, None] - weights[None], axis=2)
    np.testing.assert_allclose(
        np.take_along_axis(distance, near, axis=1), np.sort(distance, axis=1)[:, :count], rtol=1e-12, atol=1e-15
    )


@pytest.mark.parametrize("order", ["random", "ascending"])
@pytest.mark.parametrize(("n", "count"), [(40, 7), (700, 1), (1000, 100), (1000, 990), (1234, 60)])
def test_least_keys_are_those_of_a_whole_sort(n, count, order):
    """Ascending keys all lie in the first part of a row."""
    keys = np.random.default_rng(n).permuted(np.tile(np.arange(n), (5, 1)), axis=1)
    if order == "ascending":
        keys[::2].sort(axis=1)
    np.testing.assert_array_equal(least(keys, count), np.sort(keys, axis=1)[:, :count])


def test_blocks_are_compact_up_to_the_tip_of_the_triangle():
    """A block of 32 even points has an area of 32 of theirs: none is farther from its middle than two sides.

    Strips of equal counts leave some at 2.6 sides.
    """
    weights = weight_vectors(2000, 3)
    side = np.sqrt(32 * np.sqrt(3) / 2 / 2000)  # of a square; the triangle has an area of sqrt(3) / 2
    order = winding(weights)
    np.testing.assert_array_equal(np.sort(order), np.arange(2000))
    far = [np.linalg.norm(weights[rows] - weights[rows].mean(axis=0), axis=1).max() for rows in blocks(order)]
    assert np.median(far) < side
    assert max(far) < 2 * side

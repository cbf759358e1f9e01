"""Distances to nearest neighbours, beside the matrix of all distances and scipy's tree."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from scipy.spatial import cKDTree

from suspension_ctrl.search.nearest import nearest_others

whole = hnp.arrays(float, st.tuples(st.integers(0, 12), st.integers(1, 4)), elements=st.integers(-3, 3).map(float))


@given(whole)
def test_copies_are_one_point_with_the_nearest_of_all_others(points):
    """Of whole numbers, which often coincide: squares are exact."""
    different = np.unique(points, axis=0)
    squares = ((different[:, None] - different) ** 2).sum(axis=2)
    np.fill_diagonal(squares, np.inf)
    nearest = squares.min(axis=1, initial=np.inf)
    assert sorted(nearest_others(points)) == sorted(np.sqrt(nearest))


@pytest.mark.parametrize("m", [1, 2, 3, 6])
def test_many_points_have_the_neighbours_that_a_tree_finds(m):
    """In the order of the points; the sums of squares have another order of terms, some 1e-16."""
    points = np.random.default_rng(m).random((400, m)) * np.geomspace(0.1, 1.0, m)
    wanted = cKDTree(points).query(points, k=[2])[0].ravel()
    np.testing.assert_allclose(nearest_others(points), wanted, rtol=1e-14)

"""Sorting of keys against numpy's lexicographic sort."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl.search.sorting import by_buckets, insert, lexicographic, sorted_by

LARGEST = np.finfo(float).max


def ties(rows: st.SearchStrategy[int]) -> st.SearchStrategy[np.ndarray]:
    """Keys (k, n) with few and many ties, spans beyond the largest number and without a reciprocal."""
    elements = st.sampled_from(
        [
            st.integers(0, 3).map(float),
            st.floats(-LARGEST, LARGEST),
            st.floats(-1e-320, 1e-320),
            st.sampled_from([0.0, -0.0, 1e-300, 1.0]),
        ]
    )
    return elements.flatmap(lambda one: arrays(float, st.tuples(rows, st.integers(1, 200)), elements=one))


@given(ties(st.integers(1, 3)))
def test_sorts_as_numpys_lexicographic_sort_does(keys):
    before = keys.copy()
    np.testing.assert_array_equal(lexicographic(keys), np.lexsort(before[::-1]))
    np.testing.assert_array_equal(keys, before)


@pytest.mark.parametrize("outlier", [0.0, 10.0, 1e150])
def test_sorts_keys_that_lie_evenly_and_those_that_an_outlier_crowds(outlier):
    """One bucket each, one of all others with which sorting by insertion is given up, and some between."""
    keys = np.random.default_rng(0).normal(size=(2, 1000))
    keys[0, 500] += outlier
    order = by_buckets(keys)[0]
    assert insert(keys, order) == (outlier < 1e150)
    np.testing.assert_array_equal(lexicographic(keys), np.lexsort(keys[::-1]))
    np.testing.assert_array_equal(sorted_by(keys, lexicographic(keys[:1])), np.lexsort(keys[::-1]))

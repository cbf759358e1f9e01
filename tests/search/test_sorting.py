"""The stable sort against numpy's."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl.search.sorting import sorted_by

LARGEST = np.finfo(float).max
ELEMENTS = [
    st.integers(0, 3).map(float),  # ties
    st.floats(-1e3, 1e3),
    st.floats(-LARGEST, LARGEST),  # a span beyond the largest number
    st.floats(-1e-320, 1e-320),  # a span that has no reciprocal
    st.sampled_from([0.0, -0.0, 1e-300, 1.0]),
]


@given(st.data())
def test_sorts_as_numpy_does(data):
    values = data.draw(arrays(float, st.integers(1, 60), elements=data.draw(st.sampled_from(ELEMENTS))))
    order = np.array(data.draw(st.permutations(range(values.size))))
    objectives = np.stack([np.zeros_like(values), values], axis=1)
    expected = order[np.argsort(values[order], kind="stable")]
    listed, value = sorted_by(objectives, order, 1)
    np.testing.assert_array_equal(listed, expected)
    np.testing.assert_array_equal(value, values[expected])


@pytest.mark.parametrize("power", [1, 8, 60])
def test_sorts_what_crowds_into_few_buckets(power):
    """With the power nearly all of a thousand values fall into the first bucket."""
    values = np.random.default_rng(0).random(1000) ** power
    values[::7] = values[0]
    order = np.arange(1000)
    expected = np.argsort(values, kind="stable")
    listed, value = sorted_by(values[:, np.newaxis], order, 0)
    np.testing.assert_array_equal(listed, expected)
    np.testing.assert_array_equal(value, values[expected])
    np.testing.assert_array_equal(order, np.arange(1000))

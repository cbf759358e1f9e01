"""Rows called into the cache: nothing changes but time."""

import numpy as np
import pytest
from numba import njit

from suspension_ctrl.search.prefetch import prefetch


@njit
def fetched(rows, i):
    prefetch(rows, i)
    return rows[i].sum()


@pytest.mark.parametrize("width", [0, 3, 1000])
def test_rows_stay_as_they_are(width):
    rows = np.arange(5 * width).reshape(5, width)
    before = rows.copy()
    assert [fetched(rows, i) for i in range(5)] == rows.sum(axis=1).tolist()
    np.testing.assert_array_equal(rows, before)
    assert prefetch(rows, 0) is None


def test_the_processor_is_told():
    assert "llvm.prefetch" in next(iter(fetched.inspect_llvm().values()))

"""Non-dominated points and their volume: beside all comparisons, cells that are counted, and moocore."""

import moocore
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from suspension_ctrl.search.stairs import swept

CORNER = 4
levels = hnp.arrays(
    float, st.tuples(st.integers(0, 15), st.integers(1, 3)), elements=st.integers(0, CORNER + 1).map(float)
)


@settings(max_examples=300)
@given(levels)
def test_points_of_few_levels_beside_all_comparisons_and_counted_cells(points):
    """Many coincide in an objective or in all, some lie at the corner or beyond; whole numbers are exact."""
    best, volume = swept(points, np.maximum(CORNER - points, 0))
    no_worse, better = (points[:, None] <= points).all(axis=2), (points[:, None] < points).any(axis=2)
    assert best.tolist() == (~(no_worse & better).any(axis=0)).tolist()
    cells = np.stack(np.meshgrid(*[np.arange(CORNER)] * points.shape[1]), axis=-1).reshape(-1, points.shape[1])
    assert volume == (points <= cells[:, None]).all(axis=2).any(axis=1).sum()


@pytest.mark.parametrize("m", [2, 3])
def test_many_points_beside_moocore(m):
    """5,000 points, mostly on a front; volumes are sums of as many numbers, rounded by some 1e-14."""
    rng = np.random.default_rng(m)
    angles = rng.random((5000, m))
    points = 1.0 - angles / np.linalg.norm(angles, axis=1, keepdims=True) + rng.exponential(1e-3, (5000, m))
    best, volume = swept(points, np.maximum(0.9 - points, 0))
    assert best.tolist() == moocore.is_nondominated(points, keep_weakly=True).tolist()
    assert volume == pytest.approx(moocore.hypervolume(points, ref=0.9), rel=1e-12)

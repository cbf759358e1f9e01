"""Order along Morton's curve: bits in turn, and neighbours that follow one another."""

import numpy as np
import pytest

from suspension_ctrl.search.morton import along_curve


def test_cells_follow_one_another_in_quarters_of_quarters():
    """Of a square of 4 x 4 cells: each quarter before the next, in each the same order."""
    x, y = (axis.ravel().astype(float) for axis in np.meshgrid(range(4), range(4)))
    order = along_curve(np.column_stack([x, y]))
    quarters = (x // 2 + 2 * (y // 2))[order]
    assert quarters.tolist() == [0] * 4 + [1] * 4 + [2] * 4 + [3] * 4
    assert (x % 2 + 2 * (y % 2))[order].tolist() == [0, 1, 2, 3] * 4


@pytest.mark.parametrize("m", [1, 2, 3, 16, 20])
@pytest.mark.parametrize("scale", [1e-150, 1e150])
def test_all_points_stand_in_the_order_at_any_scale(m, scale):
    points = scale * np.random.default_rng(m).normal(size=(200, m))
    assert sorted(along_curve(points)) == list(range(200))
    assert along_curve(np.zeros((5, m))).tolist() == [0, 1, 2, 3, 4]  # without a range as they come
    assert along_curve(np.empty((0, m))).size == 0


def test_steps_along_the_curve_are_short():
    """Random points of a square are half of its side apart in the mean; along the curve 64 steps cross it."""
    points = np.random.default_rng(0).random((4096, 2))
    steps = np.linalg.norm(np.diff(points[along_curve(points)], axis=0), axis=1)
    assert steps.mean() < 0.5 / 10

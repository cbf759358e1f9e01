"""Shortfall of points from a front: beside all distances and shifts, bit by bit, and beside moocore."""

import moocore
import numpy as np
import pytest

from suspension_ctrl.search.shortfall import Goals


def front(m: int, n: int) -> np.ndarray:
    """Points of a sphere in m objectives."""
    directions = np.random.default_rng(m).random((n, m)) + 1e-3
    return 1.0 - directions / np.linalg.norm(directions, axis=1, keepdims=True)


@pytest.mark.parametrize("m", [2, 3, 5])
def test_squares_and_shifts_are_the_least_of_all_points(m):
    """In blocks of which the last is not full, of points far and near; blocks change no bit."""
    goals, points = front(m, 333), front(m, 200) + np.random.default_rng(0).normal(0.01, 0.1, (200, m))
    found = Goals.of(goals).shortfall(points)
    beyond = points[:, None] - goals
    squares = np.zeros(beyond.shape[:2])
    for k in range(m):
        squares += np.maximum(beyond[..., k], 0) ** 2
    np.testing.assert_array_equal(found.squares, squares.min(axis=0)[found.order])
    np.testing.assert_array_equal(found.shifts, beyond.max(axis=2).min(axis=0)[found.order])
    in_order = Goals.of(goals).shortfall(points[np.argsort(points[:, 0])])
    np.testing.assert_array_equal(in_order.squares, found.squares)
    assert found.epsilon == moocore.epsilon_additive(points, ref=goals)
    # sums of 333 numbers, rounded by some 1e-15
    assert found.igd_plus == pytest.approx(moocore.igd_plus(points, ref=goals), rel=1e-12)


def test_points_that_come_later_lower_it():
    goals, points = Goals.of(front(3, 100)), front(3, 50) + 0.01
    before = goals.shortfall(points[:20])
    kept = before.squares.copy()
    together = goals.shortfall(points[20:], before)
    for name in ("squares", "shifts", "order"):
        np.testing.assert_array_equal(getattr(together, name), getattr(goals.shortfall(points), name))
    np.testing.assert_array_equal(before.squares, kept)  # which stays as it was
    assert goals.shortfall(points[:0], together).epsilon == together.epsilon


def test_nothing_and_better_points():
    """Without points everything is lacking; a front that is better by 1/4 everywhere has 1/4 to spare."""
    goals = Goals.of(front(3, 40))
    nothing = goals.shortfall(np.empty((0, 3)))
    assert nothing.igd_plus == nothing.epsilon == np.inf
    better = goals.shortfall(front(3, 40) - 0.25)
    assert better.igd_plus == 0
    assert better.epsilon == pytest.approx(-0.25, abs=1e-15)

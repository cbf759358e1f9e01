"""The adjoint of the strut loop beside differences, on loops of random numbers."""

import numpy as np
import pytest

from suspension_ctrl.response.gradients.many_struts import with_slopes
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.many_struts import ManyStruts

N = 8
SIZES = [(2, 1, 3), (3, 2, 2)]
"""Struts, sources and responses of two blocks."""
WANTED = Wanted(np.array([[1.0, 2.0, 0.0, 3.0], [1.0, 2.0, 0.5, 3.0]]), np.array([False, True]))


def random_struts(seed: int) -> ManyStruts:
    rng = np.random.default_rng(seed)
    rows = [0.1 ** (part == 0) * rng.normal(size=(count, 2, N)) for q, s, k in SIZES
            for part, count in enumerate((q * q, q * s, k * s, k * q))]  # fmt: skip
    gains = [rng.normal(size=(4, q, q)) for q, _, _ in SIZES]
    gains[0][:, 0, 1] = 0.0  # an entry that no coefficient reaches
    return ManyStruts(
        omega=rng.uniform(0.5, 2.0, N),
        rows=np.concatenate(rows),
        sizes=np.array(SIZES),
        response=np.array([0, 2, 1, 1, 0]),
        channel=np.array([2, 0, 0, 1]),
        gain=np.hstack([gain.reshape(4, -1) for gain in gains]),
        order=np.array([0, 1, 2, 0]),
        origin=rng.normal(size=4),
    )


@pytest.mark.parametrize("seed", range(3))
def test_derivatives_are_those_of_differences(seed):
    """Extrapolated central differences: with steps of 2e-3 their error is of size h^4 = 2e-11, rounding 1e-13."""
    struts = random_struts(seed)
    designs = np.random.default_rng(seed + 10).normal(size=(2, 4))
    designs[0] = struts.origin  # nothing is added
    squares, slopes = with_slopes(struts, WANTED, designs)
    np.testing.assert_allclose(squares, struts(designs), rtol=1e-13)

    def wanted(x: np.ndarray) -> np.ndarray:
        products = struts(x)[:, None] * WANTED.factor
        return np.where(WANTED.largest, products.max(axis=2), products.sum(axis=2))

    for v in range(4):
        by = 2e-3 * np.eye(4)[v]
        half, whole = ((wanted(designs + m * by) - wanted(designs - m * by)) / (4e-3 * m) for m in (1, 2))
        np.testing.assert_allclose(slopes[:, :, v], (4 * half - whole) / 3, rtol=1e-8, atol=1e-8 * squares.max())


def test_no_blocks_give_nothing():
    """As of roll on a road shaped like a cylinder."""
    none, whole = np.empty((0, 2, N)), np.zeros(0, dtype=np.int64)
    struts = ManyStruts(
        omega=np.ones(N), rows=none, sizes=np.empty((0, 3), dtype=np.int64), response=whole,
        channel=np.array([0, 0]), gain=np.empty((1, 0)), order=np.array([0]), origin=np.ones(1),
    )  # fmt: skip
    wanted = Wanted(np.eye(2), np.zeros(2, dtype=bool))
    found = with_slopes(struts, wanted, np.array([[2.0], [3.0]]))
    np.testing.assert_array_equal(found[0], np.zeros((2, 2)))
    np.testing.assert_array_equal(found[1], np.zeros((2, 2, 1)))

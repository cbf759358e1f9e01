"""A block of two struts in registers beside the same block row by row."""

import numpy as np
import pytest

from suspension_ctrl.response.many_struts import ManyStruts


@pytest.mark.parametrize("sources", [1, 2])
def test_a_block_in_lanes_is_the_block_row_by_row(sources):
    """Of a number of nodes that is no multiple of eight every block is closed row by row.

    The larger of two neighbours among the eliminated is not sought: with couplings of 0.1 no digit is lost.
    """
    rng = np.random.default_rng(sources)
    rows = rng.normal(size=(4 + 2 * sources + 3 * (sources + 2), 2, 24))
    rows[:4] *= 0.1
    gain = np.array([[1.0, 0, 0, 0], [0.5, 0, 0, 1], [0, 0, 0, -0.7]])
    parts = {
        "sizes": np.array([[2, sources, 3]]), "response": np.arange(3), "channel": np.array([2, 0, 1]),
        "gain": gain, "order": np.array([0, 1, 2]), "origin": np.ones(3),
    }  # fmt: skip
    omega, designs = rng.uniform(0.5, 2.0, 24), rng.normal(size=(5, 3))
    whole = ManyStruts(omega=omega, rows=rows, **parts)
    first, last = (
        ManyStruts(omega=omega[part], rows=np.ascontiguousarray(rows[:, :, part]), **parts)
        for part in (slice(0, 5), slice(5, 24))
    )
    np.testing.assert_allclose(whole(designs), first(designs) + last(designs), rtol=1e-12)
    np.testing.assert_array_equal(whole(designs[3:4]), whole(designs)[3:4])

"""A block of two struts in registers beside the same block among those of any number."""

import numpy as np
import pytest

from suspension_ctrl.response.many_struts import ManyStruts


@pytest.mark.parametrize("sources", [1, 2])
def test_two_struts_are_the_block_of_any_number(sources):
    """A variable that could couple the two, and stays at its origin, makes them a block of any number.

    The larger of two neighbours among the eliminated is not sought: with couplings of 0.1 no digit is lost.
    """
    rng = np.random.default_rng(sources)
    rows = rng.normal(size=(4 + 2 * sources + 3 * (sources + 2), 2, 24))
    rows[:4] *= 0.1
    gain = np.array([[1.0, 0, 0, 0], [0.5, 0, 0, 1], [0, 0, 0, -0.7], [0, 0, 0, 0]])
    parts = {
        "omega": rng.uniform(0.5, 2.0, 24), "rows": rows, "sizes": np.array([[2, sources, 3]]),
        "response": np.arange(3), "channel": np.array([2, 0, 1]), "order": np.array([0, 1, 2, 0]),
        "origin": np.ones(4),
    }  # fmt: skip
    designs = rng.normal(size=(5, 4))
    designs[:, 3] = 1.0
    coupled = gain.copy()
    coupled[3, 1] = 1.0
    two, any_number = ManyStruts(gain=gain, **parts), ManyStruts(gain=coupled, **parts)
    np.testing.assert_allclose(two(designs), any_number(designs), rtol=1e-12)
    for struts in (two, any_number):
        np.testing.assert_array_equal(struts(designs[3:4]), struts(designs)[3:4])

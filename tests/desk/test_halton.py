"""Points of Halton's sequence as by SciPy."""

import numpy as np
import pytest
from scipy.stats.qmc import Halton

from suspension_ctrl.desk.halton import halton


@pytest.mark.parametrize(("points", "d"), [(32, 2), (1000, 7), (1, 3), (5, 0)])
def test_points_are_those_of_scipy(points, d):
    expected = Halton(d, scramble=False).random(points)
    # Both add up to ten digits, each rounded once.
    np.testing.assert_allclose(halton(points, d), expected, rtol=0, atol=1e-15)

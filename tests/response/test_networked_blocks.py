"""Blocks of struts with networks beside numpy's solver at each frequency."""

import numpy as np
import pytest

import struts_by_numpy

VALUES = np.array([0.7, 1.2, 0.3, 0.4])


@pytest.mark.parametrize(("sizes", "crossed"), [([(2, 1, 3), (2, 2, 2)], False), ([(2, 1, 3), (3, 2, 2)], True)])
def test_squares_are_those_of_a_dense_solve(sizes, crossed):
    """Two struts in registers, and any number; couplings of 0.1 lose no digit."""
    struts = struts_by_numpy.random_struts(sizes, [crossed] * 2)
    case, (network, *_) = struts_by_numpy.on_mounts(struts, VALUES)
    expected, _ = struts_by_numpy.with_slopes(case.struts, VALUES, [network])
    np.testing.assert_allclose(case(VALUES[None])[0], expected, rtol=1e-12)


def test_a_design_has_the_same_bits_alone_and_among_others():
    """More than are settled together, and an odd number; the plant is that of the first test, compiled."""
    struts = struts_by_numpy.random_struts([(2, 1, 3), (3, 2, 2)], [True, True])
    case, _ = struts_by_numpy.on_mounts(struts, VALUES)
    designs = np.random.default_rng(1).uniform(0.5, 1.5, (19, 4))
    together = case(designs)
    np.testing.assert_array_equal(together, np.concatenate([case(one[None]) for one in designs]))

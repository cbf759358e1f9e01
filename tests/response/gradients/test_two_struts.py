"""Blocks of two struts in registers beside the adjoint of the strut loop, which has any number of them."""

import numpy as np

from suspension_ctrl.response.gradients import many_struts, two_struts
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.many_struts import ManyStruts

SIZES = [(2, 1, 3), (2, 2, 2)]
"""Struts, sources and responses of two blocks."""
WANTED = Wanted(np.array([[1.0, 2.0, 0.0, 3.0], [1.0, 2.0, 0.5, 0.0]]), np.array([False, True]))


def random_struts(n: int) -> ManyStruts:
    rng = np.random.default_rng(0)
    rows = [0.1 ** (part == 0) * rng.normal(size=(count, 2, n)) for q, s, k in SIZES
            for part, count in enumerate((q * q, q * s, k * s, k * q))]  # fmt: skip
    gain = rng.normal(size=(4, 2, 2, 2))
    gain[:, :, 0, 1] = gain[:, :, 1, 0] = 0.0
    return ManyStruts(
        omega=rng.uniform(0.5, 2.0, n),
        rows=np.concatenate(rows),
        sizes=np.array(SIZES),
        response=np.array([0, 2, 1, 1, 0]),
        channel=np.array([2, 0, 0, 1]),
        gain=gain.reshape(4, -1),
        order=np.array([0, 1, 2, 0]),
        origin=rng.normal(size=4),
    )


STRUTS = random_struts(24)
DESIGNS = np.random.default_rng(1).normal(size=(5, 4))


def test_derivatives_are_those_of_the_adjoint():
    """Numbers of the order of one are rounded some hundred times; mean squares have the bits of values alone."""
    squares, slopes = two_struts.with_slopes(STRUTS, WANTED, DESIGNS)
    _, expected = many_struts.with_slopes(STRUTS, WANTED, DESIGNS)
    np.testing.assert_array_equal(squares, STRUTS(DESIGNS))
    np.testing.assert_allclose(slopes, expected, rtol=1e-11, atol=1e-12 * np.abs(expected).max())


def test_a_design_has_the_same_derivatives_among_others_as_alone():
    together = two_struts.with_slopes(STRUTS, WANTED, DESIGNS)[1]
    np.testing.assert_array_equal(two_struts.with_slopes(STRUTS, WANTED, DESIGNS[3:4])[1], together[3:4])


def test_blocks_of_other_sizes_coupled_struts_and_odd_numbers_of_nodes_do_not_fit():
    coupled = STRUTS.gain.copy()
    coupled[2, 5] = 1.0
    assert two_struts.fits(STRUTS)
    assert not two_struts.fits(STRUTS._replace(gain=coupled))
    assert not two_struts.fits(STRUTS._replace(sizes=np.array([(2, 1, 3), (3, 2, 2)])))
    assert not two_struts.fits(random_struts(23))

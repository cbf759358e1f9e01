"""The adjoint of the strut loop in rows beside numpy, on blocks of random numbers."""

import numpy as np

import struts_by_numpy
from suspension_ctrl.response.gradients.many_struts import close, fill_force, fill_values, loops_of, moments
from suspension_ctrl.response.loop_rows import fill_stiffness

SIZES = [(2, 1, 3), (3, 2, 2)]


def test_squares_and_their_derivatives_are_those_of_linear_equations():
    """In plain Python, of the sum of all distinct mean squares; rounded some hundred times."""
    struts = struts_by_numpy.random_struts(SIZES, [True, True])._replace(channel=np.arange(3))
    design = np.random.default_rng(1).normal(size=4)
    loops, slopes = loops_of(struts), np.zeros(4)
    loops.found[:], loops.weight[:] = 0.0, [1.0, 2.0, 3.0]
    for b, (q, s, _) in enumerate(SIZES):
        _, _, _, _, right, entry, _, _ = loops.block[b]
        square = slice(entry, entry + q * q)
        fill_stiffness(design - struts.origin, struts, entry, loops.present[square], loops.stiffness[square])
        close(struts, loops, b)
        fill_values(struts, loops, b)
        for source in range(s):
            assert fill_force(struts, loops, b, source)
            for i, j in np.ndindex(q, q):
                solved = loops.loop[entry + right + j * (q + s + q) + q + source]
                own = moments(loops.force[q + i], solved, struts.omega)
                slopes += 2 * struts.gain[:, entry + i * q + j] * np.array(own)[struts.order]
    squares, expected = struts_by_numpy.with_slopes(struts, design)
    np.testing.assert_allclose(loops.found, squares, rtol=1e-11)
    np.testing.assert_allclose(slopes, loops.weight @ expected, rtol=1e-11)
    reached = [gain != 0.0 for gain in np.abs(struts.gain).max(axis=0)]
    np.testing.assert_array_equal(loops.reached, reached)


def test_a_block_without_a_weight_has_no_force():
    struts = struts_by_numpy.random_struts(SIZES, [True, True])
    loops = loops_of(struts)
    loops.weight[:] = 0.0
    assert not fill_force(struts, loops, 0, 0)

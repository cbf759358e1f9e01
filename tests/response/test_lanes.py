"""Eight numbers at a time: compiled as in plain Python."""

import numpy as np

from suspension_ctrl.compiled import compiled
from suspension_ctrl.response.lanes import (
    WIDTH,
    at,
    empty,
    in_lines,
    less,
    load,
    plus,
    product,
    reciprocal,
    spread,
    store,
    total,
)

ROWS = np.random.default_rng(0).uniform(0.5, 2.0, (3, 2, 3 * WIDTH))


@compiled()
def compute(rows, found):
    """Fill in z = (a b + c) / (a - b c) of 24 complex numbers, and return the sum of their real parts."""
    whole = spread(0.0)
    for start in range(0, rows.shape[2], WIDTH):
        a, b, c = at(rows, 0, start), at(rows, 1, start), at(rows, 2, start)
        re, im = product(plus(c, a, b), reciprocal(less(a, b, c)))
        store(re, found, (0, start))
        store(im, found, (1, start))
        whole = whole + load(found, (0, start))
    return total(whole)


def test_products_and_sums_are_those_of_complex_numbers():
    """Numbers are of the order of one, and rounded a few times each."""
    a, b, c = ROWS[:, 0] + 1j * ROWS[:, 1]
    expected = (a * b + c) / (a - b * c)
    for function in (compute, compute.py_func):
        found = np.empty((2, 3 * WIDTH))
        whole = function(ROWS, found)
        np.testing.assert_allclose(found, [expected.real, expected.imag], rtol=1e-13)
        np.testing.assert_allclose(whole, expected.real.sum(), rtol=1e-13)


def test_a_sum_is_taken_by_halves():
    """The same order on every processor: 1 is lost beside 1e16, but for 1e16 + (-1e16) first."""
    lanes = np.array([1e16, 1.0, 0.0, 0.0, -1e16, 1.0, 0.0, 0.0])
    assert total(lanes) == summed(lanes) == 2.0


@compiled()
def summed(array):
    return total(load(array, (0,)))


@compiled()
def made(rows, columns):
    return empty((rows, columns)), empty((columns,))


def test_rows_of_empty_arrays_are_lines_of_the_cache():
    for _ in range(8):  # 32 bytes, to which numba aligns, would be 64 by chance
        for one in (*made(3, 16), *made.py_func(3, 16), in_lines(np.ones((2, 8)))):
            assert one.ctypes.data % 64 == 0
            assert one.flags.c_contiguous
            assert one.dtype == float
    assert [one.shape for one in made(3, 16)] == [one.shape for one in made.py_func(3, 16)] == [(3, 16), (16,)]


def test_an_empty_array_belongs_to_its_receiver_alone():
    """As an array of numpy's `empty` in compiled code does: its memory is freed with it."""
    assert [one.base.refcount for one in made(1, 8)] == [1, 1]


def test_copies_in_lines_have_the_same_numbers():
    np.testing.assert_array_equal(in_lines(ROWS), ROWS)

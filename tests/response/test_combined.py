"""Scores in compiled loops beside those of numpy."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from suspension_ctrl.response.combined import fill_scores
from suspension_ctrl.response.kernel import Kernel

RNG = np.random.default_rng(0)
WORST = np.array([False, False, True, True])
SQUARES = RNG.uniform(0.5, 2.0, (3, 4, 2)) * [[1, 1], [1, 0], [1, 1], [0, 1]]
FOUND = [RNG.uniform(0.1, 9.0, (20, k)) for k in (2, 2, 1)]
SQUARES[2, :, 1] = 0.0  # the last case has one mean square


def kernel(cases: int) -> Kernel:
    shares = np.array([0.5, 0.3, 0.2][:cases])
    scale, offset = np.array([1.0, -2.0, 0.7, 3.0]), np.array([0.0, 0.1, -1.0, 0.0])
    worst_case = np.array([False, True, False, True])
    return Kernel((), SQUARES[:cases], shares / shares.sum(), WORST, worst_case, scale, offset)


@settings(max_examples=20)
@given(st.integers(1, 3), st.integers(0, 7), st.integers(0, 12))
def test_a_part_of_the_rows_has_the_bits_of_numpy(cases, start, count):
    rows, found = np.full((4, 20), 7.0), [each[:count] for each in FOUND[:cases]]
    assert fill_scores(kernel(cases), found, rows, start)
    np.testing.assert_array_equal(rows[:, start : start + count], kernel(cases).scores(found).T)
    np.testing.assert_array_equal(np.delete(rows, range(start, start + count), axis=1), 7.0)


def test_a_design_without_a_number_in_any_term_or_case_has_none():
    """Whether sums or largest ones count: NaN is not lost beside larger numbers that follow or go before."""
    for case in (0, 1):
        for term in (0, 1):
            found = [each.copy() for each in FOUND]
            found[case][5, term] = np.nan
            rows, one = np.empty((4, 20)), kernel(3)
            assert not fill_scores(one, found, rows, 0)
            np.testing.assert_array_equal(rows, one.scores(found).T)
            assert np.isnan(rows[:, 5]).tolist() == (SQUARES[case, :, term] > 0).tolist()
            assert not np.isnan(np.delete(rows, 5, axis=1)).any()

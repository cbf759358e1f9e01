"""Sums and the largest of products by hand."""

import numpy as np

from suspension_ctrl.response.gradients.wanted import Wanted, combine, fill_weights, fold, leave_out, searched

SQUARES = np.array([[9.0, 9.0, 9.0], [3.0, 2.0, 5.0]])
WANTED = Wanted(np.array([[1.0, 4.0, 0.0], [2.0, 4.0, 1.0]]), np.array([False, True]))


def test_a_sum_has_its_factors_and_the_largest_that_of_one():
    weight = np.empty((2, 3))
    fill_weights(WANTED, SQUARES, 1, weight)
    np.testing.assert_array_equal(weight, [[1.0, 4.0, 0.0], [0.0, 4.0, 0.0]])


def test_derivatives_are_combined_by_weights():
    weight, slopes, result = (
        np.array([[1.0, 2.0, 0.0]]),
        np.array([[1.0, 3.0, 7.0], [5.0, 1.0, 7.0]]),
        np.empty((1, 1, 2)),
    )
    combine(weight, slopes, 0, result)
    np.testing.assert_array_equal(result[0], weight @ slopes.T)


def test_of_equal_ones_the_first_is_the_largest_whatever_rounding_says():
    weight = np.empty((1, 3))
    for squares in ([1.0, 2.0, 2.0 * (1 + 1e-12)], [1.0, 2.0 * (1 + 1e-12), 2.0]):
        fill_weights(Wanted(np.ones((1, 3)), np.array([True])), np.array([squares]), 0, weight)
        np.testing.assert_array_equal(weight, [[0.0, 1.0, 0.0]])


def test_weights_of_distinct_mean_squares_are_sums_of_those_of_their_terms_by_case():
    folded = np.empty(4)
    fold(np.array([1, 0, 1]), np.array([1.0, 2.0, 4.0, 8.0, 16.0, 32.0]), folded)
    np.testing.assert_array_equal(folded, [2.0, 5.0, 16.0, 40.0])


def test_combinations_that_do_not_count_have_no_weight():
    weight = np.ones((2, 3))
    leave_out(np.array([[False, False], [True, False]]), 1, weight)
    np.testing.assert_array_equal(weight, [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]])


def test_sums_have_the_same_weights_for_all_designs():
    assert searched(WANTED)
    assert not searched(WANTED._replace(largest=np.array([False, False])))

"""Scores of one design beside those of many."""

import numpy as np
import pytest

from suspension_ctrl.response.kernel import Kernel

RNG = np.random.default_rng(0)
FOUND = RNG.uniform(0.1, 9.0, (3, 5, 2))
"""Mean squares of two terms of five designs in three load cases."""


def kernel(found: np.ndarray) -> Kernel:
    """Four scores of a design with mean squares (c, 1, k): sums and largest terms, means and worst cases."""
    cases = tuple((lambda _designs, own=own: own) for own in found)
    worst_term, worst_case = np.array([False, False, True, True]), np.array([False, True, False, True])
    squares = np.random.default_rng(1).uniform(0.5, 2.0, (3, 4, 2))
    scale, offset = np.array([1.0, -2.0, 0.7, 3.0]), np.array([0.0, 0.1, -1.0, 0.0])
    return Kernel(cases, squares, np.array([0.5, 0.3, 0.2]), worst_term, worst_case, scale, offset)


@pytest.mark.parametrize("design", range(5))
def test_a_design_alone_has_the_scores_of_many(design):
    one = kernel(FOUND[:, design : design + 1])
    np.testing.assert_allclose(one(np.ones(2)), one.scores(FOUND)[design], rtol=1e-14)  # another order of sums


@pytest.mark.parametrize("case", range(3))
def test_a_design_without_a_number_in_one_case_has_no_scores(case):
    """NaN is not lost beside numbers of cases that go before or follow."""
    found = FOUND[:, :1].copy()
    found[case] = np.nan
    assert np.isnan(kernel(found)(np.ones(2))).all()
    assert np.isnan(kernel(found).scores(found)).all()

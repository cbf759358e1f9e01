"""Scores by hand: from mean squares to objectives and constraints."""

import numpy as np
import pytest

from garage import QUARTER, ROAD
from suspension_ctrl import LoadCase, Term
from suspension_ctrl.response.measures.terms import CaseMeasure
from suspension_ctrl.response.scores import Score, Scores

VARIABLES = {"spring": 2e4, "damper": 1500.0}
DESIGNS = np.array([[18e3, 1200.0], [26e3, 2100.0]])
A, B = Term("body_acceleration", "Wk", 2.0), Term("body_acceleration", None, 0.5)
CASES = [LoadCase(vehicle=QUARTER, road=ROAD, speed=v, share=share) for v, share in ((10.0, 3.0), (30.0, 1.0))]
SHARES = np.array([0.75, 0.25])


def scores(*each: Score) -> Scores:
    return Scores(CASES, each, [VARIABLES] * 2, list(VARIABLES), (0.0, 20.0))


@pytest.fixture(scope="module")
def mean_squares() -> np.ndarray:
    """Mean squares (c, p, 2) of A and B without their factors."""
    measured = scores(Score((CaseMeasure((A, B)),) * 2, False))
    return np.array([case(DESIGNS) for case in measured.kernel(256).cases])


@pytest.mark.parametrize("worst_case", [False, True])
@pytest.mark.parametrize("worst_term", [False, True])
def test_a_score_is_made_of_terms_and_cases(mean_squares, worst_term, worst_case):
    squares = mean_squares * [4.0, 0.25]
    by_case = squares.max(axis=2) if worst_term else squares.sum(axis=2)
    over = by_case.max(axis=0) if worst_case else SHARES @ by_case
    measure = CaseMeasure((A, B), worst_term)
    judged = scores(Score((measure, measure), worst_case, -3.0, 0.5))
    np.testing.assert_allclose(judged.evaluate(DESIGNS, 256)[:, 0], 0.5 - 3.0 * np.sqrt(over), rtol=1e-13)
    assert judged.compiled


def test_a_single_case_of_one_term_each_is_scored_as_any_other_to_the_last_bit():
    doubled = Term("body_acceleration", None, 1.0)
    each = [
        Score((CaseMeasure((term,), worst_term),), worst_case, -3.0, 0.5)
        for term, worst_term, worst_case in ((B, False, False), (A, True, False), (doubled, False, True))
    ]
    judged = Scores(CASES[:1], each, [VARIABLES], list(VARIABLES), (0.0, 20.0))
    found = judged.evaluate(DESIGNS, 256)
    kernel = judged.kernel(256)
    np.testing.assert_array_equal(found, kernel.scores([case(DESIGNS) for case in kernel.cases]))
    assert len(set(found.ravel().tolist())) == found.size


def test_cases_may_have_different_terms(mean_squares):
    each = tuple(CaseMeasure(terms) for terms in ((A,), (A, B)))
    squares = mean_squares * [4.0, 0.25]
    expected = np.sqrt(0.75 * squares[0, :, 0] + 0.25 * squares[1].sum(axis=1))
    np.testing.assert_allclose(scores(Score(each, False)).evaluate(DESIGNS, 256)[:, 0], expected, rtol=1e-13)


def test_the_same_integral_is_taken_once():
    twice = CaseMeasure((A, A, Term("body_acceleration", "Wk")))
    judged = scores(Score((twice, twice), False))
    assert [len(terms) for terms in judged.terms] == [1, 1]
    assert judged.kernel(256).squares[0].tolist() == [[9.0]]


def test_errors_are_the_changes_by_twice_the_nodes():
    measure = CaseMeasure((A,))
    judged = scores(Score((measure, measure), False))
    coarse, fine = (np.array([case(DESIGNS) for case in judged.kernel(n).cases]) for n in (24, 48))
    expected = np.abs(np.sqrt(coarse / fine) - 1).max(axis=1)
    np.testing.assert_allclose(np.array(judged.errors(DESIGNS, 24)), expected, rtol=1e-9)
    assert max(error.max() for error in judged.errors(DESIGNS, 256)) < 1e-9

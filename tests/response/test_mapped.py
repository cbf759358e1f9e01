"""Cases of formulas: the case itself at the coefficients that they give, alone as in compiled loops."""

import numpy as np

from garage import QUARTER, ROAD
from suspension_ctrl import RideProblem
from suspension_ctrl.response.mapped import Mapped, coefficients_of, mean_squares_of, slopes_of, unmapped

PROBLEM = RideProblem(
    QUARTER, ROAD, speed=20.0, bounds={"ride_frequency": (1.0, 1.6), "damping_ratio": (0.2, 0.5)}, nodes=256
)
DESIGNS = np.array([[1.1, 0.25], [1.5, 0.4]])


def test_a_case_of_formulas_is_the_case_at_its_coefficients():
    case = PROBLEM.kernel.cases[0]
    assert isinstance(case, Mapped)
    inner, coefficients = unmapped(case, DESIGNS)
    np.testing.assert_array_equal(mean_squares_of(case, DESIGNS), inner(coefficients))
    np.testing.assert_allclose(case(DESIGNS), inner(coefficients), rtol=1e-13)  # compiled into one: sums differ
    assert unmapped(inner, DESIGNS) == (inner, DESIGNS)


def test_a_search_in_compiled_code_finds_the_same_scores():
    """One design in compiled code as many by numpy; a square root of sums in the same order."""
    found = [PROBLEM.kernel(design) for design in DESIGNS]
    np.testing.assert_allclose(found, PROBLEM.evaluate(DESIGNS), rtol=1e-14)


def test_derivatives_of_coefficients_are_those_of_differences():
    """Central differences of 1e-4 of roots and squares: an error of 1e-8."""
    formulas = PROBLEM.kernel.cases[0].formulas
    found = slopes_of(formulas, DESIGNS)
    for v in range(2):
        by = 1e-4 * np.eye(2)[v]
        expected = (coefficients_of(formulas, DESIGNS + by) - coefficients_of(formulas, DESIGNS - by)) / 2e-4
        np.testing.assert_allclose(found[:, :, v], expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())

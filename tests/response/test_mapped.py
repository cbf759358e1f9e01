"""Cases of formulas: the case itself at the coefficients that they give, alone as in compiled loops."""

import numpy as np

from garage import QUARTER, ROAD
from suspension_ctrl import RideProblem
from suspension_ctrl.response.mapped import Mapped, mean_squares_of, unmapped

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

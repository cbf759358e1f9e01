"""Measures by a function: along tangents of mean squares, inside the bounds."""

import numpy as np
import pytest
from scipy.stats import norm

import suspension_ctrl as sc
from garage import QUARTER, ROAD

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 5e3)}
CORNERS = [[1e4, 1e3], [3e4, 5e3], [1e4, 5e3], [2e4, 2e3]]


def problem_of(*measures, **changes) -> sc.RideProblem:
    return sc.RideProblem(QUARTER, ROAD, speed=20.0, measures=["ACC", *measures], **{"bounds": BOUNDS, **changes})


def test_functions_of_mean_squares_have_exact_derivatives():
    """The vibration dose is (3 T)^(1/4) ACC; lift is the normal distribution of the tyre load.

    Differences leave 1e-10 of a value by a change of a variable by its size; a derivative may be far smaller.
    """
    problem = problem_of("VDV", "lift", "DTL", "largest tyre_load 1000")
    values, found = problem.with_jacobian(CORNERS)
    factor = (3 * 8 * 3600.0) ** 0.25
    by_share = found * np.array(CORNERS)[:, None] / values[:, :, None]
    np.testing.assert_allclose(by_share[:, 1], by_share[:, 0], atol=1e-10)
    np.testing.assert_allclose(values[:, 1], factor * values[:, 0], rtol=1e-12)
    static = (317.5 + 45.4) * 9.80665
    chain = norm.pdf(static / values[:, 3]) * static / values[:, 3] ** 2
    np.testing.assert_allclose(found[:, 2], chain[:, None] * found[:, 3], rtol=1e-6)


@pytest.mark.parametrize("worst_case", [False, True])
def test_functions_over_load_cases(worst_case):
    cases = [
        sc.LoadCase(vehicle=QUARTER, road=ROAD, speed=speed, share=share)
        for speed, share in ((20.0, 3.0), (30.0, 1.0))
    ]
    problem = sc.RideProblem(cases=cases, measures=["ACC", "VDV"], bounds=BOUNDS, worst_case=worst_case)
    each = [problem.replace(cases=[case]).with_jacobian(CORNERS) for case in cases]
    (value, slope), (other, other_slope) = ((values[:, 1], slopes[:, 1]) for values, slopes in each)
    expected = other_slope
    if not worst_case:
        total = 0.75 * value**4 + 0.25 * other**4
        expected = total[:, None] ** -0.75 * (
            0.75 * value[:, None] ** 3 * slope + 0.25 * other[:, None] ** 3 * other_slope
        )
    np.testing.assert_allclose(problem.jacobian(CORNERS)[:, 1], expected, rtol=1e-8)


def test_functions_of_designs_are_called_inside_the_bounds_alone():
    """Derivatives of a cubic, exact by differences of fourth order but for rounding."""
    seen = []

    def cubic(designs: np.ndarray) -> np.ndarray:
        seen.append(designs)
        return (designs[:, 0] / 1e4) ** 3 * designs[:, 1]

    problem = problem_of(sc.Measure("cubic", "-", cubic))
    found = problem.jacobian(CORNERS)[:, 1]
    x, y = np.array(CORNERS).T
    np.testing.assert_allclose(found, np.stack([3e-12 * x**2 * y, 1e-12 * x**3], axis=1), rtol=1e-9)
    assert (np.concatenate(seen) >= problem.lower).all()
    assert (np.concatenate(seen) <= problem.upper).all()


def test_handling_and_modes_beside_closed_forms():
    """The undamped quarter car: w^2 of both modes by spring, from the characteristic polynomial."""
    problem = problem_of("frequency heave", limits := "-damping_ratio heave")
    assert limits in problem.objectives
    design = np.array([[2e4, 2e3]])
    m, w, kt, k = 317.5, 45.4, 192e3, 2e4

    def square(k: complex) -> complex:
        b = k / m + (k + kt) / w
        return (b - np.sqrt(b**2 - 4 * k * kt / (m * w))) / 2

    expected = (np.sqrt(square(k + 1e-30j)) / (2 * np.pi)).imag / 1e-30
    found = problem.jacobian(design)[0, 1]
    np.testing.assert_allclose(found, [expected, 0.0], rtol=1e-8, atol=1e-12)


def test_a_variable_that_is_held_has_a_derivative_too():
    held = problem_of("VDV", bounds={"spring": (2e4, 2e4), "damper": (1e3, 5e3)})
    free = problem_of("VDV")
    np.testing.assert_allclose(held.jacobian([[2e4, 2e3]]), free.jacobian([[2e4, 2e3]]), rtol=1e-8)

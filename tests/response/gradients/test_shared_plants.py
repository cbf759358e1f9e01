"""Derivatives in load cases with one plant beside each case by itself."""

import numpy as np

import struts_by_numpy
import suspension_ctrl as sc
from garage import HALF, ROAD
from suspension_ctrl.response.gradients.shared_plants import joined, of_struts, slopes_by_case
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.shared_plants import Shared, shared, squares_by_case

SIZES = [(3, 2, 3), (2, 2, 2)]
FACTORS = [np.array([[1.0, 2.0, 0.0, 3.0]]), np.array([[0.0, 1.0, 1.0, 0.0], [1.0, 0.0, 0.0, 0.0]]), np.eye(4)]


def test_each_case_has_the_derivatives_of_its_own_combinations():
    """Cases 0 and 2 share a plant; the last factors are of terms that a case has not. Numbers of order one."""
    first = struts_by_numpy.random_struts(SIZES, [False, False])
    of_sources = np.concatenate([np.repeat([False, True, True, False], (q * q, q * s, k * s, k * q))
                                 for q, s, k in SIZES])  # fmt: skip
    louder = first._replace(rows=first.rows * np.where(of_sources, 2.0, 1.0)[:, None, None])
    cases = [first, first._replace(rows=2 * first.rows), louder]
    groups, designs = shared(cases), np.random.default_rng(1).normal(size=(3, 4))
    assert [group.numbers for group in groups] == [(0, 2), (1,)]
    assert of_struts(groups)
    wanted = [Wanted(np.pad(factor, ((0, 0), (0, 2))), np.zeros(len(factor), dtype=bool)) for factor in FACTORS]
    counted = [np.ones((3, len(factor)), dtype=bool) for factor in FACTORS]
    counted[1][0] = False
    plan = [joined([(wanted[c], 4) for c in group.numbers]) for group in groups]
    found = slopes_by_case(groups, plan, designs, squares_by_case(groups, designs), counted)
    for own, case, factor, which in zip(found, cases, FACTORS, counted, strict=True):
        slopes = np.array([struts_by_numpy.with_slopes(case, design)[1] for design in designs])
        expected = (factor @ slopes) * which[:, :, None]
        np.testing.assert_allclose(own, expected, rtol=1e-11, atol=1e-12 * np.abs(slopes).max())


def test_variables_may_be_formulas_of_coefficients():
    """Extrapolated central differences of 1e-3: an error of 1e-10 by rounding."""
    bounds = {
        f"{axle}.{one}": pair
        for axle in ("front", "rear")
        for one, pair in (("ride_frequency", (1.0, 1.6)), ("damping_ratio", (0.2, 0.5)))
    }
    problem = sc.RideProblem(HALF, ROAD, speed=20.0, bounds=bounds, band=(0.3, 20.0))
    groups = [Shared(*problem.scores.kernel(problem.nodes).cases, (0,))]
    designs = np.random.default_rng(0).uniform(problem.lower, problem.upper, (3, 4))
    designs.flags.writeable = False
    (squares,) = squares_by_case(groups, designs)
    k = squares.shape[1]
    plan, counted = [Wanted(np.eye(k), np.zeros(k, dtype=bool))], [np.ones((3, k), dtype=bool)]
    assert of_struts(groups)
    (slopes,) = slopes_by_case(groups, plan, designs, [squares], counted)
    for v, low in enumerate(problem.lower):
        by = 1e-3 * low * np.eye(4)[v]
        half, whole = (
            (squares_by_case(groups, designs + m * by)[0] - squares_by_case(groups, designs - m * by)[0])
            / (2e-3 * low * m)
            for m in (1, 2)
        )
        np.testing.assert_allclose(
            slopes[:, :, v], (4 * half - whole) / 3, rtol=1e-8, atol=1e-8 * np.abs(slopes).max()
        )

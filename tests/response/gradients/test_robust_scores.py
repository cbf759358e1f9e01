"""Derivatives over a scatter beside differences of the problem itself."""

import numpy as np

import suspension_ctrl as sc
from garage import QUARTER, ROAD

SCATTER = {"spring": 0.05, "damper": 0.1, "body_mass": 0.03}


def test_mean_quantile_and_more_beside_differences():
    """No samples change places over central differences of 1e-4: an error of 1e-7 by the third derivative."""
    problem = sc.RideProblem(
        QUARTER, ROAD, speed=20.0, bounds={"spring": (1e4, 3e4), "damper": (1e3, 5e3)},
        measures=["mean ACC", sc.Quantile("DTL", 90.0), "SWS", "mean VDV"], constraints=["mean SWS <= 0.03"],
        scatter=sc.Scatter(SCATTER, samples=24, seed=1),
    )  # fmt: skip
    designs = np.array([[2e4, 2e3], [1.4e4, 3e3]])
    values, found = problem.with_jacobian(designs)
    np.testing.assert_allclose(values, problem.evaluate(designs), rtol=1e-12)
    for v in range(2):
        by = 1e-4 * designs[:, v : v + 1] * np.eye(2)[v]
        moved = (problem.evaluate(designs + by) - problem.evaluate(designs - by)) / 2e-4
        np.testing.assert_array_less(np.abs(found[:, :, v] * designs[:, [v]] - moved), 1e-6 * np.abs(values))

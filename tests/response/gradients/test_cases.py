"""Every class of cases in one pass: mean squares of the case, and derivatives by formulas as differences."""

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import QUARTER, ROAD
from suspension_ctrl.response.gradients.cases import with_slopes
from suspension_ctrl.response.gradients.wanted import Wanted
from suspension_ctrl.response.mapped import Mapped, mean_squares_of

BOUNDS = {"ride_frequency": (1.0, 1.6), "damping_ratio": (0.2, 0.5)}
MOUNTED = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount", 2e5)))


@pytest.mark.parametrize(
    ("vehicle", "bounds"),
    [
        (QUARTER, BOUNDS),
        (QUARTER, {"spring": (1e4, 3e4), "damper": (1e3, 3e3)}),
        (sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=MOUNTED),
         {"damper": (1e3, 3e3), "spring": (1e4, 3e4), "tyre_stiffness": (15e4, 22e4)}),
    ],
)  # fmt: skip
def test_mean_squares_and_derivatives_of_a_case(vehicle, bounds):
    """Extrapolated central differences of 1e-3: an error of 1e-10 by rounding."""
    problem = sc.RideProblem(vehicle, ROAD, speed=20.0, bounds=bounds)
    (case,) = problem.scores.kernel(problem.nodes).cases
    assert isinstance(case, Mapped) == ("ride_frequency" in " ".join(bounds) or "tyre_stiffness" in bounds)
    designs = np.random.default_rng(0).uniform(problem.lower, problem.upper, (3, len(bounds)))
    designs.flags.writeable = False
    k = mean_squares_of(case, designs).shape[1]
    squares, slopes = with_slopes(case, Wanted(np.eye(k), np.zeros(k, dtype=bool)), designs)
    np.testing.assert_allclose(squares, mean_squares_of(case, designs), rtol=1e-12)
    for v, low in enumerate(problem.lower):
        by = 1e-3 * low * np.eye(len(bounds))[v]
        half, whole = (
            (mean_squares_of(case, designs + m * by) - mean_squares_of(case, designs - m * by)) / (2e-3 * m)
            for m in (1, 2)
        )
        off = np.abs(slopes[:, :, v] * low - (4 * half - whole) / 3)
        assert (off < 1e-9 * squares.max(axis=0)).all()

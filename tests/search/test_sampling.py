"""Baselines: samples of the box, of which all that is not dominated is kept."""

import numpy as np
import pytest
from scipy.stats import qmc

from functions import dtlz2
from suspension_ctrl import minimise
from suspension_ctrl.search import sampling
from suspension_ctrl.search.indicators import non_dominated
from suspension_ctrl.search.sampling import Sampling


@pytest.mark.parametrize("points", ["random", "sobol"])
def test_keeps_the_best_of_all_that_it_has_seen(points):
    problem, optimiser = dtlz2(3), Sampling(population=30, points=points)
    toolbox = optimiser.toolbox(problem)
    seen = []
    toolbox.register("evaluate", lambda designs: seen.append(designs) or problem.evaluate(designs))
    run = minimise(problem, optimiser, iterations=9, seed=4, toolbox=toolbox)
    designs = np.concatenate(seen)
    objectives = problem.evaluate(designs)
    best = non_dominated(objectives)
    np.testing.assert_array_equal(run.designs, designs[best])
    np.testing.assert_array_equal(run.objectives, objectives[best])
    assert run.evaluations == len(designs) == 300


def test_sobol_parts_are_one_sequence():
    """Parts of any size are what scipy gives at once, and are spread more evenly than independent points."""
    parts = sampling.sobol_points(np.random.default_rng(5), 24, 2)
    points = np.concatenate([next(parts) for _ in range(20)])
    np.testing.assert_array_equal(points, qmc.Sobol(2, rng=np.random.default_rng(5)).random(512)[:480])
    independent = next(sampling.random_points(np.random.default_rng(5), 480, 2))
    assert qmc.discrepancy(points) < 0.1 * qmc.discrepancy(independent)


def test_rejects_bad_settings():
    with pytest.raises(ValueError, match=r"^points must be one of random, sobol, got 'grid'$"):
        Sampling(population=20, points="grid")
    with pytest.raises(ValueError, match=r"^population must be a whole number >= 4, got 2$"):
        Sampling(population=2)

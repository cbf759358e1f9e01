"""The loop in C that MOEA/D-DRA is compared with: it is the same search."""

import shutil

import numpy as np
import pandas as pd
import pytest

from functions import dtlz2, uf
from sections import moead_limits
from suspension_ctrl.search.decomposition import ZERO_WEIGHT, weight_vectors
from suspension_ctrl.search.neighbours import neighbourhoods


def test_uf1_is_that_of_the_tests():
    designs = np.random.default_rng(0).uniform(uf(1).lower, uf(1).upper, (20, 30))
    np.testing.assert_allclose(moead_limits.uf1().evaluate(designs), uf(1).evaluate(designs), rtol=1e-13)


@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler")
def test_the_loop_in_c_reaches_the_front(tmp_path):
    """Zhang, Liu and Li printed an IGD of 0.0043 at 300,000 evaluations, of 100 designs; here all 600 count."""
    program = moead_limits.compile_loop(tmp_path)
    found = [moead_limits.loop_in_c(program, 300_000, seed) for seed in range(3)]
    assert 0.001 < np.median([igd for _, igd in found]) < 0.004
    assert all(seconds > 0 for seconds, _ in found)
    _, early = moead_limits.loop_in_c(program, 3000, 0)
    assert early > 0.1


def test_the_bare_loop_is_a_search():
    """As plain Python, on DTLZ2, whose front is the unit sphere: 20 generations of 40."""
    problem, rng = dtlz2(4), np.random.default_rng(0)
    weights = np.maximum(weight_vectors(40, 3), ZERO_WEIGHT)
    designs, parents = rng.random((40, 4)), rng.integers(0, 40, 800)
    values = problem.evaluate(designs)
    begin = np.linalg.norm(values, axis=1) - 1

    def evaluate(child, value):
        value[:] = problem.evaluate(child[np.newaxis])[0]

    box = np.zeros(4), np.ones(4)
    moead_limits.bare.py_func(evaluate, rng, designs, values, weights, neighbourhoods(40, 3, 20), parents, *box, 2)
    np.testing.assert_array_equal(values, problem.evaluate(designs))
    assert np.abs(np.linalg.norm(values, axis=1) - 1).mean() < 0.25 * begin.mean()
    assert (np.ptp(values, axis=0) > 0.9).all()


def test_goals_are_those_of_what_was_measured():
    names = [moead_limits.RIDE, moead_limits.BARE, moead_limits.UF1, moead_limits.LOOP]
    timings = pd.DataFrame({"contender": names, "seconds": [3.0, 2.0, 5.0, 4.0]})
    assert [ratio for _, _, ratio, _ in moead_limits.goals(timings)] == [1.25, 1.5]
    assert [ratio for _, _, ratio, _ in moead_limits.goals(timings[:3])] == [1.5]

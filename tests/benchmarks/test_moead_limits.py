"""The loop in C that MOEA/D-DRA is compared with: it is the same search."""

import shutil

import numpy as np
import pandas as pd
import pytest

from functions import uf
from sections import moead_limits


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


def test_goals_are_those_of_what_was_measured():
    names = [moead_limits.RIDE, moead_limits.BARE, moead_limits.UF1, moead_limits.LOOP]
    timings = pd.DataFrame({"contender": names, "seconds": [3.0, 2.0, 5.0, 4.0]})
    assert [ratio for _, _, ratio, _ in moead_limits.goals(timings)] == [1.25, 1.5]
    assert [ratio for _, _, ratio, _ in moead_limits.goals(timings[:3])] == [1.5]

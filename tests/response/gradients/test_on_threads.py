"""Derivatives on threads: the same bits for any number, functions of users on the caller's thread alone."""

import threading

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import QUARTER, ROAD

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 5e3)}
DRAWN = np.random.default_rng(3).uniform([1e4, 1e3], [3e4, 5e3], (9000, 2))
PROBLEM = sc.RideProblem(QUARTER, ROAD, speed=20.0, bounds=BOUNDS)
SCATTERED = PROBLEM.replace(measures=["mean ACC", "SWS"], scatter=sc.Scatter({"damper": 0.1}, samples=24))


@pytest.mark.parametrize(("problem", "count"), [(PROBLEM, 9000), (SCATTERED, 400)])
def test_any_number_of_threads_gives_the_same_bits(problem, count):
    """With another number of designs blocks end elsewhere."""
    values, jacobian = problem.with_jacobian(DRAWN[:count], threads=2)
    assert (values.shape, jacobian.shape) == ((count, values.shape[1]), (count, values.shape[1], 2))
    for part in (slice(count), slice(count // 3)):
        one = problem.with_jacobian(DRAWN[part], threads=1)
        np.testing.assert_array_equal(values[part], one[0])
        np.testing.assert_array_equal(jacobian[part], one[1])


def test_functions_of_users_are_called_on_the_callers_thread():
    seen = set()

    def softness(designs):
        seen.add(threading.get_ident())
        return 1.0 / designs[:, 0]

    problem = PROBLEM.replace(measures=["ACC", sc.Measure("softness", "m/N", softness)])
    _, jacobian = problem.with_jacobian(DRAWN, threads=2)
    np.testing.assert_allclose(jacobian[:, 1, 0], -1.0 / DRAWN[:, 0] ** 2, rtol=1e-9)  # of differences some 1e-10
    assert seen == {threading.get_ident()}

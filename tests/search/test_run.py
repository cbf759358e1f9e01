"""Runs that go on in memory."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from functions import zdt1
from suspension_ctrl import MoeadDra, Nsga2, minimise


@given(st.integers(1, 12), st.integers(1, 12), st.integers(0, 2**40))
@settings(max_examples=10)
def test_any_two_parts_make_the_whole(first, second, seed):
    for optimiser in (Nsga2(population=20), MoeadDra(population=20, utility_period=3)):
        whole = minimise(zdt1(5), optimiser, iterations=first + second, seed=seed)
        part = minimise(zdt1(5), optimiser, iterations=first, seed=seed)
        found = part.resume(zdt1(5), iterations=second)
        np.testing.assert_array_equal(found.designs, whole.designs)
        np.testing.assert_array_equal(found.objectives, whole.objectives)
        assert found.evaluations == whole.evaluations


def test_budgets_of_a_further_search_count_from_there():
    run = minimise(zdt1(5), Nsga2(population=20), iterations=2, seed=1)
    assert run.resume(zdt1(5), evaluations=59).evaluations == 60 + 40
    assert run.resume(zdt1(5), iterations=9, callback=lambda run: run.evaluations >= 100).evaluations == 100
    with pytest.raises(ValueError, match=r"^evaluations must be a whole number >= 20, got 19$"):
        run.resume(zdt1(5), evaluations=19)


def test_another_problem_is_refused():
    run = minimise(zdt1(3), Nsga2(population=20), iterations=2, seed=1)
    with pytest.raises(ValueError, match=r"^problem must be that of the run, x1, x2, x3, f1, f2, got x1, x2"):
        run.resume(zdt1(4), iterations=1)

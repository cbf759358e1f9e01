"""Searches that people of other toolboxes run, beside those that the tests of modules hold."""

import numpy as np
import pytest

from functions import zdt1
from suspension_ctrl import MoeadDra, Nsga2, minimise


@pytest.mark.parametrize(("population", "neighbours", "replaced"), [(30, 20, 2), (100, 20, 2), (600, 60, 6)])
def test_moead_dra_as_it_comes_has_the_usual_settings_of_its_population(population, neighbours, replaced):
    """T = 20 and n_r = 2 for 100: jMetalPy's moeaddra_UF.py @8cca589; MOEAFramework's MOEAD.java @9f2ce5a.

    For 600 the tenth and the hundredth of the authors. The run is that of the settings spelt out.
    """
    optimiser = MoeadDra(population=population)
    assert (optimiser.neighbours, optimiser.replacements) == (neighbours, replaced)
    spelt = MoeadDra(
        population=population, neighbourhood=neighbours / population, replacement_limit=replaced / population
    )
    runs = [minimise(zdt1(5), one, iterations=3, seed=1) for one in (optimiser, spelt)]
    np.testing.assert_array_equal(runs[0].designs, runs[1].designs)


def test_the_designs_handed_out_hold_a_front_of_their_own():
    """Platypus issue 32, pymoo issue 717: early on most designs of a population are dominated."""
    run = minimise(zdt1(5), Nsga2(population=50), evaluations=100, seed=1)
    front = run.front()[["f1", "f2"]].to_numpy()
    assert 0 < len(front) < len(run.designs) == 50
    worse = [(front <= one).all(axis=1) & (front < one).any(axis=1) for one in run.objectives]
    known = [(front == one).all(axis=1).any() for one in run.objectives]
    assert [bool(one.any()) for one in worse] == [not one for one in known]

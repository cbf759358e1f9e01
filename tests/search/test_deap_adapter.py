"""Operators of DEAP as its users write them, in our toolboxes."""

import random

import numpy as np
import pytest
from deap import tools

from functions import zdt1
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.search import operators
from suspension_ctrl.search.deap_adapter import (
    mate_by_deap,
    mutate_by_deap,
    select_with_deap,
    with_deap_operators,
)

PROBLEM = zdt1(4)
MUTATIONS = {
    "gaussian": (tools.mutGaussian, {"mu": 0.0, "sigma": 0.3, "indpb": 0.5}),
    "polynomial": (tools.mutPolynomialBounded, {"eta": 20.0, "low": 0.0, "up": 1.0, "indpb": 0.5}),
}
CROSSOVERS = {
    "blend": (tools.cxBlend, {"alpha": 0.5}),
    "simulated binary": (tools.cxSimulatedBinaryBounded, {"eta": 20.0, "low": 0.0, "up": 1.0}),
}
CASES = [
    *[(Nsga2(population=20), "mutate", *case) for case in MUTATIONS.values()],
    *[(Nsga2(population=20), "mate", *case) for case in CROSSOVERS.values()],
    *[(MoeadDra(population=20), "mutate", *case) for case in MUTATIONS.values()],
]


@pytest.mark.parametrize(("optimiser", "verb", "operator", "settings"), CASES)
def test_deaps_operators_are_registered_as_in_deap(optimiser, verb, operator, settings):
    """Same seed, same run, whatever state Python's generator is in; and that state is kept."""
    toolbox = optimiser.toolbox(PROBLEM)
    toolbox.register(verb, operator, **settings)
    runs = []
    for seed in (1, 2):
        random.seed(seed)
        state = random.getstate()
        runs.append(minimise(PROBLEM, optimiser, iterations=8, seed=4, toolbox=toolbox))
        assert random.getstate() == state
    np.testing.assert_array_equal(runs[0].designs, runs[1].designs)
    assert ((runs[0].designs >= 0) & (runs[0].designs <= 1)).all()
    assert not np.array_equal(runs[0].designs, minimise(PROBLEM, optimiser, iterations=8, seed=4).designs)
    assert getattr(toolbox, verb).func is operator


def shift(individual, by):
    """An operator in DEAP's form by a user."""
    for i in range(len(individual)):
        individual[i] += by
    return (individual,)


def swap(ind1, ind2):
    return ind2, ind1


def test_individuals_are_lists_and_results_are_clipped():
    designs, box = np.array([[0.1, 0.8], [0.2, 0.5], [0.3, 0.4]]), (np.zeros(2), np.ones(2))
    rng = np.random.default_rng(0)
    shifted = mutate_by_deap(rng, designs, lambda individual: shift(individual, 0.5), *box)
    np.testing.assert_array_equal(shifted, np.minimum(designs + 0.5, 1.0))
    np.testing.assert_array_equal(mutate_by_deap(rng, designs[0], lambda i: shift(i, 0.5), *box), shifted[0])
    np.testing.assert_array_equal(mate_by_deap(rng, designs, swap, *box), designs[[1, 0, 2]])
    np.testing.assert_array_equal(mate_by_deap(rng, designs[:2], swap, *box), designs[[1, 0]])
    np.testing.assert_array_equal(designs[0], [0.1, 0.8])


def test_operators_are_told_apart_by_their_first_parameter():
    toolbox = Nsga2(population=20).toolbox(PROBLEM)
    toolbox.register("mutate", shift, by=0.1)
    adapted = with_deap_operators(toolbox, np.array(PROBLEM.lower), np.array(PROBLEM.upper))
    assert adapted.mutate.func is mutate_by_deap
    assert adapted.mate.func is operators.simulated_binary_crossover
    assert toolbox.mutate.func is shift


def test_deaps_selection_keeps_the_best_in_the_order_of_the_population():
    """Of the second front the end is kept, infinitely far from its neighbours."""
    objectives = np.array([[3.0, 3.0], [1.0, 2.0], [4.0, 2.5], [2.0, 1.0], [3.1, 2.9]])
    index, rank, crowding = select_with_deap(objectives, 3)
    assert (index.tolist(), rank.tolist()) == ([0, 1, 3], [1, 0, 0])
    assert np.isinf(crowding).all()

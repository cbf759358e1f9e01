from itertools import pairwise

import moocore
import numpy as np
from deap import tools

from functions import zdt1
from suspension_ctrl import Nsga2, minimise


def test_zdt1_is_solved():
    """N = 100, 25,000 evaluations, median of 11 seeds; the front's hypervolume at (1, 1) is 2/3."""
    runs = [minimise(zdt1(), Nsga2(population=100), evaluations=25_000, seed=seed) for seed in range(11)]
    assert {run.evaluations for run in runs} == {25_000}
    volumes = [moocore.hypervolume(run.objectives, ref=1.0) for run in runs]
    assert 0.655 < np.median(volumes) < 2 / 3


def test_toolbox_has_the_lines_of_the_pseudo_code_as_verbs():
    toolbox = Nsga2(population=8).toolbox(zdt1(3))
    assert all(hasattr(toolbox, verb) for verb in ("sample", "evaluate", "tournament", "mate", "mutate", "select"))


def test_a_verb_can_be_exchanged():
    """Uniform crossover written by a user in place of the default; the toolbox handed in is not changed."""
    problem, optimiser = zdt1(3), Nsga2(population=20)
    toolbox = optimiser.toolbox(problem)
    calls = []

    def uniform(rng, parents, share):
        calls.append(share)
        swap = rng.random(parents.shape) < share
        return np.where(swap, parents[::-1], parents)

    toolbox.register("mate", uniform, share=0.5)
    run = minimise(problem, optimiser, iterations=3, seed=0, toolbox=toolbox)
    assert calls == [0.5] * 3
    assert toolbox.mate.func is uniform
    assert not np.array_equal(run.designs, minimise(problem, optimiser, iterations=3, seed=0).designs)


def test_survivors_are_never_worse_than_their_parents():
    """No survivor on the first front is dominated by anyone of the population before."""
    problem = zdt1(5)
    runs = [minimise(problem, Nsga2(population=20), iterations=i, seed=2).objectives for i in range(5, 12)]
    for before, after in pairwise(runs):
        front = after[moocore.is_nondominated(after, keep_weakly=True)]
        for survivor in front:
            assert not ((before <= survivor).all(axis=1) & (before < survivor).any(axis=1)).any()


def test_tournaments_know_crowding_and_the_ideal_point_knows_every_child():
    problem, optimiser = zdt1(5), Nsga2(population=4)
    toolbox = optimiser.toolbox(problem)
    seen, evaluated = [], []
    tournament = toolbox.tournament
    toolbox.register("tournament", lambda *args: seen.append(args[2]) or tournament(*args))
    toolbox.register("evaluate", lambda x: evaluated.append(problem.evaluate(x)) or evaluated[-1])
    run = minimise(problem, optimiser, iterations=30, seed=0, toolbox=toolbox)
    assert all(np.isinf(crowding).any() for crowding in seen)
    least = np.vstack(evaluated).min(axis=0)
    np.testing.assert_array_equal(run.history[["ideal_f1", "ideal_f2"]].iloc[-1], least)


def test_deaps_selection_is_deaps():
    """The adapter calls the library's function, not a copy of it."""
    toolbox = Nsga2(population=8, selection="deap-log").toolbox(zdt1(3))
    objectives = np.random.default_rng(0).random((12, 2))
    called = []
    original = tools.selNSGA2
    try:
        tools.selNSGA2 = lambda *args, **kwargs: called.append(kwargs["nd"]) or original(*args, **kwargs)
        toolbox.select(objectives, 8)
    finally:
        tools.selNSGA2 = original
    assert called == ["log"]

"""What every optimiser owes: budgets, seeds, histories, and clear errors."""

import json
import pickle
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from functions import dtlz2, slow, zdt1
from suspension_ctrl import Gamultiobj, MoeadDra, Nsga2, Problem, Run, Sampling, minimise
from suspension_ctrl.paper import experiment as paper

OPTIMISERS = {
    "nsga2": Nsga2(population=40),
    "nsga2-odd": Nsga2(population=41),
    "nsga2-deap-standard": Nsga2(population=40, selection="deap-standard"),
    "nsga2-deap-log": Nsga2(population=40, selection="deap-log"),
    "moead-dra": MoeadDra(population=40, utility_period=3),
    "moead-dra-raw": MoeadDra(population=40, normalise=False, objective_scales=(1.0, 1.0, 1e3)),
    "moead-dra-batch": MoeadDra(population=40, update="batch"),
    "nsga2-gamultiobj": Gamultiobj(population=40),
    "random": Sampling(population=40, points="random"),
    "sobol": Sampling(population=40),
}

PROBLEM = zdt1(4)

every_optimiser = pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())


class Counted:
    """A problem's evaluation that counts designs."""

    def __init__(self, problem):
        self.evaluate_inside = problem.evaluate
        self.designs = 0

    def __call__(self, designs):
        self.designs += len(designs)
        return self.evaluate_inside(designs)


def counted(problem: Problem) -> tuple[Problem, Counted]:
    counter = Counted(problem)
    return replace(problem, evaluate=counter), counter


@every_optimiser
@pytest.mark.parametrize("iterations", [1, 7])
def test_evaluations_are_those_counted(optimiser, iterations):
    problem, counter = counted(dtlz2(5))
    run = minimise(problem, optimiser, iterations=iterations, seed=1)
    assert run.evaluations == counter.designs
    share = 5 if isinstance(optimiser, MoeadDra) else 1
    assert run.evaluations == optimiser.population + iterations * (optimiser.population // share)


@every_optimiser
def test_a_budget_of_evaluations_is_kept(optimiser):
    problem, counter = counted(dtlz2(5))
    run = minimise(problem, optimiser, evaluations=333, seed=1)
    assert run.evaluations == counter.designs <= 333
    assert run.evaluations + optimiser.evaluations_per_iteration(3) > 333


@every_optimiser
def test_same_seed_same_arrays(optimiser):
    problem = paper.ride_problem()
    first, again, other = (minimise(problem, optimiser, iterations=6, seed=seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(first.designs, again.designs)
    np.testing.assert_array_equal(first.objectives, again.objectives)
    assert not np.array_equal(first.designs, other.designs)


PROGRAM = """
import json, sys
from suspension_ctrl import Gamultiobj, MoeadDra, Nsga2, Sampling, minimise
from suspension_ctrl.paper import experiment as paper
runs = [minimise(paper.ride_problem(), eval(text), iterations=6, seed=3) for text in json.loads(sys.argv[1])]
print(json.dumps([[run.designs.tolist(), run.objectives.tolist()] for run in runs]))
"""


def test_same_seed_same_arrays_in_another_process():
    texts = json.dumps([repr(optimiser) for optimiser in OPTIMISERS.values()])
    done = subprocess.run([sys.executable, "-c", PROGRAM, texts], capture_output=True, text=True, check=True)
    for optimiser, (designs, objectives) in zip(OPTIMISERS.values(), json.loads(done.stdout), strict=True):
        run = minimise(paper.ride_problem(), optimiser, iterations=6, seed=3)
        np.testing.assert_array_equal(run.designs, designs)
        np.testing.assert_array_equal(run.objectives, objectives)


@every_optimiser
def test_results_are_in_the_box_and_evaluated(optimiser):
    problem = paper.ride_problem()
    run = minimise(problem, optimiser, iterations=5, seed=0)
    assert ((run.designs >= problem.lower) & (run.designs <= problem.upper)).all()
    np.testing.assert_array_equal(run.objectives, problem.evaluate(run.designs))


@every_optimiser
def test_history_has_a_row_for_the_start_and_one_per_iteration(optimiser):
    run = minimise(dtlz2(5), optimiser, iterations=4, seed=0)
    history = run.history
    assert history.iteration.tolist() == [0, 1, 2, 3, 4]
    assert history.evaluations.iloc[0] == optimiser.population
    assert history.evaluations.iloc[-1] == run.evaluations
    assert history.evaluations.diff().iloc[1:].eq(optimiser.evaluations_per_iteration(3)).all()
    assert history.seconds.is_monotonic_increasing
    assert history.seconds.iloc[-1] == run.seconds
    phases = history[[f"{phase}_seconds" for phase in optimiser.phases]]
    assert (phases.diff().iloc[1:] >= 0).all(axis=None)
    assert phases.iloc[-1].sum() <= run.seconds
    ideal = history[["ideal_f1", "ideal_f2", "ideal_f3"]]
    assert (ideal.diff().iloc[1:] <= 0).all(axis=None)
    assert (ideal.iloc[-1] <= run.objectives.min(axis=0)).all()


def test_a_fresh_seed_is_kept_and_repeats_the_run():
    run = minimise(zdt1(4), OPTIMISERS["nsga2"], iterations=2)
    again = minimise(zdt1(4), OPTIMISERS["nsga2"], iterations=2, seed=run.seed)
    np.testing.assert_array_equal(run.designs, again.designs)


@every_optimiser
def test_any_number_of_variables(optimiser):
    for variables in (1, 3):
        problem = Problem(
            evaluate=lambda x: np.stack([x.sum(axis=1), (1 - x).sum(axis=1), (x**2).sum(axis=1)], axis=1),
            lower=(0.0,) * variables,
            upper=(2.0,) * variables,
            objectives=("a", "b", "c"),
        )
        assert minimise(problem, optimiser, iterations=3, seed=0).designs.shape[1] == variables


@pytest.mark.parametrize(
    ("budget", "message"),
    [
        ({}, "one of iterations and evaluations, or seconds, must be given, got None, None and None"),
        (
            {"iterations": 1, "evaluations": 99},
            "one of iterations and evaluations, or seconds, must be given, got 1, 99 and None",
        ),
        ({"iterations": 0}, "iterations must be a whole number >= 1, got 0"),
        ({"iterations": 2.5}, "iterations must be a whole number >= 1, got 2.5"),
        ({"evaluations": 79}, "evaluations must be a whole number >= 80, got 79"),
        ({"iterations": 1, "seed": -1}, "seed must be a whole number >= 0, got -1"),
    ],
)
def test_rejects_bad_budgets(budget, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        minimise(zdt1(3), OPTIMISERS["nsga2"], **budget)


@every_optimiser
@pytest.mark.parametrize(
    ("evaluate", "message"),
    [
        (lambda x: x[:, :2], "evaluate must return shape (40, 3) for designs (40, 5), got (40, 2)"),
        (lambda x: x[1:, :3], "evaluate must return shape (40, 3) for designs (40, 5), got (39, 3)"),
        (lambda x: x[:, :3] * np.nan, "evaluate must return finite objectives, got [nan, nan, nan] for design"),
        (lambda x: x[:, :3] / 0.0, "evaluate must return finite objectives, got [inf, inf, inf] for design"),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero:RuntimeWarning")  # made on purpose, for an infinite objective
def test_rejects_bad_evaluations(optimiser, evaluate, message):
    optimiser = replace(optimiser, population=40)
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        minimise(replace(dtlz2(5), evaluate=evaluate), optimiser, iterations=1, seed=0, failures="error")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Nsga2(population=3), "population must be a whole number >= 4, got 3"),
        (lambda: MoeadDra(population=3), "population must be a whole number >= 4, got 3"),
        (lambda: Nsga2(population=10.0), "population must be a whole number >= 4, got 10.0"),
        (
            lambda: Nsga2(population=8, crossover_probability=1.5),
            "crossover_probability must be a number from 0 to 1",
        ),
        (
            lambda: Nsga2(population=8, mutation_probability=-0.1),
            "mutation_probability must be a number from 0 to 1",
        ),
        (
            lambda: Nsga2(population=8, selection="quick"),
            "selection must be one of array, deap-standard, deap-log, got",
        ),
        (lambda: MoeadDra(population=8, neighbourhood=2), "neighbourhood must be a number from 0 to 1, got 2"),
        (lambda: MoeadDra(population=8, repair_reach=-1), "repair_reach must be a number from 0 to 1, got -1"),
        (lambda: MoeadDra(population=8, update="both"), "update must be one of sequential, batch, got 'both'"),
        (
            lambda: MoeadDra(population=8, normalise=False, objective_scales=(1.0, 0.0)),
            "objective_scales must be finite",
        ),
    ],
)
def test_rejects_bad_settings(make, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        make()


def test_rejects_populations_too_small_for_the_corner_subproblems():
    with pytest.raises(ValueError, match=r"^population must be >= 15 for 3 objectives, .* got 14$"):
        minimise(dtlz2(5), MoeadDra(population=14), iterations=1, seed=0)
    assert minimise(dtlz2(5), MoeadDra(population=15), iterations=1, seed=0).evaluations == 18


def test_rejects_scales_that_do_not_fit():
    with pytest.raises(
        ValueError, match=r"^objective_scales must be 3 numbers, one per objective, got \(1.0, 2.0\)$"
    ):
        minimise(
            dtlz2(5), MoeadDra(population=20, normalise=False, objective_scales=(1.0, 2.0)), iterations=1, seed=0
        )
    with pytest.raises(ValueError, match=r"^objective_scales must be None with normalise, got"):
        MoeadDra(population=20, objective_scales=(1.0, 2.0, 3.0))


@every_optimiser
def test_an_evaluation_may_keep_its_memory_and_change_its_argument(optimiser):
    """It hands out the same array each time, and spoils the designs that it is given."""
    plain = dtlz2(5)
    memory = {}

    def careless(designs):
        values = memory.setdefault(len(designs), np.empty((len(designs), 3)))
        values[:] = plain.evaluate(designs)
        designs[:] = -1.0
        return values

    run = minimise(replace(plain, evaluate=careless), optimiser, iterations=3, seed=0)
    expected = minimise(plain, optimiser, iterations=3, seed=0)
    np.testing.assert_array_equal(run.designs, expected.designs)
    np.testing.assert_array_equal(run.objectives, expected.objectives)


@every_optimiser
def test_exchanged_evaluations_are_checked_and_counted(optimiser):
    problem = paper.ride_problem()
    toolbox = optimiser.toolbox(problem)
    toolbox.register("evaluate", lambda designs: np.full((len(designs), 3), np.nan))
    with pytest.raises(ValueError, match=r"^evaluate must return finite objectives"):
        minimise(problem, optimiser, iterations=1, seed=0, toolbox=toolbox, failures="error")


@pytest.mark.parametrize("population", [np.uint8(200), np.int8(100), np.int64(40)])
def test_whole_numbers_of_any_type_are_taken(population):
    """A sum of small ones does not wrap round."""
    for kind in (Nsga2, MoeadDra, Gamultiobj, Sampling):
        one = minimise(dtlz2(5), kind(population=population), evaluations=np.uint16(1000), seed=np.uint8(3))
        other = minimise(dtlz2(5), kind(population=int(population)), evaluations=1000, seed=3)
        np.testing.assert_array_equal(one.designs, other.designs)
        assert one.evaluations == other.evaluations


@pytest.mark.parametrize("optimiser", [Nsga2(population=20), MoeadDra(population=20), Gamultiobj(population=20)])
def test_more_designs_than_the_population_are_all_evaluated(optimiser):
    """The best go on; every one is counted."""
    problem, known = zdt1(5), np.c_[np.linspace(0, 1, 70), np.zeros((70, 4))]
    run = minimise(problem, optimiser, evaluations=100, seed=1, start=known, callback=lambda run: True)
    assert len(run.designs) == 20
    assert run.evaluations == 70 + optimiser.evaluations_per_iteration(2)
    assert (run.designs[:, 1:] == 0).all(axis=1).mean() > 0.5  # known ones, all Pareto-optimal


@pytest.mark.parametrize("optimiser", [Nsga2(population=20), MoeadDra(population=20)], ids=["nsga2", "moead-dra"])
def test_callbacks_get_the_run_so_far_and_may_end_it(optimiser):
    seen = []
    run = minimise(
        PROBLEM, optimiser, iterations=9, seed=1, callback=lambda run: seen.append(run) or len(seen) == 4
    )
    assert len(seen) == 4
    for iterations, so_far in enumerate(seen, 1):
        alone = minimise(PROBLEM, optimiser, iterations=iterations, seed=1)
        np.testing.assert_array_equal(so_far.designs, alone.designs)
        assert so_far.evaluations == alone.evaluations
        assert len(so_far.history) == iterations + 1
    np.testing.assert_array_equal(run.designs, seen[-1].designs)


def test_seconds_end_a_search_alone_or_beside_another_budget():
    problem = Problem(evaluate=slow, lower=(0.0,) * 4, upper=(1.0,) * 4, objectives=("f1", "f2"))
    alone = minimise(problem, Nsga2(population=8), seconds=0.1, seed=0)  # an evaluation takes 0.01 s
    assert 2 <= len(alone.history) <= 13
    beside = minimise(problem, Nsga2(population=8), iterations=10**6, seconds=0.05, seed=0)
    assert 2 <= len(beside.history) <= 8
    assert len(minimise(problem, Nsga2(population=8), evaluations=24, seconds=60.0, seed=0).history) == 3
    with pytest.raises(ValueError, match=r"^seconds must be finite and > 0 s, got 0$"):
        minimise(problem, Nsga2(population=8), seconds=0)


def starts(designs: np.ndarray, run: Run) -> dict:
    frame = run.to_frame()
    return {"array": designs, "list": designs.tolist(), "run": run, "frame": frame, "mixed": frame.iloc[:, ::-1]}


@pytest.mark.parametrize("kind", ["array", "list", "run", "frame", "mixed"])
def test_given_designs_take_the_place_of_the_first_sampled_ones(kind):
    ride = paper.ride_problem(nodes=256)
    before = minimise(ride, Nsga2(population=8), iterations=3, seed=5)
    start = starts(before.designs, before)[kind]
    for optimiser in (Nsga2(population=20), MoeadDra(population=20), Gamultiobj(population=20)):
        toolbox = optimiser.toolbox(ride)
        sampled = toolbox.sample(np.random.default_rng(7), 20)
        seen = []
        toolbox.register("evaluate", lambda x, seen=seen: seen.append(x) or ride.evaluate(x))
        minimise(ride, optimiser, iterations=1, seed=7, start=start, toolbox=toolbox)
        np.testing.assert_array_equal(seen[0], np.concatenate([before.designs, sampled[8:]]))


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (np.zeros((21, 2)) + 20e3, "start must lie within"),
        ([20e3, 2e3], "start must have shape (k, 2), got (2,)"),
        ([[20e3, 2e3], [1.0]], "start must be an array of real numbers, got [["),
        ({"spring": 20e3}, "start must be an array of real numbers, got {"),
        (
            pd.DataFrame({"spring [N/m]": [2e4]}),
            "start must have the columns spring [N/m], damper [N s/m], got none",
        ),
    ],
)
def test_rejects_starts_that_do_not_fit(start, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        minimise(paper.ride_problem(nodes=256), Nsga2(population=20), iterations=1, start=start)


def test_a_sample_has_no_start():
    with pytest.raises(ValueError, match=r"^start must be None for an optimiser whose toolbox has no verb sample"):
        minimise(PROBLEM, Sampling(population=8), iterations=1, start=np.zeros((1, len(PROBLEM.lower))))


def test_runs_are_shown_in_a_few_lines_and_pickled():
    run = minimise(paper.ride_problem(nodes=256), Nsga2(population=20), iterations=1, seed=0)
    lines = repr(run).splitlines()
    assert lines[0] == "Run: 20 designs, 20 feasible"
    assert re.fullmatch(r"    least ACC \S+ m/s\^2, SWS \S+ m, DTL \S+ N", lines[1])
    assert re.fullmatch(r"    40 evaluations, \S+ s, seed 0", lines[2])
    assert pickle.loads(pickle.dumps(run)) == run
    assert not run.designs.flags.writeable

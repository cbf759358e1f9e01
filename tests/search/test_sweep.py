"""The sweep of MOEA/D-DRA, compiled or plain, with any verbs and kernels."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from numba import njit

from functions import c2dtlz2, dtlz2, srn, zdt1
from suspension_ctrl import FailureWarning, MoeadDra, Problem, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search import sweep


def halfway(rng, child, parent, lower, upper):
    repaired = child.copy()
    for v in range(child.size):
        if not lower[v] <= child[v] <= upper[v]:
            repaired[v] = (lower[v] + upper[v]) / 2
    return repaired


@njit
def counting_kernel(design, calls):
    calls[0] += 1
    return np.array([design[0], design[1], 2.0 - design[0] - design[1]])


@njit
def short_kernel(design):
    return design[:2].copy()


@njit
def bad_kernel(design):
    return np.array([np.nan, 1.0, 1.0])


@njit
def failing_kernel(x):
    rest = 1.0 + x[1] + x[2]
    return np.array([x[0] if x[0] > 0.01 else np.nan, rest * (1.0 - x[0] ** 2)])


@pytest.mark.parametrize(
    "problem",
    [dtlz2(4), paper.ride_problem(), c2dtlz2(4, compiled=False), srn()],
    ids=["no kernel", "kernel", "constraints, no kernel", "constraints, kernel"],
)
def test_compiled_and_plain_sweeps_make_the_same_run(problem):
    """The compiled loop, the same function as plain Python, and every step of it as plain Python."""
    optimiser = MoeadDra(population=30, utility_period=3)
    runs = [minimise(problem, optimiser, iterations=8, seed=2)]
    toolbox = optimiser.toolbox(problem)
    toolbox.register("evaluate", lambda designs: problem.evaluate(designs))
    runs.append(minimise(problem, optimiser, iterations=8, seed=2, toolbox=toolbox))
    for name in ("choose_subproblems", *sweep.VERBS):
        toolbox.register(name, getattr(toolbox, name).args[0].__call__)
    runs.append(minimise(problem, optimiser, iterations=8, seed=2, toolbox=toolbox))
    for other in runs[1:]:
        np.testing.assert_array_equal(runs[0].designs, other.designs)
        np.testing.assert_array_equal(runs[0].objectives, other.objectives)
        np.testing.assert_array_equal(runs[0].constraints, other.constraints)


def test_kernel_is_used_where_it_may_be_and_only_there():
    problem = paper.ride_problem()
    toolbox = MoeadDra(population=20).toolbox(problem)
    assert sweep.compiled_evaluation(toolbox, problem) is problem.kernel
    toolbox.register("evaluate", lambda designs: problem.evaluate(designs))
    assert sweep.compiled_evaluation(toolbox, problem) is None
    assert sweep.compiled_evaluation(MoeadDra(population=20).toolbox(zdt1(3)), zdt1(3)) is None


def test_a_users_compiled_verb_joins_the_compiled_sweep():
    """With settings by name in any order; the run is the one of the same verb in Python."""
    problem, optimiser = paper.ride_problem(), MoeadDra(population=25)
    runs = []
    for function in (njit(halfway), halfway):
        toolbox = optimiser.toolbox(problem)
        toolbox.register("repair", function, upper=np.array(problem.upper), lower=np.array(problem.lower))
        assert (sweep.compiled_verb(toolbox.repair) is None) == (function is halfway)
        runs.append(minimise(problem, optimiser, iterations=4, seed=0, toolbox=toolbox))
    np.testing.assert_array_equal(runs[0].designs, runs[1].designs)
    assert not np.array_equal(runs[0].designs, minimise(problem, optimiser, iterations=4, seed=0).designs)


def test_exchanged_verbs_are_called_in_the_sweep():
    problem, optimiser = paper.ride_problem(), MoeadDra(population=25)
    toolbox = optimiser.toolbox(problem)
    calls = {"evaluate": 0, "repair": 0}

    def evaluate(designs):
        calls["evaluate"] += len(designs)
        return problem.evaluate(designs)

    def clip(rng, child, parent, low, high):
        calls["repair"] += 1
        return np.clip(child, low, high)

    toolbox.register("evaluate", evaluate)
    toolbox.register("repair", clip, low=problem.lower, high=problem.upper)
    run = minimise(problem, optimiser, iterations=4, seed=0, toolbox=toolbox)
    assert calls == {"evaluate": run.evaluations, "repair": 4 * 5}


def test_compiled_sweep_counts_its_evaluations():
    """A kernel that is handed a counter: as many calls as the run says, but for the start."""
    problem = replace(dtlz2(4), evaluate=lambda x: np.c_[x[:, :2], 2 - x[:, :2].sum(axis=1)])
    calls = np.zeros(1, dtype=np.int64)
    run = minimise(
        replace(problem, kernel=(counting_kernel, (calls,))), MoeadDra(population=37), iterations=9, seed=0
    )
    assert calls[0] == 9 * 7 == run.evaluations - 37


@pytest.mark.parametrize("normalise", [True, False])
def test_iterations_in_one_call_are_those_one_by_one(normalise):
    """With a callback each is a call of its own; failures of the kernel end a call, and so do new utilities."""
    problem = Problem(
        evaluate=lambda rows: np.array([failing_kernel(row) for row in rows]),
        lower=(0.0,) * 3,
        upper=(1.0,) * 3,
        objectives=("f1", "f2"),
        kernel=(failing_kernel, ()),
    )
    optimiser = MoeadDra(population=30, normalise=normalise, utility_period=7)
    with pytest.warns(FailureWarning):
        whole = minimise(problem, optimiser, iterations=60, seed=3)
    with pytest.warns(FailureWarning):
        single = minimise(problem, optimiser, iterations=60, seed=3, callback=lambda run: False)
    assert whole.failures == single.failures > 5
    np.testing.assert_array_equal(whole.designs, single.designs)
    columns = ["iteration", "evaluations", "ideal_f1", "ideal_f2"]
    pd.testing.assert_frame_equal(whole.history[columns], single.history[columns])
    assert (whole.history.seconds.diff().iloc[1:] > 0).all()


@pytest.mark.parametrize(
    ("problem", "kernel", "message"),
    [
        (
            dtlz2(4),
            short_kernel,
            "kernel must return a value for each objective and constraint, got ",
        ),
        (srn(), short_kernel, "kernel must return a value for each objective and constraint, got "),
        (dtlz2(4), bad_kernel, "kernel must return finite objectives, got others for design ["),
    ],
)
def test_kernels_are_checked(problem, kernel, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        minimise(replace(problem, kernel=(kernel, ())), MoeadDra(population=20), iterations=1, failures="error")


def test_batch_makes_one_evaluation_call_per_iteration():
    problem, optimiser = dtlz2(5), MoeadDra(population=50, update="batch")
    toolbox = optimiser.toolbox(problem)
    sizes = []
    toolbox.register("evaluate", lambda designs: sizes.append(len(designs)) or problem.evaluate(designs))
    minimise(problem, optimiser, iterations=3, seed=0, toolbox=toolbox)
    assert sizes == [50, 10, 10, 10]

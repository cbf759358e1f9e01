"""Designs that cannot be evaluated, answers of the wrong kind, and what a search that ends by an error leaves."""

import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from numba import njit

from suspension_ctrl import FailureWarning, Gamultiobj, MoeadDra, Nsga2, Problem, Sampling, minimise
from suspension_ctrl.search.evaluation import SearchProblem
from suspension_ctrl.search.trace import trace

BOX = {"lower": [0.0] * 10, "upper": [1.0] * 10, "objectives": ["f1", "f2"]}
OPTIMISERS = [
    Nsga2(population=100),
    MoeadDra(population=100),
    Gamultiobj(population=100),
    Sampling(population=100),
]
OPTIMISERS += [Nsga2(population=100, selection="deap-log"), MoeadDra(population=100, update="batch")]


def zdt1(x):
    g = 1 + 9 * x[:, 1:].mean(1)
    return np.c_[x[:, 0], g * (1 - np.sqrt(x[:, 0] / g))]


def failing(x):
    """One design in twenty."""
    return np.floor(1000 * x[:, 1:].sum(1)) % 1000 < 50


def as_nan(x):
    return np.where(failing(x)[:, None], np.nan, zdt1(x))


@njit
def nan_kernel(x):
    g = 1.0 + x[1:].mean() * 9.0
    if np.floor(1000 * x[1:].sum()) % 1000 < 50:
        return np.array([np.inf, np.nan])
    return np.array([x[0], g * (1 - np.sqrt(x[0] / g))])


PROBLEMS = {
    "NaN": Problem(evaluate=as_nan, **BOX),
    "NaN and a violated constraint": Problem(
        evaluate=lambda x: np.c_[as_nan(x), failing(x)], constraints=["failed"], **BOX
    ),
    "infinite": Problem(evaluate=lambda x: np.where(failing(x)[:, None], -np.inf, zdt1(x)), **BOX),
    "by a kernel": Problem(evaluate=as_nan, kernel=(nan_kernel, ()), **BOX),
}


@pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS)
@pytest.mark.parametrize("optimiser", OPTIMISERS, ids=str)
def test_designs_that_cannot_be_evaluated_count_as_worst(problem, optimiser):
    """The search goes on, and gets as far as it gets on a problem without failures, but for a twentieth."""
    with pytest.warns(FailureWarning, match=r"^\d+ of 40\d\d designs could not be evaluated and count as worst; "):
        run = minimise(problem, optimiser, evaluations=4000, seed=1)
    assert np.isfinite(run.objectives[run.feasible]).all()
    assert 20 < run.failures < 400
    assert np.isfinite(run.front().to_numpy()).all()
    whole = minimise(Problem(evaluate=zdt1, **BOX), optimiser, evaluations=4000, seed=1)
    assert run.objectives[run.feasible].sum(axis=1).min() < 1.5 * whole.objectives.sum(axis=1).min()
    assert f"{run.failures} failed" in repr(run)


def test_a_start_that_fails_throughout_ends_in_nan_and_a_warning():
    problem = Problem(evaluate=lambda x: np.full((len(x), 2), np.nan), **BOX)
    for optimiser in OPTIMISERS:
        with pytest.warns(FailureWarning):
            run = minimise(problem, optimiser, iterations=2, seed=1)
        assert not run.feasible.any()
        assert np.isnan(run.objectives).all()
        assert run.front().empty


def test_failures_may_be_errors():
    with pytest.raises(ValueError, match=r"^evaluate must return finite objectives, got \[nan, nan\] for "):
        minimise(PROBLEMS["NaN"], Nsga2(population=100), iterations=9, seed=1, failures="error")
    kernel = PROBLEMS["by a kernel"].replace(evaluate=zdt1)
    with pytest.raises(ValueError, match=r"^kernel must return finite objectives, got others for design \["):
        minimise(kernel, MoeadDra(population=100), iterations=40, seed=1, failures="error")
    with pytest.raises(ValueError, match=r"^failures must be one of worst, error, got 'none'$"):
        minimise(PROBLEMS["NaN"], Nsga2(population=100), iterations=9, failures="none")


def test_a_trace_goes_on_and_warns():
    with pytest.warns(FailureWarning):
        found = trace(PROBLEMS["NaN"], Nsga2(population=100), [400], seed=1)
    assert np.isnan(found.objectives).any()
    assert len(found.front())


@pytest.mark.parametrize("optimiser", OPTIMISERS, ids=str)
def test_an_exception_ends_the_search_and_carries_the_run(optimiser):
    calls = [0]

    def raising(x):
        calls[0] += len(x)
        if calls[0] > 1000:
            raise RuntimeError("solver did not converge")
        return zdt1(x)

    with pytest.raises(RuntimeError, match=r"^solver did not converge$") as caught:
        minimise(Problem(evaluate=raising, **BOX), optimiser, evaluations=4000, seed=1)
    run = caught.value.run
    assert run.evaluations == 1000
    whole = minimise(Problem(evaluate=zdt1, **BOX), optimiser, evaluations=1000, seed=1)
    np.testing.assert_array_equal(run.designs, whole.designs)
    calls[0] = 1001
    with pytest.raises(RuntimeError) as caught:
        minimise(Problem(evaluate=raising, **BOX), optimiser, evaluations=4000, seed=1)
    assert len(caught.value.run.designs) == caught.value.run.evaluations == 0
    assert "no feasible design" in repr(caught.value.run)


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT for a child process")
def test_ctrl_c_keeps_what_was_found():
    program = """
import time
import numpy as np
from suspension_ctrl import Nsga2, Problem, minimise
def evaluate(x):
    time.sleep(0.02)
    return np.c_[(x**2).sum(1), ((x - 1) ** 2).sum(1)]
problem = Problem(evaluate=evaluate, lower=[0.0] * 5, upper=[1.0] * 5, objectives=["a", "b"])
def started(run):
    if run.evaluations == 100:
        print("started", flush=True)
try:
    minimise(problem, Nsga2(population=20), iterations=100000, seed=1, callback=started)
except KeyboardInterrupt as stop:
    print(len(stop.run.designs), stop.run.evaluations >= 100)
"""
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    ) as process:  # fmt: skip
        assert process.stdout.readline() == "started\n"
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=30)
    assert out == "20 True\n"


def f(x):
    return np.c_[(x**2).sum(1), ((x - 1) ** 2).sum(1)]


@pytest.mark.parametrize(
    ("evaluate", "message"),
    [
        (lambda x: {"F": f(x)}, "evaluate must return an array of real numbers, got {'F': array("),
        (lambda x: (row for row in f(x)), "evaluate must return an array of real numbers, got <generator"),
        (lambda x: [[1.0, 2.0]] * (len(x) - 1) + [[1.0]], "evaluate must return an array of real numbers, got [["),
        (lambda x: [["low", "high"]] * len(x), "evaluate must return an array of real numbers, got [['low'"),
        (lambda x: [[object(), 1.0]] * len(x), "evaluate must return an array of real numbers, got [["),
        (lambda x: f(x) + 0j, "evaluate must return an array of real numbers, got array("),
        (
            lambda x: np.ma.masked_less(f(x), 0.5),
            "evaluate must return an array of real numbers, got masked",
        ),
        (lambda x: None, "evaluate must return an array of real numbers, got None"),
    ],
)
def test_answers_of_the_wrong_kind_are_one_line(evaluate, message):
    problem = Problem(evaluate=evaluate, lower=[0.0] * 2, upper=[1.0] * 2, objectives=["a", "b"])
    with pytest.raises(ValueError, match="^" + re.escape(message)) as caught:
        minimise(problem, Nsga2(population=20), iterations=2, seed=1)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("kind", ["float32", "fortran", "strided", "list", "frame"])
def test_answers_of_any_layout_are_taken(kind):
    import pandas as pd

    kinds = {
        "float32": lambda y: y.astype(np.float32), "fortran": np.asfortranarray, "list": lambda y: y.tolist(),
        "strided": lambda y: np.repeat(y, 2, axis=0)[::2], "frame": pd.DataFrame,
    }  # fmt: skip
    box = {"lower": [0.0] * 2, "upper": [1.0] * 2, "objectives": ["a", "b"]}
    problem = Problem(evaluate=lambda x: kinds[kind](np.round(f(x), 3)), **box)
    plain = Problem(evaluate=lambda x: np.round(f(x), 3), **box)
    one, other = (minimise(p, Nsga2(population=20), iterations=5, seed=1) for p in (problem, plain))
    np.testing.assert_allclose(one.objectives, other.objectives, rtol=1e-6)


GOOD = {"evaluate": f, "lower": (0.0, 0.0), "upper": (1.0, 1.0), "objectives": ("a", "b")}


def test_the_first_bad_design_is_named():
    designs, problem = np.array([[0.1, 0.2], [0.2, 0.9]]), SearchProblem(Problem(**GOOD))
    assert problem.values(lambda x: [[1, 2], [3, 4]], designs).tolist() == [[1.0, 2.0], [3.0, 4.0]]
    with pytest.raises(ValueError, match=r"got \[0.2, nan\] for design \[0.2, 0.9\]$"):
        problem.values(lambda x: [[1, 2], [0.2, np.nan]], designs)
    limited = SearchProblem(Problem(**GOOD, constraints=("limit",)))
    assert limited.values(lambda x: np.hstack([x, x[:, :1]]), designs).shape == (2, 3)
    message = r"^evaluate must return shape \(2, 3\) for designs \(2, 2\), got \(2, 2\)$"
    with pytest.raises(ValueError, match=message):
        limited.values(lambda x: x, designs)
    message = r"^evaluate must return finite objectives and constraints, got \[1.0, 2.0, inf\]"
    with pytest.raises(ValueError, match=message):
        limited.values(lambda x: [[1, 2, np.inf], [1, 2, 3]], designs)


def test_a_resumed_run_tells_of_failures_before():
    """The first failure of the run is not known any more; its number goes on."""
    calls = [0]

    def fails_once(x):
        calls[0] += 1
        return np.where(calls[0] == 1, np.nan, zdt1(x))

    problem = Problem(evaluate=fails_once, **BOX)
    with pytest.warns(FailureWarning, match=r"^100 of 200 designs .* got \[nan, nan\] for design \["):
        run = minimise(problem, Nsga2(population=100), iterations=1, seed=1)
    with pytest.warns(FailureWarning, match=r"^100 of 300 designs .*; first: in the run before$"):
        assert run.resume(problem, iterations=1).failures == 100


@pytest.mark.parametrize("kernel", [None, (nan_kernel, ())], ids=["python", "compiled"])
def test_each_failure_of_a_sweep_is_counted_once(kernel):
    problem = Problem(evaluate=as_nan, kernel=kernel, **BOX)
    with pytest.warns(FailureWarning):
        run = minimise(problem, MoeadDra(population=100), evaluations=1000, seed=1)
    with pytest.warns(FailureWarning):
        seen = trace(problem, MoeadDra(population=100), [1000], seed=1)
    assert run.failures == np.isnan(seen.objectives).any(axis=1).sum() > 20

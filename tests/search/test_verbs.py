"""Verbs of a toolbox that return the wrong count, kind or place, in Python and compiled."""

import re
import subprocess
import sys

import numpy as np
import pytest
from numba import njit

from functions import dtlz2
from suspension_ctrl import Gamultiobj, MoeadDra, Nsga2, Problem, Sampling, minimise

PROBLEM = Problem(
    evaluate=lambda x: np.c_[(x**2).sum(1), ((x - 1) ** 2).sum(1)],
    lower=[0.0] * 4, upper=[1.0] * 4, objectives=["a", "b"],
)  # fmt: skip
NSGA2, MOEAD, GAM = Nsga2(population=40), MoeadDra(population=40), Gamultiobj(population=40)
SAMPLE = Sampling(population=8)


def searched(optimiser, verb, function, problem=PROBLEM):
    toolbox = optimiser.toolbox(problem)
    toolbox.register(verb, function)
    return minimise(problem, optimiser, iterations=5, seed=1, toolbox=toolbox)


@pytest.mark.parametrize(
    ("optimiser", "verb", "function", "message"),
    [
        (NSGA2, "mutate", lambda rng, x: None, "mutate must return an array of real numbers"),
        (NSGA2, "mutate", lambda rng, x: (x,), "mutate must return an array of shape (40, 4), got (1, 40, 4)"),
        (NSGA2, "mutate", lambda rng, x: x + 2, "designs of mutate must lie within ["),
        (NSGA2, "mutate", lambda rng, x: x * np.nan, "mutate must return finite numbers, got nan"),
        (NSGA2, "mutate", lambda rng, x: x + 1j, "mutate must return an array of real numbers"),
        (NSGA2, "mate", lambda rng, x: x[::2], "mate must return an array of shape (40, 4), got (20, 4)"),
        (NSGA2, "mate", lambda rng, x: x[:, :2], "mate must return an array of shape (40, 4), got (40, 2)"),
        (NSGA2, "mate", lambda rng, x: np.ma.array(x, mask=x < 0.5),
         "mate must return an array of real numbers"),
        (NSGA2, "sample", lambda rng, n: np.zeros((5, 4)),
         "sample must return an array of shape (40, 4), got (5, 4)"),
        (NSGA2, "sample", lambda rng, n: np.zeros((500, 4)),
         "sample must return an array of shape (40, 4), got (500"),
        (MOEAD, "sample", lambda rng, n: np.full((n, 4), 3.0), "designs of sample must lie within ["),
        (GAM, "sample", lambda rng, n: np.full((n, 4), -3.0), "designs of sample must lie within ["),
        (GAM, "mate", lambda rng, x: x, "mate must return an array of shape (32, 4), got (64, 4)"),
        (GAM, "select", lambda v, n: (np.arange(n), np.zeros(n)),
         "select must return a tuple of 3 arrays, got 'tuple'"),
        (NSGA2, "select", lambda v, n: np.arange(n), "select must return a tuple of 3 arrays, got 'ndarray'"),
        (NSGA2, "select", lambda v, n: (np.arange(n // 2), np.zeros(n), np.zeros(n)),
         "select must return 40 indices, got int64 of"),
        (NSGA2, "select", lambda v, n: (np.arange(n), np.zeros(n), np.zeros(3)),
         "select must return arrays of shape (40,), got ["),
        (NSGA2, "select", lambda v, n: (np.arange(n) + 90, np.zeros(n), np.zeros(n)),
         "select must return indices from 0 to 39, "),
        (NSGA2, "select", lambda v, n: (np.zeros(n, int), np.zeros(n), np.zeros(n)),
         "select must return different indices, got one"),
        (NSGA2, "tournament", lambda r, v, c, n: np.zeros(n),
         "tournament must return 40 indices, got float64 of"),
        (MOEAD, "choose_subproblems", lambda r, u, c, n: [99] * n,
         "choose_subproblems must return indices from 0 to"),
        (MOEAD, "mating_range", lambda r, i, n: [-1, 2],
         "mating_range must return indices from 0 to 39, got -1 to 2"),
        (MOEAD, "reproduce", lambda r, x, i, p: x[0, :2],
         "reproduce must return an array of shape (4,), got (2,)"),
        (MOEAD, "repair", lambda r, x, p: x + 9, "designs of repair must lie within ["),
        (SAMPLE, "filter", lambda v: [0], "filter must return 8 truth values, got int64 of shape (1,)"),
        (SAMPLE, "points", lambda r, n: iter([np.ones((n, 4)) * 2]), "points must return numbers from 0"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)  # fmt: skip
def test_wrong_results_name_the_verb(optimiser, verb, function, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        searched(optimiser, verb, function)


@pytest.mark.parametrize("verb", ["mutate", "mate"])
def test_lists_of_rows_are_arrays(verb):
    run = searched(NSGA2, verb, lambda rng, x: x.tolist())
    assert run.designs.shape == (40, 4)
    assert run.evaluations == 240


@njit
def other_width(rng, designs, i, partners):
    return np.zeros(7)


@njit
def far_out(rng, child, parent):
    return child + 100.0


@njit
def beyond(rng, i, neighbours):
    return np.array([1, 5_000_000])


@njit
def of_another_kind(rng, child, parent):
    return 3


@pytest.mark.parametrize(
    ("verb", "function", "message"),
    [
        (
            "reproduce",
            other_width,
            "reproduce, repair and mutate must return a value for each variable, got ",
        ),
        ("repair", far_out, "repair and mutate must return designs within the bounds, got one outside"),
        ("mating_range", beyond, "mating_range must return indices of individuals, got others"),
        ("repair", of_another_kind, "verbs must compile together, got "),
    ],
)
def test_wrong_results_of_compiled_verbs_name_them_too(verb, function, message):
    with pytest.raises(ValueError, match="^" + message):
        searched(MoeadDra(population=30), verb, function, dtlz2(4, compiled=True))


@njit
def five(rng, size):
    return np.zeros((5, 4))


@njit
def too_far(rng, utility, corners, size):
    return np.full(size, 5_000_000)


@njit
def doubled(rng, designs):
    return designs + 2.0


@njit
def wide(rng, child, parent):
    return np.zeros(100_000)


@pytest.mark.parametrize(
    ("optimiser", "verb", "function", "message"),
    [
        (MOEAD, "sample", five, "sample must return an array of shape (40, 4), got (5, 4)"),
        (NSGA2, "mutate", doubled, "designs of mutate must lie within ["),
        (MOEAD, "choose_subproblems", too_far, "choose_subproblems must return indices from 0 to 39, got 5000000"),
        (MoeadDra(population=40, update="batch"), "repair", far_out, "designs of repair must lie within ["),
        (MOEAD, "repair", wide, "reproduce, repair and mutate must return a value for each variable, got another"),
    ],
)
def test_compiled_verbs_outside_a_compiled_sweep_are_checked_too(optimiser, verb, function, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        searched(optimiser, verb, function)


def test_misspelt_and_missing_verbs_are_refused():
    toolbox = NSGA2.toolbox(PROBLEM)
    toolbox.register("mutat", lambda rng, x: x)
    with pytest.raises(ValueError, match=r"^toolbox must have the verbs evaluate, mate, mutate, .*, got mutat$"):
        minimise(PROBLEM, NSGA2, iterations=1, toolbox=toolbox)
    toolbox.unregister("mutat")
    toolbox.unregister("mate")
    with pytest.raises(ValueError, match=r"^toolbox must have the verbs .*, got no mate$"):
        minimise(PROBLEM, NSGA2, iterations=1, toolbox=toolbox)


def test_a_given_toolbox_of_a_ride_problem_is_swept_compiled(table1_problem, monkeypatch):
    """A method such as `evaluate` is another object each time that it is looked up."""
    calls = []
    evaluate = type(table1_problem).evaluate
    monkeypatch.setattr(
        type(table1_problem), "evaluate", lambda self, x: calls.append(len(x)) or evaluate(self, x)
    )
    toolbox = MOEAD.toolbox(table1_problem)
    minimise(table1_problem, MOEAD, iterations=5, seed=1, toolbox=toolbox)
    assert calls == [40, 1]  # the start, and the comparison with the kernel


def test_a_kernel_of_another_function_is_noticed():
    whole = dtlz2(4, compiled=True)
    other = whole.replace(evaluate=lambda x: whole.evaluate(x) + 0.01)
    with pytest.raises(
        ValueError, match=r"^kernel must return what evaluate does, \[.*\], got \[.*\] for design "
    ):
        minimise(other, MoeadDra(population=30), iterations=1, seed=1)
    assert minimise(whole, MoeadDra(population=30), iterations=1, seed=1).evaluations == 36


def test_a_short_start_leaves_the_process_alive():
    """Compiled code once wrote beyond the end of the five designs."""
    program = """
import numpy as np
from suspension_ctrl import MoeadDra, Problem, minimise
problem = Problem(
    evaluate=lambda x: np.c_[(x**2).sum(1), ((x - 1) ** 2).sum(1)],
    lower=[0.0] * 5, upper=[1.0] * 5, objectives=["a", "b"],
)
toolbox = MoeadDra(population=100).toolbox(problem)
toolbox.register("sample", lambda rng, size: np.full((5, 5), 0.5))
for _ in range(20):
    try:
        minimise(problem, MoeadDra(population=100), iterations=50, seed=1, toolbox=toolbox)
    except ValueError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=100, check=True)
    assert set(done.stdout.splitlines()) == {"sample must return an array of shape (100, 5), got (5, 5)"}

"""Every library that is installed does the work it is asked for."""

import sys
from dataclasses import replace

import numpy as np
import pytest

import peers
from sections import searches
from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study.reference import grid_front

# Other libraries warn of what they are going to change; that is theirs to mend.
pytestmark = pytest.mark.filterwarnings("ignore")


RANDOM = 0.917
"""Hypervolume of the best of eight random samples of 100 designs: what a search must go beyond."""


@pytest.fixture(scope="module")
def problem():
    return paper.ride_problem(nodes=200)


@pytest.fixture(scope="module")
def field():
    return peers.contenders()


@pytest.fixture(scope="module")
def reference(problem):
    return ReferenceFront.of(grid_front(problem, 100))


def test_all_are_found_or_absent_with_a_reason(field):
    assert set(field.versions) | set(field.absent) == {peers.OURS, *peers.PEERS}
    assert not set(field.versions) & set(field.absent)
    assert {peers.OURS, "deap"} <= set(field.versions)
    assert all(field.absent.values())


def test_a_library_that_breaks_at_import_is_absent(monkeypatch):
    monkeypatch.setitem(sys.modules, "deap.tools", None)
    monkeypatch.delitem(sys.modules, "peers.plain_deap", raising=False)
    monkeypatch.setattr(peers, "PEERS", {"deap": "plain_deap"})
    monkeypatch.delattr(sys.modules["deap"], "tools", raising=False)
    found = peers.contenders()
    assert set(found.absent) == {"deap"}
    assert set(found.nsga2) == {peers.OURS}


def test_nsga2_of_every_library(field, problem, reference):
    """As many evaluations as asked for, less what a library saves on copies, and a front near the true one."""
    task = peers.Task(problem, 100, 10, 1)
    for name, prepare in field.nsga2.items():
        count = searches.evaluations(prepare, task)
        assert 0.9 * task.evaluations <= count <= task.evaluations, name
        job = prepare(task)
        objectives = job.objectives(job.run())
        assert 0 < len(objectives) <= 100, name
        assert RANDOM + 0.01 < reference.hypervolume(objectives) < 0.955, name


def test_moead_of_every_library(field, problem, reference):
    scaled = searches.scaled_problem(problem, reference)
    front = searches.scaled_front(reference)
    task = peers.Task(scaled, 100, 10, 2)
    for name, prepare in field.moead.items():
        assert 0.9 * task.evaluations <= searches.evaluations(prepare, task) <= task.evaluations, name
        job = prepare(task)
        objectives = job.objectives(job.run())
        assert RANDOM + 0.01 < front.hypervolume(objectives) < 0.955, name


def test_ours_are_the_runs_that_minimise_makes(field, problem):
    task = peers.Task(problem, 40, 6, 3)
    for searches_, optimiser in ((field.nsga2, Nsga2), (field.moead, MoeadDra)):
        job = searches_[peers.OURS](task)
        run = minimise(problem, optimiser(population=40), evaluations=280, seed=3)
        np.testing.assert_array_equal(job.objectives(job.run()), run.objectives)


def test_scaled_problem_is_the_problem_scaled(problem, reference):
    scaled = searches.scaled_problem(problem, reference)
    designs = np.random.default_rng(0).uniform(problem.lower, problem.upper, (20, 2))
    expected = reference.scaled(problem.evaluate(designs))
    np.testing.assert_allclose(scaled.evaluate(designs), expected, rtol=1e-12)
    np.testing.assert_allclose([call_compiled(scaled.kernel, x) for x in designs], expected, rtol=1e-12)


def test_task_says_what_the_papers_say(problem):
    task = peers.Task(problem, 1000, 20, 0)
    assert (task.evaluations, task.neighbours, task.replacements) == (21_000, 100, 10)
    assert task.mutation_probability == 0.5
    assert task.weights.shape == (1000, 3)
    small = replace(task, population=20)
    assert (small.neighbours, small.replacements) == (20, 2)

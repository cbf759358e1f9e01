"""Runs that go on, from memory and from files, bit for bit."""

import re

import numpy as np
import pytest

from functions import c2dtlz2, dtlz2, zdt1
from suspension_ctrl import Gamultiobj, MoeadDra, Nsga2, Run, Sampling, minimise
from suspension_ctrl.paper import experiment as paper

OPTIMISERS = [
    Nsga2(population=20), Nsga2(population=20, selection="deap-log"), Gamultiobj(population=20),
    MoeadDra(population=40, utility_period=3), MoeadDra(population=40, update="batch"),
    Sampling(population=10), Sampling(population=12, points="random"),
]  # fmt: skip
PROBLEMS = {"plain": zdt1(5), "kernel": dtlz2(5, compiled=True), "constraints": c2dtlz2(5)}


def same(one, other):
    for name in ("designs", "objectives", "constraints"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    assert one.evaluations == other.evaluations
    columns = ["iteration", "evaluations", *(f"ideal_{name}" for name in ("f1", "f2"))]
    assert one.history[columns].equals(other.history[columns])


@pytest.mark.parametrize("problem", PROBLEMS.values(), ids=PROBLEMS)
@pytest.mark.parametrize("optimiser", OPTIMISERS, ids=str)
def test_a_run_goes_on_bit_for_bit_twice(optimiser, problem, tmp_path):
    """By way of a file, then in memory; times go on too."""
    whole = minimise(problem, optimiser, iterations=20, seed=7)
    first = minimise(problem, optimiser, iterations=7, seed=7)
    first.save(tmp_path / "run.npz")
    second = Run.load(tmp_path / "run.npz").resume(problem, iterations=6)
    third = second.resume(problem, iterations=7)
    same(third, whole)
    assert third.seconds > second.seconds > first.seconds
    assert (third.history.filter(like="seconds").diff().iloc[1:] >= 0).all(axis=None)
    assert [path.name for path in tmp_path.iterdir()] == ["run.npz"]


def test_a_loaded_run_is_the_run(tmp_path):
    run = minimise(paper.ride_problem(), MoeadDra(population=40), iterations=3, seed=1)
    run.save(tmp_path / "run.npz")
    found = Run.load(tmp_path / "run.npz")
    assert found == run
    assert found.checkpoint.optimiser == run.checkpoint.optimiser
    assert found.front().equals(run.front())


def test_spoilt_files_are_named(tmp_path):
    path = tmp_path / "run.npz"
    minimise(zdt1(3), Nsga2(population=20), iterations=2, seed=1).save(path)
    whole = path.read_bytes()
    message = re.escape(f"{str(path)!r} must be a run written by save, got another or a spoilt file")
    np.savez(tmp_path / "other.npz", text=np.array("[]"))
    other = (tmp_path / "other.npz").read_bytes()
    for spoilt in (b"", b"text", whole[: len(whole) // 2], whole[:-1], other, b"[" * 10_000):
        path.write_bytes(spoilt)
        with pytest.raises(ValueError, match=f"^{message}$"):
            Run.load(path)
    with pytest.raises(FileNotFoundError):
        Run.load(tmp_path / "none.npz")


class Other(Nsga2):
    pass


def test_an_optimiser_of_ones_own_is_not_written(tmp_path):
    run = minimise(zdt1(3), Other(population=20), iterations=2, seed=1)
    with pytest.raises(ValueError, match=r"^optimiser must be one of Nsga2, .* to be saved, got Other$"):
        run.save(tmp_path / "run.npz")

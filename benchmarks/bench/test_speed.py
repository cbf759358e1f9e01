"""Steps to watch while working on them; nothing is asserted about time. `scripts/benchmark.py` compares."""

import numpy as np
import pytest

from suspension_ctrl import MoeadDra, Nsga2, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.study import machine as environment

NODES = 200


@pytest.fixture(autouse=True)
def one_thread():
    with environment.single_thread():
        yield


@pytest.fixture(scope="module")
def problem():
    return paper.ride_problem(nodes=NODES)


@pytest.fixture(scope="module")
def designs(problem):
    return np.random.default_rng(0).uniform(problem.lower, problem.upper, (1000, 2))


@pytest.mark.benchmark(group="evaluate 1000 designs, 200 nodes")
def test_batched_evaluation(benchmark, problem, designs):
    benchmark(problem.evaluate, designs)


@pytest.mark.benchmark(group="evaluate 1000 designs, 200 nodes")
def test_python_control_loop(benchmark, problem, designs):
    omega = np.linspace(0.1, 125, NODES)

    def loop():
        for spring, damper in designs:
            problem.vehicle.closed(spring, damper).frequency_response(omega)

    benchmark.pedantic(loop, rounds=5, warmup_rounds=1)


@pytest.mark.benchmark(group="search, N = 1000, 20 iterations")
@pytest.mark.parametrize(
    "optimiser",
    [Nsga2(population=1000), MoeadDra(population=1000), MoeadDra(population=1000, update="batch")],
    ids=["nsga2", "moead-dra", "moead-dra-batch"],
)
def test_search(benchmark, problem, optimiser):
    benchmark.pedantic(minimise, (problem, optimiser), {"iterations": 20, "seed": 0}, rounds=7, warmup_rounds=1)

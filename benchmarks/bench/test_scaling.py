"""A campaign of 200 runs on one and on two processes of this machine; the ratio is read off the table."""

import pytest

from suspension_ctrl import MoeadDra, Nsga2
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront
from suspension_ctrl.study import workers as clusters
from suspension_ctrl.study.reference import grid_front
from suspension_ctrl.study.study import Study

RUNS = 200


def campaign(seeds: range) -> Study:
    problem = paper.ride_problem()
    return Study(
        problems={"ride": problem},
        algorithms={"nsga2": Nsga2(population=500), "moead-dra": MoeadDra(population=500)},
        seeds=seeds,
        budgets=range(1000, 5501, 500),
        references={"ride": ReferenceFront.of(grid_front(problem, 100))},
    )


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.benchmark(group="campaign of 200 runs")
def test_campaign(benchmark, workers):
    with clusters.local_cluster(workers) as client:
        campaign(range(4 * workers)).run(client)  # processes import and compile what they need
        table = benchmark.pedantic(campaign(range(RUNS // 2)).run, args=(client,), rounds=1)
    assert table.seed.nunique() * table.algorithm.nunique() == RUNS

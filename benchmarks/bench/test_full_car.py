"""A full car on a road of class C: all designs at once beside python-control, and what 20 elastic modes cost.

Times are those of as many designs as the id says, at the same quadrature nodes; nothing is asserted about them.
"""

import numpy as np
import pytest

from suspension_ctrl import FlexibleBody, Iso8608Road, RideProblem
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.study import machine as environment
from suspension_ctrl.vehicles.files import load_vehicle

NODES = 256
MODES = 20


@pytest.fixture(autouse=True)
def one_thread():
    with environment.single_thread():
        yield


def bending_plate() -> FlexibleBody:
    """Return a body that bends and twists in turn, left and right alike, from 12 Hz on."""
    front, rear = np.random.default_rng(0).normal(size=(2, MODES)) / 60
    side = {1: np.ones(MODES), -1: np.resize([1, -1], MODES)}
    return FlexibleBody(
        frequencies=np.geomspace(12.0, 80.0, MODES),
        damping_ratios=np.full(MODES, 0.02),
        shapes={(x, 0.9 * y): shape * side[y] for x, shape in ((1.5, front), (-1.5, rear)) for y in side},
    )


def ride(vehicle, file) -> RideProblem:
    return RideProblem(
        vehicle, Iso8608Road("C"), speed=20.0, bounds=file.bounds, nodes=NODES, band=(0.1, 10.0),
        measures=["ACC", "SWS", "DTL"],
    )  # fmt: skip


@pytest.fixture(scope="module")
def file():
    return load_vehicle("jian_2022_full")


@pytest.fixture(scope="module")
def designs(file):
    lower, upper = np.array(list(file.bounds.values())).T
    return np.random.default_rng(0).uniform(lower, upper, (200, len(lower)))


@pytest.mark.benchmark(group="full car, 256 nodes")
def test_200_designs_at_once(benchmark, file, designs):
    benchmark(ride(file.vehicle, file).evaluate, designs)


@pytest.mark.benchmark(group="full car, 256 nodes")
def test_200_designs_at_once_with_20_elastic_modes(benchmark, file, designs):
    benchmark(ride(bending_plate().on(file.vehicle), file).evaluate, designs)


@pytest.mark.benchmark(group="full car, 256 nodes")
def test_10_designs_by_python_control(benchmark, file, designs):
    f, _ = frequency_nodes((0.1, 10.0), NODES)

    def loop():
        for design in designs[:10]:
            file.vehicle.closed(dict(zip(file.bounds, design, strict=True))).frequency_response(2 * np.pi * f)

    benchmark.pedantic(loop, rounds=5, warmup_rounds=1)

"""The benchmark on the study of a full car: what its usual evaluator and its stopwatch say."""

import numpy as np
import pytest

from peers import OURS, contenders
from sections import full_car


@pytest.fixture(scope="module")
def ride():
    return full_car.problem()


def test_the_usual_evaluator_finds_the_same_objectives(ride):
    """At the same nodes: python-control's solver and ours differ by rounding."""
    for design in np.random.default_rng(3).uniform(ride.lower, ride.upper, (2, len(ride.lower))):
        expected = ride.evaluate([design])[0, : len(ride.objectives)]
        np.testing.assert_allclose(full_car.usual_way(ride, design), expected, rtol=1e-10)


def test_the_target_is_reached_when_the_volume_of_all_feasible_designs_is(ride):
    watched, front = full_car.Watched(ride), full_car.reference(ride, 40, 5)
    for part in np.random.default_rng(4).uniform(ride.lower, ride.upper, (3, 100, len(ride.lower))):
        watched.as_problem().evaluate(part)
    feasible = np.concatenate([objectives for _, objectives in watched.calls[:2]])
    target = front.hypervolume(feasible)
    assert watched.reached(front, target) == (watched.calls[1][0], 2)
    assert watched.reached(front, 2 * front.volume)[1] == 0


def test_a_row_for_each_run(ride):
    front, searches = full_car.reference(ride, 40, 5), {OURS: contenders().nsga2[OURS]}
    table = full_car.measure(searches, ride, front, 1e-3, 20, 2, 2)
    assert (table.generations <= 2).all()
    assert (table.seconds <= table.whole_seconds).all()
    assert full_car.quartiles(table).loc[OURS, "repeats"] == 2
    assert full_car.against_fastest(table)[0] == "-"
    assert np.isnan(full_car.usual_seconds(table, 0.2))  # pymoo did not run

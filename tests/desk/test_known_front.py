"""What is known of a front: designs between exact points against a fine grid, by hypervolume."""

import numpy as np
import pytest

from suspension_ctrl import Measure, ReferenceFront, pareto_front
from suspension_ctrl.desk.known_front import can_be_continued, designs_between, finder, known_front
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import best_of

TWO = paper.ride_problem(measures=["ACC", "SWS"])


def grid(problem, points: int) -> np.ndarray:
    axes = [np.linspace(*pair, points) for pair in problem.bounds.values()]
    return best_of(problem.evaluate(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)))


@pytest.mark.parametrize(("problem", "points", "short"), [(TWO, 20, 1e-3), (paper.ride_problem(), 40, 1e-2)])
def test_designs_between_the_points_fill_the_stairs(problem, points, short):
    """Hypervolume against a grid of 401 x 401: points alone are short by 1/N, of a surface by 1/sqrt(N)."""
    reference = ReferenceFront.of(grid(problem, 401))
    alone = pareto_front(problem, points).to_numpy()[:, 2:-1]
    filled = known_front(problem, points)
    stairs, left = (1 - reference.relative_hypervolume(one) for one in (alone, filled))
    assert -1e-4 < left < short
    assert stairs > 5 * left


def test_lines_and_triangles_between_neighbours():
    front = pareto_front(TWO, 5).to_numpy()
    between = designs_between(TWO, front[:, :2], front[:, 2:4])
    assert len(between) == 4 * 65
    assert all((np.abs(between - one) < 1e-6 * one).all(axis=1).any() for one in front[:, :2])
    three = paper.ride_problem()
    designs = np.array([[5e3, 2e3], [20e3, 2e3], [20e3, 4e3]])
    inside = designs_between(three, designs, three.evaluate(designs))
    assert len(inside) == 91  # nodes of 12 parts of each side
    np.testing.assert_allclose(inside.mean(axis=0), designs.mean(axis=0), rtol=1e-9)
    assert len(designs_between(three, designs[:1], three.evaluate(designs[:1]))) == 1


def test_what_can_be_continued():
    own = Measure("own", "-", lambda designs: designs[:, 0])
    assert can_be_continued(TWO)
    assert can_be_continued(paper.ride_problem(kinds={"spring": "log"}))
    four = ["ACC", "SWS", "DTL", "DLC"]
    for changes in ({"kinds": {"spring": "integer"}}, {"measures": ["ACC", own]}, {"measures": four}):
        assert not can_be_continued(paper.ride_problem(**changes))
    assert len(known_front(paper.ride_problem(constraints=["SWS <= 0.001"]))) == 0
    assert finder(TWO, 4.0) is None
    assert finder(paper.ride_problem(measures=four), 60.0) is None
    found = finder(TWO, 10.0)
    assert found.keywords == {"seconds": 10.0}
    assert finder(TWO, 100.0).keywords == {"seconds": 60.0}
    assert len(known_front(TWO, 10, seconds=0.0)) > 2  # the ends, and designs between them

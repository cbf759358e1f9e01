import numpy as np
import pytest

from suspension_ctrl import paper
from suspension_ctrl.indicators import ReferenceFront, non_dominated


def sphere(n: int) -> np.ndarray:
    """A quarter of the unit sphere's front, points on a grid of angles."""
    a, b = np.meshgrid(np.linspace(0, np.pi / 2, n), np.linspace(0, np.pi / 2, n))
    return np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=-1).reshape(-1, 3)


def test_hypervolume_of_a_plane_in_closed_form():
    """Points on the unit square's diagonal, once scaled: below them lie stairs, above them the rest of 1.21."""
    for n in (2, 5, 50):
        f1 = np.linspace(0, 1, n)
        front = ReferenceFront(3 + 7 * np.stack([f1, 1 - f1], axis=1))
        step = 1 / (n - 1)
        lost = sum(step * (1 - i * step) for i in range(n - 1))
        np.testing.assert_allclose(front.hypervolume(front.objectives), 1.1**2 - lost, rtol=1e-12)


def test_hypervolume_of_a_sphere_converges_to_its_closed_form():
    """Beyond the front lies 1.1^3 less the eighth of a ball that no point dominates, pi/6."""
    front = ReferenceFront(sphere(2))
    volumes = [front.hypervolume(sphere(n)) for n in (20, 40, 80)]
    errors = 1.1**3 - np.pi / 6 - np.array(volumes)
    assert (errors > 0).all()
    assert errors[2] < errors[1] / 1.7 < errors[0] / 1.7**2  # first order in the grid
    assert errors[2] < 0.03


def test_igd_plus_of_shifted_fronts():
    """None for the front itself or a better one; for its middle alone the mean of |f1 - 1/2|."""
    f1 = np.linspace(0, 1, 101)
    front = ReferenceFront(np.stack([f1, 1 - f1], axis=1))
    assert front.igd_plus(front.objectives) == 0
    assert front.igd_plus(front.objectives - 0.1) == 0
    np.testing.assert_allclose(front.igd_plus(front.objectives[50:51]), np.abs(f1 - 0.5).mean(), rtol=1e-12)


def test_order_and_copies_do_not_matter():
    rng = np.random.default_rng(0)
    front = ReferenceFront(sphere(20))
    points = rng.random((60, 3))
    shuffled = np.vstack([points, points[:10]])[rng.permutation(70)]
    np.testing.assert_allclose(front.hypervolume(shuffled), front.hypervolume(points), rtol=1e-12)
    np.testing.assert_allclose(front.igd_plus(shuffled), front.igd_plus(points), rtol=1e-12)


def test_non_dominated_keeps_copies():
    points = np.array([[0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert non_dominated(points).tolist() == [True, True, False, True]


def test_reference_front_of_the_ride_problem():
    """About a fifth of Table 1's box is Pareto-optimal: the share falls to that as the grid is refined."""
    problem = paper.ride_problem()
    shares = [len(ReferenceFront.on_grid(problem, points).objectives) / points**2 for points in (100, 200, 400)]
    assert 0.15 < shares[2] < shares[1] < shares[0] < 0.3
    with pytest.raises(ValueError, match=r"^points must be a whole number >= 2, got 1$"):
        ReferenceFront.on_grid(problem, 1)

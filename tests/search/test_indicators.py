import moocore
import numpy as np
import pytest

from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import ReferenceFront, evenly_spread, non_dominated
from suspension_ctrl.study.reference import grid_front


def sphere(n: int) -> np.ndarray:
    """A quarter of the unit sphere's front, points on a grid of angles."""
    a, b = np.meshgrid(np.linspace(0, np.pi / 2, n), np.linspace(0, np.pi / 2, n))
    return np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=-1).reshape(-1, 3)


def test_hypervolume_of_a_plane_in_closed_form():
    """Points on the unit square's diagonal, once scaled: below them lie stairs, above them the rest of 1.21."""
    for n in (2, 5, 50):
        f1 = np.linspace(0, 1, n)
        front = ReferenceFront.of(3 + 7 * np.stack([f1, 1 - f1], axis=1))
        step = 1 / (n - 1)
        lost = sum(step * (1 - i * step) for i in range(n - 1))
        np.testing.assert_allclose(front.hypervolume(front.objectives), 1.1**2 - lost, rtol=1e-12)


def test_hypervolume_of_a_sphere_converges_to_its_closed_form():
    """Beyond the front lies 1.1^3 less the eighth of a ball that no point dominates, pi/6."""
    front = ReferenceFront.of(sphere(2))
    volumes = [front.hypervolume(sphere(n)) for n in (20, 40, 80)]
    errors = 1.1**3 - np.pi / 6 - np.array(volumes)
    assert (errors > 0).all()
    assert errors[2] < errors[1] / 1.7 < errors[0] / 1.7**2  # first order in the grid
    assert errors[2] < 0.03


def test_igd_plus_of_shifted_fronts():
    """None for the front itself or a better one; for its middle alone the mean of |f1 - 1/2|."""
    f1 = np.linspace(0, 1, 101)
    front = ReferenceFront.of(np.stack([f1, 1 - f1], axis=1))
    assert front.igd_plus(front.objectives) == 0
    assert front.igd_plus(front.objectives - 0.1) == 0
    np.testing.assert_allclose(front.igd_plus(front.objectives[50:51]), np.abs(f1 - 0.5).mean(), rtol=1e-12)


def test_an_even_selection_of_a_line():
    """Ends first, then the middle, then the quarters: what is farthest from all chosen."""
    f1 = np.linspace(0, 8, 9)
    line = np.stack([1000 * f1, 8 - f1], axis=1)
    assert evenly_spread(line, 5).tolist() == [0, 2, 4, 6, 8]
    assert evenly_spread(line, 3).tolist() == [0, 4, 8]
    assert evenly_spread(line, 1).tolist() == [0]
    copies = np.repeat(line[:3], 4, axis=0)
    assert len(set(evenly_spread(copies, 6))) == 6
    assert len(np.unique(copies[evenly_spread(copies, 3)], axis=0)) == 3
    assert evenly_spread(line, 9).tolist() == evenly_spread(line, 20).tolist() == list(range(9))


INDICATORS = ("hypervolume", "relative_hypervolume", "igd_plus", "epsilon", "spread")


@pytest.mark.parametrize("indicator", INDICATORS)
def test_order_and_copies_do_not_matter(indicator):
    rng = np.random.default_rng(0)
    judge = getattr(ReferenceFront.of(sphere(20)), indicator)
    points = rng.random((60, 3))
    shuffled = np.vstack([points, points[:10]])[rng.permutation(70)]
    np.testing.assert_allclose(judge(shuffled), judge(points), rtol=1e-12)


@pytest.mark.parametrize("indicator", INDICATORS)
def test_units_of_the_objectives_do_not_matter(indicator):
    points = sphere(12)[5:90] + 0.1
    scale, shift = np.array([1e3, 1e-3, 7.0]), np.array([-5.0, 0.0, 1e4])
    plain, other = ReferenceFront.of(sphere(20)), ReferenceFront.of(sphere(20) * scale + shift)
    np.testing.assert_allclose(
        getattr(other, indicator)(points * scale + shift), getattr(plain, indicator)(points), rtol=1e-9
    )


def test_relative_hypervolume_of_a_front_is_one():
    front = ReferenceFront.of(sphere(20))
    assert front.relative_hypervolume(sphere(20)) == pytest.approx(1)
    assert front.relative_hypervolume([[2.0, 2.0, 2.0]]) == 0


def test_igd_plus_is_that_of_moocore():
    """Of some points beyond the front and some that it dominates; sums of 231 numbers, rounded by some 1e-15."""
    front, points = ReferenceFront.of(sphere(20)), np.random.default_rng(1).normal(0.6, 0.2, (50, 3))
    scaled = front.scaled(points), front.scaled(front.objectives)
    assert front.igd_plus(points) == pytest.approx(moocore.igd_plus(scaled[0], ref=scaled[1]), rel=1e-12)
    parts = front.shortfall(points[20:], front.shortfall(points[:20]))
    assert parts.igd_plus == front.igd_plus(points)
    assert parts.epsilon == front.epsilon(points) == moocore.epsilon_additive(scaled[0], ref=scaled[1])


def test_epsilon_is_the_shift_that_is_needed():
    """A front shifted by c needs c; one better by c in all objectives needs -c."""
    f1 = np.linspace(0, 1, 51)
    front = ReferenceFront.of(10 * np.stack([f1, 1 - f1], axis=1))
    for c in (0.3, 0.0, -0.2):
        np.testing.assert_allclose(front.epsilon(front.objectives + 10 * c), c, atol=1e-12)
    np.testing.assert_allclose(front.epsilon([[5.0, 5.0]]), 0.5)


def test_spread_of_worked_examples():
    """Even points from end to end: 0. Without its first of n = 5, gaps of 1/4: the ends are missed by one gap."""
    f1 = np.linspace(0, 1, 5)
    line = np.stack([f1, 1 - f1], axis=1)
    front = ReferenceFront.of(line)
    assert front.spread(line) == pytest.approx(0)
    assert front.spread(line[1:]) == pytest.approx(1 / (1 + 4))  # one gap missed, four points a gap apart
    uneven = line[[0, 1, 4]]  # gaps to the nearest: 1, 1 and 3 quarters, their mean 5/3
    assert front.spread(uneven) == pytest.approx((2 / 3 + 2 / 3 + 4 / 3) / 5)
    assert np.isnan(front.spread(line[:1]))


def test_non_dominated_keeps_copies():
    points = np.array([[0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    assert non_dominated(points).tolist() == [True, True, False, True]


@pytest.mark.parametrize("columns", [[0, 1, 2], [2, 0, 1], [1, 2, 0]])
def test_many_rows_are_swept_along_any_column(columns):
    """15,000 rows of which few differ, in order, beside all comparisons of these."""
    rng = np.random.default_rng(4)
    first, second = rng.integers(0, 40, (2, 15_000))
    points = np.stack([first, second, (first - second) ** 2 % 31], axis=1).astype(float)[:, columns]
    rows, place = np.unique(points, axis=0, return_inverse=True)
    beaten = ((rows[:, None] <= rows).all(axis=2) & (rows[:, None] < rows).any(axis=2)).any(axis=0)
    assert non_dominated(points).tolist() == (~beaten)[place].tolist()


@pytest.mark.parametrize("m", [2, 3, 4])
def test_the_best_stand_in_the_order_of_an_objective(m):
    """Those of `non_dominated`, copies too; in an order in which one objective ascends."""
    points = np.random.default_rng(m).integers(0, 12, (300, m)).astype(float)
    points[100:120] = points[:20]
    best = ReferenceFront.of(points).best(points)
    assert sorted(best) == np.flatnonzero(non_dominated(points)).tolist()
    assert (np.diff(points[best], axis=0) >= 0).all(axis=0).any()
    assert ReferenceFront.of(points).best(points[:0]).size == 0


def test_reference_front_of_the_ride_problem():
    """About a fifth of Table 1's box is Pareto-optimal: the share falls to that as the grid is refined."""
    problem = paper.ride_problem()
    shares = [len(grid_front(problem, points)) / points**2 for points in (100, 200, 400)]
    assert 0.15 < shares[2] < shares[1] < shares[0] < 0.3
    with pytest.raises(ValueError, match=r"^points must be a whole number >= 2, got 1$"):
        grid_front(problem, 1)


def test_an_empty_set_is_worse_than_any():
    """As a search leaves it that finds no feasible design: nothing dominated, and nowhere near."""
    front, nothing = ReferenceFront.of(sphere(5)), np.empty((0, 3))
    assert front.hypervolume(nothing) == front.relative_hypervolume(nothing) == 0
    assert front.igd_plus(nothing) == front.epsilon(nothing) == np.inf
    assert np.isnan(front.spread(nothing))


@pytest.mark.parametrize("m", [2, 5, 8])
def test_a_flat_or_single_front_gives_numbers(m):
    """One point (2, ..., 2): a volume of 1.1^m in units of its values, (1.1 - 0.5) 1.1^(m - 1) of 1.5 times it."""
    front = ReferenceFront.of(np.full((1, m), 2.0))
    assert front.volume == pytest.approx(1.1**m, rel=1e-3)
    worse = np.full((1, m), 2.0)
    worse[0, 0] = 3.0
    assert front.relative_hypervolume(worse) == pytest.approx(0.6 / 1.1, rel=2e-3)
    assert front.igd_plus(worse) == pytest.approx(0.5)
    assert front.epsilon(worse) == pytest.approx(0.5)
    assert np.isnan(front.spread(worse))


def test_an_objective_that_does_not_vary_does_not_count():
    line = np.column_stack([np.linspace(0, 1, 50), np.linspace(1, 0, 50)])
    for value in (3.3, 0.0):
        flat = ReferenceFront.of(np.column_stack([line, np.full(50, value)]))
        part = np.column_stack([line[:20], np.full(20, value)])
        plain = ReferenceFront.of(line)
        assert flat.relative_hypervolume(part) == pytest.approx(plain.relative_hypervolume(line[:20]), rel=1e-12)
        assert flat.igd_plus(part) == pytest.approx(plain.igd_plus(line[:20]), rel=1e-12)


@pytest.mark.parametrize("m", [4, 6, 8, 10])
def test_hypervolume_of_many_objectives_is_near_its_closed_form(m):
    """The corners of a simplex leave a cube of 1 undominated; above five objectives it is an approximation."""
    front = ReferenceFront(np.eye(m), np.zeros(m), np.ones(m), 1.0)
    assert front.hypervolume(np.eye(m)) == pytest.approx(1.1**m - 1, rel=1e-12 if m <= front.EXACT else 5e-3)
    assert front.hypervolume(np.zeros((1, m))) == pytest.approx(1.1**m, rel=1e-12 if m <= front.EXACT else 1e-3)
    assert front.hypervolume(np.empty((0, m))) == 0


@pytest.mark.parametrize("objectives", [[1.0, 2.0], [[np.nan, 1.0]], np.empty((0, 2)), "front"])
def test_what_is_no_front_is_one_line(objectives):
    with pytest.raises(ValueError, match=r"^objectives must .*, got [^\n]*$"):
        ReferenceFront.of(objectives)


def test_a_front_may_be_a_list():
    assert ReferenceFront.of([[0, 1], [1, 0]]) == ReferenceFront.of(np.array([[0.0, 1.0], [1.0, 0.0]]))

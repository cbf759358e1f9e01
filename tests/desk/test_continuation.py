"""Exact fronts: against a grid, closed forms of white noise, refined designs; even and not dominated."""

import numpy as np
import pytest

import garage
from suspension_ctrl import Iso8608Road, RideProblem, non_dominated, pareto_front, refine
from suspension_ctrl.commands.studies import chosen_study
from suspension_ctrl.desk.continuation import Continuation, Point, continued
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import best_of

TWO = paper.ride_problem(measures=["ACC", "SWS"])
THREE = paper.ride_problem()


def split(problem: RideProblem, table) -> tuple[np.ndarray, np.ndarray]:
    """Return designs and objectives of a table."""
    d, m = len(problem.variables), len(problem.objectives)
    return table.to_numpy()[:, :d], table.to_numpy()[:, d : d + m]


def grid_front(problem: RideProblem, points: int = 401) -> np.ndarray:
    m = len(problem.objectives)
    axes = [np.linspace(*pair, points) for pair in problem.bounds.values()]
    values = problem.evaluate(np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, len(axes)))
    return best_of(values[(values[:, m:] <= 0).all(axis=1), :m])


@pytest.mark.parametrize("problem", [TWO, THREE, THREE.replace(constraints=["SWS <= 0.025", "DTL <= 1500"])])
def test_no_design_of_a_grid_is_better_and_every_point_is_near_one(problem):
    """401 x 401 designs, steps of a 400th of the box: objectives to 0.5 % of the front."""
    table = pareto_front(problem, points=30)
    designs, points = split(problem, table)
    assert list(table.columns)[-1] == "residual"
    assert (table["residual"] < 1e-8).all()
    np.testing.assert_allclose(problem.evaluate(designs)[:, : points.shape[1]], points, rtol=1e-12)
    assert (problem.evaluate(designs)[:, points.shape[1] :] <= 1e-8).all()
    assert non_dominated(points).all()
    grid = grid_front(problem)
    span = np.ptp(grid, axis=0)
    ahead = ((points[:, None] - grid[None]) / span).min(axis=2)  # how far a design is ahead in every objective
    assert ahead.max() < 1e-6
    near = (np.abs(points[:, None] - grid[None]) / span).max(axis=2).min(axis=1)
    assert near.max() < 5e-3
    np.testing.assert_allclose(points.min(axis=0), grid.min(axis=0), rtol=1e-3)


def test_points_of_two_measures_are_even_along_the_line_between_the_ends():
    table = pareto_front(TWO, points=21)
    _, points = split(TWO, table)
    low, high = points.min(axis=0), points.max(axis=0)
    along = ((points - low) / (high - low)) @ [1.0, -1.0]
    np.testing.assert_allclose(np.diff(along), 0.1, atol=1e-5)


def test_points_of_three_measures_cover_the_front_of_a_grid():
    """Every design of the grid's front has a point within about the distance of points, 1/sqrt(N)."""
    _, points = split(THREE, pareto_front(THREE, points=60))
    assert len(points) == 60
    grid = grid_front(THREE, 101)
    gaps = (np.abs(points[:, None] - grid[None]) / np.ptp(grid, axis=0)).max(axis=2).min(axis=0)
    assert gaps.max() < 1.5 * 60**-0.5


def test_each_point_is_the_least_of_one_measure_at_its_value_of_the_other():
    table = pareto_front(TWO, points=7)
    for row in table.iloc[1:-1].to_numpy():
        best = refine(TWO, row[:2], minimise="ACC", within={"SWS": row[3]})
        assert best.measures["ACC"] == pytest.approx(row[2], rel=1e-9)


def test_the_front_of_white_noise_is_that_of_its_closed_form():
    """Least acceleration and tyre load of all frequencies: c^2 = k (ms - k M/kt), up to the least tyre load.

    From a_k d_c = a_c d_k with the mean squares of a quarter car on white road velocity, M = ms + mu: acceleration
    a = S (kt c + k^2 M/c)/(2 ms^2), tyre deflection d = S (M^3 k^2/(2 ms^2 kt^2 c) - mu M k/(ms kt c) + mu/(2 c)
    + M^2 c/(2 ms^2 kt)).
    """
    car = garage.QUARTER
    ms, mu, kt = car.body_mass, car.wheel_mass, car.tyre_stiffness
    problem = RideProblem(
        car, Iso8608Road("C"), speed=20.0, band=(0.0, 200.0), weighting=None, measures=["ACC", "DTL"],
        bounds={"spring": (5e3, 40e3), "damper": (200.0, 5e3)}, nodes=2048,
    )  # fmt: skip
    designs, _ = split(problem, pareto_front(problem, points=15))
    spring, damper = designs.T
    inside = spring > 5.001e3
    assert inside.sum() >= 5
    expected = np.sqrt(spring * (ms - spring * (ms + mu) / kt))
    np.testing.assert_allclose(damper[inside], expected[inside], rtol=0.01)
    assert spring.max() == pytest.approx(mu * ms * kt / (ms + mu) ** 2, rel=2e-3)
    lowest = damper[~inside]  # at the least spring, from the least acceleration to the curve
    assert lowest.min() == pytest.approx(5e3 * np.sqrt((ms + mu) / kt), rel=0.01)
    assert lowest.max() <= expected[~inside].max() * 1.01


def test_a_full_car_has_an_exact_front():
    """Worst wheels: six variables, a limit. No point of it is beaten by random designs around it."""
    problem = chosen_study(vehicle="jian_2022_full", road="C").problem.replace(
        measures=["ACC", "DTL"], constraints=["SWS <= 0.01"]
    )
    table = pareto_front(problem, points=5)
    designs, points = split(problem, table)
    assert len(table) == 5
    assert (table["residual"] < 1e-8).all()
    width = np.subtract(problem.upper, problem.lower)
    steps = np.random.default_rng(0).normal(size=(500, 6)) * 0.01 * width
    for design, point in zip(designs, points, strict=True):
        values = problem.evaluate(np.clip(design + steps, problem.lower, problem.upper))
        better = (values[:, :2] < point * (1 - 1e-9)).all(axis=1) & (values[:, 2] <= 0)
        assert not better.any()


@pytest.mark.parametrize(
    ("changes", "points", "message"),
    [
        ({"measures": ["ACC", "SWS", "DTL", "DLC"]}, 9, "problem must have two or three objectives, got 4"),
        ({}, 2, "points must be a whole number >= 3, got 2"),
        ({"kinds": {"spring": "integer"}}, 9, "kinds must be log or fixed for a front, got 'integer' of spring"),
        (
            {"constraints": ["SWS <= 0.001"]},
            9,
            "limits must be those of a design within the bounds, got SWS <= 0.001",
        ),
    ],
)
def test_what_has_no_such_front_is_one_line(changes, points, message):
    with pytest.raises(ValueError, match="must") as error:
        pareto_front(THREE.replace(**changes), points)
    assert str(error.value) == message


def test_a_ray_meets_the_front_or_misses_it():
    """In scaled measures the ends are (0, 1) and (1, 0): rays beyond them miss by as much as they are apart."""
    front = Continuation(TWO)
    for reference, meets in (
        ((0.2, 0.3), True),
        ((0.0, 0.999), True),
        ((0.0, 1.0001), False),
        ((1.5, -0.5), False),
    ):
        assert front.meets(np.array(reference)) == meets


def test_exact_points_that_differ_make_the_front():
    front = Continuation(TWO)
    middle = Point(front.points[0].design, front.low + 0.5 * front.span, 0.0)
    for apart, residual in ((0.0, 0.0), (1e-8, 0.0), (1e-4, 0.0), (2e-4, 1e-7)):
        shifted = middle.objectives + apart * front.span * [1.0, -1.0]
        front.points.append(middle._replace(objectives=shifted, residual=residual))
    front.points.append(middle._replace(objectives=middle.objectives + 0.01 * front.span))  # dominated
    shares = [front.scaled(point.objectives)[0] for point in front.front()]
    np.testing.assert_allclose(sorted(shares), [0.0, 0.5, 0.5001, 1.0], atol=1e-9)


def test_without_time_the_ends_are_left():
    assert len(continued(TWO, 9, seconds=0.0)) == 2

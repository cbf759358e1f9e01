"""Knee, compromise, least of a measure: against formulas of analytic fronts and against grids of designs."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from suspension_ctrl import Nsga2, Problem, knee, minimise, pick
from suspension_ctrl.desk.choosing import SAME, chosen, flat, improving, scaled
from suspension_ctrl.search.indicators import best_of
from suspension_ctrl.search.population import Population


def population_of(designs, objectives, constraints=None) -> Population:
    """A population of these designs, without constraints if none are given."""
    none = np.zeros((len(designs), 0))
    return Population(
        designs=np.array(designs, dtype=float), objectives=np.array(objectives, dtype=float),
        constraints=none if constraints is None else np.array(constraints, dtype=float),
    )  # fmt: skip


def problem_of(objectives, **others) -> Problem:
    """A problem of one variable with these objectives."""
    names = [f"f{j + 1}" for j in range(len(objectives(np.zeros((1, 1)))[0]))]
    return Problem(evaluate=objectives, lower=(0.0,), upper=(1.0,), objectives=names, **others)


def along(function, n=2001) -> tuple[Problem, Population]:
    """A problem of one variable and its front on a grid."""
    problem, x = problem_of(function), np.linspace(0, 1, n)[:, None]
    return problem, population_of(x, function(x))


@pytest.mark.parametrize("power", [0.3, 0.5, 0.8])
@pytest.mark.parametrize("scales", [(1.0, 1.0), (1e3, 1e-3)])
def test_the_knee_of_a_power_law_is_where_its_slope_is_that_of_the_chord(power, scales):
    """f2 = 1 - f1^p has the slope -1 of the chord at f1 = p^(1/(1 - p)), whatever the units."""
    problem, run = along(lambda x: np.column_stack([scales[0] * x[:, 0], scales[1] * (1 - x[:, 0] ** power)]))
    assert knee(problem, run).iloc[0] == pytest.approx(power ** (1 / (1 - power)), abs=1e-3)  # two steps


def test_the_knee_of_two_straight_lines_is_their_corner():
    problem, run = along(lambda x: np.column_stack([x[:, 0], np.maximum(1 - 4 * x[:, 0], (1 - x[:, 0]) / 16)]))
    corner = 15 / 63  # 1 - 4 x = (1 - x)/16
    assert knee(problem, run).iloc[0] == pytest.approx(corner, abs=5e-4)


def test_the_compromise_of_a_line_is_its_middle_and_the_knee_of_a_sphere_has_equal_objectives():
    x = np.linspace(0, 1, 1001)
    names = chosen(np.column_stack([3 * x, 1e4 * (1 - x)]), ("a", "b"), 3)
    assert {x[row] for row, name in names.items() if "compromise" in name} == {0.5}
    angles = np.array(list(product(np.linspace(0, np.pi / 2, 91), repeat=2)))
    first, second = angles.T
    sphere = 1 - np.column_stack([np.cos(first) * np.cos(second), np.cos(first) * np.sin(second), np.sin(first)])
    row = next(row for row, name in chosen(sphere, ("a", "b", "c"), 3).items() if "knee" in name)
    np.testing.assert_allclose(sphere[row], 1 - 3**-0.5, atol=0.01)  # half a step of a degree


@pytest.mark.parametrize(
    "changes",
    [
        {"measures": ["ACC", "SWS"]},
        {"measures": ["ACC", "SWS", "DTL"]},
        {"constraints": ["SWS <= 0.022", "DTL <= 1500"]},
    ],
    ids=["two measures", "three", "within limits"],
)
def test_knee_and_ends_of_a_search_are_those_of_a_grid(changes, table1_problem):
    """Against 601 x 601 designs: objectives in terms of the front, to 2 %."""
    problem = table1_problem.replace(**changes)
    m = len(problem.measures)
    axes = [np.linspace(*pair, 601) for pair in problem.bounds.values()]
    values = problem.evaluate(np.array(list(product(*axes))))
    front = best_of(values[(values[:, m:] <= 0).all(axis=1), :m])
    low, span = front.min(axis=0), np.ptp(front, axis=0)
    points = (front - low) / span
    run = minimise(problem, Nsga2(population=400), iterations=60, seed=1)
    found = (knee(problem, run).to_numpy()[-m:] - low) / span
    best = points.sum(axis=1).min()
    assert found.sum() == pytest.approx(best, abs=0.02)
    assert np.abs(points[points.sum(axis=1) <= best + 0.01] - found).max(axis=1).min() < 0.05
    for j, name in enumerate(problem.objectives):
        least = (pick(problem, run, minimise=name).to_numpy()[-m:] - low) / span
        assert least[j] == pytest.approx(0.0, abs=0.02)


@given(
    st.lists(st.lists(st.floats(0, 1), min_size=3, max_size=3), min_size=1, max_size=30),
    st.integers(1, 9),
    st.tuples(st.floats(1e-3, 1e6), st.floats(1e-3, 1e6), st.floats(1e-3, 1e6)),
)
def test_candidates_are_of_the_front_have_names_and_do_not_depend_on_units(rows, count, units):
    front = np.unique(best_of(np.round(np.array(rows), 3)), axis=0)
    names = chosen(front, ("a", "b", "c"), count)
    assert len(names) == min(max(count, len(set(names.values()) - {"between"})), len(front))
    text = ", ".join(names.values())
    assert all(text.count(name) == 1 for name in ("least a", "least b", "least c", "knee", "compromise"))
    assert [tuple(front[row]) for row in names] == sorted(tuple(front[row]) for row in names)
    np.testing.assert_allclose(scaled(front * units), scaled(front), atol=1e-9)


def test_designs_of_equal_objectives_are_listed_once():
    """A front of one point, one with an objective that is equal throughout, and one that two designs share."""
    names = ("a", "b", "c")
    point = np.tile([[2.0, 3.0, 0.0]], (9, 1)) * (1 + 1e-9 * np.arange(9)[:, None])  # ends of descents
    assert flat(point).all()
    assert list(chosen(point, names, 7).values()) == ["least a, least b, least c, knee, compromise"]
    line = np.linspace(0, 1, 101)
    held = np.column_stack([line, np.full(101, 5.0), 1 - line])
    assert flat(held).tolist() == [False, True, False]
    assert list(chosen(held, names, 7)) == list(chosen(held[:, [0, 2]], ("a", "c"), 7))
    twice = np.repeat([[0.0, 1.0], [0.5, 0.4], [1.0, 0.0]], 5, axis=0) + SAME / 5 * np.arange(15)[:, None]
    assert list(chosen(twice, ("a", "b"), 7).values()) == ["least a", "knee, compromise", "least b"]
    assert len(chosen(twice + 10 * SAME * np.arange(15)[:, None], ("a", "b"), 7)) == 7


@pytest.mark.parametrize(("apart", "count"), [(0.9e-4, 3), (1.1e-4, 4)])
def test_designs_count_as_one_up_to_a_ten_thousandth_of_the_front(apart, count):
    front = np.array([[0.0, 1.0], [0.5, 0.4], [0.5 + apart, 0.4 - apart], [1.0, 0.0]])
    assert len(chosen(front, ("a", "b"), 7)) == count


def test_of_equal_least_values_that_of_the_least_sum_is_taken():
    front = np.array([[0.0, 0.1, 1.0], [0.0, 0.5, 0.2], [1.0, 0.0, 0.5], [0.5, 1.0, 0.0]])
    for order in ([0, 1, 2, 3], [1, 0, 2, 3]):
        names = chosen(front[order], ("a", "b", "c"), 7)
        (row,) = (row for row, name in names.items() if "least a" in name)
        assert order[row] == 1


def test_rows_that_gain_and_lose_nothing_improve_the_largest_sum_first():
    """Changes up to 0.05 % count as none, gains as losses."""
    changes = np.array([[0.04, -1.0], [0.06, -9.0], [-0.04, 0.0], [-2.0, -3.0], [-0.06, 0.05]])
    assert improving(changes).tolist() == [3, 0, 4]


def test_a_row_that_is_worse_in_nothing_joins_where_no_other_is():
    x = np.linspace(0, 1, 11)
    line = np.column_stack([x, (1 - x) ** 2])
    changes = np.full((11, 2), 9.0)
    changes[7] = [-1.0, 0.0]
    assert "none worse" in chosen(line, ("a", "b"), 3, changes)[7]
    plain = chosen(line, ("a", "b"), 3)
    for row in plain:
        changes[row] = [-0.5, 0.0]
    assert chosen(line, ("a", "b"), 3, changes) == plain


def test_ten_objectives_have_a_knee_and_ten_ends():
    rng = np.random.default_rng(0)
    directions = np.abs(rng.normal(size=(300, 10)))
    front = 1 - directions / np.linalg.norm(directions, axis=1, keepdims=True)
    names = chosen(front, tuple("abcdefghij"), 7)
    assert 10 <= len(names) <= 12
    assert "knee" in ", ".join(names.values())


def test_the_least_within_limits_is_that_of_the_front():
    problem, run = along(lambda x: np.column_stack([x[:, 0], 1 - x[:, 0]]), 11)
    assert pick(problem, run, minimise="f1", within={"f2": 0.45}).to_dict() == pytest.approx(
        {"x1": 0.6, "f1": 0.6, "f2": 0.4}
    )
    inside = pick(problem, run, minimise="f1", within={"f2": (0.2, 0.45), "f1": (0.65, 1)})
    assert inside.to_numpy() == pytest.approx([0.7, 0.7, 0.3])
    assert inside.name == "least f1"
    assert pick(problem, run, minimise="f1", within={"f2": (0.25, 0.5)})["x1"] == 0.5  # a limit may be reached


def test_a_limit_may_have_a_unit(table1_problem):
    run = minimise(table1_problem, Nsga2(population=40), iterations=10, seed=1)
    texts = pick(table1_problem, run, minimise="ACC", within={"SWS": "25mm", "DTL": ("0.5kN", "1.6 kN")})
    numbers = pick(table1_problem, run, minimise="ACC", within={"SWS": 0.025, "DTL": (500.0, 1600.0)})
    assert texts.equals(numbers)


def test_infeasible_and_dominated_designs_do_not_count():
    problem = problem_of(lambda x: np.column_stack([x, 1 - x, x - 0.6])[:, :2], constraints=("g",))
    run = population_of(
        [[0.1], [0.5], [0.55], [0.2]], [[0.1, 0.9], [0.5, 0.5], [0.55, 0.6], [0, 0]], [[0], [0], [0], [1]]
    )
    assert pick(problem, run, minimise="f2")["x1"] == 0.5
    assert pick(problem, run, minimise="f1")["x1"] == 0.1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"minimise": "f3"}, "minimise must be one of f1, f2, got 'f3'"),
        ({"minimise": "f1", "within": {"x1": 1.0}}, "within must be one of f1, f2, got 'x1'"),
        ({"minimise": "f1", "within": [1]}, "within must be a mapping by name, got [1]"),
        (
            {"minimise": "f1", "within": {"f2": None}},
            "within must have a number or a pair of them for f2, got None",
        ),
        (
            {"minimise": "f1", "within": {"f2": (0.0, np.nan)}},
            "within must have a number or a pair of them for f2, got (0.0, nan)",
        ),
        ({"minimise": "f1", "within": {"f2": "1 m"}}, "f2 must be a number without unit, got '1 m' in m"),
        (
            {"minimise": "f1", "within": {"f2": -1.0}},
            "within must leave a design of the front, whose 11 have f2 from 0 to 1, got -1.0 for f2",
        ),
    ],
)
def test_wrong_arguments_of_pick(arguments, message):
    problem, run = along(lambda x: np.column_stack([x[:, 0], 1 - x[:, 0]]), 11)
    with pytest.raises(ValueError, match="must") as error:
        pick(problem, run, **arguments)
    assert str(error.value) == message


def test_a_run_of_another_problem_or_without_feasible_design(table1_problem):
    problem, run = along(lambda x: np.column_stack([x[:, 0], 1 - x[:, 0]]), 11)
    with pytest.raises(
        ValueError, match=r"^run must be of the problem, 2 variables and 3 objectives, got 1 and 2$"
    ):
        knee(table1_problem, run)
    with pytest.raises(ValueError, match=r"^run must be a Population, got 'front'$"):
        knee(problem, "front")
    barren = population_of([[0.1]], [[0.1, 0.9]], [[1.0]])
    with pytest.raises(ValueError, match=r"^run must have a feasible design, got none of 1$"):
        knee(problem.replace(constraints=("g",)), barren)

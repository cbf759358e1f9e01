"""One measure for SciPy: slopes by a second road, the optimum of several methods, units at the end."""

import pickle

import numpy as np
import pytest
from scipy import optimize

from suspension_ctrl import Problem, as_scipy
from suspension_ctrl.desk.refinement import refine
from suspension_ctrl.paper.experiment import ride_problem

LIMIT = 0.0287
RIDE = ride_problem(constraints=[f"SWS <= {LIMIT}"])


def rosenbrock(**kinds) -> Problem:
    """Rosenbrock's valley, least 1 at (1, 1), and beside it a limit that cuts the minimum off if it is used."""

    def values(x):
        a, b = x.T
        return np.column_stack([1 + (1 - a) ** 2 + 100 * (b - a**2) ** 2, a])

    return Problem(evaluate=values, lower=(0.1, 0.1), upper=(3.0, 3.0), objectives=("f", "a"), kinds=kinds)


def test_the_least_discomfort_within_a_travel_is_the_exact_one():
    least = as_scipy(RIDE, "ACC")
    found = optimize.minimize(**least, options={"ftol": 1e-12})
    best = refine(RIDE, [15e3, 2000.0], minimise="ACC")
    assert found.success
    here = least.at(found.x)
    np.testing.assert_allclose([here["spring"], here["damper"]], list(best.design.values()), rtol=1e-3)
    assert here["ACC"] == pytest.approx(best.measures["ACC"], rel=1e-6)
    assert here["SWS"] == pytest.approx(LIMIT, rel=1e-6)
    assert here[f"SWS <= {LIMIT}"] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("method", ["trust-constr", "COBYLA", "COBYQA"])
def test_other_methods_come_to_the_same(method):
    least = as_scipy(RIDE, "ACC")
    arguments = {name: value for name, value in least.items() if name != "jac" or method == "trust-constr"}
    found = least.at(optimize.minimize(**arguments, method=method).x)
    assert found["ACC"] == pytest.approx(2.158, rel=2e-3)


def test_differential_evolution_takes_populations_as_columns():
    least = as_scipy(RIDE, "ACC")
    settings = {"vectorized": True, "updating": "deferred", "rng": 1, "maxiter": 60, "tol": 1e-8}
    found = optimize.differential_evolution(
        least["fun"], least["bounds"], constraints=least["constraints"], **settings
    )
    assert least.at(found.x)["ACC"] == pytest.approx(2.158, rel=2e-3)


@pytest.mark.parametrize("at", [(0.5, 0.5), (0.0, 1.0), (1.0, 0.3)])
def test_slopes_are_those_of_the_valley_also_at_the_ends(at):
    least = as_scipy(rosenbrock(), "f")
    a, b = 0.1 + 2.9 * np.array(at)
    exact = 2.9 * np.array([-2 * (1 - a) - 400 * a * (b - a**2), 200 * (b - a**2)])
    middle = least.at([0.5, 0.5])["f"]
    one_sided = 1e-4 * 2.9**2 * 6000 / middle  # half a second derivative times the step
    np.testing.assert_allclose(
        least["jac"](np.array(at)), exact / middle, rtol=1e-6, atol=one_sided * (0 in at or 1 in at)
    )


@pytest.mark.parametrize("at", [(0.5, 0.5), (0.0, 1.0), (1.0, 0.0)])
def test_slopes_of_limits_stay_within_the_box(at):
    """Forward differences beyond the box would see no slope at its end."""

    def values(x):
        return np.column_stack([x, x[:, 0] + 3 * x[:, 1] - 4])

    problem = Problem(
        evaluate=values, lower=(0.0, 0.0), upper=(2.0, 5.0), objectives=("f", "g"), constraints=("sum",)
    )
    (limit,) = as_scipy(problem, "f")["constraints"]
    np.testing.assert_allclose(limit.jac(np.array(at)), [[2.0, 15.0]], rtol=1e-9)
    np.testing.assert_allclose(limit.fun(np.array(at)), [2 * at[0] + 15 * at[1] - 4])


def test_without_limits_there_are_none():
    least = as_scipy(rosenbrock(), "f")
    assert least["constraints"] == []
    np.testing.assert_allclose(list(least.at(optimize.minimize(**least).x).values()), 1.0, atol=1e-3)


def test_logarithmic_and_held_variables():
    """The middle of a logarithmic variable is the geometric mean of its bounds; a held one is no variable."""
    middle = as_scipy(rosenbrock(x1="log"), "f").at([0.5, 0.5])
    assert middle["x1"] == pytest.approx(np.sqrt(0.1 * 3.0), rel=1e-12)
    held = rosenbrock().replace(lower=(0.5, 0.1), upper=(0.5, 3.0))
    least = as_scipy(held, "f")
    assert least["x0"].shape == (1,)
    assert least.at(optimize.minimize(**least).x) == pytest.approx(
        {"x1": 0.5, "x2": 0.25, "f": 1.25, "a": 0.5}, rel=1e-5
    )


def test_beyond_the_box_the_nearest_design_counts():
    least = as_scipy(RIDE, "DTL")
    assert least["fun"](np.array([-0.5, 2.0])) == least["fun"](np.array([0.0, 1.0]))
    assert least.at([-0.5, 2.0])["spring"] == RIDE.lower[0]


def test_it_can_be_pickled_for_workers():
    least = as_scipy(RIDE, "ACC")
    point = np.array([0.3, 0.7])
    assert pickle.loads(pickle.dumps(least))["fun"](point) == least["fun"](point)


@pytest.mark.parametrize(
    ("problem", "measure", "message"),
    [
        (3, "ACC", "problem must be an object with a method evaluate, got 3"),
        (RIDE, "acc", "measure must be one of ACC, SWS, DTL, got 'acc'"),
        (
            rosenbrock(x1="integer"),
            "f",
            "kinds must be log or fixed for SciPy, which descends, got 'integer' of x1",
        ),
        (rosenbrock(x2=(1.0, 2.0)), "f", "kinds must be log or fixed for SciPy, which descends, got .* of x2"),
    ],
)
def test_what_scipy_cannot_minimise_is_one_line(problem, measure, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        as_scipy(problem, measure)
    with pytest.raises(ValueError, match=r"^x must have shape \(2,\), got \(3,\)$"):
        as_scipy(RIDE, "ACC").at([0.1, 0.2, 0.3])


def test_a_measure_below_zero_is_scaled_by_its_size():
    def values(x):
        return np.column_stack([x[:, 0] - 8.0, x[:, 0]])

    below = Problem(evaluate=values, lower=(1.0,), upper=(3.0,), objectives=("f", "g"))
    least = as_scipy(below, "f")
    assert least["fun"](np.array([0.5])) == -1.0
    assert least.at(optimize.minimize(**least).x) == pytest.approx({"x1": 1.0, "f": -7.0, "g": 1.0}, rel=1e-9)


@pytest.mark.parametrize("kinds", [{}, {"x1": "log"}])
def test_ends_are_not_rounded_beyond_the_bounds(kinds):
    """0.1 + (0.3 - 0.1) is a little more than 0.3."""
    problem = Problem(
        evaluate=lambda x: np.hstack([x, x]), lower=(0.1,), upper=(0.3,), objectives=("f", "g"), kinds=kinds
    )
    for place, value in ((1.0, 0.3), (1e9, 0.3), (0.0, 0.1), (-1e9, 0.1)):
        found = as_scipy(problem, "f").at([place])["x1"]
        assert 0.1 <= found <= 0.3
        assert found == pytest.approx(value, rel=1e-15)


def test_slopes_beyond_the_box_are_those_at_its_end():
    least = as_scipy(rosenbrock(), "f")
    np.testing.assert_array_equal(least["jac"](np.array([1.5, -0.5])), least["jac"](np.array([1.0, 0.0])))


def test_a_measure_of_zero_in_the_middle_is_not_scaled():
    zero = Problem(evaluate=lambda x: np.hstack([x - 2.0, x]), lower=(1.0,), upper=(3.0,), objectives=("f", "g"))
    assert [as_scipy(zero, "f")["fun"](np.array([place])) for place in (0.5, 1.0)] == [0.0, 1.0]

"""Problems for pymoo: the same values, bounds and limits; mixed variables by name; a missing pymoo is one line."""

import pickle
import sys

import numpy as np
import pytest

from suspension_ctrl import Iso8608Road, Nsga2, Problem, RideProblem, as_pymoo, load_vehicle, minimise

pytestmark = pytest.mark.filterwarnings("ignore")  # pymoo's, of its own future
FILE = load_vehicle("yuen_ramli_2010")
RIDE = RideProblem(FILE.vehicle, Iso8608Road("C"), speed=20.0, bounds=FILE.bounds, constraints=["SWS <= 0.02"])
X = np.array([[22e3, 1500.0], [12e3, 4000.0]])


def mixed(**kinds) -> Problem:
    def values(x):
        return np.column_stack([x[:, 0] + x[:, 2], (x[:, 1] - 3) ** 2 + x[:, 3], 1.0 - x[:, 0]])

    return Problem(
        evaluate=values, lower=(0.5, 0.0, 1.0, 1.0), upper=(4.2, 9.0, 100.0, 2.0), objectives=("f", "g"),
        constraints=("h",), kinds=kinds,
    )  # fmt: skip


def test_values_and_bounds_are_those_of_the_problem():
    there = as_pymoo(RIDE)
    f, g = there.evaluate(X)
    np.testing.assert_array_equal(np.hstack([f, g]), RIDE.evaluate(X))
    assert (there.n_var, there.n_obj, there.n_ieq_constr) == (2, 3, 1)
    np.testing.assert_array_equal((there.xl, there.xu), (RIDE.lower, RIDE.upper))


def test_a_problem_without_limits_has_objectives_alone():
    np.testing.assert_array_equal(as_pymoo(RIDE.replace(constraints=())).evaluate(X), RIDE.evaluate(X)[:, :3])


def test_its_front_is_ours():
    """The least discomfort within the limit lies on it: of both searches to a percent."""
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.optimize import minimize

    theirs = minimize(as_pymoo(RIDE), NSGA2(pop_size=60), ("n_gen", 40), seed=1)
    ours = minimise(RIDE, Nsga2(population=60), iterations=40, seed=1)
    assert (theirs.G <= 0).all()
    assert theirs.F[:, 0].min() == pytest.approx(ours.objectives[ours.feasible, 0].min(), rel=0.01)


def test_whole_numbers_and_catalogues_are_pymoos_variables_by_name():
    """Held ones are left out: pymoo's operators divide by the width of a bound."""
    from pymoo.core.variable import Choice, Integer, Real

    there = as_pymoo(mixed(x1="integer", x2=(0.0, 3.0, 7.0), x3="log", x4=(1.5,)))
    assert {name: type(one) for name, one in there.vars.items()} == {"x1": Integer, "x2": Choice, "x3": Real}
    assert there.vars["x1"].bounds == (1, 4)
    assert list(there.vars["x2"].options) == [0.0, 3.0, 7.0]
    f, g = there.evaluate(np.array([{"x1": 2, "x2": 7.0, "x3": 10.0}, {"x1": 1, "x2": 3.0, "x3": 1.0}]))
    np.testing.assert_array_equal(f, [[12.0, 17.5], [2.0, 1.5]])
    np.testing.assert_array_equal(g, [[-1.0], [0.0]])


def test_mixed_variables_are_searched():
    from pymoo.algorithms.moo.nsga2 import RankAndCrowdingSurvival
    from pymoo.core.mixed import MixedVariableGA
    from pymoo.optimize import minimize

    there = as_pymoo(mixed(x1="integer", x2=(0.0, 3.0, 7.0), x4=(1.0, 2.0)))
    found = minimize(
        there, MixedVariableGA(pop_size=20, survival=RankAndCrowdingSurvival()), ("n_gen", 30), seed=1
    )
    best = found.X if isinstance(found.X, dict) else found.X[0]
    assert (best["x1"], best["x2"], best["x4"]) == (1, 3.0, 1.0)


def test_held_and_logarithmic_variables_of_real_designs_are_rows():
    held = mixed(x3="log").replace(upper=(4.2, 9.0, 100.0, 1.0), kinds={"x3": "log", "x4": "fixed"})
    there = as_pymoo(held)
    assert (there.n_var, there.xl[3], there.xu[3]) == (4, 1.0, 1.0)


def test_it_is_pickled_as_the_problem_of_which_it_was_made():
    again = pickle.loads(pickle.dumps(as_pymoo(RIDE)))
    np.testing.assert_array_equal(again.evaluate(X)[0], RIDE.evaluate(X)[:, :3])


def test_what_is_no_problem_and_a_missing_pymoo_are_one_line(monkeypatch):
    with pytest.raises(ValueError, match=r"^problem must be an object with a method evaluate, got 3$"):
        as_pymoo(3)
    monkeypatch.setitem(sys.modules, "pymoo.core.problem", None)
    monkeypatch.setitem(sys.modules, "pymoo", None)
    with pytest.raises(
        ImportError, match=r'^pymoo\S* must be installed, by: pip install "suspension-ctrl\[pymoo\]"$'
    ):
        as_pymoo(RIDE)

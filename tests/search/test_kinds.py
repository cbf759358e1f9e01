"""Kinds of variables: designs of a search are whole numbers, values of a catalogue, or held, exactly."""

import pickle
import re
from itertools import product

import numpy as np
import pytest
from deap import tools
from hypothesis import given
from hypothesis import strategies as st
from numba import njit

from functions import zdt1
from suspension_ctrl import Gamultiobj, MoeadDra, Nsga2, Problem, Sampling, minimise
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.search.indicators import non_dominated
from suspension_ctrl.search.kinds import Coding
from suspension_ctrl.search.trace import trace

OPTIMISERS = {
    "nsga2": Nsga2(population=40),
    "moead-dra": MoeadDra(population=40),
    "moead-dra-batch": MoeadDra(population=40, update="batch"),
    "gamultiobj": Gamultiobj(population=40),
    "sobol": Sampling(population=40),
}
every_optimiser = pytest.mark.parametrize("optimiser", OPTIMISERS.values(), ids=OPTIMISERS.keys())

SPRINGS = (18e3, 20e3, 22e3, 27.5e3)
BOUNDS = {"lower": (0.0, 1e3, -3.5, 0.1, 0.3), "upper": (1.0, 30e3, 5.5, 1e6, 0.3)}
NAMES = ("real", "spring", "count", "damper", "held")
KINDS = {"spring": SPRINGS[::-1], "count": "integer", "damper": "log", "held": "fixed"}


@njit
def of_all(design):
    """Objectives that depend on every variable."""
    a, k, n, c, h = design
    return np.array([a + k / 1e4 + n * n + c / 1e6 + h, (1 - a) ** 2 + 1e4 / k - n + 1 / c])


def evaluate_all(designs):
    return np.array([of_all(design) for design in designs])


MIXED = {"evaluate": evaluate_all, **BOUNDS, "objectives": ("f", "g"), "variables": NAMES, "kinds": KINDS}


def whole_and_catalogue(evaluate, **changes) -> Problem:
    settings = {"lower": (-20.0, 0.0), "upper": (20.0, 1.0), "kinds": {"x1": "integer", "x2": (0.1, 0.4, 0.7)}}
    return Problem(evaluate=evaluate, objectives=("a", "b"), **settings | changes)


class Seen:
    """An evaluation that keeps its designs."""

    def __init__(self):
        self.designs = []

    def __call__(self, x):
        self.designs += map(tuple, x.tolist())
        return np.c_[x.sum(1), ((x - 7) ** 2).sum(1)]


@given(
    st.floats(0, 1),
    st.sampled_from(SPRINGS),
    st.integers(-3, 5),
    st.floats(0.1, 1e6),
)
def test_designs_are_those_of_their_codes(real, spring, count, damper):
    problem, design = Coding(Problem(**MIXED)), np.array([[real, spring, count, damper, 0.3]])
    code = problem.encode("start", design)
    assert (code >= problem.lower).all()
    assert (code <= problem.upper).all()
    found = problem.decode(code)
    assert found[0, [0, 1, 2, 4]].tolist() == design[0, [0, 1, 2, 4]].tolist()
    # A rounded logarithm of up to 14 in size is off by 1e-15; so is the value, relatively.
    assert found[0, 3] == pytest.approx(damper, rel=4e-15)


@given(st.lists(st.floats(0, 1), min_size=4, max_size=4))
def test_every_code_is_a_design_of_the_problem(shares):
    problem = Coding(Problem(**MIXED))
    design = problem.decode(np.array([problem.lower + np.array(shares) * (problem.upper - problem.lower)]))[0]
    assert (design >= BOUNDS["lower"]).all()
    assert (design <= BOUNDS["upper"]).all()
    assert design[1] in SPRINGS
    assert design[2] == np.rint(design[2])
    assert not (design[2] == 0 and np.signbit(design[2]))
    assert design[4] == 0.3


def test_values_of_a_discrete_variable_are_equally_likely():
    coding = Coding(Problem(**MIXED))
    shares = (np.arange(36_000)[:, None] + 0.5) / 36_000
    designs = coding.decode(coding.lower + (coding.upper - coding.lower) * shares)
    for column, count in ((1, 4), (2, 9)):
        assert np.unique(designs[:, column], return_counts=True)[1].tolist() == [36_000 // count] * count
    logarithms = np.log(designs[:, 3])
    np.testing.assert_allclose(np.diff(logarithms), np.log(1e7) / 36_000, rtol=1e-6)


@pytest.mark.parametrize(("points", "counts"), [(50, [50, 4, 9, 50]), (3, [3, 3, 3, 3])])
def test_a_grid_has_different_values(points, counts):
    problem = Coding(Problem(**MIXED))
    axes = problem.grid_axes(points)
    assert [axis.size for axis in axes] == counts
    middle = (problem.lower + problem.upper) / 2
    for v, axis in enumerate(axes):
        codes = np.tile(middle, (axis.size, 1))
        codes[:, v] = axis
        values = problem.decode(codes)[:, v]
        assert len(set(values)) == axis.size
        ends = (0.0, 1.0), (18e3, 27.5e3), (-3.0, 5.0), (0.1, 1e6)
        assert values[[0, -1]] == pytest.approx(ends[v], rel=4e-15)
    assert [axis.tolist() for axis in Coding(zdt1(2)).grid_axes(3)] == [[0.0, 0.5, 1.0]] * 2


@every_optimiser
@pytest.mark.parametrize("kernel", [None, (of_all, ())], ids=["python", "compiled"])
def test_designs_have_the_kinds_of_their_variables(optimiser, kernel):
    problem, seen = Problem(**MIXED, kernel=kernel), []
    run = minimise(problem, optimiser, iterations=4, seed=1, callback=lambda so_far: seen.append(so_far.designs))
    for designs in (*seen, run.designs, run.to_frame()[list(NAMES)].to_numpy()):
        assert ((designs >= BOUNDS["lower"]) & (designs <= BOUNDS["upper"])).all()
        assert set(designs[:, 1]) <= set(SPRINGS)
        np.testing.assert_array_equal(designs[:, 2], np.rint(designs[:, 2]))
        assert set(designs[:, 4]) == {0.3}
    np.testing.assert_array_equal(run.objectives, evaluate_all(run.designs))
    assert run.repeats == 0


@every_optimiser
def test_a_kernel_gives_the_run_of_evaluate(optimiser):
    compiled, plain = (
        minimise(Problem(**MIXED, kernel=kernel), optimiser, iterations=5, seed=3)
        for kernel in ((of_all, ()), None)
    )
    np.testing.assert_array_equal(compiled.designs, plain.designs)
    np.testing.assert_array_equal(compiled.objectives, plain.objectives)
    other = minimise(Problem(**MIXED), optimiser, iterations=5, seed=4)
    assert not np.array_equal(other.designs, plain.designs)


@every_optimiser
def test_a_known_design_is_not_evaluated_again(optimiser):
    seen = Seen()
    run = minimise(whole_and_catalogue(seen), optimiser, evaluations=1000, seed=1)
    assert len(seen.designs) == len(set(seen.designs)) == run.evaluations - run.repeats
    assert run.evaluations > 900
    assert run.repeats > 900 - 41 * 3
    np.testing.assert_array_equal(run.objectives, Seen()(run.designs))


def test_a_toolbox_made_before_gives_the_same_run():
    """Its verb `evaluate` is the problem's own: the kernel is taken, which `evaluate` would betray."""
    told = []
    problem = Problem(
        **MIXED | {"evaluate": lambda x: [told.append(len(x)), evaluate_all(x)][1]}, kernel=(of_all, ())
    )
    optimiser = MoeadDra(population=20)
    runs = [
        minimise(problem, optimiser, iterations=3, seed=1, toolbox=toolbox)
        for toolbox in (None, optimiser.toolbox(problem))
    ]
    assert sum(told) <= 2 * (20 + 6)  # the start and what a kernel is compared with; in Python 12 children more
    np.testing.assert_array_equal(runs[0].designs, runs[1].designs)


def test_a_verb_of_the_user_evaluates_designs():
    optimiser, problem = Nsga2(population=20), Problem(**MIXED)
    toolbox = optimiser.toolbox(problem)
    toolbox.register("evaluate", lambda x: 2 * evaluate_all(x))
    run = minimise(problem, optimiser, iterations=3, seed=1, toolbox=toolbox)
    np.testing.assert_array_equal(run.objectives, 2 * evaluate_all(run.designs))


def test_operators_of_deap_vary_codes():
    optimiser, problem = Nsga2(population=20), Problem(**MIXED)
    toolbox = optimiser.toolbox(problem)
    toolbox.register("mutate", tools.mutGaussian, mu=0.0, sigma=1e4, indpb=0.5)
    run = minimise(problem, optimiser, iterations=3, seed=1, toolbox=toolbox)
    assert set(run.designs[:, 1]) <= set(SPRINGS)
    assert ((run.designs >= BOUNDS["lower"]) & (run.designs <= BOUNDS["upper"])).all()


@every_optimiser
@pytest.mark.parametrize("problem", [Problem(**MIXED), whole_and_catalogue(Seen())], ids=["mixed", "discrete"])
def test_a_search_goes_on_from_its_codes(optimiser, problem):
    whole = minimise(problem, optimiser, iterations=6, seed=1)
    half = pickle.loads(pickle.dumps(minimise(problem.replace(), optimiser, iterations=3, seed=1)))
    rest = half.resume(problem, iterations=3)
    np.testing.assert_array_equal(rest.designs, whole.designs)
    np.testing.assert_array_equal(rest.objectives, whole.objectives)
    assert rest.evaluations == whole.evaluations
    assert half.repeats <= rest.repeats <= whole.repeats


def test_every_search_evaluates_anew():
    seen = Seen()
    problem = whole_and_catalogue(seen)
    first, count = minimise(problem, Nsga2(population=20), iterations=3, seed=1), len(seen.designs)
    again = minimise(problem, Nsga2(population=20), iterations=3, seed=1)
    assert seen.designs[count:] == seen.designs[:count]
    np.testing.assert_array_equal(first.designs, again.designs)


@pytest.mark.parametrize(
    "name", [name for name in OPTIMISERS if name != "gamultiobj"]
)  # it keeps copies of a few designs
def test_the_front_of_a_small_problem_is_found(name):
    problem = whole_and_catalogue(Seen(), lower=(-3, 0), upper=(9, 1))
    run = minimise(problem, OPTIMISERS[name], evaluations=4000, seed=1)
    every = problem.evaluate(np.array([(n, x) for n in range(-3, 10) for x in (0.1, 0.4, 0.7)]))
    best = {tuple(row) for row in every[non_dominated(every)]}
    found = {tuple(row) for row in run.front()[["a", "b"]].to_numpy()}
    assert found == best


@pytest.mark.parametrize("optimiser", [Nsga2(population=20), MoeadDra(population=20)])
def test_a_variable_between_equal_bounds_is_held(optimiser):
    lower, upper = np.zeros(40), np.ones(40)
    lower[17] = upper[17] = 0.3
    problem = Problem(
        evaluate=lambda x: np.c_[(x**2).sum(1), ((x - 1) ** 2).sum(1)],
        lower=lower, upper=upper, objectives=("a", "b"), variables=[f"k{i}" for i in range(1, 41)],
    )  # fmt: skip
    run = minimise(problem, optimiser, iterations=20, seed=1)
    assert set(run.designs[:, 17]) == {0.3}
    assert np.ptp(np.delete(run.designs, 17, axis=1), axis=0).all()
    without = problem.replace(
        evaluate=lambda x: problem.evaluate(np.insert(x, 17, 0.3, axis=1)),
        lower=np.zeros(39), upper=np.ones(39), variables=(),
    )  # fmt: skip
    same = minimise(without, optimiser, iterations=20, seed=1)
    np.testing.assert_array_equal(np.delete(run.designs, 17, axis=1), same.designs)


@pytest.mark.parametrize("optimiser", [Nsga2(population=100), MoeadDra(population=100)])
def test_whole_numbers_are_whole_and_evaluated_once(optimiser):
    seen = Seen()
    problem = whole_and_catalogue(
        seen, lower=(-20.0, -20.0), upper=(20.0, 20.0), kinds={"x1": "integer", "x2": "integer"}
    )
    run = minimise(problem, optimiser, evaluations=5000, seed=1)
    np.testing.assert_array_equal(run.designs, np.rint(run.designs))
    assert len(seen.designs) == len(set(seen.designs)) <= 41**2
    # The front, by enumeration: x1 and x2 from -20 to 7 that differ by at most 1.
    front = run.front()
    assert (np.abs(front.x1 - front.x2) <= 1).mean() > 0.9
    assert len(front.drop_duplicates()) > 40


def test_a_problem_without_kinds_is_searched_as_it_is():
    problem, designs = zdt1(4, compiled=True), np.full((2, 4), 0.5)
    coding = Coding(problem)
    assert (coding.lower.tolist(), coding.upper.tolist()) == (list(problem.lower), list(problem.upper))
    assert coding.decode(designs) is designs
    assert coding.kernel(problem.kernel) is problem.kernel
    outside = np.full((1, 4), 1 + 1e-12)  # by rounding, as a start may be
    np.testing.assert_array_equal(coding.encode("start", outside), outside)


def test_start_designs_are_in_the_first_population():
    start = [[0.5, 20e3, -3, 1e3, 0.3], [0.25, 27.5e3, 5, 1e6, 0.3]]
    states = []
    for optimiser in (Nsga2(population=20), MoeadDra(population=20)):
        run = minimise(Problem(**MIXED), optimiser, iterations=1, seed=1, start=start)
        again = minimise(Problem(**MIXED), optimiser, iterations=1, seed=1, start=run)
        states += [run, again]
    first = trace(Problem(**MIXED), Nsga2(population=20), [20], seed=1).designs
    seen = []

    def kept(x):
        seen.append(x.copy())
        return evaluate_all(x)

    minimise(Problem(**MIXED | {"evaluate": kept}), Nsga2(population=20), iterations=1, seed=1, start=start)
    np.testing.assert_allclose(seen[0][:2], start, rtol=4e-15)
    np.testing.assert_array_equal(seen[0][2:], first[2:])
    assert all(np.isfinite(run.designs).all() for run in states)


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        (1, 19e3, "start must have one of [18000.0, 20000.0, 22000.0, 27500.0] in spring, got 19000.0"),
        (1, 28e3, "start must have one of [18000.0, 20000.0, 22000.0, 27500.0] in spring, got 28000.0"),
        (2, 1.5, "start must have a whole number in count, got 1.5"),
        (4, 0.4, "start must lie within"),
    ],
)
def test_a_start_of_another_kind_is_named(place, value, message):
    start = np.array([[0.5, 20e3, 1.0, 1e3, 0.3]] * 2)
    start[1, place] = value
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        minimise(Problem(**MIXED), Nsga2(population=20), iterations=1, start=start)


@pytest.mark.parametrize(
    ("kinds", "message"),
    [
        ({"x": "integer"}, "kinds must be one of real, spring, count, damper, held, got 'x'"),
        ("log", "kinds must be a mapping by variable, got 'log'"),
        ({"real": "whole"}, "kinds of real must be integer, log, fixed or values from 0 to 1, got 'whole'"),
        ({"real": ()}, "kinds of real must be integer, log, fixed or values from 0 to 1, got ()"),
        ({"real": (0.5, 2.0)}, "kinds of real must be integer, log, fixed or values from 0 to 1, got (0.5, 2.0)"),
        ({"real": (np.nan,)}, "kinds of real must be integer, log, fixed or values from 0 to 1, got (nan,)"),
        ({"real": ("a",)}, "kinds of real must be integer, log, fixed or values from 0 to 1, got ('a',)"),
        (
            {"real": np.array(0.5)},
            "kinds of real must be integer, log, fixed or values from 0 to 1, got array(0.5)",
        ),
        ({"real": None}, "kinds of real must be integer, log, fixed or values from 0 to 1, got None"),
        ({"real": "log"}, "bounds of real must be above 0, got 0.0 and 1.0"),
        ({"real": "fixed"}, "bounds of real must be equal, got 0.0 and 1.0"),
        ({"held": "integer"}, "bounds of held must hold a whole number of at most 1e15, got 0.3 and 0.3"),
        (
            {"real": (0.5,), "spring": (2e3,), "count": (0,), "damper": (1,)},
            "kinds must leave a variable that is not held, got {",
        ),
    ],
)
def test_kinds_that_do_not_fit_are_named(kinds, message):
    with pytest.raises(ValueError, match="^" + re.escape(message)):
        Problem(**MIXED | {"kinds": kinds})


def test_bounds_may_not_all_be_equal():
    with pytest.raises(
        ValueError, match=r"^lower must be finite, <= upper in every variable and < upper in one, got \[1.0\]"
    ):
        Problem(evaluate=len, lower=[1.0], upper=[1.0], objectives=("a", "b"))


def test_kinds_are_kept_sorted_and_frozen():
    catalogue = [3.0, 1.0, 2, 1]
    problem = Problem(evaluate=len, lower=[0], upper=[9], objectives=("a", "b"), kinds={"x1": catalogue})
    catalogue.append(7.0)
    assert problem.kinds["x1"] == (1.0, 2.0, 3.0)
    assert pickle.loads(pickle.dumps(problem)) == problem
    assert problem.replace(kinds={}) != problem
    assert hash(problem) == hash(problem.replace())
    assert "kinds={'x1': (1.0, 2.0, 3.0)}" in repr(problem)


def test_a_value_that_is_not_finite_is_reported_with_its_design():
    problem = whole_and_catalogue(lambda x: np.full((len(x), 2), np.nan))
    with pytest.raises(ValueError, match=r"for design \[-?\d+\.0, 0\.[147]\]"):
        minimise(problem, Nsga2(population=20), iterations=1, seed=1, failures="error")


@every_optimiser
def test_a_trace_has_each_evaluated_design_once(optimiser):
    seen = Seen()
    found = trace(whole_and_catalogue(seen), optimiser, [40, 400], seed=2)
    assert found.designs.tolist() == [list(design) for design in seen.designs]
    assert found.spent[400] == len(seen.designs)
    assert found.spent[40] <= 40
    run = minimise(whole_and_catalogue(Seen()), optimiser, evaluations=400, seed=2)
    np.testing.assert_array_equal(found.states[400].designs, run.designs)


CATALOGUE = {"spring": (12e3, 8e3, 20e3, 14.5e3), "damper": (1000, 1100, 1300, 1500, 1800, 2200)}


@pytest.mark.parametrize(("optimiser", "share"), [(Nsga2(population=40), 1.0), (MoeadDra(population=40), 0.5)])
def test_the_front_of_a_catalogue_is_that_of_all_its_designs(optimiser, share):
    """A scalar subproblem of MOEA/D-DRA has one best design: designs between two of them may be missing."""
    problem = paper.ride_problem(kinds=CATALOGUE)
    every = np.array(list(product(*CATALOGUE.values())), dtype=float)
    best = set(map(tuple, every[non_dominated(problem.evaluate(every))].tolist()))
    run = minimise(problem, optimiser, evaluations=2000, seed=1)
    found = set(map(tuple, run.front()[["spring [N/m]", "damper [N s/m]"]].to_numpy().tolist()))
    assert found <= best
    assert len(found) >= share * len(best)
    np.testing.assert_allclose(run.objectives, problem.evaluate(run.designs), rtol=1e-14)


def test_a_damper_by_its_logarithm_beside_a_catalogue_of_springs():
    problem = paper.ride_problem(kinds={"spring": CATALOGUE["spring"], "damper": "log"})
    run = minimise(problem, MoeadDra(population=40), iterations=10, seed=1)
    assert set(run.designs[:, 0]) <= set(CATALOGUE["spring"])
    assert len(set(run.designs[:, 1])) > 20
    # The kernel takes one design at a time; its sums may differ from those of many in the last bits.
    np.testing.assert_allclose(run.objectives, problem.evaluate(run.designs), rtol=1e-14)

"""Values of single wheels in single load cases: against `evaluate` of the whole problem and differences."""

from dataclasses import replace

import numpy as np
import pytest

from suspension_ctrl import RideProblem, load_problem
from suspension_ctrl.datafiles import path as data
from suspension_ctrl.desk.smooth import Atoms, Box, atoms_of, by_wheel
from suspension_ctrl.paper import experiment as paper

STUDY = load_problem(data("studies/full_car.toml"))


def points(problem: RideProblem, count: int) -> np.ndarray:
    return np.random.default_rng(0).random((count, len(problem.variables)))


def test_means_and_worst_wheels_of_the_values_are_the_objectives_and_limits():
    """Equations of `RideProblem`: root mean square over load cases by shares, limits in the worst of them."""
    atoms, where = Atoms(STUDY), points(STUDY, 5)
    values = atoms.values(where)
    expected = STUDY.evaluate(atoms.box.designs(where))
    shares = np.array([case.share for case in STUDY.cases])
    for column, measure in enumerate(STUDY.measures):
        worst = np.array([values[:, places].max(axis=1) for places in atoms.of(measure)])
        np.testing.assert_allclose(np.sqrt(shares / shares.sum() @ worst**2), expected[:, column], rtol=1e-12)
    for column, limit in enumerate(STUDY.constraints, start=3):
        worst = values[:, np.concatenate(atoms.of(limit.measure))].max(axis=1)
        np.testing.assert_allclose(limit.scale * worst + limit.offset, expected[:, column], rtol=1e-9, atol=1e-12)


def test_a_measure_of_statics_counts_once_for_each_vehicle():
    atoms, (_, roll) = Atoms(STUDY), (limit.measure for limit in STUDY.constraints)
    first, second, laden = atoms.of(roll)
    assert first == second != laden  # two load cases without payload
    assert atoms.count == 3 * 9 + 2  # comfort, four travels and four loads
    assert len(by_wheel(STUDY, STUDY.measures[1])) == 4


def test_slopes_are_those_of_the_values_over_the_box():
    problem = paper.ride_problem(kinds={"damper": "log"})
    atoms, where, step = Atoms(problem), points(problem, 3) * 0.8 + 0.1, 1e-5
    values, slopes = atoms.with_slopes(where)
    np.testing.assert_allclose(values, atoms.values(where), rtol=1e-12)
    for v, one in enumerate(step * np.eye(2)):
        differences = (atoms.values(where + one) - atoms.values(where - one)) / (2 * step)
        np.testing.assert_allclose(slopes[:, :, v], differences, rtol=1e-7, atol=1e-9 * np.abs(slopes).max())


def test_points_and_designs_are_of_one_another():
    problem = paper.ride_problem(kinds={"damper": "log"})
    box = Box.of(problem)
    where = points(problem, 20)
    np.testing.assert_allclose(box.points(box.designs(where)), where, atol=1e-13)
    np.testing.assert_allclose(box.designs(np.array([[0.0, 0.5]])), [[1e3, np.sqrt(1e3 * 5e3)]], rtol=1e-12)
    np.testing.assert_allclose(box.designs(np.array([[-1.0, 2.0]])), [[1e3, 5e3]], rtol=1e-12)


def test_the_values_of_a_problem_are_kept():
    assert atoms_of(paper.ride_problem()) is atoms_of(paper.ride_problem())
    with pytest.raises(ValueError, match=r"^kinds must leave a real variable to refine, got"):
        Box.of(paper.ride_problem(kinds={"spring": "integer", "damper": (1e3, 2e3)}))


def test_a_measure_of_statics_is_another_with_another_roll_geometry():
    case = STUDY.cases[0]
    higher = replace(case, roll_geometry=replace(case.roll_geometry, front_roll_centre=0.1))
    problem = STUDY.replace(cases=[case, higher], measures=["ACC driver", "roll_gradient"], constraints=())
    first, second = Atoms(problem).of(problem.measures[1])
    assert first != second


def test_a_variable_between_equal_bounds_is_held():
    held = paper.ride_problem(lower=(2e4, 1e3), upper=(2e4, 2e3))
    assert Box.of(held).free.tolist() == [False, True]

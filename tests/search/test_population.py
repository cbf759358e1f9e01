"""A population's tables, and what of it cannot be changed."""

import numpy as np
import pandas as pd
import pytest

from functions import srn
from suspension_ctrl import Nsga2, minimise
from suspension_ctrl.search.population import Population

DESIGNS = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0], [7.0, 8.0]]
OBJECTIVES = [[0.0, 1.0], [1.0, 0.0], [2.0, 2.0], [-1.0, -1.0]]
HEADERS = ("spring [N/m]", "damper [N s/m]", "ACC [m/s^2]", "SWS [m]")


def population(constraints=((-1.0,), (0.0,), (-2.0,), (0.5,)), headers=HEADERS) -> Population:
    return Population(designs=DESIGNS, objectives=OBJECTIVES, constraints=np.array(constraints), headers=headers)


def test_front_holds_the_feasible_designs_that_none_dominates():
    expected = pd.DataFrame([[1.0, 2.0, 0.0, 1.0], [3.0, 4.0, 1.0, 0.0]], columns=list(HEADERS))
    pd.testing.assert_frame_equal(population().front(), expected)


def test_front_holds_a_design_once():
    twice = Population(designs=DESIGNS[:2] * 2, objectives=OBJECTIVES[:2] * 2, constraints=np.empty((4, 0)))
    assert twice.front().to_numpy().tolist() == [[1.0, 2.0, 0.0, 1.0], [3.0, 4.0, 1.0, 0.0]]


def test_frame_holds_all_designs_and_violations_where_there_are_constraints():
    frame = population().to_frame()
    assert list(frame) == [*HEADERS, "violation"]
    np.testing.assert_array_equal(frame, np.hstack([DESIGNS, OBJECTIVES, [[0.0], [0.0], [0.0], [0.5]]]))
    assert list(population(np.empty((4, 0))).to_frame()) == list(HEADERS)
    assert list(population(headers=()).front()) == ["x1", "x2", "f1", "f2"]


def test_runs_name_their_columns():
    run = minimise(srn(), Nsga2(population=20), iterations=20, seed=1)
    assert list(run.to_frame()) == ["x1", "x2", "f1", "f2", "violation"]
    front = run.front()
    assert 0 < len(front) <= run.feasible.sum()
    np.testing.assert_allclose(srn().evaluate(front[["x1", "x2"]].to_numpy())[:, :2], front[["f1", "f2"]])


def test_arrays_are_copies_that_cannot_be_changed():
    given = np.array(DESIGNS)
    made = Population(designs=given, objectives=OBJECTIVES, constraints=np.empty((4, 0)))
    given[0] = 9.0
    np.testing.assert_array_equal(made.designs, DESIGNS)
    for array in (made.designs, made.objectives, made.constraints, made.violation):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_populations_are_equal_by_their_arrays():
    assert population() == population()
    assert hash(population()) == hash(population())
    assert population() != population(headers=())


def test_is_shown_by_its_least_objectives():
    assert repr(population()) == "Population: 4 designs, 3 feasible\n    least ACC 0 m/s^2, SWS 0 m"
    assert repr(population(np.ones((4, 1)))) == "Population: 4 designs, 0 feasible\n    no feasible design"
    assert "<th>SWS [m]</th>" in population()._repr_html_()

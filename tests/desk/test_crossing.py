"""Optima on opposite bounds: of a function that is concave in a variable, and of the seat of a full car."""

from functools import partial

import numpy as np
import pytest

import suspension_ctrl as sc
from garage import QUARTER, ROAD
from suspension_ctrl.desk.crossing import crossed
from suspension_ctrl.desk.descent import descended
from suspension_ctrl.desk.optimality import EXACT
from suspension_ctrl.desk.refinement import program_of

LOWER, WIDTH = np.array([1e4, 1e3]), np.array([2e4, 4e3])


def hill(top: float, designs: np.ndarray) -> np.ndarray:
    """1 less squares about a top in the box: least in its corners."""
    return 1.0 - 0.05 * (((designs - LOWER) / WIDTH - top) ** 2).sum(axis=1)


def ends_of(top: float) -> tuple:
    bounds = dict(zip(("spring", "damper"), zip(LOWER, LOWER + WIDTH, strict=True), strict=True))
    measures = ["ACC", sc.Measure("hill", "-", partial(hill, top))]
    problem = sc.RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds, measures=measures)
    at = partial(program_of, problem, minimise="hill", within={})
    end = descended(at(LOWER + 0.1 * WIDTH))
    return end, crossed(end, at)


def test_from_a_corner_to_the_best_one():
    """By two crossings: opposite corners are no neighbours."""
    end, best = ends_of(0.4)
    np.testing.assert_allclose(end.design, LOWER)
    np.testing.assert_allclose(best.design, LOWER + WIDTH)
    assert best.value == pytest.approx(1 - 0.05 * 2 * 0.36, rel=1e-12)


def test_the_first_corner_is_not_returned_to():
    end, begun = ends_of(0.4)[0], []

    def noted(design):
        begun.append(tuple(design))
        return program_of(end.program.atoms.problem, design, "hill", {})

    crossed(end, noted)
    assert begun
    assert tuple(end.design) not in begun


def test_where_the_other_side_is_worse_the_optimum_stays():
    end, best = ends_of(0.6)
    np.testing.assert_allclose(end.design, LOWER)
    assert best is end


def test_local_optima_of_a_seat_on_its_bounds():
    """Least tyre loads of a full car have optima with seats of least and of most stiffness and damping."""
    problem = sc.load_study("full_car").problem
    at = partial(program_of, problem, minimise="DLC", within={})
    lower, upper = np.array(problem.lower), np.array(problem.upper)
    end = descended(at(lower + 0.8 * (upper - lower)))
    best = crossed(end, at)
    assert best.value < end.value * (1 - 1e-5)
    assert best.conditions.residual <= EXACT

"""The array form of NSGA-II's selection against DEAP's own."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl.search.deap_adapter import select_with_deap
from suspension_ctrl.search.selection import select_survivors


@st.composite
def fronts(draw):
    """Objectives with whatever makes selections disagree: few levels, duplicates, constant objectives."""
    n, m = draw(st.integers(1, 30)), draw(st.integers(2, 4))
    value = draw(st.sampled_from([st.integers(0, 1), st.integers(0, 3), st.integers(0, 9), st.floats(-1e3, 1e3)]))
    objectives = draw(arrays(float, (n, m), elements=value.map(float)))
    if draw(st.booleans()):
        objectives[:, draw(st.integers(0, m - 1))] = 1.0
    if draw(st.booleans()):
        objectives = objectives[draw(arrays(int, n, elements=st.integers(0, n - 1)))]
    return objectives, draw(st.integers(1, n))


@settings(max_examples=1500)
@given(fronts())
def test_keeps_what_deap_keeps(case):
    objectives, size = case
    assert_same(select_survivors(objectives, size), select_with_deap(objectives, size, nd="standard"))


@pytest.mark.parametrize("shape", ["sphere", "cube", "line"])
def test_keeps_what_deap_keeps_of_a_population(shape):
    """Three hundred points of which half are copies, as a population soon holds."""
    objectives = points(shape)[np.random.default_rng(1).permutation(np.r_[0:150, 0:150])]
    for size in (1, 37, 150, 299, 300):
        assert_same(select_survivors(objectives, size), select_with_deap(objectives, size, nd="standard"))


@pytest.mark.parametrize("shape", ["sphere", "cube", "line"])
def test_keeps_what_deaps_faster_sorting_keeps_where_there_are_no_ties(shape):
    """With ties DEAP's two sortings list a front differently, and so may keep different points."""
    for size in (75, 149, 150):
        assert_same(select_survivors(points(shape), size), select_with_deap(points(shape), size, nd="log"))


def points(shape: str) -> np.ndarray:
    cube = np.random.default_rng(7).random((150, 3))
    x = cube[:, 0]
    return {
        "cube": cube,
        "sphere": cube / np.linalg.norm(cube, axis=1, keepdims=True),
        "line": np.stack([x, 1 - x, x**2], axis=1),
    }[shape]


def assert_same(ours, deaps):
    for array, deaps_array in zip(ours, deaps, strict=True):
        np.testing.assert_array_equal(array, deaps_array)


def test_crowding_distance_of_a_worked_example():
    """Five points on one front, range 4 in both: the neighbours of each middle one are 2 apart in both."""
    objectives = np.array([[0.0, 4.0], [1.0, 3.0], [2.0, 2.0], [3.0, 1.0], [4.0, 0.0]])
    _, crowding = select_survivors(objectives, 5)
    np.testing.assert_array_equal(crowding, [np.inf, 0.5, 0.5, 0.5, np.inf])  # (2/4 + 2/4) / 2 objectives

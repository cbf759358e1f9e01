"""The array form of NSGA-II's selection against DEAP's own."""

from collections import Counter

import numpy as np
import pytest
from deap import tools
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl.search.deap_adapter import as_individuals, select_with_deap
from suspension_ctrl.search.selection import ranks_and_crowding, select_survivors


@st.composite
def copies(draw):
    """A population with many copies of few points, different points differing in every objective."""
    n, m, points = draw(st.integers(1, 40)), draw(st.integers(2, 4)), draw(st.integers(1, 12))
    columns = [draw(st.permutations(range(points))) for _ in range(m)]
    members = draw(arrays(int, n, elements=st.integers(0, points - 1)))
    return np.array(columns, dtype=float).T[members], draw(st.integers(1, n))


@st.composite
def levels(draw):
    """Objectives of few levels, so that different points share many of them; maybe a constant objective."""
    n, m = draw(st.integers(1, 30)), draw(st.integers(2, 4))
    value = draw(st.sampled_from([st.integers(0, 1), st.integers(0, 3), st.integers(0, 9)]))
    objectives = draw(arrays(float, (n, m), elements=value.map(float)))
    if draw(st.booleans()):
        objectives[:, draw(st.integers(0, m - 1))] = 1.0
    return objectives, draw(st.integers(1, n))


def deaps_fronts(objectives: np.ndarray) -> list[list]:
    """Individuals front by front, each front in the order of the population, with their crowding distances."""
    individuals = as_individuals(objectives)
    fronts = tools.sortNondominated(individuals, len(individuals))
    for front in fronts:
        front.sort(key=lambda individual: individual.index)
        tools.emo.assignCrowdingDist(front)
    return fronts


def kept_by(objectives: np.ndarray, selection: tuple[np.ndarray, np.ndarray, np.ndarray]) -> Counter:
    """Rank and crowding distance of each survivor, counted; the selection must tell its rank."""
    rank = {i.index: r for r, front in enumerate(deaps_fronts(objectives)) for i in front}
    index, told, crowding = selection
    assert [rank[i] for i in index] == list(told)
    return Counter((rank[i], round(c, 12)) for i, c in zip(index, crowding, strict=True))


@settings(max_examples=500)
@given(copies())
def test_keeps_the_ranks_and_crowding_distances_that_deap_keeps(case):
    """However many copies there are; which of the copies stays is a tie."""
    objectives, size = case
    expected = kept_by(objectives, select_with_deap(objectives, size, nd="standard"))
    assert kept_by(objectives, select_survivors(objectives, size)) == expected


@settings(max_examples=500)
@given(levels())
def test_ranks_are_deaps_and_the_least_crowded_stay(case):
    """Where points share an objective, crowding distances depend on their order: ours are held to one another."""
    objectives, size = case
    index, fronts, crowding = select_survivors(objectives, size)
    rank, distance = ranks_and_crowding(objectives, len(objectives))
    np.testing.assert_array_equal(fronts, rank[index])
    np.testing.assert_array_equal(
        rank[[i.index for front in deaps_fronts(objectives) for i in front]], np.sort(rank)
    )
    np.testing.assert_array_equal(crowding, distance[index])
    preferred = np.lexsort((np.arange(rank.size), -distance, rank))
    np.testing.assert_array_equal(index, np.sort(preferred[:size]))


@given(arrays(float, st.tuples(st.integers(1, 30), st.integers(2, 4)), elements=st.floats(-1e3, 1e3), unique=True))
def test_crowding_distances_are_deaps_where_no_values_are_equal(objectives):
    _, distance = ranks_and_crowding(objectives, len(objectives))
    for front in deaps_fronts(objectives):
        expected = [individual.fitness.crowding_dist for individual in front]
        np.testing.assert_allclose(distance[[i.index for i in front]], expected, rtol=1e-12)


@pytest.mark.parametrize("shape", ["sphere", "cube", "line"])
def test_keeps_what_deaps_sortings_keep_where_there_are_no_ties(shape):
    for size in (75, 149, 150):
        ours = select_survivors(points(shape), size)
        for nd in ("standard", "log"):
            for array, deaps_array in zip(ours, select_with_deap(points(shape), size, nd=nd), strict=True):
                np.testing.assert_array_equal(array, deaps_array)


def points(shape: str) -> np.ndarray:
    cube = np.random.default_rng(7).random((150, 3))
    x = cube[:, 0]
    return {
        "cube": cube,
        "sphere": cube / np.linalg.norm(cube, axis=1, keepdims=True),
        "line": np.stack([x, 1 - x, x**2], axis=1),
    }[shape]


def test_crowding_distance_of_a_worked_example():
    """Five points on one front, range 4 in both: the neighbours of each middle one are 2 apart in both."""
    objectives = np.array([[0.0, 4.0], [1.0, 3.0], [2.0, 2.0], [3.0, 1.0], [4.0, 0.0]])
    *_, crowding = select_survivors(objectives, 5)
    np.testing.assert_array_equal(crowding, [np.inf, 0.5, 0.5, 0.5, np.inf])  # (2/4 + 2/4) / 2 objectives


def test_of_equal_individuals_the_earlier_stays():
    index, *_ = select_survivors(np.zeros((9, 2)), 4)
    np.testing.assert_array_equal(index[1:-1], [1, 2])  # between the first and the last, the ends of the front
    objectives = np.array([[1.0, 1.0], [0.0, 2.0], [2.0, 0.0], [0.0, 2.0], [2.0, 0.0]])
    np.testing.assert_array_equal(select_survivors(objectives, 2)[0], [1, 2])


@settings(max_examples=300)
@given(levels())
def test_fronts_beyond_those_needed_are_behind_them(case):
    """Whatever number they have; the fronts needed, and their crowding distances, do not depend on the size."""
    objectives, size = case
    (rank, distance), (every, distances) = (ranks_and_crowding(objectives, k) for k in (size, len(objectives)))
    needed = every <= np.sort(every)[size - 1]
    np.testing.assert_array_equal(rank[needed], every[needed])
    np.testing.assert_array_equal(distance[needed], distances[needed])
    assert (rank[~needed] > every[needed].max()).all()


@pytest.mark.parametrize("worst", [np.inf, np.nan])
def test_values_that_are_not_finite_end_the_ranking_all_the_same(worst):
    rank, _ = ranks_and_crowding(np.full((5, 3), worst), 5)
    assert rank.min() == 0

"""The controlled NSGA-II of MATLAB's gamultiobj: what is documented of it, step by step."""

from math import ceil

import moocore
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from functions import dtlz2, zdt1
from suspension_ctrl import minimise
from suspension_ctrl.search import gamultiobj
from suspension_ctrl.search.gamultiobj import Gamultiobj
from suspension_ctrl.search.selection import select_survivors

LOWER, UPPER = np.array([-1.0, 0.0, 10.0]), np.array([1.0, 5.0, 11.0])


@given(arrays(float, st.tuples(st.integers(2, 60), st.just(3)), elements=st.integers(0, 9).map(float)), st.data())
def test_no_more_than_a_fraction_comes_from_the_first_front_while_others_exist(objectives, data):
    n = len(objectives)
    size, fraction = data.draw(st.integers(1, n)), data.draw(st.sampled_from([0.0, 0.35, 1.0]))
    index, rank, _ = gamultiobj.select_controlled(objectives, size, fraction)
    assert len(set(index)) == size
    assert (np.diff(index) > 0).all()
    first = moocore.pareto_rank(objectives) == 0
    np.testing.assert_array_equal(rank == 0, first[index])
    others = n - first.sum()
    wanted = min(first.sum(), ceil(fraction * size))
    assert first[index].sum() == max(wanted, size - others)


def test_all_of_a_population_with_one_front_is_what_nsga2_keeps():
    angle = np.random.default_rng(0).random(40) * np.pi / 2
    objectives = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    index, _, crowding = gamultiobj.select_controlled(objectives, 25, 0.35)
    expected, *_ = select_survivors(objectives, 25)
    np.testing.assert_array_equal(index, expected)
    assert np.isinf(crowding).sum() == 2


def test_later_fronts_are_taken_in_their_order():
    """Fronts of 4, 3, 2 and 1 on parallel lines: of 5 survivors at most 2 are of the first, then the second."""
    fronts = [
        np.stack([np.arange(k) + 0.0, k - 1.0 - np.arange(k)], axis=1) + 10 * r for r, k in enumerate((4, 3, 2, 1))
    ]
    index, rank, _ = gamultiobj.select_controlled(np.concatenate(fronts), 5, 0.35)
    assert rank.tolist() == [0, 0, 1, 1, 1]
    assert {0, 3} == set(index[:2])  # the ends, which are infinitely far from others


def test_tournaments_are_won_by_rank_then_crowding():
    rng = np.random.default_rng(1)
    rank, crowding = np.array([0, 1, 1, 1]), np.array([0.1, 9.0, 0.5, 0.5])
    winners = gamultiobj.ranked_tournament(rng, rank, crowding, 16_000)
    counts = np.bincount(winners, minlength=4) / 16_000
    # Of 16 pairs drawn with replacement: 7 hold individual 0, 5 more hold 1, then equals, where the first stays.
    np.testing.assert_allclose(counts, [7 / 16, 5 / 16, 2 / 16, 2 / 16], atol=5 * 0.5 / np.sqrt(16_000))


def test_children_lie_in_the_box_between_their_parents():
    rng = np.random.default_rng(2)
    parents = rng.random((4000, 2))
    children = gamultiobj.intermediate_crossover(rng, parents)
    share = (children - parents[::2]) / (parents[1::2] - parents[::2])
    assert children.shape == (2000, 2)
    assert ((share >= 0) & (share <= 1)).all()
    np.testing.assert_allclose(share.mean(axis=0), 0.5, atol=5 / np.sqrt(12 * 2000))
    assert abs(np.corrcoef(share.T)[0, 1]) < 5 / np.sqrt(2000)  # each variable has a draw of its own


@given(arrays(float, (7, 3), elements=st.floats(0, 1)), st.integers(0, 2**32), st.floats(1e-6, 1))
def test_mutants_stay_in_the_box_and_within_the_step(unit, seed, step):
    designs = LOWER + unit * (UPPER - LOWER)
    mutants = gamultiobj.feasible_steps(np.random.default_rng(seed), designs, step, LOWER, UPPER)
    assert ((mutants >= LOWER) & (mutants <= UPPER)).all()
    moved = np.linalg.norm((mutants - designs) / (UPPER - LOWER), axis=1)
    assert (moved <= step * (1 + 1e-9) + 1e-12).all()


def test_mutants_leave_the_bounds_on_which_they_lie():
    corners = np.array([LOWER, UPPER, [LOWER[0], UPPER[1], 10.5]])
    mutants = gamultiobj.feasible_steps(
        np.random.default_rng(4), np.repeat(corners, 50, axis=0), 0.1, LOWER, UPPER
    )
    assert (mutants != np.repeat(corners, 50, axis=0)).all()


def test_directions_of_mutants_are_even():
    """From the middle of the box, a step that never meets a bound: no direction is preferred."""
    designs = np.tile((LOWER + UPPER) / 2, (20_000, 1))
    moved = gamultiobj.feasible_steps(np.random.default_rng(3), designs, 0.2, LOWER, UPPER) - designs
    scaled = moved / (UPPER - LOWER)
    direction = scaled / np.linalg.norm(scaled, axis=1, keepdims=True)
    np.testing.assert_allclose(direction.mean(axis=0), 0, atol=5 * np.sqrt(1 / 3 / 20_000))
    np.testing.assert_allclose((direction**2).mean(axis=0), 1 / 3, atol=0.01)


def test_the_step_grows_with_success_and_shrinks_without():
    problem, optimiser = dtlz2(5), Gamultiobj(population=50)
    toolbox = optimiser.toolbox(problem)
    steps, kept = [], []

    def mutate(rng, designs, step, **box):
        steps.append(step)
        return gamultiobj.feasible_steps(rng, designs, step, **box)

    def select(objectives, size, **fraction):
        index, rank, crowding = gamultiobj.select_controlled(objectives, size, **fraction)
        kept.append((index >= 90).sum())  # the 10 mutants of each generation stand last
        return index, rank, crowding

    toolbox.register("mutate", mutate, lower=np.zeros(5), upper=np.ones(5))
    toolbox.register("select", select, pareto_fraction=0.35)
    minimise(problem, optimiser, iterations=12, seed=0, toolbox=toolbox)
    assert steps[0] == 1
    for step, following, survived in zip(steps, steps[1:], kept[1:], strict=False):
        assert following == (min(1, 2 * step) if survived > 2 else step / 2)
    assert len(set(steps)) > 1


def test_a_fifth_of_the_children_are_mutants():
    problem, optimiser = dtlz2(5), Gamultiobj(population=50)
    toolbox = optimiser.toolbox(problem)
    sizes = []
    toolbox.register("mate", lambda rng, parents: sizes.append(len(parents) // 2) or parents[::2])
    toolbox.register("mutate", lambda rng, designs, step: sizes.append(len(designs)) or designs)
    minimise(problem, optimiser, iterations=1, seed=0, toolbox=toolbox)
    assert sizes == [40, 10]


def test_the_front_advances():
    """Of ZDT1, whose hypervolume at (1, 1) is 2/3."""
    early, late = (minimise(zdt1(10), Gamultiobj(population=100), evaluations=e, seed=0) for e in (2000, 20_000))
    assert moocore.hypervolume(late.objectives, ref=1.0) > moocore.hypervolume(early.objectives, ref=1.0) + 0.1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"population": 3}, "population must be a whole number >= 4, got 3"),
        ({"crossover_fraction": 1.5}, "crossover_fraction must be a number from 0 to 1, got 1.5"),
        ({"pareto_fraction": -1}, "pareto_fraction must be a number from 0 to 1, got -1"),
    ],
)
def test_rejects_bad_settings(change, message):
    with pytest.raises(ValueError, match=f"^{message}$"):
        Gamultiobj(**{"population": 20, **change})

"""Replacement of partners by a child, against its definition; over a sweep, against replacements one by one."""

import numpy as np
import pytest

from suspension_ctrl.compiled_verbs import call_compiled
from suspension_ctrl.search import decomposition
from suspension_ctrl.search.constraints import violations
from suspension_ctrl.search.replacement import ReplaceInSweep, ReplaceWorse


def population(n=12):
    rng = np.random.default_rng(2)
    weights = np.maximum(decomposition.weight_vectors(n, 3), decomposition.ZERO_WEIGHT)
    objectives = 1 + rng.random((n, 3))
    return rng.random((n, 2)), objectives, weights, objectives.min(axis=0)


def replace(limit, *arguments, rng=None):
    call_compiled(ReplaceWorse(limit), rng or np.random.default_rng(0), *arguments)


def test_an_ideal_child_replaces_up_to_the_limit_and_moves_the_ideal_point():
    designs, objectives, weights, ideal = population()
    child = np.array([0.5, 0.5])
    replace(4, child, np.full(3, 0.1), np.arange(12), designs, objectives, weights, ideal)
    replaced = (objectives == 0.1).all(axis=1)
    assert replaced.sum() == 4
    assert (designs[replaced] == child).all()
    np.testing.assert_array_equal(ideal, 0.1)


def test_whom_a_child_replaces_is_left_to_chance():
    """It betters all twelve; each is among the four replaced a third of the time."""
    counts = np.zeros(12)
    rng = np.random.default_rng(3)
    for _ in range(3000):
        designs, objectives, weights, ideal = population()
        replace(4, np.zeros(2), np.full(3, 0.1), np.arange(12), designs, objectives, weights, ideal, rng=rng)
        counts += (objectives == 0.1).all(axis=1)
    assert (np.abs(counts - 1000) < 5 * np.sqrt(3000 * 2 / 9)).all()


def test_the_ideal_point_moves_before_the_comparison():
    """The child betters the partner only if measured from the ideal point that it moves itself.

    Partner (1, 3), child (2, 0), weights (0.3, 0.7). From the old ideal (1, 3) the partner has g = 0 and
    nothing betters it; from the new one (1, 0) it has 0.7 x 3 = 2.1 and the child 0.3 x 1 = 0.3.
    """
    designs, objectives = np.array([[0.0]]), np.array([[1.0, 3.0]])
    ideal = np.array([1.0, 3.0])
    weights = np.array([[0.3, 0.7]])
    replace(1, np.array([9.0]), np.array([2.0, 0.0]), np.array([0]), designs, objectives, weights, ideal)
    np.testing.assert_array_equal(ideal, [1.0, 0.0])
    assert designs[0, 0] == 9.0


def test_a_worse_child_and_an_equal_one_replace_nobody():
    designs, objectives, weights, ideal = population()
    before = designs.copy()
    for value in (np.full(3, 9.0), objectives[3].copy()):
        replace(5, np.zeros(2), value, np.array([3]), designs, objectives, weights, ideal)
    np.testing.assert_array_equal(designs, before)


@pytest.mark.parametrize(
    ("child", "replaced"),
    [
        ([9.0, 9.0, -1.0, 0.0], [True, True, True, False]),  # feasible and bad: infeasible ones make room
        ([0.0, 0.0, -1.0, -1.0], [True, True, True, True]),  # feasible and good: everyone does
        ([0.0, 0.0, 0.25, 0.25], [True, False, False, False]),  # only those of larger violation
        ([0.0, 0.0, 2.0, 0.0], [False, False, False, False]),
    ],
)
def test_whom_a_child_replaces_with_constraints(child, replaced):
    """Partners of violation 1, 0.5, 0.4 and none: slack of one constraint makes up for no other."""
    values = np.array([[1.0, 1.0, 1.0, -9.0], [1.0, 1.0, 0.5, -1.0], [1.0, 1.0, 0.2, 0.2], [1.0, 1.0, 0.0, -1.0]])
    designs, ideal = np.zeros((4, 1)), np.array([1.0, 1.0])
    replace(4, np.ones(1), np.array(child), np.arange(4), designs, values, np.full((4, 2), 0.5), ideal)
    np.testing.assert_array_equal(designs[:, 0] == 1, replaced)
    feasible = max(child[2:]) <= 0
    np.testing.assert_array_equal(ideal, np.minimum(child[:2], 1.0) if feasible else 1.0)


@pytest.mark.parametrize("ordered", [False, True])
@pytest.mark.parametrize(("m", "c"), [(2, 0), (3, 0), (5, 0), (3, 2)])
def test_replacements_in_a_sweep_are_those_one_by_one(m, c, ordered):
    """Costs that are kept follow replaced partners, new weights and the ideal point, which moves now and then.

    Every third child is compared with all 43, which are no whole number of words of eight marks.
    """
    rng, n, everyone = np.random.default_rng(m + c), 43, np.arange(43)
    weights = np.maximum(decomposition.weight_vectors(n, m), decomposition.ZERO_WEIGHT)
    designs, values = rng.random((n, 2)), np.hstack([rng.random((n, m)), rng.random((n, c)) - 0.5])
    children = rng.random((200, 2))
    drift = np.linspace(0, 1 / m, 200)[:, np.newaxis]
    born = np.hstack([rng.random((200, m)) - drift, rng.random((200, c)) - 0.5])
    ranges = [
        rng.permutation(n)[:15] if k % 3 else everyone if ordered else everyone[::-1].copy() for k in range(200)
    ]
    assert (np.diff(np.minimum.accumulate(born[:, 0])) < 0).sum() > 3
    assert c == 0 or 20 < (violations(born, m) > 0).sum() < 180
    one, whole = ReplaceWorse(4), ReplaceInSweep.of(ReplaceWorse(4), everyone, np.empty(m), ordered)
    for span in (1.0, 2.0):
        found = []
        for verb in (one, whole):
            whole.kept.known.fill(np.nan)
            draws = np.random.default_rng(0)
            ends = designs.copy(), values.copy(), weights / span, values[:, :m].min(axis=0)
            for child, value, partners in zip(children, born, ranges, strict=True):
                call_compiled(verb, draws, child, value, partners, *ends)
            found.append(np.concatenate([end.ravel() for end in ends]))
        np.testing.assert_array_equal(*found)
        assert not np.array_equal(ends[1], values)

"""Constrained dominance by its definition, and the ideal point of what is feasible."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from suspension_ctrl.search.constraints import (
    any_feasible,
    constrained,
    feasible_objectives,
    ideal_with,
    violation_of,
    violations,
)
from suspension_ctrl.search.deap_adapter import select_with_deap
from suspension_ctrl.search.selection import select_survivors

LEVELS = st.integers(-2, 2).map(float)
# Neighbours in double precision, violations that a sum with them would lose, and the ends of the range.
AWKWARD = st.sampled_from(
    [0.0, -0.0, 5e-324, 1e-300, 1e-17, 2e-17, 1.0, 1.0 + 2.0**-52, 1e6, -1e6, 1e16, 1e16 + 2, 1e307, -1e307, -1.0]
)


@st.composite
def populations(draw):
    """Values (n, m + c) with ties, and their number of objectives."""
    n, m, c = draw(st.integers(1, 20)), draw(st.integers(2, 3)), draw(st.integers(0, 3))
    elements = draw(st.sampled_from([LEVELS, AWKWARD, st.floats(-1e3, 1e3)]))
    return draw(arrays(float, (n, m + c), elements=elements)), m


def dominates(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(all(a <= b) and any(a < b))


def constrained_dominates(a: np.ndarray, b: np.ndarray, m: int) -> bool:
    """Deb et al. 2002, definition 1, to the letter."""
    violation_a, violation_b = (sum(max(0.0, g) for g in one[m:]) for one in (a, b))
    if violation_a == 0 and violation_b > 0:
        return True
    if violation_a > 0 and violation_b > 0:
        return violation_a < violation_b
    return violation_a == violation_b == 0 and dominates(a[:m], b[:m])


@settings(max_examples=600)
@given(populations())
@example((np.array([[1e6, 1e6, 0.0], [0.0, 0.0, 1e-17], [0.0, 0.0, 2e-17]]), 2))
@example((np.array([[1e307, -1e307, 0.0], [-1e307, 1e307, -1.0], [0.0, 0.0, 5e-324], [0.0, 0.0, 1e-300]]), 2))
@example((np.array([[5e-324, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0 + 2**-52]]), 2))
def test_dominance_of_constrained_objectives_is_constrained_dominance(case):
    values, m = case
    ranked = constrained(values, m)
    assert ranked.shape == (len(values), m)
    assert np.isfinite(ranked).all()
    assert np.isfinite(np.ptp(ranked, axis=0)).all()
    for i, j in np.ndindex(len(values), len(values)):
        assert dominates(ranked[i], ranked[j]) == constrained_dominates(values[i], values[j], m)
    feasible = violations(values, m) == 0
    np.testing.assert_array_equal(ranked[feasible], values[feasible, :m])


def test_thousands_of_violations_stay_apart():
    """Also beyond a feasible value of 1e16, where 1 is lost in a sum."""
    rng = np.random.default_rng(0)
    values = np.vstack([np.full((1, 3), [1e16, -1e-9, 0.0]), rng.random((20_000, 3))])
    values[:, 2] *= 1e-12
    order = np.argsort(violations(values, 2))
    assert (np.diff(constrained(values, 2)[order], axis=0) > 0).all()


@settings(max_examples=300)
@given(populations(), st.data())
def test_selections_drop_the_largest_violations_first(case, data):
    violation, ranked = violations(*case), constrained(*case)
    size = data.draw(st.integers(1, len(ranked)))
    for select in (select_survivors, select_with_deap):
        index, *_ = select(ranked, size)
        np.testing.assert_array_equal(np.sort(violation[index]), np.sort(violation)[:size])


@given(populations())
def test_without_constraints_nothing_is_copied(case):
    values, _ = case
    assert constrained(values, values.shape[1]) is values
    assert feasible_objectives(values, values.shape[1]) is values


@given(populations(), st.integers(0, 20))
def test_the_ideal_point_is_that_of_the_feasible_as_soon_as_there_are_any(case, cut):
    """In one go or in two, with what was found before."""
    values, m = case
    start = np.full(m, np.inf)
    met = np.array([violation_of(value, m) == 0 for value in values])
    assert any_feasible(values, m) == met.any()
    expected = values[met if met.any() else slice(None), :m].min(axis=0)
    np.testing.assert_array_equal(ideal_with(start, values, False), expected)
    early, late = values[:cut], values[cut:]
    before = ideal_with(start, early, False)
    np.testing.assert_array_equal(ideal_with(before, late, any_feasible(early, m)), expected)
    np.testing.assert_array_equal(start, np.inf)


def test_violations_are_summed_and_slack_is_not():
    values = np.array([[9.0, 9.0, 0.5, -3.0, 0.25], [9.0, 9.0, 0.0, -0.0, -1.0]])
    np.testing.assert_array_equal(violations(values, 2), [0.75, 0.0])
    np.testing.assert_array_equal(feasible_objectives(values, 2), [[9.0, 9.0]])
    assert violation_of(values[0], 2) == pytest.approx(0.75)

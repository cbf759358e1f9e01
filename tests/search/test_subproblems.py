"""How an iteration of MOEA/D-DRA begins: weights over spans, and the choice by a verb of a toolbox."""

import numpy as np
import pytest
from deap.base import Toolbox

from suspension_ctrl.search.constraints import violations
from suspension_ctrl.search.evaluation import WORST
from suspension_ctrl.search.subproblems import Decomposed


def population(m, c, failed=(), shift=0.0, normalise=True):
    rng = np.random.default_rng(m + c)
    values = np.hstack([rng.random((12, m)), rng.random((12, c)) - 0.5 + shift])
    values[list(failed)] = WORST
    vectors, everyone = rng.random((12, m)), np.tile(np.arange(12), (12, 1))
    ideal = values[:, :m].min(axis=0)
    return Decomposed.of(
        rng.random((12, 2)), values, ideal, vectors, normalise, everyone, np.arange(m), np.ones(12), m + 1
    )


def begun(one):
    toolbox = Toolbox()
    toolbox.register("choose_subproblems", lambda rng, utility, corners, size: rng.permutation(12)[:size])
    one.known.fill(0.0)
    one.begin(np.random.default_rng(0), toolbox)
    return one


@pytest.mark.parametrize("failed", [(), (0,), range(2, 9), range(12)])
@pytest.mark.parametrize(("m", "c", "shift"), [(2, 0, 0.0), (3, 2, 0.0), (3, 2, 0.5)])
def test_weights_are_over_the_span_of_feasible_designs_or_of_any(m, c, shift, failed):
    one = begun(population(m, c, failed, shift))
    evaluated = np.setdiff1d(np.arange(12), failed)
    feasible = evaluated[violations(one.values[evaluated], m) == 0]
    counted = one.values[feasible if feasible.size else evaluated, :m]
    span = counted.max(axis=0, initial=-np.inf) - one.ideal
    np.testing.assert_array_equal(one.weights, one.vectors / np.where(span > 0, span, 1.0))
    assert c == 0 or shift == 0 or not feasible.size
    assert np.isnan(one.known).all()
    np.testing.assert_array_equal(one.chosen, np.random.default_rng(0).permutation(12)[: m + 1])


def test_objectives_without_span_and_weights_without_normalisation_stay_as_they_are():
    flat = population(2, 0)
    flat.values[:, 1] = flat.ideal[1]
    begun(flat)
    np.testing.assert_array_equal(flat.weights[:, 1], flat.vectors[:, 1])
    assert not np.array_equal(flat.weights[:, 0], flat.vectors[:, 0])
    plain = begun(population(2, 0, normalise=False))
    np.testing.assert_array_equal(plain.weights, plain.vectors)
    assert (plain.known == 0).all()

"""Judged sets of a run, beside moocore on all that was evaluated."""

import moocore
import numpy as np
import pytest

from functions import srn
from suspension_ctrl import MoeadDra, Nsga2
from suspension_ctrl.search.indicators import ReferenceFront, non_dominated
from suspension_ctrl.search.trace import trace
from suspension_ctrl.study.judging import ARCHIVE, judged


@pytest.mark.parametrize("optimiser", [Nsga2(population=20), MoeadDra(population=20)])
def test_the_archive_of_a_budget_is_what_was_evaluated_within_it(optimiser):
    """Gaps that were lowered budget by budget are those of the archive: sums in another order, some 1e-15."""
    budgets = [20, 21, 40, 90, 100, 200]
    reference = ReferenceFront.of(np.stack([np.linspace(10, 220, 50), np.linspace(-20, -210, 50)], axis=1))
    traced = trace(srn(compiled=False), optimiser, budgets, seed=1)
    rows = [row for row in judged(traced, 20, reference) if row["set"] == ARCHIVE]
    assert [row["budget"] for row in rows] == budgets
    for row in rows:
        spent = traced.spent[row["budget"]]
        seen = traced.objectives[:spent][traced.feasible[:spent]]
        best = seen[non_dominated(seen)]
        assert row["members"] == len(best)
        assert row["relative_hypervolume"] == reference.relative_hypervolume(best)
        scaled = reference.scaled(seen), reference.scaled(reference.objectives)
        assert row["igd_plus"] == pytest.approx(moocore.igd_plus(scaled[0], ref=scaled[1]), rel=1e-12)

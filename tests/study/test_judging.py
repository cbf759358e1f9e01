"""Judged sets of a run, beside moocore on all that was evaluated."""

import moocore
import numpy as np
import pytest

from functions import srn
from suspension_ctrl import MoeadDra, Nsga2
from suspension_ctrl.search.indicators import ReferenceFront, evenly_spread, non_dominated
from suspension_ctrl.search.sampling import Sampling
from suspension_ctrl.search.trace import Trace, trace
from suspension_ctrl.study.judging import ARCHIVE, CUT_ARCHIVE, INDICATORS, POPULATION, judged

BUDGETS = [20, 21, 40, 90, 100, 200]
REFERENCE = ReferenceFront.of(np.stack([np.linspace(10, 220, 50), np.linspace(-20, -210, 50)], axis=1))


def sets(traced: Trace, budget: int, population: int) -> dict[str, np.ndarray]:
    """The judged sets within a budget, each from all that was evaluated or is in the population."""
    spent = traced.spent[budget]
    seen = traced.objectives[:spent][traced.feasible[:spent]]
    archive, state = seen[non_dominated(seen)], traced.states[budget]
    final = state.objectives[state.feasible]
    final = final[non_dominated(final)]
    cut, final = (part[evenly_spread(part, population)] for part in (archive, final))
    return {POPULATION: final, ARCHIVE: archive, CUT_ARCHIVE: cut}


@pytest.mark.parametrize(
    "optimiser", [Nsga2(population=20), MoeadDra(population=20), Sampling(population=20, points="random")]
)
def test_sets_of_a_budget_are_of_what_was_evaluated_within_it(optimiser):
    """Front, volume and shortfall that grew budget by budget are those of the whole sets, bit by bit.

    Sums of distances to neighbours, and those of moocore, are taken in another order, some 1e-15.
    """
    traced = trace(srn(compiled=False), optimiser, BUDGETS, seed=1)
    rows = {(row["budget"], row["set"]): row for row in judged(traced, 20, REFERENCE)}
    assert list(rows) == [(budget, name) for budget in BUDGETS for name in (POPULATION, ARCHIVE, CUT_ARCHIVE)]
    for (budget, name), row in rows.items():
        found = sets(traced, budget, 20)[name]
        assert row["members"] == len(found)
        for indicator in INDICATORS[:-1]:
            assert row[indicator] == getattr(REFERENCE, indicator)(found)
        assert row["spread"] == pytest.approx(REFERENCE.spread(found), rel=1e-12)
        scaled, front = REFERENCE.scaled(found), REFERENCE.scaled(REFERENCE.objectives)
        volume = moocore.hypervolume(scaled, ref=1.1) / REFERENCE.volume
        assert row["relative_hypervolume"] == pytest.approx(volume, rel=1e-12)
        assert row["igd_plus"] == pytest.approx(moocore.igd_plus(scaled, ref=front), rel=1e-12)
        assert row["epsilon"] == moocore.epsilon_additive(scaled, ref=front)


def test_equal_sets_and_states_are_judged_once(monkeypatch):
    """The population of a sample is its archive, cut if it is larger than N = 8; 20 and 21 have one state."""
    traced = trace(srn(compiled=False), Sampling(population=8, points="random"), BUDGETS, seed=1)
    judge, sizes = ReferenceFront.volume_and_spread, []

    def counted(front, objectives):
        sizes.append(len(objectives))
        return judge(front, objectives)

    monkeypatch.setattr(ReferenceFront, "volume_and_spread", counted)
    rows = list(judged(traced, 8, REFERENCE))
    archives = {row["evaluations"]: row["members"] for row in rows if row["set"] == ARCHIVE}
    assert len(archives) == 5
    assert max(archives.values()) > 8
    assert sizes == [n for size in archives.values() for n in ((8, size) if size > 8 else (size,))]

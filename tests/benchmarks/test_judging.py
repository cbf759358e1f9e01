"""Searches beside judging, in a short form."""

import judging
from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.study.comparison import Comparison


def test_searches_and_judging_are_told_by_algorithm():
    """A sample has its budgets' states, 40 and 80 of these evaluations, and an archive of at most all of them."""
    comparison = Comparison(
        problem=paper.ride_problem(), algorithms=["nsga2", "sobol"], populations=[40], iterations=[1]
    )
    table = judging.measured(comparison, repeats=1).set_index("algorithm")
    assert table.N.tolist() == [40, 40]
    assert (table[["search", "judging", "compared"]] > 0).all().all()
    assert table.states.tolist() == [2, 2]
    assert table.archive.between(2, 80).all()

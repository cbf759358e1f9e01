"""Tables 2 to 5 by hand, of made-up runs."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl.paper import experiment as paper
from suspension_ctrl.paper import tables
from suspension_ctrl.study import timing


def made_up_runs(rows: list[tuple]) -> pd.DataFrame:
    columns = ("algorithm", "budget", "repeat", "evaluations", "seconds", "hypervolume")
    common = {"population": 500, "iterations": 10, "igd_plus": 0.1}
    return pd.DataFrame([common | dict(zip(columns, row, strict=True)) for row in rows])


def test_tables_2_and_3_put_published_beside_measured():
    """Of the published algorithm alone, none that only begins like it."""
    rows = [("nsga2", "iterations", 1, 5500, 2.0, 0.9), ("nsga2", "iterations", 2, 5500, 4.0, 0.8)]
    others = [(name, "iterations", 1, 5500, 9.0, 0.9) for name in ("nsga2-gamultiobj", "moead-dra", "random")]
    published = paper.published_seconds()
    table = tables.seconds_by_repeat(made_up_runs(rows + others), published, "nsga2")
    own = published[
        (published.algorithm == "nsga2") & (published.population == 500) & (published.iterations == 10)
    ]
    assert table.algorithm.tolist() == ["nsga2"] * 2
    assert table.published_seconds.tolist() == own.sort_values("repeat").published_seconds.tolist()[:2]
    assert table.microseconds_per_evaluation.tolist() == pytest.approx([2e6 / 5500, 4e6 / 5500])
    printed = tables.as_printed(table)
    assert printed["repeat"].tolist() == ["1", "2", "mean", "evaluations", "µs per evaluation"]
    first, second = table.published_seconds
    assert printed["N=500, 10 iterations"].tolist() == [
        *(f"{first:.1f} / 2.0000", f"{second:.1f} / 4.0000", f"{(first + second) / 2:.1f} / 3.0000"),
        *("5500", "545.45"),
    ]  # fmt: skip


def test_other_configurations_have_no_published_seconds():
    runs = made_up_runs([("moead-dra", "iterations", 1, 1500, 1.0, 0.7)]).assign(population=40)
    table = tables.seconds_by_repeat(runs, paper.published_seconds(), "moead-dra")
    assert table.published_seconds.isna().all()
    assert tables.as_printed(table)["N=40, 10 iterations"][0] == "- / 1.0000"


def test_table_4_compares_with_the_first_algorithm():
    """By hand, two repeats each: mean seconds 3 / 1.5 at equal iterations, 3 / 6 at equal evaluations."""
    runs = made_up_runs(
        [
            ("nsga2", "iterations", 1, 5500, 2.0, 0.9), ("nsga2", "iterations", 2, 5500, 4.0, 0.8),
            ("moead-dra", "iterations", 1, 1500, 1.0, 0.7), ("moead-dra", "iterations", 2, 1500, 2.0, 0.7),
            ("moead-dra", "evaluations", 1, 5500, 5.0, 0.7), ("moead-dra", "evaluations", 2, 5500, 7.0, 0.7),
        ]
    )  # fmt: skip
    table = tables.comparison(runs, paper.published_seconds()).set_index(["algorithm", "budget"])
    assert len(table) == 4  # NSGA-II stands in both budgets, as it spends the most
    assert table.ratio_percent["nsga2", "iterations"] == table.ratio_percent["nsga2", "evaluations"] == 100
    assert table.ratio_percent["moead-dra", "iterations"] == pytest.approx(200)
    assert table.ratio_percent["moead-dra", "evaluations"] == pytest.approx(50)
    assert table.published_ratio_percent["moead-dra", "iterations"] == pytest.approx(239, rel=2e-3)
    assert np.isnan(table.published_ratio_percent["moead-dra", "evaluations"])
    assert table.microseconds_per_evaluation["moead-dra", "iterations"] == pytest.approx(1e3)
    quality = timing.quality(runs).set_index(["algorithm", "budget"]).hypervolume
    assert quality["moead-dra", "iterations"] == pytest.approx(0.7)
    assert quality["nsga2", "iterations"] == quality["nsga2", "evaluations"] == pytest.approx(0.85)


def test_table_4_with_a_baseline_that_spends_less():
    """NSGA-II's only run stands against both of the baseline's: 1 / 2 and 4 / 2 seconds."""
    runs = made_up_runs(
        [
            ("moead-dra", "iterations", 1, 1500, 1.0, 0.7),
            ("nsga2", "iterations", 1, 5500, 2.0, 0.9),
            ("moead-dra", "evaluations", 1, 5500, 4.0, 0.7),
        ]
    )
    ratio = tables.comparison(runs, paper.published_seconds()).set_index(["algorithm", "budget"]).ratio_percent
    assert ratio["nsga2", "iterations"] == pytest.approx(50)
    assert ratio["nsga2", "evaluations"] == pytest.approx(200)
    assert ratio["moead-dra", "iterations"] == ratio["moead-dra", "evaluations"] == 100


def test_table_5_has_the_deviation_from_what_is_published():
    problem = paper.ride_problem()
    designs = {"reference car": paper.reference_design(), "mine": (12e3, 1600.0)}
    table = tables.beside_published(problem, designs, {"reference car": {"ACC": 2.0}}).set_index("design")
    acc = problem.evaluate(list(designs.values()))[:, 0]
    np.testing.assert_array_equal(table["ACC [m/s^2]"], acc)
    assert table["ACC off [%]"]["reference car"] == pytest.approx(100 * (acc[0] / 2.0 - 1))
    assert table[["ACC off [%]", "SWS off [%]"]].isna().sum().tolist() == [1, 2]
    assert table["spring [N/m]"].tolist() == [22e3, 12e3]

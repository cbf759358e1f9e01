"""Candidates over a scatter: against the table of each design."""

import numpy as np
import pytest

from garage import DAMPED_QUARTER, QUARTER, ROAD
from suspension_ctrl import Measure, Nsga2, RideProblem, Scatter, SpeedBump, candidates, minimise, robustness
from suspension_ctrl.desk.candidate_scatter import candidate_scatter, parts_over_scatter, scatter_for

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
BUMP, PEAK = SpeedBump(height=0.05, length=2.0), "peak travel bump <= 0.2"


@pytest.fixture(scope="module")
def problem():
    given = {"speed": 20.0, "bounds": BOUNDS, "band": (0.3, 20.0), "nodes": 256}
    return RideProblem(QUARTER, ROAD, constraints=["SWS <= 29mm"], **given)


def test_each_candidate_has_its_quantiles_and_the_share_beyond_limits(problem):
    run = minimise(problem, Nsga2(population=20), iterations=3, seed=1)
    table = candidates(problem, run, present=[22e3, 1500.0], count=3)
    scatter = Scatter({"damper": 0.15}, samples=64)
    found = candidate_scatter(problem, table, scatter)
    expected = ["name", "q95 ACC [m/s^2]", "q95 SWS [m]", "q95 DTL [N]", "beyond SWS <= 29 mm [%]"]
    assert list(found) == expected
    assert found["name"].tolist() == table["name"].tolist()
    for number, row in found.iterrows():
        design = table.loc[number, ["spring [N/m]", "damper [N s/m]"]].tolist()
        own = robustness(problem, design, scatter)
        # nodes differ: within 1e-6
        np.testing.assert_allclose(row[expected[1:4]].tolist(), own["q95"].iloc[:3], rtol=1e-6)
        assert row[expected[4]] == own["beyond limit [%]"].iloc[3]
    assert found[expected[4]].max() > 0


def test_of_a_measure_of_which_more_is_better_the_lower_quantile_counts(problem):
    other = problem.replace(measures=["ACC", "-damper_power"], constraints=())
    run = minimise(other, Nsga2(population=20), iterations=1, seed=1)
    table = candidates(other, run, count=2)
    found = candidate_scatter(other, table, Scatter({"damper": 0.15}, samples=64))
    (header,) = [one for one in found if "damper_power" in one]
    assert header == "q5 -damper_power [W]"
    own = robustness(other, table.iloc[0, 1:3].tolist(), Scatter({"damper": 0.15}, samples=64))
    assert found[header].iloc[0] == pytest.approx(own["q5"].iloc[1], rel=1e-6)


def test_a_problem_without_scatter_has_that_of_springs_and_dampers(problem):
    assert scatter_for(problem) == Scatter({"spring": 0.05, "damper": 0.15})
    own = Scatter({"tyre_stiffness": 0.1})
    assert scatter_for(problem.replace(scatter=own)) == own
    tyre = RideProblem(
        DAMPED_QUARTER,
        ROAD,
        speed=20.0,
        bounds={"tyre_stiffness": (1e5, 3e5)},
        struts={"spring": 2e4, "damper": 1500.0},
    )
    assert scatter_for(tyre) == Scatter({"spring": 0.05, "damper": 0.15})


def test_peaks_and_functions_of_python_have_no_scatter_but_their_own(problem):
    heavy = Measure("heavy", "-", lambda frequency, spectra: 1.0)
    for own in (
        problem.replace(measures=["ACC", heavy]),
        problem.replace(events={"bump": BUMP}, constraints=[PEAK]),
    ):
        assert scatter_for(own) is None
        table = candidates(own, minimise(own, Nsga2(population=8), iterations=1, seed=1), count=2)
        assert [*parts_over_scatter(own, table)] == ["What changes each measure most, by 1 % more"]


def test_tables_tell_the_scatter(problem):
    table = candidates(problem, minimise(problem, Nsga2(population=8), iterations=1, seed=1), count=2)
    first, second = parts_over_scatter(problem, table)
    assert first == "Over a scatter of spring -5 to +5 %, damper -15 to +15 %, 256 samples, seed 1"
    assert second == "What changes each measure most, by 1 % more"

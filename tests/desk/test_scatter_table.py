"""Robustness of a design: against the robust measures of a problem and vehicles built anew."""

import re

import numpy as np
import pytest

from garage import FULL, GEOMETRY, QUARTER, ROAD
from suspension_ctrl import LoadCase, RideProblem, Scatter, robustness
from suspension_ctrl.desk.scatter_table import nodes_at

BOUNDS = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
GIVEN = {"speed": 20.0, "bounds": BOUNDS, "band": (0.3, 20.0)}
SETTING = {"spring": 22e3, "damper": 1500.0}
SCATTER = {"spring": 0.05, "damper": (-0.25, 0.0)}


@pytest.fixture(scope="module")
def problem():
    return RideProblem(QUARTER, ROAD, constraints=["SWS <= 29mm", "DTL <= 1kN"], **GIVEN)


def test_the_table_has_the_robust_measures_of_a_problem(problem):
    measures = [f"{kind} {name}" for name in problem.objectives for kind in ("mean", "q5", "q50", "q95", "CVaR95")]
    scatter = Scatter(SCATTER, samples=128, seed=3)
    robust = problem.replace(measures=measures, scatter=scatter)
    table = robustness(problem, SETTING, scatter)
    values = robust.evaluate([[22e3, 1500.0]])[0, :15].reshape(3, 5)
    found = table.loc[list(problem.objectives), ["mean", "q5", "q50", "q95", "CVaR95"]]
    np.testing.assert_allclose(found.to_numpy(dtype=float), values, rtol=1e-9)
    np.testing.assert_allclose(table["nominal"].iloc[:3], problem.evaluate([[22e3, 1500.0]])[0, :3], rtol=1e-9)
    assert table["unit"].tolist() == ["m/s^2", "m", "N", "m", "N"]


def test_the_share_beyond_a_limit_and_the_deviation_are_those_of_the_samples(problem):
    table = robustness(problem, SETTING, SCATTER, samples=256, seed=5)
    factors = Scatter(SCATTER, samples=256, seed=5).factors([(-0.05, 0.05), (-0.25, 0.0)])
    wide = problem.replace(bounds={"spring": (1e4, 4e4), "damper": (500.0, 4e3)})
    values = wide.evaluate([22e3, 1500.0] * factors)
    beyond = table["beyond limit [%]"]
    assert beyond["SWS <= 0.029"] == pytest.approx(100 * (values[:, 3] > 0).mean())
    assert 0 < beyond["SWS <= 0.029"] < 100
    assert beyond["DTL <= 1000"] == 100.0
    assert beyond[list(problem.objectives)].isna().all()
    np.testing.assert_allclose(table["standard deviation"].iloc[:3], values[:, :3].std(axis=0), rtol=1e-9)
    assert table["limit"].tolist()[3:] == [0.029, 1000.0]


def test_samples_and_seed_are_told_and_common_to_all_designs(problem):
    table = robustness(problem, SETTING, SCATTER)
    assert table.attrs == {"samples": 1000, "seed": 1}
    assert str(table).startswith("1000 samples, seed 1")
    robust = problem.replace(scatter=Scatter(SCATTER, samples=32, seed=4))
    assert robustness(robust, SETTING).attrs == {"samples": 32, "seed": 4}
    assert robustness(robust, SETTING, samples=16).attrs == {"samples": 16, "seed": 4}
    assert robustness(robust, SETTING, SCATTER, seed=9).attrs == {"samples": 1000, "seed": 9}
    assert robustness(robust, SETTING, Scatter(SCATTER, seed=2)).attrs == {"samples": 256, "seed": 2}


def test_designs_outside_of_the_bounds_and_robust_problems_have_a_table(problem):
    far = robustness(problem, [50e3, 800.0], SCATTER, samples=64)
    again = robustness(
        problem.replace(bounds={"spring": (1e4, 6e4), "damper": (500.0, 4e3)}), [50e3, 800.0], SCATTER, samples=64
    )
    np.testing.assert_allclose(far["q95"], again["q95"], rtol=1e-6)
    robust = problem.replace(
        measures=["mean ACC", "q95 ACC", "DTL"], constraints=["q95 SWS <= 29mm"], scatter=Scatter(SCATTER)
    )
    assert list(robustness(robust, SETTING).index) == ["ACC", "DTL", "q95 SWS <= 0.029"]


def test_nodes_are_no_fewer_than_those_of_the_problem(problem):
    scores = problem.scoring.scattered(problem.measures, Scatter(SCATTER, samples=2))
    design = np.array([[22e3, 1500.0]])
    found = [nodes_at(scores, design, least) for least in (256, 500, 1024)]
    assert found == [max(found[0], 256), 512, 1024]


def test_the_tail_of_a_least_value_is_below():
    case = LoadCase(vehicle=FULL, road=ROAD, speed=20.0, roll_geometry=GEOMETRY)
    bounds = {f"{axle}.{name}": pair for axle in ("front", "rear") for name, pair in BOUNDS.items()}
    problem = RideProblem(
        cases=[case],
        bounds=bounds,
        band=(0.3, 20.0),
        measures=["ACC", "-roll_damping"],
        constraints=["roll_damping >= 0.3"],
    )
    table = robustness(problem, [2e4, 2e3, 2e4, 2e3], {"damper": 0.1}, samples=64)
    for row in ("-roll_damping", "roll_damping >= 0.3"):
        assert table["CVaR95"][row] <= table["q5"][row] < table["nominal"][row]
    assert table["CVaR95"]["ACC"] >= table["q95"]["ACC"]
    assert table["nominal"]["-roll_damping"] > 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "scatter must be given where the problem has none, got None"),
        ({"scatter": {"sprang": 0.1}}, "scatter must be one of spring, damper, tyre_stiffness, "),
        ({"scatter": SCATTER, "samples": 0}, "samples must be a whole number >= 1, got 0"),
        ({"scatter": SCATTER, "design": [1.0]}, "design must be finite values of spring, damper, got [1.0]"),
        ({"scatter": SCATTER, "design": {"spring": 1.0}}, "design must have spring, damper, got none for damper"),
        ({"scatter": SCATTER, "design": [-1.0, 1e3]}, "spring must be finite and > 0 N/m, got -1.0"),
        ({"scatter": SCATTER, "problem": 1}, "problem must be a RideProblem, got 1"),
    ],
)
def test_wrong_arguments_are_told_in_one_line(problem, arguments, message):
    with pytest.raises(ValueError, match=f"^{re.escape(message)}"):
        robustness(**{"problem": problem, "design": SETTING} | arguments)

"""Fronts to compare with: exact points where they are cheap, what controllers attain within a passive front."""

import numpy as np
import pandas as pd

from suspension_ctrl import Measure, load_study, non_dominated
from suspension_ctrl.desk.explorer.layers import POINTS, attainable_layers, exact_layers


def test_the_exact_front_is_that_of_designs_within_the_limits(table1_problem):
    problem = table1_problem.replace(constraints=["SWS <= 0.02"])
    (layer,) = exact_layers(problem)
    assert (layer.kind, list(layer.table)) == ("reference", ["ACC [m/s^2]", "SWS [m]", "DTL [N]"])
    assert 3 < len(layer.table) <= POINTS
    assert layer.table["SWS [m]"].max() <= 0.02 * (1 + 1e-8)  # optima meet limits up to 1e-8
    assert non_dominated(layer.table.to_numpy()).all()
    grid = np.stack(np.meshgrid(np.linspace(1e3, 30e3, 40), np.linspace(1e3, 5e3, 40)), axis=-1).reshape(-1, 2)
    values = problem.evaluate(grid)
    others = values[values[:, 3] <= 0, :3]
    dominated = (others[:, None] <= layer.table.to_numpy() * (1 - 1e-6)).all(axis=2)
    assert not dominated.any()


def test_where_it_is_not_cheap_or_not_smooth_there_is_none(table1_problem):
    own = Measure("sum", "N/m", lambda designs: designs.sum(axis=1))
    assert exact_layers(load_study("full_car").problem) == []
    assert exact_layers(table1_problem.replace(measures=["ACC", own])) == []
    assert exact_layers(table1_problem.replace(constraints=["SWS <= 1e-5"])) == []


def test_controllers_are_shown_where_no_measure_is_above_the_passive_front():
    passive = pd.DataFrame({"ride": [1.0, 2.0], "grip": [4.0, 3.0]})
    table = pd.DataFrame({"controller": ["LQR"] * 3, "ride": [0.5, 2.1, 2.0], "grip": [4.0, 1.0, 2.0]})
    (layer,) = attainable_layers({"LQR": table, "far": table[1:2]}, passive)
    assert (layer.name, layer.kind, layer.table["ride"].tolist()) == ("LQR", "attainable", [0.5, 2.0])

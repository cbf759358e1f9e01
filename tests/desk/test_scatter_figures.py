"""The figure of a design over a scatter, by its data."""

import numpy as np
import pytest

from garage import QUARTER, ROAD
from suspension_ctrl import RideProblem, robustness, robustness_figure

SCATTER = {"damper": 0.15}


def test_the_figure_shows_samples_nominal_values_and_limits():
    bounds = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
    limits = ["SWS <= 29mm", "lift <= 1 %"]
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds, band=(0.3, 20.0), constraints=limits)
    figure = robustness_figure(problem, [22e3, 1500.0], SCATTER, samples=128)
    table = robustness(problem, [22e3, 1500.0], SCATTER, samples=128)
    acc, dtl, sws, lift = figure.axes
    beyond = table["beyond limit [%]"]["SWS <= 0.029"]
    labels = [axes.get_xlabel() for axes in figure.axes]
    assert labels == ["ACC [m/s^2]", "DTL [kN]", "SWS [mm]", "lift [-]"]
    assert sws.get_title() == f"{beyond:.0f} % beyond 29 mm"
    for axes, row, factor in ((acc, "ACC", 1.0), (dtl, "DTL", 1e-3), (sws, "SWS <= 0.029", 1e3)):
        assert sum(bar.get_height() for bar in axes.patches) == 128
        assert axes.get_lines()[0].get_xdata()[0] == pytest.approx(factor * table["nominal"][row])
        edges = np.array([bar.get_x() for bar in axes.patches])
        assert edges[0] <= factor * table["q5"][row] <= factor * table["q95"][row] <= edges[-1] + np.diff(edges)[0]
    assert sws.get_lines()[1].get_xdata()[0] == pytest.approx(29.0)
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["scatter", "nominal", "limit"]
    assert len(lift.get_lines()) == 2

"""The figure of sensitivities, by its data."""

import pytest

from garage import QUARTER, ROAD
from suspension_ctrl import RideProblem, sensitivity, sensitivity_figure


def test_the_largest_changes_are_drawn_first():
    bounds = {"spring": (1e4, 3e4), "damper": (1e3, 4e3)}
    problem = RideProblem(QUARTER, ROAD, speed=20.0, bounds=bounds, band=(0.3, 20.0))
    figure = sensitivity_figure(problem, [22e3, 1500.0], most=4)
    table = sensitivity(problem, [22e3, 1500.0])
    assert [axes.get_xlabel() for axes in figure.axes] == [
        f"{name} by 1 % more [%]" for name in problem.objectives
    ]
    for axes, name in zip(figure.axes, problem.objectives, strict=True):
        column = table[f"{name} [%]"]
        expected = column.reindex(column.abs().sort_values(ascending=False).index)[:4]
        assert [label.get_text() for label in axes.get_yticklabels()] == list(expected.index)
        assert [bar.get_width() for bar in axes.patches] == pytest.approx(expected.to_list())
    with pytest.raises(ValueError, match=r"^most must be a whole number >= 1, got 0$"):
        sensitivity_figure(problem, [22e3, 1500.0], most=0)

"""Figures of a decision: points where the tables have them, in mm and kN, numbers and labels of all parts."""

import numpy as np
import pandas as pd
import pytest

from suspension_ctrl.desk.figures import attainable_figure, changes_figure, front_figure

HEADERS = ["SWS [m]", "ACC [m/s^2]", "DTL [N]"]
FRONT = pd.DataFrame({"SWS [m]": [0.004, 0.006], "ACC [m/s^2]": [1.0, 0.6], "DTL [N]": [500.0, 450.0]})
FREE = pd.DataFrame({"SWS [m]": [0.004, 0.012], "ACC [m/s^2]": [1.0, 0.4], "DTL [N]": [500.0, 800.0]})
TABLE = pd.DataFrame(
    {
        "name": ["present design", "least ACC", "least $SWS$"],
        "SWS [m]": [0.007, 0.006, 0.004], "ACC [m/s^2]": [0.7, 0.6, 1.0], "DTL [N]": [470.0, 450.0, 500.0],
        "ACC change [%]": [0.0, -14.3, 42.9], "SWS change [%]": [0.0, -14.3, -42.9],
    }
)  # fmt: skip


def test_the_front_is_drawn_in_mm_and_kn_with_candidates_by_number():
    figure = front_figure(FRONT, FREE, TABLE, HEADERS, {"SWS [m]": 0.008, "DTL [N]": 600.0}, "My $car$")
    first, second = figure.axes
    assert (first.get_xlabel(), first.get_ylabel(), second.get_ylabel()) == ("SWS [mm]", "ACC [m/s²]", "DTL [kN]")
    lines = {line.get_label(): line for line in second.lines}
    np.testing.assert_allclose(lines["front within limits"].get_xydata(), [[4.0, 0.5], [6.0, 0.45]])
    np.testing.assert_allclose(lines["front without limits"].get_xydata(), [[4.0, 0.5], [12.0, 0.8]])
    np.testing.assert_allclose(lines["candidates"].get_xydata(), [[6.0, 0.45], [4.0, 0.5]])
    np.testing.assert_allclose(lines["present design"].get_xydata(), [[7.0, 0.47]])
    at = [line.get_xydata().tolist() for line in second.lines if line.get_label() == "limit"]
    assert at == [[[8.0, 0.0], [8.0, 1.0]], [[0.0, 0.6], [1.0, 0.6]]]
    assert {text.get_text(): tuple(text.xy) for text in first.texts} == {"1": (6.0, 0.6), "2": (4.0, 1.0)}
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == ["front without limits", "front within limits", "limit", "candidates", "present design"]
    assert figure.legends[0].get_title().get_text() == r"My \$car\$"


def test_a_number_stands_away_from_the_present_design_other_numbers_and_the_frame():
    near = TABLE.assign(**{"SWS [m]": [0.0062, 0.006, 0.004]}, **{"ACC [m/s^2]": [0.62, 0.6, 1.0]})
    figure = front_figure(FREE, pd.DataFrame(), near, HEADERS[:2], {}, "")
    first, second = (np.array(text.get_position()) for text in figure.axes[0].texts)
    assert first @ [1.0, 1.0] < 8.0  # 60 degrees or more from the present design, above on the right
    assert second[0] > 0 > second[1]  # the upper left corner is near


def test_without_limits_and_present_design_there_are_only_front_and_candidates():
    figure = front_figure(FRONT, pd.DataFrame(), TABLE.iloc[1:], HEADERS[:2], {}, "")
    (ax,) = figure.axes
    assert [line.get_label() for line in ax.lines] == ["front", "candidates"]


def test_bars_show_changes_by_candidate_with_the_direction_of_better():
    figure = changes_figure(TABLE, ["ACC", "SWS"], "")
    first, second = figure.axes
    assert [bar.get_width() for bar in first.patches] == pytest.approx([-14.3, 42.9])
    assert [text.get_text() for text in second.texts] == ["-14", "-43"]
    assert [one.get_text() for one in first.get_yticklabels()] == ["1 least ACC", r"2 least \$SWS\$"]
    assert first.get_xlabel() == "change of ACC, less is better [%]"
    better, worse = (bar.get_facecolor() for bar in first.patches)
    assert better != worse
    assert second.patches[0].get_facecolor() == better


def test_controllers_are_drawn_beside_the_front_where_other_measures_are_no_larger():
    table = pd.DataFrame(
        {
            "controller": ["LQR", "LQR", "skyhook"],
            "ACC [m/s^2]": [0.5, 0.4, 0.6], "SWS [m]": [0.005, 0.006, 0.005], "DTL [N]": [450.0, 900.0, 480.0],
            "ACC weight [-]": [0.5, 0.9, np.nan], "SWS weight [-]": [0.4, 0.05, np.nan],
            "DTL weight [-]": [0.1, 0.05, np.nan],
            "least [-]": [0.9, 0.5, np.nan], "within band [-]": [0.8, 0.4, np.nan],
        }
    )  # fmt: skip
    table.attrs = {"measures": ["ACC [m/s^2]", "SWS [m]", "DTL [N]"], "present": [1.0, 0.005, 500.0]}
    figure = attainable_figure(table, FRONT)
    first, second = figure.axes
    assert (first.get_xlabel(), first.get_ylabel(), second.get_ylabel()) == ("SWS [mm]", "ACC [m/s²]", "DTL [kN]")
    lines = {line.get_label(): line.get_xydata() for line in first.lines}
    np.testing.assert_allclose(lines["front of passive designs"], [[4.0, 1.0], [6.0, 0.6]])
    np.testing.assert_allclose(lines["active, LQR"], [[5.0, 0.5]])  # the other has more tyre load than the front
    np.testing.assert_allclose(lines["skyhook"], [[5.0, 0.6]])
    (area,) = first.collections
    top = area.get_paths()[0].vertices
    (at,) = top[np.isclose(top[:, 0], first.get_xlim()[0]) & (top[:, 1] > first.get_ylim()[0])][:1]
    # w_ACC a^2 = J - w_SWS (x/5 mm)^2 - w_DTL at 500 N, of the weights that bound most
    x = first.get_xlim()[0] / 5.0
    assert at[1] == pytest.approx(np.sqrt(max((0.8 - 0.4 * x**2 - 0.1) / 0.5, (0.4 - 0.05 * x**2 - 0.05) / 0.9)))
    with pytest.raises(ValueError, match=r"^measures of the table must be one of SWS \[m\], got 'ACC"):
        attainable_figure(table, FRONT[["SWS [m]"]])


def test_a_front_of_a_decision_has_what_is_attainable_behind_it():
    table = pd.DataFrame(
        {
            "controller": ["LQR", "skyhook"],
            "ACC [m/s^2]": [0.5, 0.6], "SWS [m]": [0.005, 0.005], "DTL [N]": [450.0, 480.0],
            "ACC weight [-]": [0.5, np.nan], "SWS weight [-]": [0.4, np.nan], "DTL weight [-]": [0.1, np.nan],
            "least [-]": [0.9, np.nan], "within band [-]": [0.8, np.nan],
        }
    )  # fmt: skip
    table.attrs = {"measures": ["ACC [m/s^2]", "SWS [m]", "DTL [N]"], "present": [1.0, 0.005, 500.0]}
    figure = front_figure(FRONT, pd.DataFrame(), TABLE, HEADERS, {}, "", table)
    first = figure.axes[0]
    lines = {line.get_label(): line.get_xydata() for line in first.lines}
    np.testing.assert_allclose(lines["active, LQR"], [[5.0, 0.5]])
    np.testing.assert_allclose(lines["present design"], [[7.0, 0.7]])
    assert first.get_xlim()[0] < 4.0 < 7.0 < first.get_xlim()[1]  # all that is drawn is in view
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts[-1] == "only with more beyond the band"
    assert len(texts) == len(set(texts))

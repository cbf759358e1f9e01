"""The factors of the standards, as they print them."""

from suspension_ctrl.response.axes import AXES
from suspension_ctrl.response.weightings import filters


def test_every_axis_has_a_weighting_and_a_factor():
    assert {axis.weighting for axis in AXES.values()} <= set(filters())
    points = {point: [name for name in AXES if name.startswith(point)] for point in ("seat", "back", "feet")}
    assert {point: len(names) for point, names in points.items()} == {"seat": 6, "back": 3, "feet": 3}


def test_factors_are_those_of_tables_of_the_standard():
    """ISO 2631-1, Tables 1 and 2 of weightings by axis, and 8.2.2.1 a) to c), 8.2.2.2."""
    printed = {
        "seat": "x Wd 1, y Wd 1, z Wk 1, roll We 0.63, pitch We 0.4, yaw We 0.2",
        "back": "x Wc 0.8, y Wd 0.5, z Wd 0.4",
        "feet": "x Wk 0.25, y Wk 0.25, z Wk 0.4",
        "floor": "x Wd 1, y Wd 1, z Wk 1",
        "hand": "x Wh 1, y Wh 1, z Wh 1",
    }
    rows = [(point, *text.split()) for point, texts in printed.items() for text in texts.split(", ")]
    assert {f"{point} {axis}": (weighting, float(k)) for point, axis, weighting, k in rows} == AXES

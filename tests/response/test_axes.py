"""The factors of the standards, as they print them."""

from suspension_ctrl.response.axes import AXES
from suspension_ctrl.response.weightings import filters


def test_every_axis_has_a_weighting_and_a_factor():
    assert {axis.weighting for axis in AXES.values()} <= set(filters())
    points = {point: [name for name in AXES if name.startswith(point)] for point in ("seat", "back", "feet")}
    assert {point: len(names) for point, names in points.items()} == {"seat": 6, "back": 3, "feet": 3}


def test_factors_are_those_of_tables_of_the_standard():
    """ISO 2631-1, Tables 1 and 2 of weightings by axis, and 8.2.2.1 a) to c), 8.2.2.2."""
    text = """
        seat x Wd 1 seat y Wd 1 seat z Wk 1 seat roll We 0.63 seat pitch We 0.4 seat yaw We 0.2
        back x Wc 0.8 back y Wd 0.5 back z Wd 0.4 feet x Wk 0.25 feet y Wk 0.25 feet z Wk 0.4
        floor x Wd 1 floor y Wd 1 floor z Wk 1 hand x Wh 1 hand y Wh 1 hand z Wh 1
    """.split()
    assert {f"{p} {a}": (w, float(k)) for p, a, w, k in zip(*(text[i::4] for i in range(4)), strict=True)} == AXES

"""Axes in which vibration enters a person: weightings, multiplying factors, values of daily exposure."""

from typing import NamedTuple


class Axis(NamedTuple):
    """Weighting of an axis and its factor k in the vibration total value; of rotations in m/rad."""

    weighting: str
    factor: float


AXES = {
    "seat x": Axis("Wd", 1.0), "seat y": Axis("Wd", 1.0), "seat z": Axis("Wk", 1.0),
    "seat roll": Axis("We", 0.63), "seat pitch": Axis("We", 0.4), "seat yaw": Axis("We", 0.2),
    "back x": Axis("Wc", 0.8), "back y": Axis("Wd", 0.5), "back z": Axis("Wd", 0.4),
    "feet x": Axis("Wk", 0.25), "feet y": Axis("Wk", 0.25), "feet z": Axis("Wk", 0.4),
    "floor x": Axis("Wd", 1.0), "floor y": Axis("Wd", 1.0), "floor z": Axis("Wk", 1.0),
    "hand x": Axis("Wh", 1.0), "hand y": Axis("Wh", 1.0), "hand z": Axis("Wh", 1.0),
}  # fmt: skip
"""By point and axis: a seated person at seat, backrest and feet (ISO 2631-1, 8.2.2.1), a standing one on a floor
(8.2.2.2), a hand on a grip (ISO 5349-1, 4.5). x is forward, y to the left, z up."""

VERTICAL, HORIZONTAL = Axis("Wk", 1.0), Axis("Wd", 1.4)
"""Axes of daily exposure of the whole body (ISO 2631-1, 7.2.3; Directive 2002/44/EC, Annex, part B)."""
DAY = 8 * 3600.0
"""Reference duration of daily exposure [s]."""


class DailyValues(NamedTuple):
    """Exposure action value and exposure limit value of Directive 2002/44/EC, article 3."""

    action: float
    limit: float


WHOLE_BODY_A8, WHOLE_BODY_VDV = DailyValues(0.5, 1.15), DailyValues(9.1, 21.0)  # m/s^2, m/s^1.75
HAND_A8 = DailyValues(2.5, 5.0)  # m/s^2

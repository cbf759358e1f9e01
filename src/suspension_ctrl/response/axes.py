"""Axes in which vibration enters a person: weightings and multiplying factors of the standards."""

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

"""Limits on measures: ``"SWS <= 0.0287"``, ``"roll_damping >= 0.2"``."""

import re
from dataclasses import dataclass

from ..vehicles.vehicle import Vehicle
from .measures import Measure, measure
from .weightings import Weighting

_LIMIT = re.compile(r"(.+?)(<=|>=)(.+)")


@dataclass(frozen=True)
class Limit:
    """A measure that may not be above a limit, or below it.

    Parameters
    ----------
    measure : Measure
    most : bool
        Whether the limit is the most that is allowed, or the least.
    value : float
        The limit, in the measure's unit.
    """

    measure: Measure
    most: bool
    value: float

    @property
    def scale(self) -> float:
        """What the measure is multiplied with in g = scale * measure + offset, which is met where g <= 0."""
        return (1.0 if self.most else -1.0) / (abs(self.value) or 1.0)

    @property
    def offset(self) -> float:
        """What is then added; g is the violation as a share of the limit."""
        return -self.scale * self.value


def limit(text: str, vehicle: Vehicle, weighting: Weighting | None) -> Limit:
    """Return the limit that is written so; ValueError if it is none.

    Measures of the ride only have a most. See `measures` for what can be limited.
    """
    found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
    try:
        value = float(found[3]) if found else float("nan")
    except ValueError:
        value = float("nan")
    if not found or not abs(value) < float("inf"):
        raise ValueError(f"constraint must be like 'SWS <= 0.03' or 'roll_damping >= 0.2', got {text!r}")
    limited = measure(found[1], vehicle, weighting)
    if limited.sign < 0:
        raise ValueError(f"constraint must limit a measure without - in front, got {text!r}")
    if not limited.handling and not (found[2] == "<=" and value > 0):
        raise ValueError(f"constraint on a measure of the ride must be <= a limit above zero, got {text!r}")
    return Limit(limited, found[2] == "<=", value)

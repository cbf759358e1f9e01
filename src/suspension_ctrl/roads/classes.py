"""Class of a measured road by ISO 8608: a straight line through its spectrum, judged at 0.1 cycle/m."""

from typing import NamedTuple

import numpy as np

from .measured import MeasuredRoad
from .spectra import limits_of_classes

RANGE = (0.011, 2.83)
"""Wavenumbers of the fit, those of the standard's straight lines [cycle/m]."""
REFERENCE = 0.1
_POINTS = 200  # of the fit, evenly over the logarithm


class FittedClass(NamedTuple):
    """A straight line through the logarithm of a spectrum, and the class that it is in at 0.1 cycle/m."""

    road_class: str
    roughness: float  # Gd(n0) of the line [m^3]
    waviness: float
    band: tuple[float, float]  # of the fit [cycle/m]


def fitted_class(road: MeasuredRoad) -> FittedClass:
    """Return the class of a road by least squares over the logarithm; ValueError if its band is too short."""
    low, high = max(road.band[0], RANGE[0]), min(road.band[1], RANGE[1])
    if high < 2 * low or not low <= REFERENCE <= high:
        needed = f"cover an octave around {REFERENCE} cycle/m"
        raise ValueError(f"spectrum for a class of ISO 8608 must {needed}, got {low:.3g} to {high:.3g} cycle/m")
    n = np.clip(np.geomspace(low, high, _POINTS), low, high)
    slope, level = np.polyfit(np.log(n / REFERENCE), np.log(road.psd(n, 1.0)), 1)
    roughness = float(np.exp(level))
    name = next(name for name, upper in limits_of_classes().items() if roughness < upper)
    return FittedClass(name, roughness, -float(slope), (low, high))

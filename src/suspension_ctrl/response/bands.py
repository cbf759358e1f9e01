"""Band of frequencies over which spectra are integrated: given, or as far as the roads are known."""

from collections.abc import Iterable
from typing import Any

from .. import checks

BAND = (0.0, 20.0)
"""Frequencies over which spectra are integrated if neither a band nor a road says otherwise [Hz]."""


class OwnBand(tuple[float, float]):
    """Band that was found from the roads; a changed problem finds it anew."""

    __slots__ = ()


def band_of(
    band: tuple[float, float] | None, roads: Iterable[tuple[Any, float]], widest: tuple[float, float] = BAND
) -> tuple[float, float]:
    """Return a band [Hz], or if None the `widest` as far as all roads, each with a speed [m/s], are known."""
    if band is not None:
        checks.interval("band", band, "Hz")
        return float(band[0]), float(band[1])
    low, high = widest
    for road, speed in roads:
        if (own := getattr(road, "band", None)) is not None:
            low, high = max(low, own[0] * speed), min(high, own[1] * speed)
    if not low < high:
        raise ValueError(f"band must be given where roads are not known below {widest[1]:g} Hz, got none")
    return OwnBand((low, high))

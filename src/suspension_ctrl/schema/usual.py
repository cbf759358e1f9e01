"""Usual sizes of numbers that are typed without a unit: beyond them a number is likely in another unit."""

from typing import NamedTuple

from ..quantities import quantity


class Usual(NamedTuple):
    """Least and greatest usual size, and units that a number may be in instead."""

    lowest: float
    highest: float
    others: tuple[str, ...]


USUAL = {
    "m/s": Usual(0.05, 99.0, ("km/h", "mph")),
    "m": Usual(1e-4, 1.0, ("mm", "cm", "in")),
    "m/s^2": Usual(1e-3, 100.0, ("mm/s^2",)),
    "N": Usual(5.0, 1e6, ("kN",)),
    "Hz": Usual(0.05, 1000.0, ("1/min",)),
}
"""Sizes of speeds, of limits on measures, and of bands, by unit."""


def is_usual(value: float, unit: str) -> bool:
    """Whether a number is of usual size, or not above zero, or in a unit without one."""
    usual = USUAL.get(unit)
    return usual is None or not value > 0 or usual.lowest <= value <= usual.highest


def check_bare(name: str, value: float, unit: str) -> None:
    """Raise ValueError if a number above zero, typed without its unit, is of no usual size."""
    if is_usual(value, unit):
        return
    usual = USUAL[unit]
    texts = [f"{value:.6g} {other}" for other in usual.others]
    likely = [text for text in texts if usual.lowest <= quantity(name, text, unit) <= usual.highest]
    hint = f": {likely[0]}?" if likely else ""
    needed = f"{usual.lowest:g} to {usual.highest:g} {unit}, or typed with its unit"
    raise ValueError(f"{name} must be {needed}, got {value:g}{hint}".lstrip())

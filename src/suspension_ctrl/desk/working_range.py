"""How far and how fast struts move on a random road: static position, root mean squares and largest values."""

from collections.abc import Mapping
from contextlib import suppress
from math import nan
from typing import NamedTuple

from ..response.linearisation import linearised
from ..response.load_case import LoadCase
from ..response.measures.gaussian import LargestPeak
from ..response.responses import ride
from ..vehicles.assembly import joined
from ..vehicles.networks import has_force_laws
from ..vehicles.parameters import alike

DISTANCE = 10e3
"""Distance over which the largest values are expected [m]."""

_KINDS = ("suspension_travel", "suspension_travel_rate", "strut_force")
UNITS = ("m", "m", "m", "m", "m/s", "m/s", "N", "N")
"""Units of the numbers of a `Motion`."""

_DIGITS = 6  # to which left and right are alike


class Motion(NamedTuple):
    """Motion of a strut, or of equal ones on the left and the right, at the wheel; NaN where there is none."""

    strut: str
    static: float  # m, deflection from the free length, in compression below zero
    mean: float  # m, by force laws on the road
    travel: float  # m, root mean square about the mean
    largest_travel: float  # m, expected over `DISTANCE`, about the mean
    rate: float  # m/s
    largest_rate: float
    force: float  # N, of the whole strut about the static force
    largest_force: float


def motions_of(case: LoadCase, setting: Mapping[str, float], band: tuple[float, float]) -> list[Motion]:
    """Return the motion of each strut in a load case, those of left and right once where they are alike."""
    vehicle, known = case.vehicle, case.vehicle.meanings
    names = {strut: [joined(strut, kind) for kind in _KINDS] for strut in vehicle.struts}
    largest = {name: LargestPeak(name, DISTANCE) for every in names.values() for name in every if name in known}
    table = ride(vehicle, setting, case.road, case.speed, band=band, measures=list(largest.values()))["value"]
    static, mean = _static(case, setting), _mean(case, setting, band)

    def values(name: str) -> tuple[float, float]:
        return (float(table[name]), float(table[largest[name].label])) if name in largest else (nan, nan)

    motions = {
        strut: Motion(
            strut,
            static.get(joined(strut, "deflection"), nan),
            mean.get(strut, nan),
            *(value for name in every for value in values(name)),
        )
        for strut, every in names.items()
    }
    groups = alike({strut: float(f"{one.travel:.{_DIGITS}g}") for strut, one in motions.items()})
    return [motions[struts[0]]._replace(strut=common) for common, struts in groups.items()]


def _static(case: LoadCase, setting: Mapping[str, float]) -> Mapping[str, float]:
    """Return static deflections by name [m], none of a vehicle that no spring carries."""
    with suppress(ValueError):
        return {str(name): float(value) for name, value in case.vehicle.static(setting)["value"].items()}
    return {}


def _mean(case: LoadCase, setting: Mapping[str, float], band: tuple[float, float]) -> Mapping[str, float]:
    """Return the mean deflections of struts by force laws on the road [m], 0 without them."""
    if not has_force_laws(case.vehicle.networks):
        return dict.fromkeys(case.vehicle.struts, 0.0)
    return linearised(case.vehicle, setting, case.road, case.speed, band=band).mean_travel

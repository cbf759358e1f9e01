"""Rates of springs: of the element itself, and at the wheel by the square of its installation ratio."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, NamedTuple

from .struts import Parallel, Strut
from .vehicle import Vehicle

if TYPE_CHECKING:
    import pandas as pd

_NOTHING = 1e-6  # N/m, of a stop out of reach


class Rate(NamedTuple):
    """Stiffness of an element at 0 Hz [N/m], and its square of the installation ratio [-]."""

    name: str
    spring: float
    square: float


def rates_of(vehicle: Vehicle, values: Mapping[str, float]) -> "pd.DataFrame":
    """Return spring rate and wheel rate of each element with a stiffness, for all coefficients by name.

    A force law has its slope about the static position; that of a linearised vehicle is its mean slope.
    """
    import pandas as pd

    found = [
        Rate(one.name, values[one.name], float(one.gain.max()))
        for one in vehicle.strut_coefficients
        if one.order == 0 and one.unit == "N/m" and one.gain.any()
    ]
    for network in vehicle.networks:
        own = {name.removeprefix(network.prefix): value for name, value in values.items()}
        found += [rate._replace(name=network.prefix + rate.name) for rate in _within(network.strut, own, 1.0)]
    shown = [rate for rate in found if rate.spring > _NOTHING]
    return pd.DataFrame(
        {
            "name": [rate.name for rate in shown],
            "spring rate [N/m]": [rate.spring for rate in shown],
            "wheel rate [N/m]": [rate.spring * rate.square for rate in shown],
        }
    )


def _within(strut: Strut, values: Mapping[str, float], square: float) -> Iterator[Rate]:
    """Yield the elements of a strut; `square` is that of the ratio of the strut around it."""
    square *= strut.installation_ratio**2
    if isinstance(strut, Parallel):
        for part in strut.parts:
            yield from _within(part, values, square)
    else:
        stiffness = float(strut.static_stiffness(values)) / strut.installation_ratio**2
        yield Rate(strut.elements[0].name, stiffness, square)

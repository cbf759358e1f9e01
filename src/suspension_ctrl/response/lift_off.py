"""Tyres that lift off: a linear tyre pulls on the road where more than its static load is taken from it."""

import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..quantities import column_headers
from ..vehicles.feedback import gains_by_order
from ..vehicles.vehicle import AssembledVehicle, Vehicle
from .motion.equations import loads_of, static_loads

if TYPE_CHECKING:
    import pandas as pd


class LiftOffWarning(UserWarning):
    """A linear tyre pulls on the road: with ``lift_off=True`` it leaves it."""


class LiftOff(NamedTuple):
    """How a tyre lifts off."""

    share: float  # of time
    first: float  # place [m], on a test rig time [s]


def tell_lift_off(
    vehicle: Vehicle, values: Mapping[str, float], table: "pd.DataFrame", lift_off: bool
) -> None:
    """Put the lift-off of each tyre that has some into ``table.attrs``; warn if tyres cannot leave the road."""
    loads = dict(zip(loads_of(vehicle), vehicle.tyres, strict=False))
    headers = {name: column_headers([name], {name: "N"})[0] for name in loads}
    if not (isinstance(vehicle, AssembledVehicle) and set(headers.values()) & set(table.columns)):
        return
    static = static_loads(vehicle, gains_by_order(vehicle.parameters, values, len(vehicle.struts))[0])
    place = table.columns[min(1, len(table.columns) - 1)]
    place = "distance [m]" if "distance [m]" in table.columns else "time [s]"
    found = {}
    for (name, tyre), stands in zip(loads.items(), static.tolist(), strict=True):
        if headers[name] not in table.columns:
            continue
        pull = table[headers[name]].to_numpy()
        off = pull >= stands * (1 - 1e-9)
        if off.any():
            first = float(table[place].to_numpy()[off.argmax()])
            found[tyre] = LiftOff(float(off.mean()), first)
            if not lift_off:
                what = f"the linear {tyre} tyre".replace("  ", " ")
                warnings.warn(
                    f"{what} would pull {pull.max() / 1e3:.2f} kN where {stands / 1e3:.2f} kN stand on it, "
                    f"{100 * off.mean():.2g} % of the time and first at {place.split()[0]} {first:.2f}: "
                    "lift_off=True lets it leave the road",
                    LiftOffWarning,
                    stacklevel=4,
                )
    if found:
        table.attrs["lift_off"] = found

"""Tyres that lift off: where the road takes more than its static load from a tyre, a linear one pulls on it."""

import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from ..quantities import column_headers
from ..vehicles.vehicle import Vehicle, assembled
from .motion.drivable import integrated
from .motion.equations import loads_of, static_loads

if TYPE_CHECKING:
    import pandas as pd

_ROUNDING = 1e-9
_TOLD = 0.01  # share of time from which a warning is given


class LiftOffWarning(UserWarning):
    """A linear tyre pulls on the road for more than 1 % of the time; with ``lift_off=True`` it leaves it.

    Examples
    --------
    Take it for an error:

    >>> import warnings
    >>> import suspension_ctrl as sc
    >>> car, profile = sc.load_vehicle("yuen_ramli_2010"), sc.Iso8608Road("F").profile(200.0, 0.1, seed=1)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", sc.LiftOffWarning)
    ...     try:
    ...         table = sc.simulate(car.vehicle, car.setting, profile, speed=20.0)
    ...     except sc.LiftOffWarning as warning:
    ...         print(str(warning).split(",")[0])
    the linear tyre would pull 18.92 kN where 3.56 kN stand on it
    """


class LiftOff(NamedTuple):
    """Share of the time for which a tyre is off the road or would be, and its first place [m] or time [s]."""

    share: float
    first: float


def tell_lift_off(vehicle: Vehicle, values: Mapping[str, float], table: "pd.DataFrame", allowed: bool) -> None:
    """Put the tyres that lift off into ``table.attrs["lift_off"]``; warn if they may not."""
    if not (loads := loads_of(vehicle)):
        return
    place = "distance [m]" if "distance [m]" in table else "time [s]"
    laden = not (vehicle.networks and integrated(vehicle, allowed))
    found, static = {}, static_loads(assembled(vehicle), values, laden=laden).tolist()
    for tyre, header, stands in zip(
        vehicle.tyres, column_headers(loads, dict.fromkeys(loads, "N")), static, strict=True
    ):
        off = (table[header] >= stands * (1 - _ROUNDING)).to_numpy() if header in table else None
        if off is not None and off.any():
            found[tyre] = LiftOff(float(off.mean()), float(table[place].iloc[int(off.argmax())]))
            if not allowed and found[tyre].share > _TOLD:
                _warn(tyre, float(table[header].max()), stands, found[tyre], place)
    if found:
        table.attrs["lift_off"] = found


def _warn(tyre: str, pull: float, stands: float, found: LiftOff, place: str) -> None:
    what = " ".join(["the linear", *filter(None, [tyre]), "tyre"])
    force = f"would pull {pull / 1e3:.2f} kN where {stands / 1e3:.2f} kN stand on it"
    when = f"{100 * found.share:.2g} % of the time, first at {place.split()[0]} {found.first:.2f} {place[-2:-1]}"
    message = f"{what} {force}, {when}; lift_off=True lets it leave the road"
    warnings.warn(message, LiftOffWarning, stacklevel=5)

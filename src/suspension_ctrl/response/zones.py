"""Share of time that a Gaussian response spends in zones: histograms of travel and of the velocity of dampers."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..vehicles.vehicle import Setting, Vehicle
from .load_case import Road
from .measures.peak import responses_at
from .responses import ride

if TYPE_CHECKING:
    import pandas as pd


def time_in_zones(
    vehicle: Vehicle,
    setting: Setting,
    road: Road,
    speed: float,
    edges: ArrayLike,
    *,
    response: str = "suspension_travel_rate",
    band: tuple[float, float] | None = None,
) -> "pd.DataFrame":
    """Return the share of time that a Gaussian response spends between edges, by wheel.

    Parameters
    ----------
    vehicle, setting, road, speed, band
        As of `ride`.
    edges : (k,) array_like
        Ascending, in the unit of the response; two more zones are beyond the first and the last.
    response : str
        As of `Peak`: the velocity of the dampers by default, ``"travel"``, ``"front_strut_force"``.

    Returns
    -------
    DataFrame
        A row for each of the k + 1 zones: ``from`` and ``to`` with the unit of the response, and the share of time
        by response.

    Raises
    ------
    ValueError
        If the edges do not ascend, or the root mean square of the response diverges.

    Examples
    --------
    The time of a damper below 0.05 m/s, where its friction and its valves for low speed act:

    >>> import suspension_ctrl as sc
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> table = sc.time_in_zones(car.vehicle, car.setting, sc.Iso8608Road("C"), 20.0, [-0.3, -0.05, 0.05, 0.3])
    >>> print(table.round(2).to_string(index=False))
     from [m/s]  to [m/s]  suspension_travel_rate
           -inf     -0.30                    0.12
          -0.30     -0.05                    0.30
          -0.05      0.05                    0.16
           0.05      0.30                    0.30
           0.30       inf                    0.12
    """
    import pandas as pd
    from scipy.special import ndtr

    ends = checks.reals("edges must be", edges)
    if ends.ndim != 1 or ends.size == 0 or not (np.diff(ends) > 0).all():
        raise ValueError(f"edges must ascend, one at least, got {checks.shown(ends.tolist())}")
    ends = np.concatenate([[-np.inf], ends, [np.inf]])
    names = responses_at(vehicle, response)
    table = ride(vehicle, setting, road, speed, band=band, measures=names)
    if lacking := [name for name in names if table["note"][name]]:
        raise ValueError(
            f"response must have a root mean square, got {lacking[0]}, which {table['note'][lacking[0]]}"
        )
    unit = table["unit"][names[0]]
    shares = {name: np.diff(ndtr(ends / table["value"][name])) for name in names}
    return pd.DataFrame({f"from [{unit}]": ends[:-1], f"to [{unit}]": ends[1:], **shares})

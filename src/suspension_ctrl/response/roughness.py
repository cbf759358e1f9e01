"""International Roughness Index of a profile: how far the suspension of a reference car travels per distance."""

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import control
import numpy as np

from .. import checks
from ..quantities import Real, Record, frozen_array, unit
from ..roads.profiles import Profile
from ..vehicles.cars import QuarterCar

if TYPE_CHECKING:
    import pandas as pd

SPEED = 80 / 3.6
"""Speed of the reference quarter car [m/s]."""
BASE = 0.25
"""Length over which a tyre averages the profile [m]."""
_START = 11.0  # length whose mean slope the car begins with [m]: half a second of driving
_COARSEST = 0.3048  # longest step of a profile [m]: a foot
_ROUNDED = 1e-3  # of a step, by rounded distances
_SLACK = 1e-9  # relative, of lengths and steps that are not round in binary


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RoughnessIndex(Record):
    """International Roughness Index of a profile.

    Parameters
    ----------
    tracks : (t,) tuple of float
        Index of each track [mm/m].
    distance : (k,) array
        End of each step [m].
    travel : (k, t) array
        Magnitude of the travel of the reference car per distance at the ends of the steps [mm/m].
    length : float
        Length of the profile, a step for each point [m].
    """

    tracks: tuple[float, ...] = field(metadata=unit("mm/m"))
    distance: Real = field(metadata=unit("m"))
    travel: Real = field(metadata=unit("mm/m"))
    length: float = field(metadata=unit("m"))

    @property
    def mean(self) -> float:
        """Mean of the indices of the tracks [mm/m]."""
        return sum(self.tracks) / len(self.tracks)

    def by_segment(self, length: float) -> "pd.DataFrame":
        """Return the index of every whole segment of a `length` [m]; the car drives on from one to the next.

        Columns are ``start [m]``, ``end [m]`` and ``IRI [mm/m]``, of several tracks ``IRI of track 1 [mm/m]`` etc.
        A shorter piece at the end is left out.
        """
        import pandas as pd

        step = float(self.distance[-1] - self.distance[0]) / (self.distance.size - 1)
        least = 2 * max(BASE, step)  # a segment at the end keeps points, although the average ends before it
        checks.positive("segment", length, "m")
        if not least <= length <= self.length + step / 2:
            raise ValueError(f"segment must be from {least:g} to {self.length:.6g} m, got {length:g} m")
        count = math.floor((self.length + step / 2) / length)  # distances in a file are rounded
        edges = np.ceil(np.arange(count + 1) * length / step - _ROUNDED).astype(int)
        edges[-1] = min(edges[-1], self.distance.size)
        sums = np.add.reduceat(self.travel[: edges[-1]], edges[:-1], axis=0)
        start = self.distance[0] - step + length * np.arange(count)
        many = len(self.tracks) > 1
        names = [f"IRI of track {i + 1} [mm/m]" if many else "IRI [mm/m]" for i in range(len(self.tracks))]
        table = pd.DataFrame(sums / np.diff(edges)[:, None], columns=names)
        return pd.concat([pd.DataFrame({"start [m]": start, "end [m]": start + length}), table], axis=1)


def golden_car() -> control.StateSpace:
    """Return the golden car from ``road`` to ``suspension_travel``, heights [m] or slopes [m/m], per body mass.

    M. W. Sayers, "On the calculation of International Roughness Index from longitudinal road profile",
    Transportation Research Record 1501 (1995); ASTM E1926.
    """
    car = QuarterCar(body_mass=1.0, wheel_mass=0.15, tyre_stiffness=653.0)
    return car.closed(spring=63.3, damper=6.0)["suspension_travel", "road"]


def international_roughness_index(profile: Profile, *, average: bool = True) -> RoughnessIndex:
    """Return the International Roughness Index of every track of a profile, in mm/m, which is m/km.

    The profile's slope, averaged over 250 mm (the nearest whole number of steps, half a step up and one at least:
    steps of more than 167 mm are not averaged), drives the golden car at 80 km/h. The response is exact for an
    averaged profile that is straight between its points. The car begins at rest on the mean slope of the first
    11 m. The index is the mean magnitude of the difference of the slopes of body and wheel (Sayers 1995).

    Parameters
    ----------
    profile : Profile
        In steps of at most 304.8 mm and at least 11.25 m long. How the car begins tells in the index of a short
        road: some 20 m of lead, and 100 m of road, are good practice.
    average : bool
        False for a profile that its profilometer has smoothed over 250 mm already: no average then.

    Returns
    -------
    RoughnessIndex
        ``.tracks`` and ``.mean`` [mm/m], and ``.by_segment(length)``, a DataFrame.

    Examples
    --------
    The golden car is linear: twice the height gives twice the index.

    >>> import suspension_ctrl as sc
    >>> profile = sc.Iso8608Road("B").profile(length=1000.0, step=0.1, seed=1)
    >>> doubled = sc.Profile(profile.distance, 2 * profile.height)
    >>> for road in (profile, doubled):
    ...     print(f"{sc.international_roughness_index(road).mean:.1f} mm/m")
    4.2 mm/m
    8.4 mm/m

    The index by segments of 250 m:

    >>> print(sc.international_roughness_index(profile).by_segment(250.0).round(1).to_string(index=False))
     start [m]  end [m]  IRI [mm/m]
           0.0    250.0         4.2
         250.0    500.0         4.4
         500.0    750.0         4.3
         750.0   1000.0         3.9
    """
    checks.of_kind("profile", profile, Profile)
    step, name = profile.step, "a profile for the roughness index"
    if step > _COARSEST * (1 + _SLACK):
        raise ValueError(f"{name} must have steps of at most {_COARSEST} m, got {step:g} m")
    if (length := step * (profile.distance.size - 1)) < _START + BASE:
        raise ValueError(f"{name} must be at least {_START + BASE} m long, got {length:g} m")
    base = max(_half_up(BASE / step), 1) if average else 1
    slope = (profile.height[base:] - profile.height[:-base]) / (base * step)
    start = _half_up(_START / step)
    first = (profile.height[start] - profile.height[0]) / (start * step)
    travel = 1e3 * np.abs(_response(slope, first, step / SPEED))
    return RoughnessIndex(
        tracks=tuple(travel.mean(axis=0).tolist()),
        distance=frozen_array(profile.distance[0] + step * np.arange(1, len(slope) + 1)),
        travel=frozen_array(travel),
        length=step * profile.distance.size,
    )


def _half_up(number: float) -> int:
    """Return the nearest whole number, of two the larger as in Sayers' program."""
    return math.floor(number + 0.5 + _ROUNDED)


def _response(slope: Real, first: Real, dt: float) -> Real:
    """Return the travel slope (k, t) at the end of steps of `dt` [s] of slopes (k, t), after a steady slope (t,).

    Every mode is a recursion of first order. Poles are conjugate pairs: one of each is taken, twice.
    """
    from scipy import signal

    car = golden_car()
    poles, modes = np.linalg.eig(car.A)
    state = np.linalg.solve(modes, -np.linalg.solve(car.A, car.B))[:, 0]  # per steady slope
    gain = (car.C @ modes)[0]
    travel = np.zeros_like(slope)
    for i in np.flatnonzero(poles.imag > 0):
        decay = np.exp(poles[i] * dt)
        # x+ = decay x + (1 - decay) state u, with the input held over the step
        begun = (decay * state[i] * first)[None, :]
        driven, _ = signal.lfilter([(1 - decay) * state[i]], [1, -decay], slope + 0j, axis=0, zi=begun)
        travel += 2 * (gain[i] * driven).real
    return travel

"""International Roughness Index of a profile: how far the suspension of a reference car travels per distance."""

import math
from dataclasses import dataclass, field

import control
import numpy as np

from ..quantities import Real, Record, unit
from ..roads.profiles import Profile
from ..vehicles.cars import QuarterCar

SPEED = 80 / 3.6
"""Speed of the reference quarter car [m/s]."""
_BASE = 0.25  # length over which a tyre averages the profile [m]
_START = 11.0  # length whose mean slope the car begins with [m]: half a second of driving
_COARSEST = 0.3  # longest step of a profile [m]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class RoughnessIndex(Record):
    """International Roughness Index of a profile."""

    tracks: tuple[float, ...] = field(metadata=unit("mm/m"))  # by track

    @property
    def mean(self) -> float:
        """Mean of the indices of the tracks [mm/m]."""
        return sum(self.tracks) / len(self.tracks)


def golden_car() -> control.StateSpace:
    """Return the golden car from ``road`` to ``suspension_travel``, heights [m] or slopes [m/m], per body mass.

    M. W. Sayers, "On the calculation of International Roughness Index from longitudinal road profile",
    Transportation Research Record 1501 (1995); ASTM E1926.
    """
    car = QuarterCar(body_mass=1.0, wheel_mass=0.15, tyre_stiffness=653.0)
    return car.closed(spring=63.3, damper=6.0)["suspension_travel", "road"]


def international_roughness_index(profile: Profile) -> RoughnessIndex:
    """Return the International Roughness Index of every track of a profile, in mm/m, which is m/km.

    The profile's slope, averaged over 250 mm (the nearest whole number of steps, half a step up and one at least:
    steps of more than 167 mm are not averaged), drives the golden car at 80 km/h. The response is exact for an
    averaged profile that is straight between its points. The car begins at rest on the mean slope of the first
    11 m. The index is the mean magnitude of the difference of the slopes of body and wheel (Sayers 1995).

    Parameters
    ----------
    profile : Profile
        In steps of at most 300 mm and at least 11.25 m long. How the car begins tells in the index of a short
        road: some 20 m of lead, and 100 m of road, are good practice.

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
    """
    step, name = profile.step, "a profile for the roughness index"
    if step > _COARSEST * (1 + 1e-9):
        raise ValueError(f"{name} must have steps of at most {_COARSEST} m, got {step:g} m")
    if (length := step * (profile.distance.size - 1)) < _START + _BASE:
        raise ValueError(f"{name} must be at least {_START + _BASE} m long, got {length:g} m")
    base = max(math.floor(round(_BASE / step, 9) + 0.5), 1)  # half up, as in Sayers' program
    slope = (profile.height[base:] - profile.height[:-base]) / (base * step)
    start = round(_START / step)
    first = (profile.height[start] - profile.height[0]) / (start * step)
    indices = (_mean_rectified(slope[:, i], first[i], step / SPEED) for i in range(slope.shape[1]))
    return RoughnessIndex(tracks=tuple(1e3 * index for index in indices))


def _mean_rectified(slope: Real, first: float, dt: float) -> float:
    """Return the mean magnitude of the response to slopes (k,) of `dt` [s] each, after steady slope `first`."""
    car = golden_car()
    at_rest = -np.linalg.solve(car.A, car.B)[:, 0] * first
    sampled = control.sample_system(car, dt, method="zoh")
    # a response at the end of each step, where the next slope would begin
    driven = np.append(slope, slope[-1])
    answer = control.forced_response(sampled, inputs=driven, initial_state=at_rest)
    return float(np.abs(answer.outputs[1:]).mean())

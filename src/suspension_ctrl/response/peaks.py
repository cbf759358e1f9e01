"""Peaks of responses in an event for many designs at once."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ..quantities import Bool, Real, frozen_array
from ..roads.events import Event
from ..vehicles.networks import has_force_laws
from ..vehicles.vehicle import AssembledVehicle, Vehicle
from .driven_peaks import driven_peaks
from .passing import passing

_PADDING = (4.0, 6.0, 9.0, 14.0, 21.0, 32.0, 48.0, 72.0)  # s of level road behind an event, as long as needed
_KEPT = 8  # peaks of populations
_AT_ONCE = 8192  # designs times frequencies: arrays that stay in the cache of a processor


def peaks(
    vehicle: Vehicle, coefficients: Real, event: Event, speed: float, responses: Sequence[str]
) -> tuple[Real, Real]:
    """Return the largest and the smallest values (p, m) of responses with struts of coefficients (p, c).

    Raises
    ------
    ValueError
        If a response has not decayed within 72 s after the event, or a vehicle with force laws has no response in
        time.
    """
    return _peaks(vehicle, coefficients.tobytes(), len(coefficients), event, speed, tuple(responses))


@lru_cache(_KEPT)
def _peaks(
    vehicle: Vehicle, numbers: bytes, designs: int, event: Event, speed: float, responses: tuple[str, ...]
) -> tuple[Real, Real]:
    """Return the peaks of designs, kept for other load cases with the event and for the other direction."""
    coefficients = np.frombuffer(numbers).reshape(designs, -1)
    judge = driven_peaks if has_force_laws(vehicle.networks) or _on_road(vehicle) else passing_peaks
    highest, lowest, rested = judge(vehicle, coefficients, event, speed, responses)
    if not rested.all():
        names = [one.name for one in vehicle.strut_coefficients]
        values = dict(zip(names, coefficients[int(rested.argmin())].tolist(), strict=True))
        raise ValueError(f"response to an event must decay within 72 s, got coefficients {values}")
    return frozen_array(highest), frozen_array(lowest)


def _on_road(vehicle: Vehicle) -> bool:
    """Whether a strut stands on a road: the kinks of its tension then depend on the design."""
    return isinstance(vehicle, AssembledVehicle) and bool(vehicle.assembly.standing.any())


def passing_peaks(
    vehicle: Vehicle, coefficients: Real, event: Event, speed: float, responses: Sequence[str]
) -> tuple[Real, Real, Bool]:
    """Return the largest and the smallest values (p, m), see `peaks`, and which designs (p,) come to rest."""
    highest, lowest = np.empty((2, len(coefficients), len(responses)))
    rested = np.zeros(len(coefficients), dtype=bool)
    for padding in _PADDING:
        left = np.flatnonzero(~rested)
        event_passed = passing(vehicle, event, speed, tuple(responses), padding)
        for part in np.array_split(left, max(1, left.size * event_passed.omega.size // _AT_ONCE)):
            history = event_passed.histories(event_passed.stiffness(vehicle, coefficients[part]))
            highest[part], lowest[part] = event_passed.crest(history).T, -event_passed.crest(-history).T
            rested[part] = event_passed.decayed(history)
        if rested.all():
            break
    return highest, lowest, rested

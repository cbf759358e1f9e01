"""Peaks of responses in an event for many designs at once."""

from collections.abc import Sequence

import numpy as np

from ..quantities import Real
from ..roads.events import Event
from ..vehicles.vehicle import Vehicle
from .passing import passing

_PADDING = (4.0, 6.0, 9.0, 14.0, 21.0, 32.0, 48.0, 72.0)  # s of level road behind an event, as long as needed
_AT_ONCE = 8192  # designs times frequencies: arrays that stay in the cache of a processor


def peaks(
    vehicle: Vehicle, coefficients: Real, event: Event, speed: float, responses: Sequence[str]
) -> tuple[Real, Real]:
    """Return the largest and the smallest values (p, m) of responses with struts of coefficients (p, c).

    Raises
    ------
    ValueError
        If the vehicle has force laws, or a response has not decayed within 72 s after the event.
    """
    highest, lowest = np.empty((2, len(coefficients), len(responses)))
    left = np.arange(len(coefficients))
    for padding in _PADDING:
        event_passed = passing(vehicle, event, speed, tuple(responses), padding)
        decayed = []
        for part in np.array_split(left, max(1, left.size * event_passed.omega.size // _AT_ONCE)):
            history = event_passed.histories(event_passed.stiffness(vehicle, coefficients[part]))
            highest[part], lowest[part] = event_passed.crest(history).T, -event_passed.crest(-history).T
            decayed.append(event_passed.decayed(history))
        left = left[~np.concatenate(decayed)]
        if not left.size:
            return highest, lowest
    values = dict(
        zip((one.name for one in vehicle.strut_coefficients), coefficients[left[0]].tolist(), strict=True)
    )
    raise ValueError(f"response to an event must decay within {_PADDING[-1]:g} s, got coefficients {values}")

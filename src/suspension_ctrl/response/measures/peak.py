"""Peaks of responses in an event."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ... import checks
from ...quantities import Real, signal_unit
from ...vehicles.assembly import joined
from ...vehicles.vehicle import Vehicle
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import CaseMeasure, Designs

_SIDES = ("both", "max", "min")
_TRAVEL = re.compile(r"(^|.*_)travel(_rate)?")
_TEXT = re.compile(r"(?:(max|min)\s+)?(\w+)\s+(\w+)")


@dataclass(frozen=True, eq=False, repr=False)
class Peak(Measure, word="peak"):
    """Peak of a response in an event: the largest magnitude, or the largest value upwards or downwards.

    A peak is a change from rest on level ground. Of steady waves it is the peak of the steady state. A vehicle
    with force laws is integrated in time for every design until its responses decay; the peaks are within 0.1 %,
    a ``body_jerk`` is the largest slope of an acceleration between rows 1 ms apart at most. Tyres are linear and
    may pull on the road, as `simulate` does by default: beyond the static load, ``"peak max tyre_load bump"``, a
    peak is one of a tyre that does not leave the road.

    Parameters
    ----------
    response : str
        A response, ``"body_acceleration"``; of an axle or of all wheels the largest, ``"front_tyre_load"``,
        ``"tyre_load"``. ``travel`` is short for ``suspension_travel``: ``"front_travel"``.
    event : str
        Name of an event of the load case.
    side : str
        "both", "max" for the largest value, of a travel the extension, "min" for the largest value downwards as a
        positive number, of a travel the compression.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    Twice the damping lowers the travel over a bump and raises the acceleration:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> problem = sc.RideProblem(
    ...     car,
    ...     sc.Iso8608Road("C"),
    ...     speed=20.0,
    ...     events={"bump": (sc.SpeedBump(height=0.05, length=2.0), 8.0)},
    ...     measures=[sc.Peak("body_acceleration", "bump"), "peak min travel bump"],
    ...     bounds={"spring": (10e3, 30e3), "damper": (500.0, 5e3)},
    ... )
    >>> for acceleration, compression in problem.evaluate([[22e3, 1e3], [22e3, 2e3]]):
    ...     print(f"acceleration {acceleration:.1f} m/s^2, compression {1e3 * compression:.0f} mm")
    acceleration 3.9 m/s^2, compression 39 mm
    acceleration 6.0 m/s^2, compression 35 mm
    """

    response: str
    event: str
    side: str = "both"

    def __post_init__(self) -> None:
        super().__post_init__()
        for name, value in (("response", self.response), ("event", self.event)):
            if not (isinstance(value, str) and re.fullmatch(r"\w+", value)):
                raise ValueError(f"{name} must be a name, got {checks.shown(value)}")
        checks.one_of("side", self.side, _SIDES)
        self._keep(unit=signal_unit(self.response))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        found = _TEXT.fullmatch(rest)
        if not found:
            needed = (
                "followed by a response and an event, max or min before them, as in 'peak min front_travel bump'"
            )
            raise ValueError(f"{cls.word} must be {needed}, got {checks.shown(rest)}")
        return cls(found[2], found[3], found[1] or "both", **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if it lacks the response or the event."""
        from ..driven_peaks import at_rest  # integration in time, which few problems need
        from ..driving import simulate
        from ..peaks import peaks

        event, speed = case.drive(self.event)
        responses = responses_at(case.vehicle, self.response)
        event.elevation(np.zeros(1), case.vehicle.contact_points, speed)  # which the wheels of a rig may refuse

        def values(designs: Designs) -> Real:
            found = [peaks(one, given, event, speed, responses) for one, given in designs.vehicles()]
            highest, lowest = map(np.concatenate, zip(*found, strict=True))
            sides = {"max": [highest], "min": [-lowest], "both": [highest, -lowest]}[self.side]
            return np.asarray(np.concatenate(sides, axis=1).max(axis=1))

        def in_event(vehicle: Vehicle, setting: Mapping[str, float], lift_off: bool) -> float:
            table = simulate(vehicle, setting, event, speed, responses=responses, lift_off=lift_off)
            history = table[table.columns[-len(responses) :]].to_numpy()
            history = history - at_rest(vehicle, setting, responses, lift_off)
            highest, lowest = history.max(), history.min()
            return float({"max": highest, "min": -lowest, "both": max(highest, -lowest)}[self.side])

        return CaseMeasure(values=values, in_event=in_event)

    def _rest(self) -> str:
        return " ".join([*([] if self.side == "both" else [self.side]), self.response, self.event])


def responses_at(vehicle: Vehicle, text: str) -> list[str]:
    """Return the responses of a text: one by its name, those of an axle, or of all wheels; ValueError if none."""
    known = vehicle.meanings
    if _TRAVEL.fullmatch(text) and "suspension_travel" not in text:
        text = text.replace("travel", "suspension_travel")
    axles = {tyre: tyre.rpartition("_")[0] for tyre in vehicle.tyres}
    at_axle = [
        joined(tyre, text.removeprefix(f"{axle}_")) for tyre, axle in axles.items() if text.startswith(f"{axle}_")
    ]
    at_wheels = [joined(tyre, text) for tyre in vehicle.tyres]
    for names in ([text], at_axle, at_wheels):
        if found := [name for name in names if name in known]:
            return found
    raise ValueError(f"response must be one of {checks.listing(known, text)}, got {checks.shown(text)}")

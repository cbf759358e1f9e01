"""A load case: a vehicle with a payload on a road at a speed."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, Protocol

import numpy as np

from .. import checks
from ..quantities import Complex, FrozenMapping, Real, Record, unit
from ..roads.events import Event
from ..vehicles.handling import RollGeometry
from ..vehicles.vehicle import Vehicle


class Road(Protocol):
    """A road of one wheel; one of several wheels has ``cross_spectrum(f, speed, contact_points)`` too."""

    def psd(self, f: Real, speed: float) -> Real:
        """Return the one-sided spectrum (n,) [m^2/Hz] at the frequencies `f` (n,) [Hz] at a speed [m/s]."""


class Drive(NamedTuple):
    """An event at a speed [m/s], None for that of the load case; a test rig has none."""

    event: Event
    speed: float | None = None


_NO_EVENTS: FrozenMapping[str, Any] = FrozenMapping({})


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LoadCase(Record):
    """A vehicle with its payload on a road at a speed.

    Parameters
    ----------
    vehicle : Vehicle
        With its payload.
    road : Road
        E.g. a `PowerLawRoad`. Under one wheel any object with ``psd(f, speed)`` is one, under several if it has
        ``cross_spectrum`` too; kinks of its spectrum stand in ``breakpoints(speed)``, if it has that [Hz].
    speed : float
        Vehicle speed V > 0 [m/s].
    share : float
        Share of time, > 0; cases count by their shares of the sum.
    roll_geometry : RollGeometry, optional
        For measures of cornering.
    events : mapping of str to Event or (Event, float), optional
        Events by name for `Peak`, driven at the speed of the load case or at one of their own [m/s].

    Examples
    --------
    A car drives for 80 % of its time alone at 30 m/s, and for 20 % laden at 20 m/s:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("minaker_half")
    >>> laden = sc.Payload(mass=250.0, position=(-1.5, 0.0)).on(file.vehicle)
    >>> road = sc.Iso8608Road("C")
    >>> cases = [
    ...     sc.LoadCase(vehicle=file.vehicle, road=road, speed=30.0, share=0.8),
    ...     sc.LoadCase(vehicle=laden, road=road, speed=20.0, share=0.2),
    ... ]
    >>> problem = sc.RideProblem(cases=cases, bounds=file.bounds, band=(0.3, 20.0))
    >>> acc, sws, dtl = problem.evaluate([list(file.setting.values())])[0]
    >>> print(f"ACC {acc:.2f} m/s^2, SWS {1e3 * sws:.1f} mm, DTL {dtl:.0f} N")
    ACC 0.57 m/s^2, SWS 27.7 mm, DTL 1795 N
    """

    vehicle: Vehicle
    road: Road
    speed: float = field(metadata=unit("m/s"))
    share: float = 1.0
    roll_geometry: RollGeometry | None = None
    events: Mapping[str, Any] = _NO_EVENTS

    def __post_init__(self) -> None:
        if not isinstance(self.vehicle, Vehicle):
            raise ValueError(f"vehicle must be a Vehicle such as a QuarterCar, got {checks.shown(self.vehicle)}")
        if not hasattr(self.road, "psd"):
            raise ValueError(f"road must be a road such as Iso8608Road('C'), got {checks.shown(self.road)}")
        if self.wheels > 1 and not hasattr(self.road, "cross_spectrum"):
            raise ValueError(
                f"road must have a cross_spectrum for {self.wheels} wheels, got {checks.shown(self.road)}"
            )
        checks.positive("speed", self.speed, "m/s")
        checks.positive("share", self.share)
        self._keep(events=_checked_events(self.events))

    def describe(self) -> str:
        """Return road and speed in words."""
        return f"{self.describe_road()}; {self.speed:.4g} m/s"

    def describe_road(self) -> str:
        """Return the road in words."""
        return self.road.describe() if hasattr(self.road, "describe") else repr(self.road)

    def drive(self, name: str) -> tuple[Event, float]:
        """Return an event with its speed [m/s]; ValueError if the load case has none of this name."""
        if name not in self.events:
            known = checks.listing(self.events, name) or "those in events=, of which there are none"
            raise ValueError(f"event must be one of {known}, got {checks.shown(name)}")
        event, speed = self.events[name]
        return event, self.speed if speed is None else speed

    @property
    def wheels(self) -> int:
        """Number of roads under the vehicle."""
        return len(self.vehicle.contact_points)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Frequencies at which the road's spectrum has a kink [Hz]."""
        return tuple(self.road.breakpoints(self.speed)) if hasattr(self.road, "breakpoints") else ()

    def psd(self, f: Real) -> Real:
        """Return the road's spectrum (n,) under a wheel [m^2/Hz], for `f` (n,) [Hz]."""
        spectrum = np.asarray(self.road.psd(f, self.speed), dtype=float)
        if spectrum.shape != f.shape or not (np.isfinite(spectrum) & (spectrum >= 0)).all():
            wanted = f"{f.size} finite values >= 0 m^2/Hz"
            raise ValueError(f"psd of the road must return {wanted}, got shape {spectrum.shape}")
        return spectrum

    def cross_spectrum(self, f: Real) -> Complex:
        """Return the cross-spectra (n, r, r) of the road under the wheels [m^2/Hz], for `f` (n,) [Hz]."""
        if self.wheels == 1:
            return self.psd(f)[:, None, None].astype(complex)
        road: Any = self.road
        return np.asarray(road.cross_spectrum(f, self.speed, self.vehicle.contact_points))


def _checked_events(events: object) -> FrozenMapping[str, Drive]:
    """Return the events by name, each with its speed; ValueError for others."""
    if not isinstance(events, Mapping):
        raise ValueError(f"events must be a mapping of events by name, got {checks.shown(events)}")
    found = {name: Drive(*one) if isinstance(one, tuple) else Drive(one) for name, one in events.items()}
    for name, (event, speed) in found.items():
        if not (isinstance(name, str) and re.fullmatch(r"\w+", name)):
            raise ValueError(
                f"events must have names of letters, digits and underscores, got {checks.shown(name)}"
            )
        if not isinstance(event, Event):
            raise ValueError(f"event {name} must be one such as SpeedBump, got {checks.shown(event)}")
        if speed is not None:
            checks.positive(f"speed of event {name}", speed, "m/s")
    return FrozenMapping(found)


def load_cases(
    cases: Sequence[LoadCase], events: Mapping[str, Any] | None = None, **given: Any
) -> tuple[LoadCase, ...]:
    """Return the cases with a `given` vehicle, road or speed in place of theirs, or the one case of all three.

    Events, if given, take the place of theirs.
    """
    own: dict[str, Any] = {} if events is None else {"events": events}
    given = {name: value for name, value in given.items() if value is not None}
    if isinstance(cases, LoadCase):
        raise ValueError("cases must be a list of load cases, got one by itself")
    checks.listed("cases", cases)
    if len(cases) > 1 and len(given) == 3:
        raise ValueError("cases must stand in place of vehicle, road and speed, got both")
    if len(cases) == 0:
        if len(given) < 3:
            raise ValueError("vehicle, road and speed must be given, or cases in their place, got neither")
        return (LoadCase(**given | own),)
    if not all(isinstance(case, LoadCase) for case in cases):
        raise ValueError(f"cases must be a list of load cases, got {checks.shown(list(cases))}")
    return tuple(replace(case, **given | own) for case in cases)

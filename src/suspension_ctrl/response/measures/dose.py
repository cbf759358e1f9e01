"""Measures of a time of exposure to stationary vibration: daily exposure A(8), vibration dose, motion sickness.

Weighted accelerations are Gaussian: the mean of the fourth power is three times the squared mean square, so that
the vibration dose value over a time T is ``(3 T)^(1/4) a_w``. The axes count with the factors k of ISO 2631-1,
7.2.3, and of Directive 2002/44/EC, Annex, part B: 1 vertically, 1.4 horizontally; the largest is the exposure.
Horizontally a body moves by its rotation alone: at a height h above its centre of gravity by h times the angular
acceleration of pitch and of roll. Motion of the whole vehicle in the plane of the road is not known, nor is the
component of gravity on a tilted seat.
"""

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import checks
from ...quantities import Real, quantity, unit
from ...vehicles.assembly import Position, turning
from ...vehicles.vehicle import AssembledVehicle, Vehicle
from ..axes import DAY, HORIZONTAL, VERTICAL, Axis
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import NUMBER, POINT, CaseMeasure, Designs, Term, number_text, place_text
from .vibration import AccelerationMeasure

if TYPE_CHECKING:
    from ..trips import Trip

_HOUR = 3600.0  # s
_LONGEST = 1e9  # s
_TEXT = re.compile(rf"((?!at\b)[A-Za-z_]\w*|{POINT})?\s*({NUMBER}\s*[a-z]+)?\s*(?:\bat\s+({NUMBER}\s*[A-Za-z]*))?")


@dataclass(frozen=True, eq=False, repr=False)
class DoseMeasure(AccelerationMeasure):
    """A measure over a time of exposure [s]."""

    duration: float = field(default=DAY, metadata=unit("s"))

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.within("duration", self.duration, 1.0, _LONGEST)
        self._keep(duration=float(self.duration))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        found = _TEXT.fullmatch(rest)
        if not found or (found[5] and "height" not in cls.__dataclass_fields__):
            raise ValueError(f"{cls.word} must be {cls._needed()}, got {checks.shown(rest)}")
        place, x, y, duration, height = found.groups()
        where = place or "" if x is None else (float(x), float(y))
        given: dict[str, Any] = {} if duration is None else {"duration": quantity("duration", duration, "s")}
        given |= {} if height is None else {"height": quantity("height", height, "m")}
        return cls(where, **given, **options)

    @classmethod
    def _needed(cls) -> str:
        return f"followed by a place and a time, as in '{cls.word} driver 2h'"

    def _rest(self) -> str:
        return self._place_and_time()

    def _place_and_time(self) -> str:
        parts = [place_text(self.where), "" if self.duration == self._default() else _time_text(self.duration)]
        return " ".join(filter(None, parts))

    @classmethod
    def _default(cls) -> object:
        return cls.__dataclass_fields__["duration"].default


@dataclass(frozen=True, eq=False, repr=False)
class AxesMeasure(DoseMeasure):
    """A measure over a time of exposure of the worst of the axes, horizontal ones by a height [m]."""

    height: float | None = field(default=None, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.height is not None:
            checks.within("height", self.height, -1e3, 1e3)
            self._keep(height=float(self.height))

    def axes(self, vehicle: Vehicle) -> tuple[Term, ...]:
        """Return the weighted acceleration of each axis that the vehicle has, with its factor k."""
        return (
            Term(self.response(vehicle), *VERTICAL),
            *horizontal_terms(vehicle, self.where, self.height, (HORIZONTAL, HORIZONTAL)),
        )

    @classmethod
    def _needed(cls) -> str:
        return f"followed by a place, a time and a height, as in '{cls.word} driver 4h at 0.6m'"

    def _rest(self) -> str:
        height = "" if self.height is None else f"at {number_text(self.height)}"
        return f"{self._place_and_time()} {height}".strip()


class A8(AxesMeasure, word="A8", unit="m/s^2"):
    """Daily exposure A(8): the weighted acceleration of the worst axis, as if it lasted eight hours.

    Directive 2002/44/EC has 0.5 m/s^2 as action value and 1.15 m/s^2 as limit value. Axes are weighted by Wk and
    Wd of ISO 2631-1 and count 1 vertically, 1.4 horizontally. Over load cases the squares of the worst axis of
    each case add up by their shares of the time: never less than the worst of the sums by axis, which the
    Directive compares.

    Parameters
    ----------
    where : str or (float, float)
        A seat by name or a point (x, y) of the body [m]; the body's centre of gravity by default.
    duration : float
        Time of exposure in a day, 1 to 1e9 [s]; eight hours by default.
    height : float, optional
        Height of the seat above the centre of gravity of the body on which it stands [m], for the horizontal axes:
        there the accelerations of pitch and roll act, no others are known. Without it the vertical axis counts
        alone.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> measures = ["A8", "A8 2h", sc.A8((0.2, 0.4), 7200.0, height=0.5)]
    >>> table = sc.ride(file.vehicle, file.setting, sc.Iso8608Road("C"), speed=20.0, measures=measures)
    >>> print(table.head(3)[["value", "unit"]].round(2).to_string(index_names=False))
                             value   unit
    A8                        0.78  m/s^2
    A8 2h                     0.39  m/s^2
    A8 (0.2, 0.4) 2h at 0.5   0.41  m/s^2
    """

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        share = (self.duration / DAY) ** 0.5
        terms = (Term(one.response, one.weighting, one.factor * share) for one in self.axes(case.vehicle))
        return CaseMeasure(tuple(terms), largest=True)


class VDV(AxesMeasure, word="VDV", unit="m/s^1.75"):
    """Vibration dose value of stationary vibration: the worst axis, ``(3 T)^(1/4)`` times its r.m.s. value.

    Directive 2002/44/EC has 9.1 m/s^1.75 as action value and 21 m/s^1.75 as limit value. Over load cases
    fourth powers add up by their shares of the time, of the worst axis of each as of `A8`.

    Parameters
    ----------
    where, duration, height, name, maximise
        As of `A8`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> road = sc.Iso8608Road("C")
    >>> table = sc.ride(file.vehicle, file.setting, road, speed=20.0, measures=["ACC", "VDV", "VDV 2h"])
    >>> print(table["value"].head(3).round(2).to_list(), round(table["value"]["ACC"] * (3 * 8 * 3600) ** 0.25, 2))
    [0.78, 13.37, 9.45] 13.37
    """

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        terms = self.axes(case.vehicle)
        factors = np.array([term.factor for term in terms])

        def values(designs: Designs) -> Real:
            worst = (factors * np.sqrt(designs.mean_squares(terms))).max(axis=1)
            return np.asarray((3 * self.duration) ** 0.25 * worst)

        def in_trip(trip: "Trip", _coefficients: Real) -> float:
            fourth = max(float(np.mean(trip.weighted(term) ** 4)) for term in terms)
            return (self.duration * fourth) ** 0.25

        return CaseMeasure(terms, values=values, power=4.0, in_trip=in_trip)


@dataclass(frozen=True, eq=False, repr=False)
class MSDV(DoseMeasure, word="MSDV", unit="m/s^1.5"):
    """Motion sickness dose value of vertical motion, ``a_w T^(1/2)`` with Wf (ISO 2631-1, annex D).

    A third of it is about the percentage of people who may vomit (there). The band of the ride must reach down
    to 0.1 Hz.

    Parameters
    ----------
    where : str or (float, float)
        As of `A8`.
    duration : float
        Time of exposure, 1 to 1e9 [s]; one hour by default.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> measures = ["MSDV", sc.MSDV(duration=4 * 3600.0)]
    >>> table = sc.ride(file.vehicle, file.setting, sc.Iso8608Road("C"), speed=20.0, measures=measures)
    >>> table["value"].head(2).round(2).to_dict()
    {'MSDV': 2.15, 'MSDV 4h': 4.31}
    """

    duration: float = field(default=_HOUR, metadata=unit("s"))

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        return CaseMeasure((Term(self.response(case.vehicle), "Wf", self.duration**0.5),))


def horizontal_terms(
    vehicle: Vehicle, place: str | Position, height: float | None, axes: tuple[Axis, Axis]
) -> list[Term]:
    """Return longitudinal and lateral acceleration at a height [m] above a body by its pitch and roll.

    The axes have weighting and factor k of both.
    """
    turns, both = rotations(vehicle, place), zip(("pitch", "roll"), axes, strict=True)
    return [Term(turns[turn], name, k * abs(height)) for turn, (name, k) in both if height and turn in turns]


def rotations(vehicle: Vehicle, place: str | Position) -> dict[str, str]:
    """Return the accelerations in pitch and roll of the body at a place, as far as the vehicle has these.

    The body is that on which a seat stands, of a plant ``body``.
    """
    body = "body"
    if isinstance(vehicle, AssembledVehicle) and isinstance(place, str) and place:
        body = vehicle.assembly.body_below(vehicle.meanings[f"{place}_acceleration"].where)
    names = {turn: f"{turning(body, turn)}_acceleration" for turn in ("pitch", "roll")}
    return {turn: name for turn, name in names.items() if name in vehicle.meanings}


def _time_text(seconds: float) -> str:
    """Return a time as a text."""
    return f"{number_text(seconds / _HOUR)}h" if seconds % 36 == 0 else f"{number_text(seconds)}s"

"""Measures of a Gaussian response by its spectral moments: crossings, lift-off, largest peak.

The response of a linear vehicle to a Gaussian road is Gaussian. Its standard deviation s and that of its rate, s',
are the roots of the moments of order 0 and 2. It crosses a level a upwards ``s'/(2 pi s) exp(-a^2/(2 s^2))`` times
a second [1]_. The expected largest value of n upward crossings of the mean is ``s (g + 0.5772/g)`` with
``g = sqrt(2 ln n)`` [2]_. Force laws and stops that are met change the distribution: the formulas then tell how
often they are met, not what follows.

.. [1] S. O. Rice, "Mathematical analysis of random noise", Bell System Technical Journal 24 (1945).
.. [2] A. G. Davenport, "Note on the distribution of the largest value of a random function with application to
   gust loading", Proceedings of the Institution of Civil Engineers 28 (1964).
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from math import e
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ... import checks
from ...quantities import Real, quantity, signal_unit, unit
from ...vehicles.networks import gap_of_stop
from ...vehicles.stops import BumpStop, ReboundStop
from ...vehicles.vehicle import Vehicle, assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .peak import responses_at
from .terms import NUMBER, CaseMeasure, Designs, Term, number_text, place_text
from .vibration import WheelMeasure

if TYPE_CHECKING:
    from ..trips import Trip

_GAP = re.compile(rf"([A-Za-z_]\w*)?\s*({NUMBER}\s*[A-Za-z]*)?")
_LARGEST = re.compile(rf"(\w+)\s+({NUMBER}\s*[A-Za-z]*)")
_EULER = 0.5772156649015329
_KM = 1000.0  # m


@dataclass(frozen=True, eq=False, repr=False)
class Bottoming(WheelMeasure, word="bottoming", unit="1/km"):
    """Expected strikes of the bump stop per kilometre: crossings of its gap by the travel in compression.

    Of several struts the one that strikes most. The travel is Gaussian, as without the stop; force laws, and
    payload on them, move its mean from the static position.

    Parameters
    ----------
    where : str
        An axle, a wheel or a seat: ``"front"``; all wheels by default.
    gap : float, optional
        Travel in compression up to the stop, > 0 [m]; without it the gap of the `BumpStop` beside the spring.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.Bottoming("front", gap=0.06), 1.0))
    bottoming front 0.06 <= 1
    """

    gap: float | None = field(default=None, metadata=unit("m"))
    kind: ClassVar[str] = "travel"
    side: ClassVar[float] = -1.0
    stop: ClassVar[type[BumpStop]] = BumpStop

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.gap is not None:
            checks.positive("gap", self.gap, "m")

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        found = _GAP.fullmatch(rest)
        if not found:
            needed = f"followed by a place and a gap in m, as in '{cls.word} front 0.06'"
            raise ValueError(f"{cls.word} must be {needed}, got {checks.shown(rest)}")
        return cls(found[1] or "", gap=quantity("gap", found[2], "m") if found[2] else None, **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks the place."""
        vehicle, names = case.vehicle, self.responses(case.vehicle)
        struts = [vehicle.struts.index(str(vehicle.meanings[name].where)) for name in names]
        terms, pairs = _moments(names)
        gaps = self._gaps(vehicle, struts)

        def values(designs: Designs) -> Real:
            deviation, rate = pairs(designs)
            left = np.maximum(gaps(designs.coefficients) - self.side * designs.mean_travels()[:, struts], 0.0)
            a_second = rate / (2 * np.pi * deviation) * np.exp(-(left**2) / (2 * deviation**2))
            return np.asarray(_KM / case.speed * a_second.max(axis=1))

        def in_trip(trip: "Trip", coefficients: Real) -> float:
            gap = self.side * np.broadcast_to(gaps(coefficients[None]), (1, len(names))).T
            beyond = self.side * trip.of(names) >= self.side * gap
            strikes = (beyond & ~np.roll(beyond, 1, axis=1)).sum(axis=1)
            return float(_KM / (case.speed * trip.duration) * strikes.max())

        return CaseMeasure(terms, values=values, in_trip=in_trip)

    def _gaps(self, vehicle: Vehicle, struts: Sequence[int]) -> Callable[[Real], Real]:
        """Return a function from coefficients (p, c) to gaps of struts at the wheel (w,) or (p, w) [m]."""
        if self.gap is not None:
            given = np.full(len(struts), self.gap)
            return lambda _coefficients: given
        found = [gap_of_stop(vehicle.networks, strut, self.stop) for strut in struts]
        if None in found:
            lacking = vehicle.struts[struts[found.index(None)]] or "strut"
            needed = f"given a gap where no {self.stop.__name__} stands beside the spring"
            raise ValueError(
                f"{self.word} must be {needed}, as in '{self.word} front 0.06', got none at {lacking}"
            )
        names = [one.name for one in vehicle.strut_coefficients]
        index = [names.index(one[0]) for one in found if one]
        ratio = np.array([one[1] for one in found if one])
        return lambda coefficients: coefficients[:, index] / ratio

    def _rest(self) -> str:
        gap = "" if self.gap is None else number_text(self.gap)
        return f"{place_text(self.where)} {gap}".strip()


class Topping(Bottoming, word="topping", unit="1/km"):
    """Expected strikes of the rebound stop per kilometre, as `Bottoming` in extension.

    Parameters
    ----------
    where, name, maximise
        As of `Bottoming`.
    gap : float, optional
        Travel in extension up to the stop, > 0 [m]; without it the gap of the `ReboundStop` beside the spring.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Topping("rear", gap=0.08))
    topping rear 0.08
    """

    side = 1.0
    stop = ReboundStop


class Lift(WheelMeasure, word="lift", unit="-"):
    """Share of time in which a tyre would pull, of several the largest.

    Its dynamic load is Gaussian, and then beyond the static load.

    Parameters
    ----------
    where : str
        An axle or a wheel: ``"rear"``; all wheels by default.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.Lift("rear"), 1e-4))
    lift rear <= 0.0001
    """

    kind = "load"

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks masses or the place."""
        vehicle = assembled(case.vehicle)
        names = self.responses(vehicle)
        terms, tyres = tuple(map(Term, names)), [str(vehicle.meanings[name].where) for name in names]
        index = [vehicle.tyres.index(tyre) for tyre in tyres]

        def values(designs: Designs) -> Real:
            from scipy.special import ndtr

            deviation = np.sqrt(designs.mean_squares(terms))
            static = designs.by_vehicle(lambda one, given: one.statics.static_loads(given))[:, index]
            return np.asarray(ndtr(-static / deviation).max(axis=1))

        def in_trip(trip: "Trip", _coefficients: Real) -> float:
            return max(trip.lift_off[tyre].share if tyre in trip.lift_off else 0.0 for tyre in tyres)

        return CaseMeasure(terms, values=values, in_trip=in_trip)


@dataclass(frozen=True, eq=False, repr=False)
class LargestPeak(Measure, word="largest"):
    """Expected largest value of a Gaussian response over a distance, upwards as downwards.

    Parameters
    ----------
    response : str
        A response, as of `Peak`; of several wheels the largest.
    distance : float
        Distance driven, > 0 [m].
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> car = sc.load_vehicle("yuen_ramli_2010")
    >>> measures = ["largest travel 1000", "largest travel 100000"]
    >>> table = sc.ride(car.vehicle, car.setting, sc.Iso8608Road("C"), speed=20.0, measures=measures)
    >>> (1e3 * table["value"].head(2)).round(1).to_dict()
    {'largest travel 1000': 37.6, 'largest travel 100000': 50.4}
    """

    response: str
    distance: float = field(metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not (isinstance(self.response, str) and re.fullmatch(r"\w+", self.response)):
            raise ValueError(f"response must be a name, got {checks.shown(self.response)}")
        checks.positive("distance", self.distance, "m")
        self._keep(unit=signal_unit(self.response))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        found = _LARGEST.fullmatch(rest)
        if not found:
            needed = "followed by a response and a distance in m, as in 'largest front_travel 1000'"
            raise ValueError(f"{cls.word} must be {needed}, got {checks.shown(rest)}")
        return cls(found[1], quantity("distance", found[2], "m"), **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks the response."""
        names = responses_at(case.vehicle, self.response)
        terms, pairs = _moments(names)

        def values(designs: Designs) -> Real:
            deviation, rate = pairs(designs)
            crossings = rate / (2 * np.pi * deviation) * self.distance / case.speed
            g = np.sqrt(2 * np.log(np.maximum(crossings, e)))
            return np.asarray((deviation * (g + _EULER / g)).max(axis=1))

        def in_trip(trip: "Trip", _coefficients: Real) -> float:
            points, history = round(self.distance / (case.speed * trip.time_step)), trip.of(names)
            parts = history.shape[1] // points
            if not parts:
                return np.nan
            each = history[:, : parts * points].reshape(len(names), parts, points)
            return float(max(each.max(axis=2).mean(axis=1).max(), -each.min(axis=2).mean(axis=1).min()))

        return CaseMeasure(terms, values=values, in_trip=in_trip)

    def _rest(self) -> str:
        return f"{self.response} {number_text(self.distance)}"


def _moments(responses: Sequence[str]) -> Any:
    """Return terms of responses (w), and a function to standard deviations of these and their rates (p, w)."""
    terms = [Term(name) for name in responses]
    rates = [Term(name, moment=2) for name in responses]

    def pairs(designs: Designs) -> tuple[Real, Real]:
        return np.sqrt(designs.mean_squares(terms)), np.sqrt(designs.mean_squares(rates))

    return (*terms, *rates), pairs

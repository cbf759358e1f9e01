"""Measures of comfort on a seat: vibration total value of several points and axes, SEAT factor."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ... import checks
from ...quantities import FrozenMapping, Real, quantity, unit
from ...vehicles.assembly import ResponseName
from ...vehicles.vehicle import AssembledVehicle, Vehicle
from ..axes import AXES, VERTICAL
from ..load_case import LoadCase
from ..weightings import Weighting
from .dose import horizontal_terms, rotations
from .measure import Measure
from .terms import NUMBER, CaseMeasure, Designs, Term, number_text, place_text
from .vibration import AccelerationMeasure, PlacedMeasure

if TYPE_CHECKING:
    from ..trips import Trip

POINTS = ("seat", "back", "feet")
"""Points of a seated person where vibration enters, ISO 2631-1, 8.2.2.1."""
_FLOOR = "_floor_acceleration"
_EVERY: Mapping[str, float | None] = FrozenMapping(dict.fromkeys(POINTS))
_TEXT = re.compile(rf"(seat|back|feet)\b\s*({NUMBER}\s*[A-Za-z]{{0,2}}(?![A-Za-z]))?\s*")


@dataclass(frozen=True, eq=False, repr=False)
class TotalValue(AccelerationMeasure, word="total", unit="m/s^2"):
    """Overall vibration total value of a seated person: root sum of squares over points and axes.

    The axes of seat, backrest and feet have the weightings and factors k of ISO 2631-1, 8.2.2.1: vertical Wk 1,
    Wd 0.4, Wk 0.4; longitudinal Wd 1, Wc 0.8, Wk 0.25; lateral Wd 1, Wd 0.5, Wk 0.25; roll and pitch of the seat
    We 0.63 and 0.4 m/rad. Axes that the vehicle does not have are left out: a quarter car has the vertical ones
    alone. Longitudinal and lateral motion is that of the body's pitch and roll at the height of a point, in a cab
    that of the cab; motion of the whole vehicle in the plane of the road and yaw are not known.

    Parameters
    ----------
    where : str or (float, float)
        A seat by name or a point (x, y) of the body [m]; the body's centre of gravity by default. The feet of a
        person on a seat stand on the body, or the seat, below it.
    points : mapping of str to float or None
        Points that count, ``"seat"``, ``"back"`` and ``"feet"``, each with its height above the centre of gravity
        of the body below [m], or None without longitudinal and lateral axes; by default all three without.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> seat = sc.Seat(mass=75.0, spring=15.7e3, damper=650.0, position=(0.2, 0.4), name="driver")
    >>> table = sc.ride(
    ...     seat.on(file.vehicle),
    ...     file.setting,
    ...     sc.Iso8608Road("C"),
    ...     speed=20.0,
    ...     measures=["ACC driver", "total driver at seat", sc.TotalValue("driver", {"seat": 0.3, "feet": -0.1})],
    ... )
    >>> print(table.head(3)[["value", "unit"]].round(2).to_string(index_names=False))
                                        value   unit
    ACC driver                           0.35  m/s^2
    total driver at seat                 0.38  m/s^2
    total driver at seat 0.3 feet -0.1   0.53  m/s^2
    """

    points: Mapping[str, float | None] = field(default=_EVERY, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.points, Mapping) or not self.points:
            needed = f"a mapping of {', '.join(POINTS)} to heights [m] or None"
            raise ValueError(f"points must be {needed}, got {checks.shown(self.points)}")
        for point, height in self.points.items():
            checks.one_of("points", point, POINTS)
            if height is not None:
                checks.within(f"height of {point}", height, -1e3, 1e3)
        kept = {point: self.points[point] for point in POINTS if point in self.points}
        self._keep(points=FrozenMapping({k: None if h is None else float(h) for k, h in kept.items()}))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        place, at, points = (part.strip() for part in re.split(r"(\bat\b|$)", rest, maxsplit=1))
        found = {one[1]: one[2] and quantity(one[1], one[2], "m") for one in _TEXT.finditer(points)}
        if _TEXT.sub("", points) or bool(at) != bool(found):
            needed = f"followed by a place and points with heights, as in '{cls.word} driver at seat 0.3 back 0.6'"
            raise ValueError(f"{cls.word} must be {needed}, got {checks.shown(rest)}")
        return super().read(place, **({"points": found} if found else {}), **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        return CaseMeasure(tuple(self._terms(case.vehicle)))

    def _terms(self, vehicle: Vehicle) -> Iterator[Term]:
        for point, height in self.points.items():
            x, y, z = (AXES[f"{point} {axis}"] for axis in "xyz")
            yield Term(self._below(vehicle) if point == "feet" else self.response(vehicle), *z)
            yield from horizontal_terms(vehicle, self.where, height, (x, y))
            if point == "seat":
                turns = rotations(vehicle, self.where)
                yield from (Term(name, *AXES[f"seat {turn}"]) for turn, name in turns.items())

    def _below(self, vehicle: Vehicle) -> ResponseName:
        """Return the acceleration below the feet: of the floor below a seat, or of the place itself."""
        floor, place = f"{self.where}{_FLOOR}", self.response(vehicle)
        if place == "body_acceleration" or isinstance(place, tuple):
            return place
        if not isinstance(vehicle, AssembledVehicle):  # a plant does not tell seats from bodies
            checks.one_of("response below the feet", floor, vehicle.meanings)
        return floor if floor in vehicle.meanings else place

    def _rest(self) -> str:
        parts = (f"{p} {'' if h is None else number_text(h)}".strip() for p, h in self.points.items())
        points = "" if self.points == _EVERY else f"at {' '.join(parts)}"
        return f"{place_text(self.where)} {points}".strip()


class SEAT(PlacedMeasure, word="SEAT", unit="-"):
    """SEAT factor: weighted acceleration of a seat over that of the floor below it, both by Wk (ISO 10326-1).

    Below 1 the seat isolates. Over load cases it is the mean by their shares.

    Parameters
    ----------
    where : str
        A seat by name.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.SEAT("driver"), 0.8))
    SEAT driver <= 0.8
    """

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such seat."""
        seats = [name.removesuffix(_FLOOR) for name in case.vehicle.meanings if name.endswith(_FLOOR)]
        if self.where not in seats:
            known = checks.listing(seats, self.where) or "seats, of which the vehicle has none"
            raise ValueError(f"{self.word} must be of one of {known}, got {checks.shown(self.where)}")
        terms = tuple(Term(f"{self.where}{part}", *VERTICAL) for part in ("_acceleration", _FLOOR))

        def values(designs: Designs) -> Real:
            seat, below = designs.mean_squares(terms).T
            return np.asarray(np.sqrt(seat / below))

        def in_trip(trip: "Trip", _coefficients: Real) -> float:
            return float(np.sqrt(trip.mean_square(terms[0]) / trip.mean_square(terms[1])))

        return CaseMeasure(terms, values=values, in_trip=in_trip)

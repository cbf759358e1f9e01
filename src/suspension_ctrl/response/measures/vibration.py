"""Measures of the vibration on a random road: root mean squares of responses, equations (3) to (13)."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ... import checks
from ...quantities import Real, signal_unit
from ...vehicles.assembly import Position, ResponseName, label, turns
from ...vehicles.varied import Varied
from ...vehicles.vehicle import Vehicle, assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure, likely
from .terms import NUMBER, POINT, CaseMeasure, Designs, Term, checked_point, place_text

_PLUS = re.compile(r"\+(?![^(]{0,99}\))")  # outside the parentheses of a point
_TERM = re.compile(rf"(?:({NUMBER})\s+)?(?:(\S+)\s+)?(\w+|acceleration\s*{POINT})")


@dataclass(frozen=True, eq=False, repr=False)
class PlacedMeasure(Measure):
    """A measure at a place of the vehicle: a name or a point (x, y) of the body [m]."""

    where: str | Position = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.where, str):
            self._keep(where=checked_point(self.where))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        point = re.fullmatch(POINT, rest)
        return cls((float(point[1]), float(point[2])) if point else rest, **options)

    def _rest(self) -> str:
        return place_text(self.where)


class AccelerationMeasure(PlacedMeasure):
    """A measure of the vertical acceleration at a seat, at a point of the body or at its centre of gravity."""

    def response(self, vehicle: Vehicle) -> ResponseName:
        """Return the acceleration at the place."""
        if not isinstance(self.where, str):
            return ("acceleration", *self.where)
        known = ((name, vehicle.meanings[name]) for name in vehicle.responses)
        vertical = [r for r, m in known if m.kind == "acceleration" and not turns(m.where)]
        if (name := f"{self.where or 'body'}_acceleration") not in vertical:
            places = checks.listing((r.removesuffix("_acceleration") for r in vertical), self.where)
            got = checks.shown(self.where)
            raise ValueError(f"{self.word} must be of one of {places} or a point (x, y), got {got}")
        return name


class ACC(AccelerationMeasure, word="ACC", unit="m/s^2"):
    """Root mean square of a vertical acceleration with the weighting of the problem, equation (6).

    Parameters
    ----------
    where : str or (float, float)
        A seat by name or a point (x, y) of the body [m]; the body's centre of gravity by default.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.ACC("driver"), sc.ACC((1.2, -0.4)), sc.ACC(name="comfort"), sep="; ")
    ACC driver; ACC (1.2, -0.4); comfort = ACC
    """

    def in_case(self, case: LoadCase, weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        return CaseMeasure((Term(self.response(case.vehicle), weighting),))


class WheelMeasure(PlacedMeasure):
    """The largest root mean square of responses of one kind: of all wheels, an axle, a strut or a seat."""

    kind: ClassVar[str]

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no such place."""
        return CaseMeasure(tuple(map(Term, self.responses(case.vehicle))), largest=True)

    def responses(self, vehicle: Vehicle) -> list[str]:
        """Return the responses at the place."""
        wheels = {*vehicle.tyres, *vehicle.wheel_struts}
        found = {
            str(response.where): name
            for name, response in vehicle.meanings.items()
            if response.kind == self.kind and (self.where or response.where in wheels)
        }
        ends = {self.where, f"{self.where}_left", f"{self.where}_right"}
        chosen = [name for end, name in found.items() if not self.where or end in ends]
        if not found:
            raise ValueError(f"{self.word} must be of a vehicle that has it by name, got one without")
        if not chosen:
            known = checks.listing(filter(None, found), self.where) or "all wheels"
            raise ValueError(f"{self.word} must be of one of {known}, got {checks.shown(self.where)}")
        return chosen


class SWS(WheelMeasure, word="SWS", unit="m"):
    """Suspension working space: root mean square of travel, of several struts the largest, equation (10).

    Parameters
    ----------
    where : str
        An axle, a strut or a seat: ``"front"``, ``"front_left"``, ``"driver"``; by default all struts on wheels,
        axles and beams, but not those of cabs and seats.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.SWS("front"))
    SWS front
    """

    kind = "travel"


class DTL(WheelMeasure, word="DTL", unit="N"):
    """Dynamic tyre load: root mean square of tyre load, of several tyres the largest, equation (13).

    Parameters
    ----------
    where : str
        An axle or a wheel: ``"rear"``, ``"rear_left"``; all wheels by default.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.DTL("rear_left"))
    DTL rear_left
    """

    kind = "load"


class DLC(DTL, word="DLC", unit="-"):
    """Dynamic load coefficient: root mean square of tyre load over static load, of several tyres the largest.

    Static loads are those on struts in the middle of their ranges; where parameters vary, those of each design.

    Parameters
    ----------
    where, name, maximise
        As of `DTL`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.DLC())
    DLC
    """

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle has no masses or no such place."""
        vehicle = assembled(case.vehicle)
        responses = self.responses(vehicle)
        if not isinstance(vehicle, Varied):
            return CaseMeasure(tuple(Term(name, relative=True) for name in responses), largest=True)
        terms = tuple(map(Term, responses))
        tyres = [vehicle.tyres.index(str(vehicle.meanings[name].where)) for name in responses]

        def values(designs: Designs) -> Real:
            static = designs.by_vehicle(lambda one, given: one.statics.static_loads(given))[:, tyres]
            return np.asarray((np.sqrt(designs.mean_squares(terms)) / static).max(axis=1))

        return CaseMeasure(terms, values=values)


@dataclass(frozen=True, eq=False, repr=False)
class RootSumSquare(Measure, word=""):
    """Root sum of squares of responses, each with a weighting and a factor.

    Parameters
    ----------
    terms : sequence of Term
        All accelerations, all travels or all loads; factors may carry further units.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    The vibration total value of a seated person, with the factors [m/rad] of ISO 2631-1, 8.2.2.1, for rotations:

    >>> import suspension_ctrl as sc
    >>> rotations = [sc.Term("roll_acceleration", "We", 0.63), sc.Term("pitch_acceleration", "We", 0.4)]
    >>> print(sc.RootSumSquare([sc.Term("driver_acceleration", "Wk"), *rotations]))
    Wk driver_acceleration + 0.63 We roll_acceleration + 0.4 We pitch_acceleration
    """

    terms: Sequence[Term]

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.listed("terms", self.terms)
        terms = tuple(self.terms)
        if not terms or any(not isinstance(term, Term) or term.moment or term.relative for term in terms):
            raise ValueError(f"terms must be a list of Term without moment, got {checks.shown(self.terms)}")
        self._keep(terms=terms, unit=signal_unit(label(terms[0].response)))

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text; options name and maximise."""
        return cls([_term(part.strip()) for part in _PLUS.split(rest)], **options)

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError for a response that the vehicle does not have."""
        for term in self.terms:
            if isinstance(term.response, str):
                _check_response(term.response, case)
        units = [signal_unit(label(term.response)) for term in self.terms]
        if len({unit.removeprefix("rad").removeprefix("m") for unit in units}) > 1:
            raise ValueError(f"measure must be a sum of responses of one kind, got {checks.shown(self._rest())}")
        return CaseMeasure(tuple(self.terms))

    def _rest(self) -> str:
        return " + ".join(map(str, self.terms))


def _check_response(name: str, case: LoadCase) -> None:
    """Raise ValueError, with a hint at measures of like spelling, unless the vehicle has this response."""
    try:
        checks.one_of("response", name, case.vehicle.meanings)
    except ValueError as error:
        raise ValueError(f"{error}{likely(name)}") from None


def _term(text: str) -> Term:
    """Return the term of a text."""
    found = _TERM.fullmatch(text)
    if not found:
        known = f"{', '.join(filter(None, Measure.words))}, or terms like '0.4 We pitch_acceleration'"
        raise ValueError(f"measure must be {known}, got {checks.shown(text)}")
    factor, weighting, response, x, y = found.groups()
    return Term(response if x is None else ("acceleration", float(x), float(y)), weighting, float(factor or 1))

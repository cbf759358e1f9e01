"""Measures that are functions of designs, as numbers for `numerics/functions.js`, computed again in a page."""

from collections.abc import Mapping
from functools import singledispatch
from typing import Any, NamedTuple

import numpy as np

from ...response.load_case import LoadCase
from ...response.measures.comfort import SEAT
from ...response.measures.dose import VDV
from ...response.measures.gaussian import Bottoming, LargestPeak, Lift, Topping
from ...response.measures.handling import FrontLoadTransfer, RollDamping, RollGradient
from ...response.measures.measure import Measure, OwnMeasure
from ...response.measures.modal import ModeDamping, ModeFrequency
from ...response.measures.peak import Peak
from ...response.measures.power import DamperPower
from ...response.measures.robust import Robust
from ...response.measures.terms import Term
from ...response.measures.vibration import DLC
from ...response.problem import RideProblem
from ...vehicles.handling import RollGeometry
from ...vehicles.modes import motions_of
from ...vehicles.networks import gap_of_stop
from ...vehicles.vehicle import Vehicle, assembled

Numbers = Mapping[str, Any]
WORDS = frozenset(
    one.word
    for one in (
        *(VDV, SEAT, DLC, Lift, LargestPeak, Bottoming, Topping, DamperPower, ModeFrequency, ModeDamping),
        *(RollDamping, RollGradient, FrontLoadTransfer),
    )
)
"""Words of the measures with a formula in `numerics/functions.js`."""


class Function(NamedTuple):
    """A measure by a function: its word, the power of its mean over load cases, and numbers in each of these."""

    word: str
    power: float
    cases: tuple[Numbers, ...]


class _Judged(NamedTuple):
    """A load case, the terms of a measure in it, and the place of each of these among all mean squares."""

    case: LoadCase
    terms: tuple[Term, ...]
    places: tuple[int, ...]

    @property
    def vehicle(self) -> Vehicle:
        return self.case.vehicle

    def where(self, term: Term) -> str:
        """Return the tyre or the strut of a term."""
        return str(self.vehicle.meanings[str(term.response)].where)


def functions_of(problem: RideProblem) -> list[Function | None]:
    """Return the function of each score of a problem, None of one by mean squares or of Python alone."""
    scores = problem.scores
    measures = [*problem.measures, *(limit.measure for limit in problem.constraints)]
    found = list[Function | None]()
    for measure, score in zip(measures, scores.scores, strict=True):
        cases = [
            numbers_of(measure, _Judged(case, own.terms, tuple(terms.index(term.integral) for term in own.terms)))
            for case, own, terms in zip(scores.cases, score.cases, scores.terms, strict=True)
        ]
        known = tuple(one for one in cases if one is not None)
        whole = score.by_function and len(known) == len(cases) and measure.word in WORDS
        found.append(Function(measure.word, score.cases[0].power, known) if whole else None)
    return found


def why_not(measure: Measure) -> str:
    """Return why a page does not compute a measure, for a reader."""
    if isinstance(measure, OwnMeasure):
        return "a function of your own"
    if isinstance(measure, Peak):
        return "simulated in an event"
    return "over the scatter" if isinstance(measure, Robust) else "by the program"


@singledispatch
def numbers_of(_measure: Measure, _judged: _Judged) -> Numbers | None:
    """Return the numbers of a measure in a load case, None if a page does not compute it."""
    return None


@numbers_of.register
def _(measure: VDV, judged: _Judged) -> Numbers:
    scale = (3 * measure.duration) ** 0.25
    return {"terms": judged.places, "factors": np.array([scale * one.factor for one in judged.terms])}


@numbers_of.register
def _(_measure: SEAT, judged: _Judged) -> Numbers:
    return {"terms": judged.places}


@numbers_of.register(Lift)
@numbers_of.register(DLC)
def _(_measure: Measure, judged: _Judged) -> Numbers:
    tyres = assembled(judged.vehicle).tyres
    return {"terms": judged.places, "tyres": tuple(tyres.index(judged.where(term)) for term in judged.terms)}


@numbers_of.register
def _(measure: LargestPeak, judged: _Judged) -> Numbers:
    return {"terms": judged.places, "seconds": measure.distance / judged.case.speed}


@numbers_of.register
def _(measure: Bottoming, judged: _Judged) -> Numbers:
    vehicle = judged.vehicle
    struts = [vehicle.struts.index(judged.where(term)) for term in judged.terms[: len(judged.terms) // 2]]
    stops = [gap_of_stop(vehicle.networks, strut, measure.stop) for strut in struts]
    names = [one.name for one in vehicle.strut_coefficients]
    return {
        "terms": judged.places, "struts": struts, "side": measure.side, "speed": judged.case.speed,
        "gap": measure.gap, "gaps": [names.index(one[0]) if one else -1 for one in stops],
        "ratios": [one[1] if one else 1.0 for one in stops],
    }  # fmt: skip


@numbers_of.register
def _(measure: DamperPower, judged: _Judged) -> Numbers:
    vehicle, terms = judged.vehicle, judged.terms[: len(judged.terms) // 2]
    struts = [vehicle.struts.index(judged.where(term)) for term in terms]
    return {"terms": judged.places[: len(terms)], "struts": struts, "dampers": measure.dampers(vehicle)[:, struts]}


@numbers_of.register
def _(measure: ModeFrequency, judged: _Judged) -> Numbers:
    return {"motion": list(motions_of(assembled(judged.vehicle).assembly)).index(measure.mode)}


@numbers_of.register
def _(_measure: RollDamping, judged: _Judged) -> Numbers:
    return {"roll": assembled(judged.vehicle).assembly.coordinates.index("roll")}


@numbers_of.register(RollGradient)
@numbers_of.register(FrontLoadTransfer)
def _(_measure: Measure, judged: _Judged) -> Numbers | None:
    geometry = judged.case.roll_geometry
    return None if geometry is None else _cornering(judged.vehicle, geometry)


def _cornering(vehicle: Vehicle, geometry: RollGeometry) -> Numbers:
    """Return the heights, and of each axle tyres and coordinates of the wheels, left and right, and the track."""
    assembly, axles = assembled(vehicle).assembly, list[Numbers]()
    for axle, height in (("front", geometry.front_roll_centre), ("rear", geometry.rear_roll_centre)):
        corners = [f"{axle}_{side}" for side in ("left", "right")]
        (_, y), (_, other) = (assembly.contacts[corner] for corner in corners)
        axles.append(
            {
                "tyres": [list(assembly.contacts).index(corner) for corner in corners],
                "wheels": [assembly.coordinates.index(f"{corner}_wheel") for corner in corners],
                "track": y - other,
                "height": height,
            }
        )
    roll = assembly.coordinates.index("roll")
    return {"roll": roll, "arm": geometry.roll_arm, "wheel": geometry.wheel_centre, "axles": axles}

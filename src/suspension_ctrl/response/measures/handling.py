"""Measures of statics and roll."""

from collections.abc import Callable

from ... import checks
from ...quantities import Real
from ...vehicles.handling import Mechanics, RollGeometry, check_cornering, check_roll
from ...vehicles.vehicle import assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import CaseMeasure


class RollDamping(Measure, word="roll_damping", unit="-"):
    """Damping ratio of the roll mode.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.RollDamping(maximise=True))
    -roll_damping
    """

    of_ride = False

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle does not roll."""
        vehicle = assembled(case.vehicle)
        check_roll(self.word, vehicle.assembly)
        if vehicle.networks:
            others = checks.listing(one.name for network in vehicle.networks for one in network.strut.elements)
            raise ValueError(f"{self.word} must be of struts of a spring beside a damper, got {others}")
        return _of_statics(lambda statics, given: statics.roll_damping(given))


class RollGradient(Measure, word="roll_gradient", unit="deg/g"):
    """Roll angle of the body in steady cornering per lateral acceleration; needs a `RollGeometry`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.RollGradient(), 5.0))
    roll_gradient <= 5
    """

    of_ride = False

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError without four wheels or roll geometry."""
        geometry = _cornering(self.word, case)
        return _of_statics(lambda statics, given: statics.roll_gradient(given, geometry))


class FrontLoadTransfer(Measure, word="front_load_transfer", unit="-"):
    """Share of the front axle in the lateral load transfer of steady cornering; needs a `RollGeometry`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.FrontLoadTransfer(), minimum=0.5))
    front_load_transfer >= 0.5
    """

    of_ride = False

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError without four wheels or roll geometry."""
        geometry = _cornering(self.word, case)
        return _of_statics(lambda statics, given: statics.front_load_transfer(given, geometry))


def _of_statics(function: Callable[[Mechanics, Real], Real]) -> CaseMeasure:
    """Return a measure by a function of statics and coefficients (p, c)."""
    return CaseMeasure(values=lambda designs: designs.by_vehicle(lambda one, given: function(one.statics, given)))


def _cornering(word: str, case: LoadCase) -> RollGeometry:
    """Return the roll geometry of a load case; ValueError if it lacks it or the vehicle does not roll."""
    vehicle = assembled(case.vehicle)
    check_cornering(word, vehicle.assembly)
    if case.roll_geometry is None:
        raise ValueError(f"roll_geometry must be given in every load case for {word}, got None")
    return case.roll_geometry

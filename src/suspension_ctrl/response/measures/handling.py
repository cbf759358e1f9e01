"""Measures of statics and roll."""

from collections.abc import Callable

from ... import checks
from ...quantities import Real
from ...vehicles.handling import Mechanics, RollGeometry, check_cornering, check_roll
from ...vehicles.lean_slopes import with_roll_slopes, with_transfer_slopes
from ...vehicles.varied import Varied
from ...vehicles.vehicle import Vehicle, assembled
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure
from .terms import CaseMeasure, Designs

_Values = Callable[[Mechanics, Real, RollGeometry], Real]
_WithSlopes = Callable[[Mechanics, Real, RollGeometry], tuple[Real, Real]]


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
        return CaseMeasure(values=_of_statics(Mechanics.roll_damping))


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
        return _of_cornering(case.vehicle, geometry, Mechanics.roll_gradient, with_roll_slopes)


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
        return _of_cornering(case.vehicle, geometry, Mechanics.front_load_transfer, with_transfer_slopes)


def _of_statics(function: Callable[[Mechanics, Real], Real]) -> Callable[[Designs], Real]:
    """Return a function of designs by one of statics and coefficients (p, c)."""
    return lambda designs: designs.by_vehicle(lambda one, given: function(one.statics, given))


def _of_cornering(vehicle: Vehicle, geometry: RollGeometry, values: _Values, slopes: _WithSlopes) -> CaseMeasure:
    """Return a measure by a function of cornering, with derivatives by coefficients if nothing else varies."""

    def with_slopes(designs: Designs) -> tuple[Real, Real]:
        return slopes(designs.vehicle.statics, designs.coefficients, geometry)

    one = assembled(vehicle)
    exact = None if isinstance(one, Varied) or one.networks else with_slopes
    of_designs = _of_statics(lambda statics, given: values(statics, given, geometry))
    return CaseMeasure(values=of_designs, with_slopes=exact)


def _cornering(word: str, case: LoadCase) -> RollGeometry:
    """Return the roll geometry of a load case; ValueError if it lacks it or the vehicle does not roll."""
    vehicle = assembled(case.vehicle)
    check_cornering(word, vehicle.assembly)
    if case.roll_geometry is None:
        raise ValueError(f"roll_geometry must be given in every load case for {word}, got None")
    return case.roll_geometry

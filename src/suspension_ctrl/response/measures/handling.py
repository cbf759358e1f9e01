"""Measures of statics and roll."""

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
            others = ", ".join(one.name for network in vehicle.networks for one in network.strut.elements)
            raise ValueError(f"{self.word} must be of struts of a spring beside a damper, got {others}")
        return CaseMeasure(values=lambda designs: vehicle.statics.roll_damping(designs.coefficients))


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
        statics, geometry = _cornering(self.word, case)
        return CaseMeasure(values=lambda designs: statics.roll_gradient(designs.coefficients, geometry))


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
        statics, geometry = _cornering(self.word, case)
        return CaseMeasure(values=lambda designs: statics.front_load_transfer(designs.coefficients, geometry))


def _cornering(word: str, case: LoadCase) -> tuple[Mechanics, RollGeometry]:
    """Return the statics and the roll geometry of a load case; ValueError if it lacks one."""
    vehicle = assembled(case.vehicle)
    check_cornering(word, vehicle.assembly)
    if case.roll_geometry is None:
        raise ValueError(f"roll_geometry must be given in every load case for {word}, got None")
    return vehicle.statics, case.roll_geometry

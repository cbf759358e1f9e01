"""Power of dampers: of a force law its mean slope times the variance of its own rate, E[v F] = c_eq s^2."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ... import checks
from ...quantities import Real
from ...vehicles.elements import Damper, Inerter, Spring
from ...vehicles.force_laws import ForceLaw
from ...vehicles.struts import Parallel, Series, Strut
from ...vehicles.vehicle import Vehicle
from ..load_case import LoadCase
from ..weightings import Weighting
from .terms import CaseMeasure, Designs, Term
from .vibration import WheelMeasure

if TYPE_CHECKING:
    from ..trips import Trip


class DamperPower(WheelMeasure, word="damper_power", unit="W"):
    """Mean power that a damper turns into heat, ``c s^2`` with the standard deviation s of its rate.

    Of several struts the largest. Dampers of a coefficient stand between body and wheel, or seat and body; force
    laws of the rate, friction too, stand anywhere. In time it is the mean product of strut force and travel rate.

    Parameters
    ----------
    where : str
        An axle, a wheel or a seat: ``"front"``; all wheels by default.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    On a road of waviness 2 and over all frequencies the power is pi^2 K_t Gd(n0) n0^2 V for any spring and damper,
    here 97 W:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> road = sc.Iso8608Road("C")
    >>> for damper in (1000.0, 2000.0):
    ...     table = sc.ride(car, (22e3, damper), road, 20.0, band=(0.0, 200.0), measures=["damper_power"])
    ...     print(round(table["value"]["damper_power"]))
    97
    97
    """

    kind = "travel_rate"

    def in_case(self, case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Return the measure in a load case; ValueError if the vehicle lacks the place, or for a lossy series."""
        vehicle, names = case.vehicle, self.responses(case.vehicle)
        struts = [vehicle.struts.index(str(vehicle.meanings[name].where)) for name in names]
        terms, dampers = tuple(map(Term, names)), self.dampers(vehicle)[:, struts]
        forces = [name.removesuffix("suspension_travel_rate") + "strut_force" for name in names]

        def values(designs: Designs) -> Real:
            power = designs.coefficients @ dampers * designs.mean_squares(terms) + designs.law_powers()[:, struts]
            return np.asarray(power.max(axis=1))

        def in_trip(trip: "Trip", _coefficients: Real) -> float:
            return float((trip.of(forces) * trip.of(names)).mean(axis=1).max())

        return CaseMeasure((*terms, *map(Term, forces)), values=values, in_trip=in_trip)

    def dampers(self, vehicle: Vehicle) -> Real:
        """Return the damping (c, q) of each strut by each coefficient."""
        every = vehicle.strut_coefficients
        found = np.array([np.diag(one.gain) if one.order == 1 else np.zeros(len(vehicle.struts)) for one in every])
        index = [one.name for one in every]
        for network in vehicle.networks:
            for name, gain in self._beside(network.strut, 1.0):
                found[index.index(network.prefix + name)] += gain**2 * np.array(network.share)
        return found

    def _beside(self, strut: Strut, ratio: float) -> Iterator[tuple[str, float]]:
        """Yield the name and the ratio of each plain damper; ValueError about losses that are not known by it."""
        ratio *= strut.installation_ratio
        if isinstance(strut, Damper):
            yield strut.name, ratio
        elif isinstance(strut, Parallel) and not isinstance(strut, Series):
            for part in strut.parts:
                yield from self._beside(part, ratio)
        elif lossy := [one.name for one in strut.elements if not isinstance(one, Spring | Inerter | ForceLaw)]:
            got = checks.listing(lossy)
            raise ValueError(f"{self.word} must be of dampers beside springs, or of laws, got {got}")

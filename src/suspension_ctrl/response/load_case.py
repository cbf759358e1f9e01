"""A load case: a vehicle with a payload on a road at a speed, and the mean squares of its responses."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks
from ..quantities import Real
from ..vehicles.handling import RollGeometry
from ..vehicles.vehicle import Vehicle
from . import weightings
from .blocks import Pairs, Variables, strut_blocks
from .many_struts import StrutBlock, mean_squares_of_all
from .measures import Term
from .one_strut import StrutLoop, loop_mean_squares_of_all
from .ports import Ports
from .quadrature import frequency_nodes


class Road(Protocol):
    """What the road has to offer: its one-sided spectrum under a wheel, and those between several."""

    def psd(self, f: ArrayLike, speed: float) -> Real:
        """Return the spectrum (n,) [m^2/Hz] at the frequencies `f` (n,) [Hz] at a speed [m/s]."""

    def breakpoints(self, speed: float) -> Sequence[float]:
        """Return the frequencies [Hz] at which the spectrum has a kink at this speed [m/s]."""

    def cross_spectrum(self, f: ArrayLike, speed: float, contact_points: ArrayLike) -> NDArray[np.complex128]:
        """Return the cross-spectra (n, r, r) [m^2/Hz] under wheels at (r, 2) [m]."""


@dataclass(frozen=True, kw_only=True)
class LoadCase:
    """What a vehicle is driven through.

    Parameters
    ----------
    vehicle : Vehicle
        With its payload.
    road : Road
        The road, e.g. a `PowerLawRoad`.
    speed : float
        Vehicle speed V [m/s].
    share : float
        How much of the time; cases count by their shares of the sum.
    roll_geometry : RollGeometry, optional
        For measures of cornering.

    Raises
    ------
    ValueError
        If speed or share are not finite and above zero.
    """

    vehicle: Vehicle
    road: Road
    speed: float
    share: float = 1.0
    roll_geometry: RollGeometry | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.vehicle, Vehicle):
            raise ValueError(f"vehicle must be a Vehicle such as a QuarterCar, got {self.vehicle!r}")
        if not hasattr(self.road, "psd"):
            raise ValueError(f"road must be a road such as Iso8608Road('C'), got {self.road!r}")
        checks.positive("speed", self.speed, "m/s")
        checks.positive("share", self.share)

    def cross_spectrum(self, f: Real) -> NDArray[np.complex128]:
        """Return the cross-spectra (n, r, r) of the road under the wheels [m^2/Hz], for `f` (n,) [Hz]."""
        points = self.vehicle.contact_points
        if len(points) == 1:
            return self.road.psd(f, self.speed)[:, None, None].astype(complex)
        return np.asarray(self.road.cross_spectrum(f, self.speed, points))


class RideCase(NamedTuple):
    """A load case ready for any number of designs.

    Parameters
    ----------
    loop : StrutLoop or tuple of StrutBlock
        From a design to mean squares: of one strut's spring and damper, or of any number of struts.
    channel : (k,) ndarray
        Which of these mean squares belongs to each of k terms.
    """

    loop: StrutLoop | tuple[StrutBlock, ...]
    channel: NDArray[np.int64]

    def mean_squares(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of the terms for designs (p, v)."""
        if isinstance(self.loop, StrutLoop):
            return loop_mean_squares_of_all(designs, self.loop)[:, self.channel]
        return mean_squares_of_all(designs, self.loop, int(self.channel.max()) + 1)[:, self.channel]


def ride_case(
    case: LoadCase,
    terms: Sequence[Term],
    variables: Mapping[str, float],
    coefficients: Mapping[str, float],
    band: tuple[float, float],
    nodes: int,
) -> RideCase:
    """Return a load case ready for designs.

    Parameters
    ----------
    case : LoadCase
    terms : (k,) sequence of Term
        Responses with their weightings.
    variables : mapping of str to float
        Coefficients that vary, by name, and a value of each in the middle of its range.
    coefficients : mapping of str to float
        All coefficients by name, those that vary at the same values.
    band : (float, float)
        Frequencies over which spectra are integrated [Hz].
    nodes : int
        Least number of quadrature nodes.
    """
    weights = [None if term.weighting is None else weightings.by_name(term.weighting) for term in terms]
    kinks = {f for weighting in weights if weighting for f in weighting.breakpoints}
    kinks.update(case.road.breakpoints(case.speed))
    f, w = frequency_nodes(band, nodes, kinks)
    omega, vehicle = 2 * np.pi * f, case.vehicle
    density = np.array([w * (weighting.factor(f) ** 2 if weighting else 1.0) for weighting in weights])
    responses = [term.response for term in terms]
    one_wheel = len(vehicle.contact_points) == 1
    if one_wheel and [p.name for p in vehicle.parameters] == list(variables) == ["spring", "damper"]:
        ports = Ports.of(vehicle, f, responses)
        loop = StrutLoop.around(ports, omega, density * case.road.psd(f, case.speed))
        return RideCase(loop, np.arange(len(terms)))
    ports = Ports.of(vehicle, f, responses, vehicle.strut_gains(coefficients))
    varied = Variables.of(vehicle.parameters, list(variables), list(variables.values()))
    pairs = Pairs.of(vehicle.struts, vehicle.contact_points)
    return RideCase(*strut_blocks(ports, omega, case.cross_spectrum(f), density, varied, pairs))

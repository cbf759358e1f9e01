"""A load case: a vehicle with a payload on a road at a speed, and the mean squares of its responses."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..quantities import Complex, Real, Record, unit
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
    """A road of one wheel; one of several wheels has ``cross_spectrum(f, speed, contact_points)`` too."""

    def psd(self, f: Real, speed: float) -> Real:
        """Return the one-sided spectrum (n,) [m^2/Hz] at the frequencies `f` (n,) [Hz] at a speed [m/s]."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LoadCase(Record):
    """A vehicle with its payload on a road at a speed.

    Parameters
    ----------
    vehicle : Vehicle
        With its payload.
    road : Road
        The road, e.g. a `PowerLawRoad`. Under one wheel any object with ``psd(f, speed)`` is one; kinks of its
        spectrum stand in ``breakpoints(speed)``, if it has that [Hz].
    speed : float
        Vehicle speed V [m/s].
    share : float
        How much of the time; cases count by their shares of the sum.
    roll_geometry : RollGeometry, optional
        For measures of cornering.

    Raises
    ------
    ValueError
        If speed or share are not finite and above zero, or the road has no spectrum for the vehicle's wheels.
    """

    vehicle: Vehicle
    road: Road
    speed: float = field(metadata=unit("m/s"))
    share: float = 1.0
    roll_geometry: RollGeometry | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.vehicle, Vehicle):
            raise ValueError(f"vehicle must be a Vehicle such as a QuarterCar, got {self.vehicle!r}")
        if not hasattr(self.road, "psd"):
            raise ValueError(f"road must be a road such as Iso8608Road('C'), got {self.road!r}")
        if self.wheels > 1 and not hasattr(self.road, "cross_spectrum"):
            raise ValueError(f"road must have a cross_spectrum for {self.wheels} wheels, got {self.road!r}")
        checks.positive("speed", self.speed, "m/s")
        checks.positive("share", self.share)

    @property
    def wheels(self) -> int:
        """Number of roads under the vehicle."""
        return len(self.vehicle.contact_points)

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Frequencies at which the road's spectrum has a kink [Hz]."""
        return tuple(self.road.breakpoints(self.speed)) if hasattr(self.road, "breakpoints") else ()

    def psd(self, f: Real) -> Real:
        """Return the road's spectrum (n,) under a wheel [m^2/Hz], for `f` (n,) [Hz]."""
        spectrum = np.asarray(self.road.psd(f, self.speed), dtype=float)
        if spectrum.shape != f.shape or not (np.isfinite(spectrum) & (spectrum >= 0)).all():
            raise ValueError(
                f"psd of the road must return {f.size} finite values >= 0 m^2/Hz, got shape {spectrum.shape}"
            )
        return spectrum

    def cross_spectrum(self, f: Real) -> Complex:
        """Return the cross-spectra (n, r, r) of the road under the wheels [m^2/Hz], for `f` (n,) [Hz]."""
        if self.wheels == 1:
            return self.psd(f)[:, None, None].astype(complex)
        road: Any = self.road
        return np.asarray(road.cross_spectrum(f, self.speed, self.vehicle.contact_points))


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
    kinks.update(case.breakpoints)
    f, w = frequency_nodes(band, nodes, kinks)
    omega, vehicle = 2 * np.pi * f, case.vehicle
    density = np.array([w * (weighting.factor(f) ** 2 if weighting else 1.0) for weighting in weights])
    responses = [term.response for term in terms]
    if case.wheels == 1 and [p.name for p in vehicle.parameters] == list(variables) == ["spring", "damper"]:
        ports = Ports.of(vehicle, f, responses)
        loop = StrutLoop.around(ports, omega, density * case.psd(f))
        return RideCase(loop, np.arange(len(terms)))
    ports = Ports.of(vehicle, f, responses, vehicle.strut_gains(coefficients))
    varied = Variables.of(vehicle.parameters, list(variables), list(variables.values()))
    pairs = Pairs.of(vehicle.struts, vehicle.contact_points)
    return RideCase(*strut_blocks(ports, omega, case.cross_spectrum(f), density, varied, pairs))

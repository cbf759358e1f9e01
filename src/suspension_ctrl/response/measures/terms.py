"""Terms of measures, and measures in a load case."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ... import checks
from ...quantities import Real, Record
from ...vehicles.assembly import Position, ResponseName, label
from ...vehicles.vehicle import AssembledVehicle, Vehicle, assembled
from .. import weightings
from ..weightings import Weighting

if TYPE_CHECKING:
    import control

    from ..trips import Trip

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
"""Regular expression of a number."""
POINT = rf"\(\s*({NUMBER})\s*,\s*({NUMBER})\s*\)"
"""Regular expression of a point of the body, with a group for each coordinate."""

_LARGEST = 1e6  # factor, and coordinate of a point [m]: squares times those of any response are finite


@dataclass(frozen=True, eq=False, repr=False)
class Term(Record):
    """A response with a weighting and a factor.

    Parameters
    ----------
    response : str or ("acceleration", x, y)
        Response of the vehicle by name, or the vertical acceleration at a point of the body [m].
    weighting : str, control.LTI or None
        Weighting of an acceleration, as of `RideProblem`.
    factor : float
        Factor of the root mean square, > 0 and at most 1e6.
    moment : int
        Order n of the spectral moment: the mean square is the integral of w^n times the spectrum.
    relative : bool
        Whether a tyre load is divided by its static load, on struts in the middle of their ranges.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Term("roll_acceleration", "We", factor=0.63))
    0.63 We roll_acceleration
    """

    response: ResponseName
    weighting: "Weighting | control.LTI | None" = None
    factor: float = 1.0
    moment: int = 0
    relative: bool = False

    def __post_init__(self) -> None:
        if isinstance(self.response, tuple):
            self._keep(response=("acceleration", *checked_point(self.response[1:])))
        self._keep(weighting=weightings.checked(self.weighting))
        if self.weighting is not None and "acceleration" not in label(self.response):
            raise ValueError(f"weighting must be of an acceleration, got {self.weighting} of {self.response}")
        real = isinstance(self.factor, int | float | np.number)
        if not (real and 0 < self.factor <= _LARGEST):
            got = f"{self.factor:g}" if real else checks.shown(self.factor)
            raise ValueError(f"factor of a response must be above 0 and up to {_LARGEST:g}, got {got}")
        checks.at_least("moment", self.moment, 0)

    @property
    def integral(self) -> "Term":
        """The term without its factors."""
        return replace(self, factor=1.0, relative=False)

    def __str__(self) -> str:
        parts = [number_text(self.factor)] if self.factor != 1 else []
        parts += [str(self.weighting)] if self.weighting is not None else []
        name = self.response
        return " ".join([*parts, name if isinstance(name, str) else f"acceleration {place_text(name[1:])}"])


class Designs(NamedTuple):
    """Designs (p, v) in a load case, all their coefficients (p, c), and response spectra design by design.

    The mean squares (p, k) of terms are those of terms of the measure; mean travels and the powers of force laws
    (p, q) are those at the struts. The vehicles hold the parameters of all designs, or each those of one, with
    coefficients (p, c) or (1, c).
    """

    values: Real
    coefficients: Real
    spectra: Callable[[], Iterator[tuple[Real, Mapping[str, Real]]]]
    mean_squares: Callable[[Sequence[Term]], Real]
    mean_travels: Callable[[], Real]
    law_powers: Callable[[], Real]
    vehicles: Callable[[], Iterator[tuple[Vehicle, Real]]]

    def by_vehicle(self, function: Callable[[AssembledVehicle, Real], Real]) -> Real:
        """Return a function of a vehicle and coefficients over all designs (p, ...); ValueError without masses."""
        return np.concatenate([function(assembled(vehicle), given) for vehicle, given in self.vehicles()])

    @property
    def vehicle(self) -> AssembledVehicle:
        """The vehicle of all designs, where no parameter varies."""
        ((vehicle, _),) = self.vehicles()
        return assembled(vehicle)


class CaseMeasure(NamedTuple):
    """A measure in a load case: the root of the sum of its mean squares or of the largest, or a function.

    A function of designs may ask them for the mean squares of the terms; its mean over load cases is that of a
    power of it, and `with_slopes` has its exact derivatives (p, c) by coefficients beside. Further functions are
    of a trip and the coefficients (c,), and of a vehicle in an event with its setting, without or with tyres that
    lift off. A measure that depends on neither has none.
    """

    terms: tuple[Term, ...] = ()
    largest: bool = False
    values: Callable[[Designs], Real] | None = None
    with_slopes: Callable[[Designs], tuple[Real, Real]] | None = None
    power: float = 1.0
    in_trip: "Callable[[Trip, Real], float] | None" = None
    in_event: Callable[[Vehicle, Mapping[str, float], bool], float] | None = None


def checked_point(values: object) -> Position:
    """Return the coordinates of a point of the body [m]; ValueError unless they are two numbers up to 1e6 m."""
    point = checks.position("a point", values)
    for axis, value in zip("xy", point, strict=True):
        checks.within(f"{axis} of a point", value, -_LARGEST, _LARGEST)
    return point


def place_text(place: str | Position) -> str:
    """Return the text of a name or a point."""
    return place if isinstance(place, str) else f"({number_text(place[0])}, {number_text(place[1])})"


def number_text(value: float) -> str:
    """Return the shortest text of a number."""
    return repr(float(value)).removesuffix(".0")

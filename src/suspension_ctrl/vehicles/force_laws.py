"""Force laws: elements whose force is a curve over their deflection or its rate.

A curve passes through the origin and rises everywhere. It is straight between knots, where it may jump, plus a
power of the rate. Its knots, slopes and jumps depend on the coefficients of the element, see `Curve`.
"""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan, prod
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real
from .struts import Coefficient, Element

Factors = tuple[float, tuple[int, ...]]
"""A number, and the coefficients of the element by which it is multiplied."""


class Curve(NamedTuple):
    """A curve by coefficients of its element, counted from 0.

    A knot is a constant plus factors; between n knots are n + 1 slopes, the first below the first knot. A jump is
    the rise of the force at a knot. The power law is ``c |v|^a sign(v)``.
    """

    knots: Sequence[tuple[float, Factors]]
    slopes: Sequence[Factors]
    jumps: Sequence[Factors] = ()  # as many as knots, or none
    power: tuple[int, int] | None = None  # the coefficients c and a

    def force(self, x: Real, values: Sequence[float]) -> Real:
        """Return the force (...) at rates or deflections (...) with these coefficients, 0 at 0."""

        def product(factors: Factors) -> float:
            return factors[0] * prod(values[i] for i in factors[1])

        slopes, jumps = [*map(product, self.slopes)], [*map(product, self.jumps)] or [0.0] * len(self.knots)
        knots = [constant + product(factors) for constant, factors in self.knots]
        force = slopes[sum(knot < 0 for knot in knots)] * x
        for knot, rise, jump in zip(knots, np.diff(slopes), jumps, strict=True):  # outward: no rounding near 0
            force += rise * (np.maximum(x - knot, 0.0) if knot >= 0 else -np.minimum(x - knot, 0.0))
            force += jump * (np.heaviside(x - knot, 0.5) - np.heaviside(-knot, 0.5))
        c, a = (values[i] for i in self.power) if self.power else (0.0, 1.0)
        return force + c * np.abs(x) ** a * np.sign(x)

    def slope_at_origin(self, values: Sequence[Any]) -> Any:
        """Return the slope at 0, on a knot the mean of both sides; values may be arrays (p,)."""
        slopes = [factor * prod(values[i] for i in by) for factor, by in self.slopes]
        knots = [constant + factor * prod(values[i] for i in by) for constant, (factor, by) in self.knots]
        below, on = (sum(np.asarray(knot < 0) for knot in knots), sum(np.asarray(knot == 0) for knot in knots))
        first = int(np.max(below)) if knots else 0  # the sign of a knot is the same for all values above zero
        return (slopes[first] + slopes[first + int(np.max(on))]) / 2 if knots else slopes[0]


@dataclass(frozen=True, eq=False, repr=False)
class ForceLaw(Element):
    """An element with a force law."""

    of_rate: ClassVar[bool]
    """Whether the force depends on the rate of the deflection, or on the deflection."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for one in self.values:
            if one.default is not None:
                checks.positive(one.name, one.default, one.unit)

    @property
    @abstractmethod
    def values(self) -> tuple[Coefficient, ...]:
        """Coefficients, named without the element."""

    @property
    @abstractmethod
    def curve(self) -> Curve:
        """Force [N] over deflection [m] or rate [m/s]."""

    @property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """Coefficients, named ``<element>.<value>``."""
        return tuple(one._replace(name=f"{self.name}.{one.name}") for one in self.values)

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the slope at the origin at the wheel, on a knot the mean of both sides; 0 N/m of a damper."""
        if self.of_rate:
            return 0.0
        own = [values[one.name] for one in self.coefficients]
        return self.curve.slope_at_origin(own) * self.installation_ratio**2

    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the change of tension at rest at the wheel; 0 N of a damper."""
        if self.of_rate:
            return 0.0
        own, ratio = [values[one.name] for one in self.coefficients], self.installation_ratio
        return float(self.curve.force(np.asarray(ratio * deflection), own)) * ratio

    def tension(self, x: ArrayLike, /, **values: float) -> Real:
        """Return the force at rates or deflections, at a jump the mean of both sides.

        Parameters
        ----------
        x : array_like
            Rate [m/s] of a damper, deflection [m] of a spring or a stop, positive in extension.
        **values : float
            Coefficients, named without the element, above zero; of the others the values of the element.

        Returns
        -------
        array of the shape of x
            Force of the element, positive in tension [N].

        Raises
        ------
        ValueError
            If a coefficient is unknown, has no value or is out of range.

        Examples
        --------
        >>> import suspension_ctrl as sc
        >>> damper = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
        >>> damper.tension([-1.0, -0.1, 0.0, 0.1, 1.0], rebound_over_bump=2.0)
        array([-1120.,  -400.,     0.,   800.,  2240.])
        """
        own = {one.name: one for one in self.values}
        for name in values:
            checks.one_of(f"coefficient of {self.name}", name, own)
        numbers = {name: values.get(name, one.default) for name, one in own.items()}
        for name, number in numbers.items():
            checks.positive(f"{self.name}.{name}", nan if number is None else number, own[name].unit)
        return self.curve.force(np.asarray(x, dtype=float), [number or nan for number in numbers.values()])


@dataclass(frozen=True, eq=False, repr=False)
class Table(ForceLaw):
    """A measured curve, straight between its rows and beyond them; its coefficient is a factor of the force."""

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """The factor of the force."""
        return (Coefficient("scale", "", 1.0),)

    def curve_of(self, x: Real, force: Real) -> Curve:
        """Return the curve through points (n,), its slopes times the factor."""
        slopes = (np.diff(force) / np.diff(x)).tolist()
        return Curve(
            knots=[(knot, (0.0, ())) for knot in x[1:-1].tolist()], slopes=[(slope, (0,)) for slope in slopes]
        )


def rows_of_curve(name: str, x: ArrayLike | None, force: ArrayLike | None) -> tuple[Real, Real]:
    """Return the rows of a curve (n,); ValueError unless x ascends and the force nowhere falls."""
    x, force = (checks.reals(f"{key} must be", value) for key, value in ((name, x), ("force", force)))
    if x.ndim != 1 or x.shape != force.shape or x.size < 2:
        raise ValueError(f"{name} and force must be of one length, 2 or more, got {x.shape} and {force.shape}")
    if not (np.isfinite(x).all() and np.isfinite(force).all()):
        raise ValueError(f"{name} and force must be finite, got nan or inf")
    if (stays := np.diff(x) <= 0).any():
        i = int(stays.argmax())
        raise ValueError(f"{name} must ascend, got {x[i]:g}, then {x[i + 1]:g}")
    if (falls := np.diff(force) < 0).any():
        i = int(falls.argmax())
        raise ValueError(f"force must not fall over {name}, got {force[i]:g} N, then {force[i + 1]:g} N")
    with np.errstate(over="ignore"):
        if not np.isfinite(np.diff(force) / np.diff(x)).all():
            raise ValueError(f"force must rise over {name} by slopes of moderate size, got an infinite one")
    return x, force


def check_origin(name: str, x: Real, force: Real) -> None:
    """Raise ValueError unless the curve passes through the origin."""
    at_zero = float(np.interp(0.0, x, force))
    if not x[0] <= 0 <= x[-1] or abs(at_zero) > 1e-9 * np.abs(force).max():
        got = f"{at_zero:g} N" if x[0] <= 0 <= x[-1] else f"{name} from {x[0]:g} to {x[-1]:g}"
        raise ValueError(f"force must be 0 N at {name} 0, got {got}")

"""Struts: elements between two ends, in parallel and in series.

Deflections and their rates are positive in extension (rebound), forces in tension.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import polynomial

from .. import checks
from ..quantities import Real, Record, unit

_SMALL, _ROUNDING = 1e-15, 1e-15  # m, and of a deflection: errors of that of a part in series

Fraction = tuple[Real, Real]
"""Dynamic stiffness as numerator and denominator: coefficients by rising powers of s."""


ROWS = 1000
"""Most rows of a table of an element."""


def column(text: str) -> dict[str, Any]:
    """Return the metadata of a field with a column of a table in this unit."""
    return {**unit(text), "most": ROWS}


class Coefficient(NamedTuple):
    """A number of an element: its name in the strut, its unit, and its value unless a setting gives one."""

    name: str
    unit: str
    default: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Strut(Record, ABC):
    """Elements between two ends.

    An installation ratio r is the deflection of the element over the deflection at the wheel: dynamic stiffness at
    the wheel is r^2 times that of the element.
    """

    installation_ratio: float = 1.0

    def __post_init__(self) -> None:
        checks.positive("installation_ratio", self.installation_ratio)
        names = [one.name for one in self.elements]
        if twice := {name for name in names if names.count(name) > 1}:
            raise ValueError(f"elements must have names of their own, got {min(twice)} twice")

    @property
    @abstractmethod
    def coefficients(self) -> tuple[Coefficient, ...]:
        """Coefficients of all elements."""

    @property
    @abstractmethod
    def elements(self) -> tuple["Element", ...]:
        """Elements from left to right."""

    @abstractmethod
    def fraction(self, values: Mapping[str, float], /) -> Fraction:
        """Return the dynamic stiffness at the wheel; ValueError if an element has none of this form."""

    @abstractmethod
    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the stiffness at the wheel at 0 Hz [N/m] about the static position; values may be arrays (p,)."""

    @abstractmethod
    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the change of tension [N] at the wheel that holds a deflection [m] from the static position."""


@dataclass(frozen=True, eq=False, repr=False)
class Element(Strut):
    """One element with a name."""

    name: str = field()

    def __post_init__(self) -> None:
        if not (isinstance(self.name, str) and self.name.isidentifier()):
            raise ValueError(f"name must be of letters, digits and underscores, got {checks.shown(self.name)}")
        super().__post_init__()

    @property
    def elements(self) -> tuple["Element", ...]:
        """The element."""
        return (self,)

    def fraction(self, _values: Mapping[str, float], /) -> Fraction:
        """Return the dynamic stiffness at the wheel; ValueError if the element has none of this form."""
        instead = "as of vehicle.linearised(setting, road, speed), with a Zener element for rubber"
        raise ValueError(f"strut must be of springs, dampers and inerters alone, {instead}, got {self.name}")

    def static_stiffness(self, _values: Mapping[str, Any], /) -> Any:
        """Return 0 N/m: the element holds no static force."""
        return 0.0

    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the change of tension at rest at the wheel."""
        return float(self.static_stiffness(values)) * deflection


@dataclass(frozen=True, eq=False, repr=False)
class Parallel(Strut):
    """Parts with the same deflection; their forces add, see `parallel`."""

    parts: tuple[Strut, ...]

    @property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """Coefficients of all elements."""
        return tuple(one for part in self.parts for one in part.coefficients)

    @property
    def elements(self) -> tuple[Element, ...]:
        """Elements from left to right."""
        return tuple(one for part in self.parts for one in part.elements)

    def fraction(self, values: Mapping[str, float], /) -> Fraction:
        """Return the dynamic stiffness at the wheel; ValueError if an element has none of this form."""
        numerator, denominator = reduce(_sum, (part.fraction(values) for part in self.parts))
        return numerator * self.installation_ratio**2, denominator

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the sum of the stiffnesses of the parts, at the wheel."""
        return sum(part.static_stiffness(values) for part in self.parts) * self.installation_ratio**2

    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the sum of the changes of tension of the parts at rest, at the wheel."""
        own = self.installation_ratio * deflection
        return sum(part.static_tension(values, own) for part in self.parts) * self.installation_ratio


@dataclass(frozen=True, eq=False, repr=False)
class Series(Parallel):
    """Parts with the same force; their deflections add, see `series`."""

    def fraction(self, values: Mapping[str, float], /) -> Fraction:
        """Return the dynamic stiffness at the wheel; ValueError if an element has none of this form."""
        denominator, numerator = reduce(_sum, (part.fraction(values)[::-1] for part in self.parts))
        return numerator * self.installation_ratio**2, denominator

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the stiffness of the parts one after the other, at the wheel; 0 N/m if one holds no force."""
        parts = [np.asarray(part.static_stiffness(values), dtype=float) for part in self.parts]
        soft = np.min(np.broadcast_arrays(*parts), axis=0) > 0
        total = sum(1 / np.where(soft, part, 1.0) for part in parts)
        return np.where(soft, self.installation_ratio**2 / total, 0.0)

    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the change of tension of the parts at rest, at the wheel."""
        own = self.installation_ratio * deflection
        return _tension_in_series(self.parts, values, own) * self.installation_ratio


def _tension_in_series(parts: Sequence[Strut], values: Mapping[str, float], deflection: float) -> float:
    """Return the tension of parts end to end, by the deflection of the first at which it pulls like the rest."""
    first, *rest = parts
    if not rest:
        return first.static_tension(values, deflection)
    from scipy.optimize import brentq

    def difference(own: float) -> float:
        return first.static_tension(values, own) - _tension_in_series(rest, values, deflection - own)

    if deflection == 0:
        return 0.0
    own = float(brentq(difference, 0.0, deflection, xtol=_SMALL, rtol=_ROUNDING))
    return _tension_in_series(rest, values, deflection - own)


def _sum(one: Fraction, other: Fraction) -> Fraction:
    """Return the sum of two fractions; polynomials of the same denominator stay as they are."""
    (a, b), (c, d) = one, other
    if np.array_equal(b, d):
        return np.asarray(polynomial.polyadd(a, c), dtype=np.float64), b
    numerator = polynomial.polyadd(polynomial.polymul(a, d), polynomial.polymul(c, b))
    return np.asarray(numerator, dtype=float), np.asarray(polynomial.polymul(b, d), dtype=float)


def parallel(*parts: Strut, installation_ratio: float = 1.0) -> Strut:
    """Return elements or struts side by side between the same two ends.

    python-control's function of this name joins systems, this one two-terminal elements.

    Parameters
    ----------
    *parts : Strut
        Two or more, with elements of different names.
    installation_ratio : float
        Deflection of the whole over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.parallel(sc.Spring(), sc.Damper())
    Parallel(parts=(Spring(), Damper()))
    """
    return Parallel(_checked_parts("parallel", parts), installation_ratio=installation_ratio)


def series(*parts: Strut, installation_ratio: float = 1.0) -> Strut:
    """Return elements or struts end to end, all under the same force.

    Parameters
    ----------
    *parts : Strut
        Two or more, with elements of different names.
    installation_ratio : float
        Deflection of the whole over the deflection at the wheel.

    Examples
    --------
    A Zener element: a spring beside a damper in series with a second spring.

    >>> import suspension_ctrl as sc
    >>> sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount")))
    Parallel(parts=(Spring(), Series(parts=(Damper(), Spring(name='mount')))))
    """
    return Series(_checked_parts("series", parts), installation_ratio=installation_ratio)


def _checked_parts(function: str, parts: Sequence[Strut]) -> tuple[Strut, ...]:
    if len(parts) < 2 or not all(isinstance(part, Strut) for part in parts):
        raise ValueError(f"{function} must be of two elements or more, got {checks.shown(list(parts))}")
    return tuple(parts)

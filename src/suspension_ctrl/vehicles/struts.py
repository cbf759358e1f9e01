"""Struts: springs, dampers, inerters and force laws between two ends, in parallel and in series.

Deflections and their rates are positive in extension (rebound), forces in tension.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.polynomial import polynomial

from .. import checks
from ..quantities import Real, Record, frozen_array, unit

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
        needed = "of springs, dampers and inerters alone: linearise force laws, put a Zener element for rubber"
        raise ValueError(f"strut must be {needed}, got {self.name}")

    def static_stiffness(self, _values: Mapping[str, Any], /) -> Any:
        """Return 0 N/m: the element holds no static force."""
        return 0.0

    def static_tension(self, values: Mapping[str, float], deflection: float, /) -> float:
        """Return the change of tension at rest at the wheel."""
        return float(self.static_stiffness(values)) * deflection


@dataclass(frozen=True, eq=False, repr=False)
class LinearElement(Element):
    """An element with a tension in proportion to its deflection or a derivative of it."""

    order: ClassVar[int]  # of the derivative
    unit: ClassVar[str]
    value: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.value is not None:
            checks.positive(self.name, self.value, self.unit)

    @property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """The coefficient, of the name of the element."""
        return (Coefficient(self.name, self.unit, self.value),)

    def fraction(self, values: Mapping[str, float], /) -> Fraction:
        """Return the dynamic stiffness at the wheel."""
        gain = values[self.name] * self.installation_ratio**2
        return gain * np.eye(1, self.order + 1, self.order)[0], np.ones(1)

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the stiffness at the wheel of a spring, 0 N/m of others."""
        return values[self.name] * self.installation_ratio**2 if self.order == 0 else 0.0


@dataclass(frozen=True, eq=False, repr=False)
class Spring(LinearElement):
    """A linear spring.

    Parameters
    ----------
    name : str
        Name of the element and of its coefficient, the stiffness.
    value : float, optional
        Stiffness if a setting gives none, above zero [N/m].
    installation_ratio : float
        Deflection of the spring over the deflection at the wheel: the wheel rate is the spring rate times r^2.

    Examples
    --------
    A spring inboard of the wheel is stiffer than the wheel rate:

    >>> import suspension_ctrl as sc
    >>> strut = sc.parallel(sc.Spring(installation_ratio=0.8), sc.Damper())
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    >>> for spring in (22e3, 22e3 / 0.8**2):
    ...     print(car.modes({"spring": spring, "damper": 1500.0})["frequency [Hz]"].round(2).to_list())
    [1.02, 10.73]
    [1.25, 10.94]
    """

    name: str = "spring"
    value: float | None = field(default=None, metadata=unit("N/m"))
    order, unit = 0, "N/m"


@dataclass(frozen=True, eq=False, repr=False)
class Damper(LinearElement):
    """A linear damper.

    Parameters
    ----------
    name : str
        Name of the element and of its coefficient, the damping coefficient.
    value : float, optional
        Damping coefficient if a setting gives none, above zero [N s/m].
    installation_ratio : float
        Deflection of the damper over the deflection at the wheel.

    Examples
    --------
    A rubber mount in series with the damper is softer than the damper at the wheel's hop:

    >>> import suspension_ctrl as sc
    >>> strut = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Spring("mount", 250e3)))
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    >>> car.coefficients({"spring": 22e3, "damper": 1500.0})
    {'spring': 22000.0, 'damper': 1500.0, 'mount': 250000.0}
    """

    name: str = "damper"
    value: float | None = field(default=None, metadata=unit("N s/m"))
    order, unit = 1, "N s/m"


@dataclass(frozen=True, eq=False, repr=False)
class Inerter(LinearElement):
    """An inerter: a tension in proportion to the relative acceleration of its ends.

    Parameters
    ----------
    name : str
        Name of the element and of its coefficient, the inertance.
    value : float, optional
        Inertance if a setting gives none, above zero [kg].
    installation_ratio : float
        Deflection of the inerter over the deflection at the wheel.

    Examples
    --------
    An inerter beside spring and damper lowers the frequency of the body:

    >>> import suspension_ctrl as sc
    >>> strut = sc.parallel(sc.Spring(), sc.Damper(), sc.Inerter())
    >>> car = sc.QuarterCar(body_mass=250.0, wheel_mass=35.0, tyre_stiffness=150e3, strut=strut)
    >>> for inerter in (1e-3, 88.0):
    ...     modes = car.modes({"spring": 120e3, "damper": 4471.0, "inerter": inerter})
    ...     print(modes["frequency [Hz]"].round(2).to_list())
    [2.56, 14.18]
    [2.43, 7.59]
    """

    name: str = "inerter"
    value: float | None = field(default=None, metadata=unit("kg"))
    order, unit = 2, "kg"


@dataclass(frozen=True, eq=False, repr=False)
class Rubber(Element):
    """Rubber of complex stiffness k' + j k'', the same at all frequencies: for the frequency domain alone.

    Parameters
    ----------
    name : str
        Name of the element; its coefficients are ``<name>.storage`` and ``<name>.loss``.
    storage, loss : float, optional
        Storage stiffness k' and loss stiffness k'' if a setting gives none, above zero [N/m].
    installation_ratio : float
        Deflection of the rubber over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> strut = sc.parallel(sc.Spring(), sc.series(sc.Damper(), sc.Rubber("mount", storage=250e3, loss=25e3)))
    >>> [one.name for one in strut.coefficients]
    ['spring', 'damper', 'mount.storage', 'mount.loss']
    """

    name: str = "rubber"
    storage: float | None = field(default=None, kw_only=True, metadata=unit("N/m"))
    loss: float | None = field(default=None, kw_only=True, metadata=unit("N/m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("storage", "loss"):
            if getattr(self, name) is not None:
                checks.positive(name, getattr(self, name), "N/m")

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the storage stiffness at the wheel."""
        return values[f"{self.name}.storage"] * self.installation_ratio**2

    @property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """Storage and loss stiffness."""
        return (
            Coefficient(f"{self.name}.storage", "N/m", self.storage),
            Coefficient(f"{self.name}.loss", "N/m", self.loss),
        )


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredStiffness(Element):
    """A measured dynamic stiffness: known in the frequency domain alone, straight between its rows.

    Parameters
    ----------
    name : str
        Name of the element; its coefficient ``<name>.scale`` multiplies the stiffness, 1 if a setting gives none.
    frequency : (n,) array_like
        Ascending [Hz]; outside, the first and the last row hold.
    storage, loss : (n,) array_like
        Storage and loss stiffness, above zero, and zero or more [N/m].
    installation_ratio : float
        Deflection of the element over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> rows = {"frequency": [1.0, 10.0, 20.0], "storage": [240e3, 260e3, 275e3], "loss": [12e3, 25e3, 40e3]}
    >>> mount = sc.MeasuredStiffness("mount", **rows)
    >>> [one.name for one in sc.parallel(sc.Spring(), sc.series(sc.Damper(), mount)).coefficients]
    ['spring', 'damper', 'mount.scale']
    """

    name: str = "mount"
    frequency: Real = field(kw_only=True, metadata=column("Hz"))
    storage: Real = field(kw_only=True, metadata=column("N/m"))
    loss: Real = field(kw_only=True, metadata=column("N/m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        rows = [checks.reals(f"{name} must be", getattr(self, name)) for name in ("frequency", "storage", "loss")]
        if len({row.shape for row in rows}) > 1 or rows[0].ndim != 1 or rows[0].size < 2:
            shapes = ", ".join(str(row.shape) for row in rows)
            raise ValueError(f"frequency, storage and loss must be of one length, 2 or more, got {shapes}")
        checks.ascending("frequency", rows[0])
        for value in rows[1]:
            checks.positive("storage", value, "N/m")
        for value in rows[2]:
            checks.not_negative("loss", value, "N/m")
        self._keep(**dict(zip(("frequency", "storage", "loss"), map(frozen_array, rows), strict=True)))

    def static_stiffness(self, values: Mapping[str, Any], /) -> Any:
        """Return the storage stiffness of the first row at the wheel."""
        return values[f"{self.name}.scale"] * self.storage[0] * self.installation_ratio**2

    @property
    def coefficients(self) -> tuple[Coefficient, ...]:
        """The factor of the stiffness."""
        return (Coefficient(f"{self.name}.scale", "", 1.0),)


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

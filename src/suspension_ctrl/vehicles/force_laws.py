"""Force laws: elements whose force is a curve over their deflection or its rate.

A curve passes through the origin and rises everywhere. It is straight between knots, where it may jump, plus a
power of the rate. Its knots, slopes and jumps depend on the coefficients of the element, see `Curve`.
"""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import nan, prod
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, frozen_array, unit
from .struts import Coefficient, Element, column

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

        first, *slopes = map(product, self.slopes)
        force, jumps = first * x, [*map(product, self.jumps)] or [0.0] * len(slopes)
        for (constant, factors), rise, jump in zip(self.knots, np.diff([first, *slopes]), jumps, strict=True):
            knot = constant + product(factors)
            force += rise * (np.maximum(x - knot, 0.0) - max(-knot, 0.0))
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

    def _curve_of(self, x: Real, force: Real) -> Curve:
        slopes = (np.diff(force) / np.diff(x)).tolist()
        return Curve(
            knots=[(knot, (0.0, ())) for knot in x[1:-1].tolist()], slopes=[(slope, (0,)) for slope in slopes]
        )


@dataclass(frozen=True, eq=False, repr=False)
class TableDamper(Table):
    """A damper by a table of force over rate.

    Parameters
    ----------
    name : str
        Name of the element; its coefficient ``<name>.scale`` multiplies the force, 1 if a setting gives none.
    velocity : (n,) array_like
        Rate of the deflection, ascending, positive in extension (rebound) [m/s]. A table without negative rates is
        that of an odd curve.
    force : (n,) array_like
        Force, positive in tension, nowhere falling, 0 at 0 m/s [N].
    installation_ratio : float
        Deflection of the damper over the deflection at the wheel.

    Raises
    ------
    ValueError
        If rates do not ascend, the force falls, or the curve does not pass through the origin.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> damper = sc.TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -400.0, 0.0, 600.0, 1500.0])
    >>> car = sc.QuarterCar(
    ...     body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(sc.Spring(), damper)
    ... )
    >>> car.coefficients({"spring": 22e3})
    {'spring': 22000.0, 'damper.scale': 1.0}
    """

    of_rate = True
    name: str = "damper"
    velocity: ArrayLike = field(kw_only=True, metadata=column("m/s"))
    force: ArrayLike = field(kw_only=True, metadata=column("N"))

    def __post_init__(self) -> None:
        super().__post_init__()
        velocity, force = _rows("velocity", self.velocity, self.force)
        if velocity[0] >= 0:
            velocity, force = np.concatenate([-velocity[:0:-1], velocity]), np.concatenate([-force[:0:-1], force])
        _check_origin("velocity", velocity, force)
        self._keep(velocity=frozen_array(velocity), force=frozen_array(force))

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        return self._curve_of(np.asarray(self.velocity), np.asarray(self.force))


@dataclass(frozen=True, eq=False, repr=False)
class TableSpring(Table):
    """A spring by a table of force over deflection.

    Parameters
    ----------
    name : str
        Name of the element; its coefficient ``<name>.scale`` multiplies the force, 1 if a setting gives none.
    deflection : (n,) array_like
        Change of length from the static position, ascending, positive in extension [m].
    force : (n,) array_like
        Change of force from the static load, positive in tension, nowhere falling, 0 at 0 m [N].
    installation_ratio : float
        Deflection of the spring over the deflection at the wheel.

    Raises
    ------
    ValueError
        If deflections do not ascend, the force falls, or the curve does not pass through the origin.

    Examples
    --------
    A spring that is stiffer in compression:

    >>> import suspension_ctrl as sc
    >>> spring = sc.TableSpring(deflection=[-0.08, 0.0, 0.08], force=[-3200.0, 0.0, 2000.0])
    >>> [one.name for one in sc.parallel(spring, sc.Damper()).coefficients]
    ['spring.scale', 'damper']
    """

    of_rate = False
    name: str = "spring"
    deflection: ArrayLike = field(kw_only=True, metadata=column("m"))
    force: ArrayLike = field(kw_only=True, metadata=column("N"))

    def __post_init__(self) -> None:
        super().__post_init__()
        deflection, force = _rows("deflection", self.deflection, self.force)
        _check_origin("deflection", deflection, force)
        self._keep(deflection=frozen_array(deflection), force=frozen_array(force))

    @property
    def curve(self) -> Curve:
        """Force [N] over deflection [m]."""
        return self._curve_of(np.asarray(self.deflection), np.asarray(self.force))


@dataclass(frozen=True, eq=False, repr=False)
class BumpStop(ForceLaw):
    """A stop that acts in compression, beyond a gap.

    Parameters
    ----------
    name : str
        Name of the element; its coefficients are ``<name>.gap`` [m], and ``<name>.stiffness`` [N/m], or of a table
        ``<name>.scale``, a factor of the force.
    gap : float, optional
        Compression at which the stop is touched if a setting gives none, above zero [m].
    stiffness : float, optional
        Stiffness of the stop if a setting gives none, above zero [N/m].
    compression, force : (n,) array_like, optional
        In place of a stiffness the compression of the stop from its free length, ascending from 0 [m], and the
        magnitude of its force, nowhere falling, from 0 [N].
    installation_ratio : float
        Compression of the stop by that at the wheel.

    Raises
    ------
    ValueError
        If the table does not begin at 0, does not ascend or falls.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> stop = sc.BumpStop(gap=0.02, stiffness=200e3)
    >>> strut = sc.parallel(sc.Spring(), sc.Damper(), stop, sc.ReboundStop(gap=0.08, stiffness=100e3))
    >>> [one.name for one in strut.coefficients if "stop" in one.name]
    ['bump_stop.gap', 'bump_stop.stiffness', 'rebound_stop.gap', 'rebound_stop.stiffness']
    """

    of_rate = False
    sign: ClassVar[float] = -1.0
    name: str = "bump_stop"
    gap: float | None = field(default=None, kw_only=True, metadata=unit("m"))
    stiffness: float | None = field(default=None, kw_only=True, metadata=unit("N/m"))
    compression: ArrayLike | None = field(default=None, kw_only=True, metadata=column("m"))
    force: ArrayLike | None = field(default=None, kw_only=True, metadata=column("N"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.compression is None) != (self.force is None) or (self.force is not None and self.stiffness):
            raise ValueError("stop must have a stiffness, or compression and force in its place, got others")
        if self.force is not None:
            compression, force = _rows("compression", self.compression, self.force)
            if compression[0] or force[0]:
                got = f"{compression[0]:g} m and {force[0]:g} N"
                raise ValueError(f"compression and force of a stop must begin with 0 m and 0 N, got {got}")
            self._keep(compression=frozen_array(compression), force=frozen_array(force))

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """Gap, and stiffness or factor of the force."""
        gap = Coefficient("gap", "m", self.gap)
        if self.force is None:
            return gap, Coefficient("stiffness", "N/m", self.stiffness)
        return gap, Coefficient("scale", "", 1.0)

    @property
    def curve(self) -> Curve:
        """Force [N] over deflection [m]."""
        depth, slopes = [0.0], [1.0]
        if self.force is not None:
            depth = np.asarray(self.compression)[:-1].tolist()
            slopes = (np.diff(np.asarray(self.force)) / np.diff(np.asarray(self.compression))).tolist()
        knots = [(self.sign * d, (self.sign, (0,))) for d in depth]
        rising = [(0.0, ()), *((slope, (1,)) for slope in slopes)]
        return Curve(knots, rising) if self.sign > 0 else Curve(knots[::-1], rising[::-1])


@dataclass(frozen=True, eq=False, repr=False)
class ReboundStop(BumpStop):
    """A stop that acts in extension, beyond a gap; parameters as of `BumpStop`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.ReboundStop(gap=0.08, stiffness=100e3)
    ReboundStop(gap=0.08 m, stiffness=100000 N/m)
    """

    sign = 1.0
    name: str = "rebound_stop"


@dataclass(frozen=True, eq=False, repr=False)
class Friction(ForceLaw):
    """Coulomb friction: a force of the same magnitude against any motion.

    Parameters
    ----------
    name : str
        Name of the element; its coefficient is ``<name>.force`` [N].
    force : float, optional
        Magnitude if a setting gives none, above zero [N].
    installation_ratio : float
        Sliding distance over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> sc.parallel(sc.Spring(), sc.Damper(), sc.Friction(force=40.0)).coefficients[-1].name
    'friction.force'
    """

    of_rate = True
    name: str = "friction"
    force: float | None = field(default=None, kw_only=True, metadata=unit("N"))

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """The magnitude."""
        return (Coefficient("force", "N", self.force),)

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        return Curve(knots=[(0.0, (0.0, ()))], slopes=[(0.0, ())] * 2, jumps=[(2.0, (0,))])


@dataclass(frozen=True, eq=False, repr=False)
class DigressiveDamper(ForceLaw):
    """A damper with a blow-off valve: steep up to a knee, flatter beyond it.

    Parameters
    ----------
    name : str
        Name of the element; its coefficients are ``<name>.low_speed`` and the like.
    low_speed, high_speed : float, optional
        Slope in compression below and above the knee, above zero [N s/m].
    knee : float, optional
        Rate of the knee in both directions, above zero [m/s].
    rebound_over_bump : float
        Force in extension by that in compression at the same rate, above zero [-].
    installation_ratio : float
        Deflection of the damper over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> damper = sc.DigressiveDamper(low_speed=4000.0, high_speed=800.0, knee=0.1)
    >>> [one.name for one in damper.coefficients]
    ['damper.low_speed', 'damper.high_speed', 'damper.knee', 'damper.rebound_over_bump']
    """

    of_rate = True
    name: str = "damper"
    low_speed: float | None = field(default=None, kw_only=True, metadata=unit("N s/m"))
    high_speed: float | None = field(default=None, kw_only=True, metadata=unit("N s/m"))
    knee: float | None = field(default=None, kw_only=True, metadata=unit("m/s"))
    rebound_over_bump: float = field(default=1.0, kw_only=True, metadata=unit(""))

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """Slopes, knee and ratio."""
        return (
            Coefficient("low_speed", "N s/m", self.low_speed),
            Coefficient("high_speed", "N s/m", self.high_speed),
            Coefficient("knee", "m/s", self.knee),
            Coefficient("rebound_over_bump", "", self.rebound_over_bump),
        )

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        slopes = [(1.0, (1,)), (1.0, (0,)), (1.0, (0, 3)), (1.0, (1, 3))]
        return Curve(knots=[(0.0, (-1.0, (2,))), (0.0, (0.0, ())), (0.0, (1.0, (2,)))], slopes=slopes)


@dataclass(frozen=True, eq=False, repr=False)
class BilinearDamper(ForceLaw):
    """A damper with one slope in compression (bump) and another in extension (rebound).

    Parameters
    ----------
    name : str
        Name of the element; its coefficients are ``<name>.bump`` and ``<name>.rebound``.
    bump, rebound : float, optional
        Slopes if a setting gives none, above zero [N s/m].
    installation_ratio : float
        Deflection of the damper over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> [one.name for one in sc.BilinearDamper(bump=750.0, rebound=2250.0).coefficients]
    ['damper.bump', 'damper.rebound']
    """

    of_rate = True
    name: str = "damper"
    bump: float | None = field(default=None, kw_only=True, metadata=unit("N s/m"))
    rebound: float | None = field(default=None, kw_only=True, metadata=unit("N s/m"))

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """Both slopes."""
        return Coefficient("bump", "N s/m", self.bump), Coefficient("rebound", "N s/m", self.rebound)

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        return Curve(knots=[(0.0, (0.0, ()))], slopes=[(1.0, (0,)), (1.0, (1,))])


@dataclass(frozen=True, eq=False, repr=False)
class PowerDamper(ForceLaw):
    """A fluid damper with force ``c |v|^a sign(v)``: an orifice with a = 2, a viscous damper with a = 1 or less.

    Parameters
    ----------
    name : str
        Name of the element; its coefficients are ``<name>.force`` and ``<name>.exponent``.
    force : float, optional
        Force c at 1 m/s if a setting gives none, above zero [N].
    exponent : float, optional
        Exponent a if a setting gives none, above zero [-].
    installation_ratio : float
        Deflection of the damper over the deflection at the wheel.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> [one.name for one in sc.PowerDamper(force=5000.0, exponent=2.0).coefficients]
    ['damper.force', 'damper.exponent']
    """

    of_rate = True
    name: str = "damper"
    force: float | None = field(default=None, kw_only=True, metadata=unit("N"))
    exponent: float | None = field(default=None, kw_only=True, metadata=unit(""))

    @property
    def values(self) -> tuple[Coefficient, ...]:
        """Force at 1 m/s and exponent."""
        return Coefficient("force", "N", self.force), Coefficient("exponent", "", self.exponent)

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        return Curve(knots=[], slopes=[(0.0, ())], power=(0, 1))


def _rows(name: str, x: ArrayLike | None, force: ArrayLike | None) -> tuple[Real, Real]:
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


def _check_origin(name: str, x: Real, force: Real) -> None:
    """Raise ValueError unless the curve passes through the origin."""
    at_zero = float(np.interp(0.0, x, force))
    if not x[0] <= 0 <= x[-1] or abs(at_zero) > 1e-9 * np.abs(force).max():
        got = f"{at_zero:g} N" if x[0] <= 0 <= x[-1] else f"{name} from {x[0]:g} to {x[-1]:g}"
        raise ValueError(f"force must be 0 N at {name} 0, got {got}")

"""Dampers with force laws: tables, digressive, bilinear and power laws, and friction."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import frozen_array, unit
from .force_laws import Curve, ForceLaw, Table, check_origin, rows_of_curve
from .struts import Coefficient, column


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
        Force, positive in tension, nowhere falling, 0 at 0 m/s [N]. Beyond the last row the curve goes on with its
        last slope; one more row with the same force holds it.
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
        velocity, force = rows_of_curve("velocity", self.velocity, self.force)
        if velocity[0] >= 0:
            velocity, force = np.concatenate([-velocity[:0:-1], velocity]), np.concatenate([-force[:0:-1], force])
        check_origin("velocity", velocity, force)
        self._keep(velocity=frozen_array(velocity), force=frozen_array(force))

    @property
    def curve(self) -> Curve:
        """Force [N] over rate [m/s]."""
        return self.curve_of(np.asarray(self.velocity), np.asarray(self.force))


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

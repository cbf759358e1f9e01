"""Springs with force laws: tables, and stops beyond a gap."""

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import frozen_array, unit
from .force_laws import Curve, ForceLaw, Table, check_origin, rows_of_curve
from .struts import Coefficient, column


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
        deflection, force = rows_of_curve("deflection", self.deflection, self.force)
        check_origin("deflection", deflection, force)
        self._keep(deflection=frozen_array(deflection), force=frozen_array(force))

    @property
    def curve(self) -> Curve:
        """Force [N] over deflection [m]."""
        return self.curve_of(np.asarray(self.deflection), np.asarray(self.force))


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
            compression, force = rows_of_curve("compression", self.compression, self.force)
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

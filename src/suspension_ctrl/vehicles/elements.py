"""Elements of struts by coefficients: springs, dampers, inerters, rubber and measured stiffness."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from .. import checks
from ..quantities import Real, frozen_array, unit
from .struts import Coefficient, Element, Fraction, column


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

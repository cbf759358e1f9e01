"""Roads as one-sided spectral densities of elevation, met over time frequency."""

from dataclasses import KW_ONLY, dataclass, field
from functools import lru_cache
from typing import ClassVar

import numpy as np

from .. import checks, datafiles
from ..quantities import Real, unit
from .coherence import EXPONENTS, power_law_coherence, two_slope_coherence
from .road import Road


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PowerLawRoad(Road):
    """Road of the spectrum ``roughness / n**exponent`` over wavenumber n [cycle/m] (Yuen and Ramli 2010, Table 1).

    Parameters
    ----------
    roughness : float
        One-sided spectral density at 1 cycle/m, G > 0 [m^(3 - exponent) cycle^(exponent - 1)].
    exponent : float
        Waviness kappa from 0.01 to 20 [-].
    coherence : Coherence
        Model of the coherence of parallel tracks.
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].

    Examples
    --------
    The road of Yuen and Ramli. A wave of 20 m is met at 1 Hz by a car at 20 m/s, at 2 Hz by one at 40 m/s, where
    the same elevation is spread over twice the band:

    >>> import suspension_ctrl as sc
    >>> road = sc.PowerLawRoad(roughness=5e-6, exponent=2.5)
    >>> for speed in (20.0, 40.0):
    ...     print(f"{road.psd([speed / 20.0], speed)[0]:.3g} m^2/Hz")
    0.000447 m^2/Hz
    0.000224 m^2/Hz
    """

    roughness: float = field(metadata=unit("m^3"))
    exponent: float = field(metadata=unit("", *EXPONENTS))

    def describe(self) -> str:
        """Return a line that identifies the road."""
        return f"power law: Gd(1 cycle/m) = {self.roughness:g} m^3, exponent {self.exponent:g}{self._contact()}"

    def isotropic_coherence(self, n: Real, distance: float) -> Real:
        """Return the coherence of an isotropic surface, see `power_law_coherence`."""
        return power_law_coherence(n, distance, self.exponent)

    def _psd(self, f: Real, speed: float) -> Real:
        return self.roughness * speed ** (self.exponent - 1) / f**self.exponent


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class TwoSlopeRoad(Road):
    """Road whose elevation spectrum has one exponent below a wavenumber and another above (Dodds and Robson 1973).

    Parameters
    ----------
    roughness, reference : float
        One-sided spectral density Gd(n0) > 0 [m^3] at a wavenumber n0 > 0 [cycle/m], on either side of the corner.
    lower_exponent, upper_exponent : float
        Waviness below and above the corner, from 0.01 to 20 [-].
    corner : float
        Wavenumber > 0 at which the exponent changes [cycle/m]; the spectrum is continuous there.
    coherence : Coherence
        Model of the coherence of parallel tracks.
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].

    Examples
    --------
    Above the corner, at 20 m/s a frequency of 4 Hz, the spectrum falls by 2^3 per octave in place of 2^2:

    >>> import suspension_ctrl as sc
    >>> road = sc.TwoSlopeRoad(roughness=64e-6, reference=0.1, lower_exponent=2.0, upper_exponent=3.0, corner=0.2)
    >>> print(road.describe())
    two slopes: Gd(0.1 cycle/m) = 6.4e-05 m^3, exponent 2 below and 3 above 0.2 cycle/m
    >>> density = road.psd([1.0, 2.0, 4.0, 8.0, 16.0], speed=20.0)
    >>> (density[:-1] / density[1:]).round(2).tolist()
    [4.0, 4.0, 8.0, 8.0]
    """

    roughness: float = field(metadata=unit("m^3"))
    reference: float = field(metadata=unit("cycle/m"))
    lower_exponent: float = field(metadata=unit("", *EXPONENTS))
    upper_exponent: float = field(metadata=unit("", *EXPONENTS))
    corner: float = field(metadata=unit("cycle/m"))

    def describe(self) -> str:
        """Return a line that identifies the road."""
        exponents = f"{self.lower_exponent:g} below and {self.upper_exponent:g} above {self.corner:g} cycle/m"
        reference = f"Gd({self.reference:g} cycle/m) = {self.roughness:g} m^3"
        return f"two slopes: {reference}, exponent {exponents}{self._contact()}"

    def breakpoints(self, speed: float, /) -> tuple[float, ...]:
        """Frequency of the corner at `speed` [m/s], the only kink of the spectrum [Hz]."""
        return (self.corner * speed,)

    def isotropic_coherence(self, n: Real, distance: float) -> Real:
        """Return the coherence of an isotropic surface, see `two_slope_coherence`."""
        return two_slope_coherence(n, distance, self.lower_exponent, self.upper_exponent, self.corner)

    def _psd(self, f: Real, speed: float) -> Real:
        at_corner = self.roughness / self._shape(np.array(self.reference))
        return at_corner * self._shape(f / speed) / speed

    def _shape(self, n: Real) -> Real:
        """Return the spectrum at wavenumbers (n,) [cycle/m], divided by its value at the corner."""
        ratio = n / self.corner
        return ratio ** -np.where(ratio < 1, self.lower_exponent, self.upper_exponent)


@dataclass(frozen=True, eq=False, repr=False)
class Iso8608Road(Road):
    """Road of a class of ISO 8608:2016, ``Gd(n) = Gd(n0) (n/n0)^-w`` with n0 = 0.1 cycle/m.

    Parameters
    ----------
    road_class : str
        ``"A"``, the smoothest, to ``"H"``.
    level : str
        ``"geometric mean"`` of the class, or its ``"lower"`` or ``"upper"`` limit. A has no lower, H no upper one.
    waviness : float
        Exponent w from 0.01 to 20 [-]; 2 in the standard's classes.
    coherence : Coherence
        Model of the coherence of parallel tracks.
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].

    Examples
    --------
    From class to class the spectrum rises by a factor of four, and r.m.s. values by two:

    >>> import suspension_ctrl as sc
    >>> print(sc.Iso8608Road("C").describe())
    ISO 8608 class C, geometric mean: Gd(0.1 cycle/m) = 256e-6 m^3, waviness 2
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> for name in "ABC":
    ...     table = sc.ride(car, {"spring": 22e3, "damper": 1500.0}, sc.Iso8608Road(name), speed=20.0)
    ...     print(f"class {name}: ACC {table['value']['ACC']:.2f} m/s^2, DTL {table['value']['DTL']:.0f} N")
    class A: ACC 0.30 m/s^2, DTL 188 N
    class B: ACC 0.60 m/s^2, DTL 377 N
    class C: ACC 1.19 m/s^2, DTL 754 N
    """

    reference: ClassVar[float] = 0.1  # n0 [cycle/m]
    road_class: str = field(metadata={"key": "class"})
    _: KW_ONLY
    level: str = "geometric mean"
    waviness: float = field(default=2.0, metadata=unit("", *EXPONENTS))

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.one_of("road_class", self.road_class, tuple(_classes()))
        checks.one_of("level", self.level, tuple(_classes()[self.road_class]))

    @property
    def roughness(self) -> float:
        """Spectral density at the reference wavenumber, Gd(n0) [m^3]."""
        return _classes()[self.road_class][self.level]

    def describe(self) -> str:
        """Return a line that identifies the road."""
        density = f"Gd({self.reference:g} cycle/m) = {1e6 * self.roughness:g}e-6 m^3"
        waviness = f"waviness {self.waviness:g}{self._contact()}"
        return f"ISO 8608 class {self.road_class}, {self.level}: {density}, {waviness}"

    def isotropic_coherence(self, n: Real, distance: float) -> Real:
        """Return the coherence of an isotropic surface, see `power_law_coherence`."""
        return power_law_coherence(n, distance, self.waviness)

    def _psd(self, f: Real, speed: float) -> Real:
        return self.roughness * (f / (speed * self.reference)) ** -self.waviness / speed


def limits_of_classes() -> dict[str, float]:
    """Return the upper limit of Gd(n0) by class [m^3], infinite of the last."""
    return {name: levels.get("upper", float("inf")) for name, levels in _classes().items()}


@lru_cache
def _classes() -> dict[str, dict[str, float]]:
    """Gd(n0) [m^3] by class and level; a level that a class does not have is absent."""
    levels = {"geometric mean": "gd_n0_geometric_mean", "lower": "gd_n0_lower", "upper": "gd_n0_upper"}
    return {
        row["class"]: {level: float(row[column]) for level, column in levels.items() if row[column]}
        for row in datafiles.rows("standards/iso8608_classes.csv")
    }

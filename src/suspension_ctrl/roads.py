"""Roads as one-sided spectral densities of elevation, met over time frequency by any number of wheels."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks, datafiles
from .coherence import Coherence, Isotropic, coherence_matrix
from .isotropy import power_law_coherence, two_slope_coherence
from .profiles import Profile, realisation


class RandomRoad(ABC):
    """What all roads can do; a road adds its spectrum and a model of the coherence of its tracks.

    At speed V a vehicle meets wavenumber n [cycle/m] at the frequency f = V n.
    """

    coherence: Coherence
    """How alike parallel tracks are."""

    def psd(self, f: ArrayLike, speed: float) -> NDArray[np.float64]:
        """Return the elevation spectrum met at `speed`; at 1 m/s that over wavenumber [m^3].

        Parameters
        ----------
        f : (n,) array_like
            Frequencies above zero [Hz].
        speed : float
            Vehicle speed V [m/s].

        Returns
        -------
        (n,) ndarray
            One-sided power spectral density [m^2/Hz].

        Raises
        ------
        ValueError
            If the speed is not finite and above zero, or a frequency is not above zero.
        """
        checks.positive("speed", speed, "m/s")
        frequency = np.asarray(f, dtype=float)
        if not (frequency > 0).all():
            raise ValueError(f"f must be > 0 Hz throughout, got a least value of {frequency.min()}")
        return self._psd(frequency, speed)

    def cross_spectrum(self, f: ArrayLike, speed: float, contact_points: ArrayLike) -> NDArray[np.complex128]:
        """Return the spectra of the elevations under several wheels with one another.

        A wheel follows its track with its lead, z_i(t) = h(V t + x_i, y_i), so that S_ij, the expectation of
        Z_i times the conjugate of Z_j, is the road's spectrum times the coherence of the tracks times
        ``exp(2j pi f (x_i - x_j) / V)``.

        Parameters
        ----------
        f : (n,) array_like
            Frequencies above zero [Hz].
        speed : float
            Vehicle speed V [m/s].
        contact_points : (r, 2) array_like
            Where the tyres meet the road, x forward and y to the left [m].

        Returns
        -------
        (n, r, r) complex ndarray
            One-sided cross-spectra [m^2/Hz], Hermitian and positive semi-definite, with `psd` on the diagonal.

        Raises
        ------
        ValueError
            If speed, frequencies or points are not as above, or the coherence is none; see `coherence_matrix`.
        """
        spectrum = self.psd(f, speed)
        frequency, points = np.asarray(f, dtype=float), np.asarray(contact_points, dtype=float)
        if frequency.ndim != 1:
            raise ValueError(f"f must be one-dimensional, got shape {frequency.shape}")
        if points.ndim != 2 or points.shape[1] != 2 or not np.isfinite(points).all():
            raise ValueError(f"contact_points must be finite and of shape (r, 2) [m], got {points.tolist()}")
        x, y = points.T
        lead = np.exp(2j * np.pi / speed * frequency[:, None, None] * (x[:, None] - x))
        return spectrum[:, None, None] * lead * coherence_matrix(self.coherence, frequency / speed, y, self)

    def profile(
        self, length: float, step: float, seed: int | np.random.Generator, tracks: Sequence[float] = (0.0,)
    ) -> Profile:
        """Return a Gaussian realisation of the road, see `profiles.realisation`."""
        return realisation(self, length, step, seed, tracks)

    def breakpoints(self, _speed: float, /) -> tuple[float, ...]:
        """Frequencies at which the spectrum met at a speed [m/s] has a kink [Hz]: none unless a road says so."""
        return ()

    @abstractmethod
    def describe(self) -> str:
        """Return a line that says which road this is, with all numbers that its spectrum needs."""

    @abstractmethod
    def isotropic_coherence(self, n: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
        """Return the coherence that isotropy gives to tracks `distance` [m] apart at `n` (n,) [cycle/m]."""

    @abstractmethod
    def _psd(self, f: NDArray[np.float64], speed: float) -> NDArray[np.float64]:
        """Spectrum (n,) [m^2/Hz] at checked frequencies (n,) [Hz] and speed [m/s]."""


@dataclass(frozen=True, kw_only=True)
class PowerLawRoad(RandomRoad):
    """Road whose elevation spectrum is a single power of frequency (Yuen and Ramli 2010, Table 1).

    Over wavenumber n [cycle/m] the spectrum is ``roughness / n**exponent``.

    Parameters
    ----------
    roughness : float
        One-sided spectral density at 1 cycle/m, G [m^(3 - exponent) cycle^(exponent - 1)].
    exponent : float
        Waviness kappa [-].
    coherence : Coherence
        How alike parallel tracks are.

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero.
    """

    roughness: float
    exponent: float
    coherence: Coherence = field(default_factory=Isotropic)

    def __post_init__(self) -> None:
        checks.positive("roughness", self.roughness)
        checks.positive("exponent", self.exponent)

    def describe(self) -> str:
        """Return a line that says which road this is."""
        return f"power law: Gd(1 cycle/m) = {self.roughness:g} m^3, exponent {self.exponent:g}"

    def isotropic_coherence(self, n: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
        """Return the coherence of an isotropic surface, see `power_law_coherence`."""
        return power_law_coherence(n, distance, self.exponent)

    def _psd(self, f: NDArray[np.float64], speed: float) -> NDArray[np.float64]:
        return self.roughness * speed ** (self.exponent - 1) / f**self.exponent


@dataclass(frozen=True, kw_only=True)
class TwoSlopeRoad(RandomRoad):
    """Road whose elevation spectrum has one exponent below a wavenumber and another above (Dodds and Robson 1973).

    Parameters
    ----------
    roughness : float
        One-sided spectral density at the reference wavenumber, Gd(n0) [m^3].
    reference : float
        Reference wavenumber n0 [cycle/m], on either side of the corner.
    lower_exponent, upper_exponent : float
        Waviness below and above the corner [-].
    corner : float
        Wavenumber at which the exponent changes [cycle/m]; the spectrum is continuous there.
    coherence : Coherence
        How alike parallel tracks are.

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero.
    """

    roughness: float
    reference: float
    lower_exponent: float
    upper_exponent: float
    corner: float
    coherence: Coherence = field(default_factory=Isotropic)

    def __post_init__(self) -> None:
        for name, unit in (("roughness", "m^3"), ("reference", "cycle/m"), ("corner", "cycle/m")):
            checks.positive(name, getattr(self, name), unit)
        checks.positive("lower_exponent", self.lower_exponent)
        checks.positive("upper_exponent", self.upper_exponent)

    def describe(self) -> str:
        """Return a line that says which road this is."""
        return (
            f"two slopes: Gd({self.reference:g} cycle/m) = {self.roughness:g} m^3, exponent "
            f"{self.lower_exponent:g} below and {self.upper_exponent:g} above {self.corner:g} cycle/m"
        )

    def breakpoints(self, speed: float, /) -> tuple[float, ...]:
        """Frequency of the corner at `speed` [m/s], the only kink of the spectrum [Hz]."""
        return (self.corner * speed,)

    def isotropic_coherence(self, n: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
        """Return the coherence of an isotropic surface, see `two_slope_coherence`."""
        return two_slope_coherence(n, distance, self.lower_exponent, self.upper_exponent, self.corner)

    def _psd(self, f: NDArray[np.float64], speed: float) -> NDArray[np.float64]:
        at_corner = self.roughness / self._shape(np.array(self.reference))
        return at_corner * self._shape(f / speed) / speed

    def _shape(self, n: NDArray[np.float64]) -> NDArray[np.float64]:
        """Spectrum over wavenumbers [cycle/m], one at the corner."""
        ratio = n / self.corner
        return ratio ** -np.where(ratio < 1, self.lower_exponent, self.upper_exponent)


@dataclass(frozen=True)
class Iso8608Road(RandomRoad):
    """Road of a class of ISO 8608:2016, ``Gd(n) = Gd(n0) (n/n0)^-w`` with n0 = 0.1 cycle/m.

    Parameters
    ----------
    road_class : str
        ``"A"`` (smoothest) to ``"H"``.
    level : str
        ``"geometric mean"`` of the class, or its ``"lower"`` or ``"upper"`` limit. A has no lower, H no upper one.
    waviness : float
        Exponent w [-]; 2 in the standard's classes.
    coherence : Coherence
        How alike parallel tracks are.

    Raises
    ------
    ValueError
        If there is no such class or level, or the waviness is not finite and above zero.
    """

    road_class: str
    _: KW_ONLY
    level: str = "geometric mean"
    waviness: float = 2.0
    coherence: Coherence = field(default_factory=Isotropic)

    def __post_init__(self) -> None:
        checks.one_of("road_class", self.road_class, tuple(_classes()))
        checks.one_of("level", self.level, tuple(_classes()[self.road_class]))
        checks.positive("waviness", self.waviness)

    @property
    def roughness(self) -> float:
        """Spectral density at the reference wavenumber, Gd(n0) [m^3]."""
        return _classes()[self.road_class][self.level]

    @property
    def reference(self) -> float:
        """Reference wavenumber n0 [cycle/m]."""
        return 0.1

    def describe(self) -> str:
        """Return a line that says which road this is."""
        return (
            f"ISO 8608 class {self.road_class}, {self.level}: Gd({self.reference:g} cycle/m) = "
            f"{1e6 * self.roughness:g}e-6 m^3, waviness {self.waviness:g}"
        )

    def isotropic_coherence(self, n: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
        """Return the coherence of an isotropic surface, see `power_law_coherence`."""
        return power_law_coherence(n, distance, self.waviness)

    def _psd(self, f: NDArray[np.float64], speed: float) -> NDArray[np.float64]:
        return self.roughness * (f / (speed * self.reference)) ** -self.waviness / speed


@lru_cache
def _classes() -> dict[str, dict[str, float]]:
    """Gd(n0) [m^3] by class and level; a level that a class does not have is absent."""
    levels = {"geometric mean": "gd_n0_geometric_mean", "lower": "gd_n0_lower", "upper": "gd_n0_upper"}
    return {
        row["class"]: {level: float(row[column]) for level, column in levels.items() if row[column]}
        for row in datafiles.rows("standards/iso8608_classes.csv")
    }

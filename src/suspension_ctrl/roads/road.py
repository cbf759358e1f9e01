"""Roads: spectra under any number of wheels, and Gaussian profiles of these spectra."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Checked, Complex, Real, unit
from .coherence import COHERENCES, Coherence, Isotropic, coherence_matrix
from .profiles import Profile


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Road(Checked, ABC):
    """The spectrum of a road's elevation and the coherence of parallel tracks.

    At speed V a vehicle meets wavenumber n [cycle/m] at the frequency f = V n.

    Parameters
    ----------
    coherence : Coherence
        Model of the coherence of parallel tracks.
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m]: a fixed footprint (K. M.
        Captain, A. B. Boghani and D. N. Wormley, "Analytical tire models for dynamic vehicle simulation", Vehicle
        System Dynamics 8, 1979). It multiplies the spectrum by sinc^2 of wavenumber times length.
    """

    coherence: Coherence = field(default_factory=Isotropic, metadata={"kinds": COHERENCES})
    contact_length: float = field(default=0.0, metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        if isinstance(self.coherence, type) or not callable(getattr(self.coherence, "between", None)):
            raise ValueError(
                f"coherence must be a model such as Exponential(decay=3.0), got {checks.shown(self.coherence)}"
            )

    def psd(self, f: ArrayLike, speed: float) -> Real:
        """Return the elevation spectrum met at `speed`; at 1 m/s that over wavenumber [m^3].

        Parameters
        ----------
        f : (n,) array_like
            Frequencies above zero [Hz].
        speed : float
            Vehicle speed V > 0 [m/s].

        Returns
        -------
        (n,) ndarray
            One-sided power spectral density [m^2/Hz].
        """
        checks.positive("speed", speed, "m/s")
        frequency = checks.reals("f must be", f)
        if not (frequency > 0).all():
            raise ValueError(f"f must be > 0 Hz throughout, got a least value of {frequency.min()}")
        spectrum = self._psd(frequency, speed)
        return (
            spectrum * np.sinc(frequency / speed * self.contact_length) ** 2 if self.contact_length else spectrum
        )

    def cross_spectrum(self, f: ArrayLike, speed: float, contact_points: ArrayLike) -> Complex:
        """Return the cross-spectra of the elevations under several wheels.

        Wheel i meets its track as z_i(t) = h(V t + x_i, y_i): S_ij = E[Z_i conj(Z_j)] is the road's spectrum times
        the coherence of the tracks times ``exp(2j pi f (x_i - x_j) / V)``.

        Parameters
        ----------
        f, speed
            As of `psd`, one-dimensional.
        contact_points : (r, 2) array_like
            Where the tyres meet the road, x forward and y to the left [m].

        Returns
        -------
        (n, r, r) complex ndarray
            One-sided cross-spectra [m^2/Hz], Hermitian and positive semi-definite, with `psd` on the diagonal.

        Raises
        ------
        ValueError
            If a parameter is not as above, or the coherence is not from 0 to 1 or its matrix not semi-definite.
        """
        spectrum = self.psd(f, speed)
        frequency, points = np.asarray(f, dtype=float), np.asarray(contact_points, dtype=float)
        if frequency.ndim != 1:
            raise ValueError(f"f must be one-dimensional, got shape {frequency.shape}")
        if points.ndim != 2 or points.shape[1] != 2 or not (len(points) and np.isfinite(points).all()):
            raise ValueError(
                f"contact_points must be finite and of shape (r, 2), r > 0 [m], got {points.tolist()}"
            )
        x, y = points.T
        lead = np.exp(2j * np.pi / speed * frequency[:, None, None] * (x[:, None] - x))
        return spectrum[:, None, None] * lead * coherence_matrix(self._between(), frequency / speed, y)

    def profile(
        self, length: float, step: float, seed: int | np.random.Generator, tracks: Sequence[float] = (0.0,)
    ) -> Profile:
        """Return a Gaussian profile with the road's spectrum and, between tracks, its coherence.

        Waves of the wavenumbers k/length below 1/(2 step), k = 1, 2, ..., have random amplitudes: the expectation
        of the periodogram is the road's spectrum. The profile has the period `length` and zero mean.

        Parameters
        ----------
        length, step : float
            Length of the road, a whole number of steps, at least four, and distance between two points [m].
        seed : int or numpy.random.Generator
        tracks : (t,) sequence of float
            Place of each track across the road, positive to the left [m].

        Returns
        -------
        Profile
            At the distances 0, step, ... below `length`.
        """
        checks.positive("step", step, "m")
        checks.positive("length", length, "m")
        if not isinstance(seed, np.random.Generator):
            seed = checks.at_least("seed", seed, 0)
        y = checks.reals("tracks must be", tracks)
        if y.ndim != 1 or y.size == 0 or not np.isfinite(y).all():
            raise ValueError(f"tracks must be finite and one-dimensional, got {checks.shown(tracks)}")
        points = round(length / step)
        if points < 4 or abs(length / step - points) > 1e-6:
            raise ValueError(f"length must be a whole number of steps of {step} m, four at least, got {length} m")
        n = np.arange(1, (points + 1) // 2) / length
        amplitude = points / 2 * np.sqrt(self.psd(n, 1.0) / length)  # of the real and of the imaginary part
        waves = np.zeros((points // 2 + 1, y.size), dtype=complex)
        waves[1 : n.size + 1] = amplitude[:, None] * self._coherent(n, y, np.random.default_rng(seed))
        heights = np.fft.irfft(waves, points, axis=0)
        return Profile(step * np.arange(points, dtype=float), heights, tuple(y.tolist()))

    def _contact(self) -> str:
        """Return the contact in words, for `describe`."""
        return f"; averaged over {self.contact_length:g} m of contact" if self.contact_length else ""

    def breakpoints(self, _speed: float, /) -> tuple[float, ...]:
        """Frequencies of the kinks of the spectrum met at a speed [m/s], in Hz."""
        return ()

    @abstractmethod
    def describe(self) -> str:
        """Return a line that identifies the road, with all numbers of its spectrum."""

    @abstractmethod
    def isotropic_coherence(self, n: Real, distance: float) -> Real:
        """Return the coherence of tracks `distance` [m] apart at `n` (n,) [cycle/m] on an isotropic surface."""

    @abstractmethod
    def _psd(self, f: Real, speed: float) -> Real:
        """Spectrum (n,) [m^2/Hz] at checked frequencies (n,) [Hz] and speed [m/s]."""

    def _between(self) -> Callable[[Real, float], Real]:
        """Return the coherence (n,) of two tracks as a function of wavenumbers (n,) and their distance."""
        if isinstance(self.coherence, Isotropic) and self.coherence.exponent is None:
            return self.isotropic_coherence
        return self.coherence.between

    def _coherent(self, n: Real, y: Real, rng: np.random.Generator) -> Complex:
        """Complex normal numbers (n, t), variance one per part, whose covariance over t is the coherence."""
        independent = rng.standard_normal((n.size, y.size)) + 1j * rng.standard_normal((n.size, y.size))
        variance, direction = np.linalg.eigh(coherence_matrix(self._between(), n, y))
        return np.einsum("nij,nj->ni", direction, independent * np.sqrt(np.maximum(variance, 0.0)))

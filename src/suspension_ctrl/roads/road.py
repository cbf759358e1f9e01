"""What all roads can do: spectra under any number of wheels, and realisations."""

from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks
from .coherence import Coherence, coherence_matrix
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

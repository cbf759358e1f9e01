"""Road irregularity as a one-sided power spectral density of elevation over time frequency."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import checks


@dataclass(frozen=True, kw_only=True)
class PowerLawRoad:
    """Road whose elevation spectrum is a single power of frequency (Yuen and Ramli 2010, Table 1).

    Over wavenumber n [cycle/m] the spectrum is ``roughness / n**exponent``; at speed V a vehicle meets it
    at f = V n.

    Parameters
    ----------
    roughness : float
        One-sided spectral density at 1 cycle/m, G [m^(3 - exponent) cycle^(exponent - 1)].
    exponent : float
        Waviness kappa [-].

    Raises
    ------
    ValueError
        If a parameter is not finite and above zero.
    """

    roughness: float
    exponent: float

    def __post_init__(self) -> None:
        checks.positive("roughness", self.roughness)
        checks.positive("exponent", self.exponent)

    def psd(self, f: ArrayLike, speed: float) -> NDArray[np.float64]:
        """Return the elevation spectrum met at `speed`, ``roughness * speed**(exponent - 1) / f**exponent``.

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
        return self.roughness * speed ** (self.exponent - 1) / frequency**self.exponent

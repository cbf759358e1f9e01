"""Coherence of the tracks of an isotropic surface, which the spectrum of a single track settles."""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gammaln, hankel1, kv


def power_law_coherence(n: ArrayLike, distance: float, exponent: float) -> NDArray[np.float64]:
    """Return the coherence of tracks on an isotropic surface of a power-law spectrum.

    Of a surface with the spectrum Phi(k) ~ k^-(w + 1) over the wave vector, a track has the integral of Phi across
    the track, ~ n^-w, and two tracks the integral with cos(2 pi m d). By Basset's integral (DLMF 10.32.11) their
    ratio is ``2^(1 - v)/Gamma(v) z^v K_v(z)`` with ``v = w/2`` and ``z = 2 pi n d``.

    Parameters
    ----------
    n : (n,) array_like
        Wavenumbers above zero [cycle/m].
    distance : float
        Distance of the tracks d > 0 [m].
    exponent : float
        Exponent w > 0 of the spectrum [-].

    Returns
    -------
    (n,) ndarray
        From 0 to 1 [-].
    """
    z, v = 2 * np.pi * distance * np.asarray(n, dtype=float), exponent / 2
    with np.errstate(all="ignore"):
        coherence = np.exp((1 - v) * np.log(2) - gammaln(v) + v * np.log(z)) * kv(v, z)
    # K_v overflows only where z is so small that the limit one is reached
    return np.clip(np.where(np.isfinite(coherence), coherence, 1.0), 0.0, 1.0)


def two_slope_coherence(
    n: NDArray[np.float64], distance: float, lower: float, upper: float, corner: float
) -> NDArray[np.float64]:
    """Return the coherence of tracks on an isotropic surface whose spectrum has another exponent above a corner.

    Abel's inversion of the track's spectrum G gives the cross-spectrum as the integral of
    ``-G'(s) J_0(2 pi d sqrt(s^2 - n^2))`` over s from n on, which has nothing of what lies below n. So above the
    corner the upper power law holds; below it the lower one, and the difference of the two is integrated from the
    corner on along the imaginary direction, where the Hankel function in place of J_0 decays.

    Parameters
    ----------
    n : (n,) ndarray
        Wavenumbers above zero [cycle/m].
    distance : float
        Distance of the tracks d > 0 [m].
    lower, upper : float
        Exponents of the spectrum below and above the corner [-].
    corner : float
        Wavenumber at which the exponent changes [cycle/m].

    Returns
    -------
    (n,) ndarray
        From 0 to 1 [-].
    """
    coherence = np.where(
        n < corner, power_law_coherence(n, distance, lower), power_law_coherence(n, distance, upper)
    )
    below = n < corner
    if lower != upper and below.any():
        coherence[below] += _beyond_corner(n[below] / corner, 2 * np.pi * distance * corner, lower, upper)
    return np.clip(coherence, 0.0, 1.0)


def _beyond_corner(n: NDArray[np.float64], d: float, lower: float, upper: float) -> NDArray[np.float64]:
    """Integral of (G_lower' - G_upper') J_0 from the corner on, over G(n); n < 1 and d in units of the corner.

    With t = exp(x) the integrand is analytic for |Im x| < pi/2 and the trapezoidal rule converges as
    exp(-pi^2/h), to 1e-11 or better for a step of h = 0.3. Below t = exp(-36) there is nothing, and beyond a
    decay by exp(-40) nothing is left.
    """
    x = np.arange(-36.0, np.log(40 / d) + 0.3, 0.3)
    t = np.exp(x)
    s = 1 + 1j * t
    slope = upper * s ** (-upper - 1) - lower * s ** (-lower - 1)
    kernel = hankel1(0, d * np.sqrt(s**2 - n[:, None] ** 2))
    return n**lower * 0.3 * (1j * t * slope * kernel).real.sum(axis=1)

"""Coherence of parallel tracks: cross-spectrum over common spectrum; `scipy.signal.coherence` is its square."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Checked, Real, unit

EXPONENTS = (0.01, 20.0)
"""Least and largest exponent of a spectrum: far beyond roads, and its powers are finite."""
_ROUNDING = 1e-9  # magnitude of negative eigenvalues of a matrix of coherences by rounding, per track


class Coherence(Protocol):
    """A model of coherence, the field ``coherence`` of every road."""

    def between(self, n: Real, distance: float, /) -> Real:
        """Return the coherence (n,) from 0 to 1 of tracks `distance` > 0 [m] apart at `n` (n,) [cycle/m]."""


@dataclass(frozen=True, eq=False, repr=False)
class Isotropic(Checked):
    """Surface whose profiles have the same spectrum in every direction [1]_, [2]_.

    The road's own spectrum then determines the coherence: in closed form for a power law, by an integral over all
    shorter waves for two slopes. A measured spectrum ends and takes an `exponent` instead.

    Parameters
    ----------
    exponent : float, optional
        Exponent from 0.01 to 20 of the power law for the coherence, in place of the road's own spectrum [-].

    References
    ----------
    .. [1] C. J. Dodds and J. D. Robson, "The description of road surface roughness", Journal of Sound and
       Vibration 31 (1973).
    .. [2] K. M. A. Kamash and J. D. Robson, "Implications of isotropy in random surfaces", Journal of Sound and
       Vibration 54 (1977).

    Examples
    --------
    Long waves lift both wheels of an axle together, short ones each by itself. Coherence of tracks 1.5 m apart
    at wavelengths of 100, 10 and 1 m:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> road = sc.Iso8608Road("C", coherence=sc.Isotropic())
    >>> wheels = [(0.0, 0.75), (0.0, -0.75)]  # m
    >>> spectra = road.cross_spectrum([0.2, 2.0, 20.0], speed=20.0, contact_points=wheels)
    >>> np.abs(spectra[:, 0, 1] / spectra[:, 0, 0]).round(2)
    array([0.99, 0.63, 0.  ])
    """

    exponent: float | None = field(default=None, metadata=unit("", *EXPONENTS))

    def between(self, n: Real, distance: float) -> Real:
        """Return the coherence; see `Coherence`. Without an exponent it is the road's."""
        if self.exponent is None:
            raise ValueError("exponent must be given where there is no road, got None")
        return power_law_coherence(n, distance, self.exponent)


@dataclass(frozen=True, eq=False, repr=False)
class Exponential(Checked):
    """Coherence ``exp(-decay n d)`` over wavenumber n and distance d, one of the models in use [1]_, [2]_.

    Parameters
    ----------
    decay : float
        Decay per cycle, 0 to 1e6 [-]; 0 for identical tracks.

    References
    ----------
    .. [1] K. Bogsjo, "Coherence of road roughness in left and right wheel-path", Vehicle System Dynamics 46
       (2008), on exponential coherence with one parameter.
    .. [2] P. Mucka, "Model of coherence function of road unevenness in parallel tracks for vehicle simulation",
       International Journal of Vehicle Design 67 (2015), on this and others beside measured roads.

    Examples
    --------
    Coherence of tracks 1.5 m apart at wavelengths of 100, 10 and 1 m, with a decay of 3 per cycle:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> sc.Exponential(decay=3.0).between(np.array([0.01, 0.1, 1.0]), 1.5).round(2)
    array([0.96, 0.64, 0.01])
    """

    decay: float = field(metadata=unit("", 0.0, 1e6))

    def between(self, n: Real, distance: float) -> Real:
        """Return the coherence; see `Coherence`."""
        return np.exp(-self.decay * n * distance)


@dataclass(frozen=True, eq=False, repr=False)
class Constant(Checked):
    """One coherence for any two tracks, at all wavenumbers.

    Parameters
    ----------
    value : float
        From 0, uncorrelated tracks, to 1, identical tracks (cylindrical road) [-].

    Examples
    --------
    Identical tracks do not roll a car with left and right alike:

    >>> import suspension_ctrl as sc
    >>> file = sc.load_vehicle("jian_2022_full")
    >>> for coherence in (sc.Constant(1.0), sc.Constant(0.0)):
    ...     road = sc.Iso8608Road("C", coherence=coherence)
    ...     table = sc.ride(file.vehicle, file.setting, road, speed=20.0, band=(0.3, 20.0))
    ...     print(f"{table['value']['roll_acceleration']:.2f} {table['unit']['roll_acceleration']}")
    0.00 rad/s^2
    0.71 rad/s^2
    """

    value: float = field(metadata=unit("", 0.0, 1.0))

    def between(self, n: Real, _distance: float) -> Real:
        """Return the coherence; see `Coherence`."""
        return np.full(n.shape, self.value)


@dataclass(frozen=True, eq=False, repr=False)
class Tabulated(Checked):
    """Measured coherence of two tracks, linear over wavenumber between the rows of a table.

    Below the first row it rises to 1 at wavenumber 0, beyond the last it is constant. Tracks at a distance d have
    the coherence of the measured distance D to the power of d/D, as of an exponential coherence.

    Parameters
    ----------
    wavenumber, coherence : (k,) sequence of float
        Wavenumbers, ascending and above zero [cycle/m], and as many coherences from 0 to 1 [-].
    distance : float
        Distance of the measured tracks, above zero [m].

    Examples
    --------
    Measured between tracks 1.5 m apart; tracks at half that distance have the root of that coherence:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> measured = sc.Tabulated(wavenumber=(0.05, 0.2, 1.0), coherence=(0.95, 0.7, 0.1), distance=1.5)
    >>> measured.between(np.array([0.2, 0.6]), 1.5).round(2)
    array([0.7, 0.4])
    >>> measured.between(np.array([0.2, 0.6]), 0.75).round(2)
    array([0.84, 0.63])
    """

    wavenumber: tuple[float, ...] = field(metadata=unit("cycle/m") | {"most": 10_000})
    coherence: tuple[float, ...] = field(metadata={"most": 10_000})
    distance: float = field(metadata=unit("m"))

    def __post_init__(self) -> None:
        super().__post_init__()
        n = checks.reals("wavenumber must be", self.wavenumber)
        gamma = checks.reals("coherence must be", self.coherence)
        if n.ndim != 1 or n.shape != gamma.shape or n.size == 0:
            raise ValueError(f"wavenumber and coherence must be of one length, got {n.shape} and {gamma.shape}")
        checks.ascending("wavenumber", n)
        if not ((gamma >= 0) & (gamma <= 1)).all():
            raise ValueError(f"coherence must be from 0 to 1, got {gamma.min()} to {gamma.max()}")
        self._keep(wavenumber=tuple(n.tolist()), coherence=tuple(gamma.tolist()))

    def between(self, n: Real, distance: float) -> Real:
        """Return the coherence; see `Coherence`."""
        measured = np.interp(n, (0.0, *self.wavenumber), (1.0, *self.coherence))
        return np.asarray(measured ** (distance / self.distance))


COHERENCES: dict[str, type] = {
    "isotropic": Isotropic, "exponential": Exponential, "constant": Constant, "tabulated": Tabulated,
}  # fmt: skip
"""Models of coherence by their kinds in files."""


def coherence_matrix(between: Callable[[Real, float], Real], n: Real, y: Real) -> Real:
    """Return the coherence (n, r, r), positive semi-definite, of tracks at `y` (r,) [m] at wavenumbers (n,)."""
    distances, which = np.unique(np.abs(y[:, None] - y), return_inverse=True)
    values = np.array([_checked(between(n, d), n) if d else np.ones(n.shape) for d in distances.tolist()])
    matrix = np.moveaxis(values[which.reshape(y.size, y.size)], 2, 0)
    if y.size > 2 and not np.linalg.eigvalsh(matrix).min(initial=0.0) >= -_ROUNDING * y.size:
        got = f"none for tracks at {y.tolist()} m"
        raise ValueError(f"coherence must make a positive semi-definite matrix, got {got}")
    return matrix


def _checked(values: ArrayLike, n: Real) -> Real:
    values = np.asarray(values)
    real = values.dtype.kind in "fiu"
    if not (values.shape == n.shape and real and ((values >= 0) & (values <= 1)).all()):
        got = f"{values.min()} to {values.max()}" if real and values.size else f"{values.dtype}"
        got = f"{got} of shape {values.shape}"
        raise ValueError(f"coherence must be real, from 0 to 1 and of shape {n.shape}, got {got}")
    return values


def power_law_coherence(n: ArrayLike, distance: float, exponent: float) -> Real:
    """Return the coherence (n,) of tracks `distance` d [m] apart on an isotropic surface of a power-law spectrum.

    The surface's spectrum Phi(k) ~ k^-(w + 1), integrated across the track, gives a track's, ~ n^-w, and with
    cos(2 pi m d) that of two tracks. By Basset's integral (DLMF 10.32.11) their ratio is
    ``2^(1 - v)/Gamma(v) z^v K_v(z)`` with ``v = w/2`` and ``z = 2 pi n d``.
    """
    from scipy.special import gammaln, kv

    z, v = 2 * np.pi * distance * np.asarray(n, dtype=float), exponent / 2
    with np.errstate(all="ignore"):
        coherence = np.exp((1 - v) * np.log(2) - gammaln(v) + v * np.log(z)) * kv(v, z)
    # K_v overflows for z near 0 alone, where the coherence is one
    return np.clip(np.where(np.isfinite(coherence), coherence, 1.0), 0.0, 1.0)


def two_slope_coherence(n: Real, distance: float, lower: float, upper: float, corner: float) -> Real:
    """Return the coherence (n,) on an isotropic surface whose spectrum has another exponent above a corner.

    By Abel's inversion of the track's spectrum G, the cross-spectrum is the integral of
    ``-G'(s) J_0(2 pi d sqrt(s^2 - n^2))`` over s > n: above the corner that of the upper power law, below it
    that of the lower one and a correction for the waves beyond the corner.
    """
    below = n < corner
    coherence = np.where(below, *(power_law_coherence(n, distance, exponent) for exponent in (lower, upper)))
    if lower != upper and below.any():
        coherence[below] += _beyond_corner(n[below] / corner, 2 * np.pi * distance * corner, lower, upper)
    return np.clip(coherence, 0.0, 1.0)


def _beyond_corner(n: Real, d: float, lower: float, upper: float) -> Real:
    """Integral of (G_lower' - G_upper') J_0 from the corner on, over G(n); n < 1 and d in units of the corner.

    Along s = 1 + i t the Hankel function in place of J_0 decays. With t = exp(x) the integrand is analytic for
    |Im x| < pi/2: the trapezoidal rule converges as exp(-pi^2/h), to 1e-11 or better for a step of h = 0.3. The
    integrand is negligible below t = exp(-36) and beyond a decay by exp(-40).
    """
    from scipy.special import hankel1

    t = np.exp(np.arange(-36.0, np.log(40 / d) + 0.3, 0.3))
    s = 1 + 1j * t
    slope = upper * s ** (-upper - 1) - lower * s ** (-lower - 1)
    kernel = hankel1(0, d * np.sqrt(s**2 - n[:, None] ** 2))
    return n**lower * 0.3 * (1j * t * slope * kernel).real.sum(axis=1)

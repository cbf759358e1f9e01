"""Coherence of the elevations of parallel tracks: how alike left and right are, by wavenumber and distance.

It is the cross-spectrum of two tracks over their common spectrum; `scipy.signal.coherence` returns its square.
"""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .. import checks
from .isotropy import power_law_coherence

_ROUNDING = 1e-9
"""What an eigenvalue of a matrix of coherences may lie below zero by."""


class Surface(Protocol):
    """What an isotropic coherence needs of a road."""

    def isotropic_coherence(self, n: NDArray[np.float64], distance: float) -> NDArray[np.float64]:
        """Return the coherence (n,) of tracks `distance` [m] apart at wavenumbers `n` (n,) [cycle/m]."""


class Coherence(Protocol):
    """A model of coherence, the field ``coherence`` of every road."""

    def between(self, n: NDArray[np.float64], distance: float, road: Surface, /) -> NDArray[np.float64]:
        """Return the coherence (n,) from 0 to 1 of tracks `distance` > 0 [m] apart at `n` (n,) [cycle/m]."""


@dataclass(frozen=True)
class Isotropic:
    """Surface whose profiles have the same spectrum in every direction [1]_, [2]_.

    The road's own spectrum then settles the coherence: in closed form for a power law, by an integral for two
    slopes. A measured spectrum ends where the integral needs it to go on, and takes an `exponent` instead.

    Parameters
    ----------
    exponent : float, optional
        Coherence as on a road of this exponent, whatever the road's spectrum is.

    Raises
    ------
    ValueError
        If the exponent is not finite and above zero; from `between`, if it is needed and absent.

    References
    ----------
    .. [1] C. J. Dodds and J. D. Robson, "The description of road surface roughness", Journal of Sound and
       Vibration 31 (1973).
    .. [2] K. M. A. Kamash and J. D. Robson, "Implications of isotropy in random surfaces", Journal of Sound and
       Vibration 54 (1977).
    """

    exponent: float | None = None

    def __post_init__(self) -> None:
        if self.exponent is not None:
            checks.positive("exponent", self.exponent)

    def between(self, n: NDArray[np.float64], distance: float, road: Surface) -> NDArray[np.float64]:
        """Return the coherence; see `Coherence`."""
        if self.exponent is None:
            return road.isotropic_coherence(n, distance)
        return power_law_coherence(n, distance, self.exponent)


@dataclass(frozen=True)
class Exponential:
    """Coherence ``exp(-decay n d)`` over wavenumber n and distance d, one of the models in use [1]_, [2]_.

    Parameters
    ----------
    decay : float
        Decay per cycle [-]; 0 for tracks that are all alike.

    Raises
    ------
    ValueError
        If the decay is not finite and at least zero.

    References
    ----------
    .. [1] K. Bogsjo, "Coherence of road roughness in left and right wheel-path", Vehicle System Dynamics 46
       (2008), on exponential coherence with one parameter.
    .. [2] P. Mucka, "Model of coherence function of road unevenness in parallel tracks for vehicle simulation",
       International Journal of Vehicle Design 67 (2015), on this and others beside measured roads.
    """

    decay: float

    def __post_init__(self) -> None:
        checks.within("decay", self.decay, 0.0, 1e6)

    def between(self, n: NDArray[np.float64], distance: float, _road: Surface) -> NDArray[np.float64]:
        """Return the coherence; see `Coherence`."""
        return np.exp(-self.decay * n * distance)


@dataclass(frozen=True)
class Constant:
    """One coherence for any two tracks, at all wavenumbers: 1 for a road shaped like a cylinder, 0 for strangers.

    Parameters
    ----------
    value : float
        From 0 to 1 [-].

    Raises
    ------
    ValueError
        If the value is out of range.
    """

    value: float

    def __post_init__(self) -> None:
        checks.within("value", self.value, 0.0, 1.0)

    def between(self, n: NDArray[np.float64], _distance: float, _road: Surface) -> NDArray[np.float64]:
        """Return the coherence; see `Coherence`."""
        return np.full(n.shape, self.value)


@dataclass(frozen=True)
class Tabulated:
    """Measured coherence of two tracks, straight over wavenumber between the rows of a table.

    Below the first row it goes straight to 1 at wavenumber 0, beyond the last it stays. Tracks at another
    distance d than the measured one D have at n the coherence of n d/D, as on an isotropic power-law road, where
    it depends on the product alone.

    Parameters
    ----------
    wavenumber : (k,) sequence of float
        Ascending, above zero [cycle/m].
    coherence : (k,) sequence of float
        From 0 to 1 [-].
    distance : float
        How far apart the tracks were that were measured [m].

    Raises
    ------
    ValueError
        If a parameter is out of range or the lengths differ.
    """

    wavenumber: tuple[float, ...] = field(repr=False)
    coherence: tuple[float, ...] = field(repr=False)
    distance: float

    def __post_init__(self) -> None:
        checks.positive("distance", self.distance, "m")
        n, gamma = np.asarray(self.wavenumber, dtype=float), np.asarray(self.coherence, dtype=float)
        if n.ndim != 1 or n.shape != gamma.shape or n.size == 0:
            raise ValueError(f"wavenumber and coherence must be of one length, got {n.shape} and {gamma.shape}")
        if not (np.isfinite(n).all() and (np.diff(n, prepend=0) > 0).all()):
            raise ValueError("wavenumber must be above zero, finite and ascending")
        if not ((gamma >= 0) & (gamma <= 1)).all():
            raise ValueError(f"coherence must be from 0 to 1, got {gamma.min()} to {gamma.max()}")
        object.__setattr__(self, "wavenumber", tuple(n.tolist()))
        object.__setattr__(self, "coherence", tuple(gamma.tolist()))

    def between(self, n: NDArray[np.float64], distance: float, _road: Surface) -> NDArray[np.float64]:
        """Return the coherence; see `Coherence`."""
        return np.interp(n * distance / self.distance, (0.0, *self.wavenumber), (1.0, *self.coherence))


def coherence_matrix(
    model: Coherence, n: NDArray[np.float64], y: NDArray[np.float64], road: Surface
) -> NDArray[np.float64]:
    """Return the coherence of every two of several tracks.

    Parameters
    ----------
    model : Coherence
        The model.
    n : (n,) ndarray
        Wavenumbers above zero [cycle/m].
    y : (r,) ndarray
        Where the tracks are across the road [m]; equal ones are one track, of coherence one with itself.
    road : Surface
        The road.

    Returns
    -------
    (n, r, r) ndarray
        Symmetric and positive semi-definite, one on the diagonal [-].

    Raises
    ------
    ValueError
        If the model does not return as many values from 0 to 1, or a matrix that belongs to no road.
    """
    distances, which = np.unique(np.abs(y[:, None] - y), return_inverse=True)
    values = np.array([_checked(model, n, d, road) for d in distances.tolist()])
    matrix = np.moveaxis(values[which.reshape(y.size, y.size)], 2, 0)
    if y.size > 2 and not np.linalg.eigvalsh(matrix).min(initial=0.0) >= -_ROUNDING * y.size:
        raise ValueError(
            f"coherence must make a positive semi-definite matrix, got none for tracks at {y.tolist()} m"
        )
    return matrix


def _checked(model: Coherence, n: NDArray[np.float64], distance: float, road: Surface) -> NDArray[np.float64]:
    if distance == 0:
        return np.ones(n.shape)
    values = np.asarray(model.between(n, distance, road))
    real = values.dtype.kind in "fiu"
    if not (values.shape == n.shape and real and ((values >= 0) & (values <= 1)).all()):
        got = f"{values.min()} to {values.max()}" if real and values.size else f"{values.dtype}"
        raise ValueError(
            f"coherence must be real, from 0 to 1 and of shape {n.shape}, got {got} of shape {values.shape}"
        )
    return values

"""Weighted root mean square of a given spectrum."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real
from . import weightings
from .weightings import Weighting

if TYPE_CHECKING:
    import control


def weighted_rms(
    frequency: ArrayLike,
    psd: ArrayLike,
    weighting: "Weighting | control.LTI | None" = "Wk",
    *,
    band: tuple[float, float] | None = None,
) -> float:
    """Return the weighted root mean square of a given spectrum, a measured one for example.

    The weighted spectrum is integrated by the trapezoidal rule, straight between the frequencies.

    Parameters
    ----------
    frequency : (n,) array_like
        Two or more, ascending, >= 0 [Hz].
    psd : (n,) array_like
        One-sided spectral density, >= 0 [unit^2/Hz].
    weighting : str, control.LTI or None
        As of `RideProblem`; None for no weighting.
    band : (float, float), optional
        Frequencies over which the spectrum is integrated, within those given [Hz].

    Raises
    ------
    ValueError
        If frequencies or densities are not as above, or the band reaches beyond the frequencies.

    Examples
    --------
    An acceleration of 0.5 (m/s^2)^2/Hz from 1 to 80 Hz:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> f = np.linspace(1.0, 80.0, 400)  # Hz
    >>> for weighting in (None, "Wk", "Wd"):
    ...     print(f"{sc.weighted_rms(f, np.full(f.size, 0.5), weighting):.2f} m/s^2")
    6.28 m/s^2
    3.19 m/s^2
    1.20 m/s^2
    """
    f, density = _checked(frequency, psd)
    if band is not None:
        checks.interval("band", band, "Hz")
        if band[0] < f[0] or band[1] > f[-1]:
            raise ValueError(f"band must lie within {f[0]:g} to {f[-1]:g} Hz, got {checks.shown(band)}")
        inside = np.array([band[0], *f[(f > band[0]) & (f < band[1])], band[1]])
        f, density = inside, np.interp(inside, f, density)
    known = weightings.checked(weighting)
    factor = np.zeros(f.size) if known else np.ones(f.size)
    if known:
        factor[f > 0] = weightings.by_name(known).factor(f[f > 0])  # weightings pass nothing at 0 Hz
    return float(np.sqrt(np.trapezoid(density * factor**2, f)))


def _checked(frequency: ArrayLike, psd: ArrayLike) -> tuple[Real, Real]:
    """Return frequencies (n,) and densities (n,); ValueError for others."""
    f, density = checks.reals("frequency must be", frequency), checks.reals("psd must be", psd)
    if f.ndim != 1 or f.shape != density.shape or f.size < 2:
        raise ValueError(f"frequency and psd must be of one length >= 2, got {f.shape} and {density.shape}")
    if not (np.isfinite(f).all() and f[0] >= 0 and (np.diff(f) > 0).all()):
        raise ValueError(f"frequency must be finite, >= 0 Hz and ascend, got {checks.shown(f.tolist())}")
    if not (np.isfinite(density) & (density >= 0)).all():
        raise ValueError(f"psd must be finite and >= 0 throughout, got a least value of {density.min()}")
    return f, density

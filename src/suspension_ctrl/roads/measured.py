"""Measured roads: the spectrum and the coherence of a profile, or a spectrum from a table.

Tables over wavenumber have the columns ``wavenumber [cycle/m]`` and ``psd [m^3]`` or ``coherence [-]``. Lines
that start with ``#`` name the source.
"""

import math
from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from .. import checks
from ..documents import naming
from ..quantities import Complex, Integer, Real, frozen_array, unit
from ..tables import read_table
from .coherence import Coherence, Isotropic, Tabulated
from .columns import DISTANCE, belonging, kind_of
from .profile_files import ERD, OPENCRG, load_profile, profile_of
from .profiles import Profile
from .road import Road

WAVENUMBER, PSD, COHERENCE = "wavenumber [cycle/m]", "psd [m^3]", "coherence [-]"
SEGMENTS = 8  # default lengths of a segment in a profile
_LOWEST = 4  # waves in a segment at the lowest usable wavenumber: leakage of longer waves is some percent there
_POINTS = 4  # points in a wave at the highest usable wavenumber: aliasing is a ninth there, exponent 2
_LEAST = 32  # points of the shortest segment, with waves 4 to 8


@dataclass(frozen=True, eq=False, repr=False)
class MeasuredRoad(Road):
    """Road of a measured spectrum, a power law between each two of its wavenumbers and nothing beyond them.

    `from_profile` and `from_csv` make one; `band` is its range of wavenumbers.

    Parameters
    ----------
    wavenumber, density : (k,) array_like
        Wavenumbers, ascending and above zero [cycle/m], and one-sided spectral density of elevation, > 0 [m^3].
    coherence : Coherence
        Model of the coherence of parallel tracks. `Isotropic` needs an exponent here, as the spectrum ends.
    contact_length : float
        Length over which a tyre averages the elevation, 0 for contact in a point [m].
    source : str
        Origin of the spectrum, for `describe`.

    Raises
    ------
    ValueError
        If there are less than two wavenumbers, or they or the densities are not as above.

    Examples
    --------
    A realisation of class B stands for a measured profile. Its estimated spectrum scatters about that of the
    class by some 10 %:

    >>> import suspension_ctrl as sc
    >>> road = sc.Iso8608Road("B")
    >>> measured = sc.MeasuredRoad.from_profile(road.profile(length=20e3, step=0.1, seed=1))
    >>> f = [0.5, 2.0, 8.0]  # Hz
    >>> print((measured.psd(f, speed=20.0) / road.psd(f, speed=20.0)).round(1))
    [1.1 1.  1. ]
    """

    wavenumber: Real = field(metadata=unit("cycle/m") | {"most": 10_000})
    density: Real = field(metadata=unit("m^3") | {"most": 10_000})
    _: KW_ONLY
    source: str = "a table"

    def __post_init__(self) -> None:
        super().__post_init__()
        n = frozen_array(checks.reals("wavenumber must be", self.wavenumber))
        density = frozen_array(checks.reals("density must be", self.density))
        if n.ndim != 1 or n.shape != density.shape or n.size < 2:
            got = f"{n.shape} and {density.shape}"
            raise ValueError(f"wavenumber and density must be of one length >= 2, got {got}")
        checks.ascending("wavenumber", n)
        if not (np.isfinite(density) & (density > 0)).all():
            got = f"a least value of {density.min()}"
            raise ValueError(f"density must be finite and > 0 m^3 throughout, got {got}")
        self._keep(wavenumber=n, density=density)

    @classmethod
    def from_profile(
        cls,
        profile: Profile,
        *,
        segment: float | None = None,
        coherence: Coherence | None = None,
        contact_length: float = 0.0,
        source: str = "a profile",
    ) -> "MeasuredRoad":
        """Estimate spectrum and coherence of a profile by Welch's method.

        Segments overlap by half, are detrended and weighted with Hann's window. Means are over segments and
        tracks, then over third-octave bands, from four waves in a segment to four points in a wave. Uneven steps
        count as their mean.

        Parameters
        ----------
        profile : Profile
        segment : float, optional
            Length of a segment [m]; an eighth of the profile if not given. A longer one reaches longer waves, a
            shorter one has a smaller scatter.
        coherence : Coherence, optional
            Model of the coherence of parallel tracks. Default with two different tracks: the root of the squared
            coherence over the same bands, of uncorrelated tracks about the root of one over the number of
            estimates in a band. With one track, or more than two: `Isotropic`.
        contact_length : float
            Length over which a tyre averages the elevation, 0 for contact in a point [m].
        source : str
            Origin of the profile, for `describe`.

        Raises
        ------
        ValueError
            If the profile or the segment is too short, the segment longer than the profile, or a track flat.
        """
        points = _segment_points(profile, segment)
        n, spectra = _welch(profile, points)
        edges = _third_octaves(n, 1 / (_POINTS * profile.step))
        middle = np.exp(_means(np.log(np.maximum(n, n[1])) + 0j, edges).real)
        smooth = _means(spectra, edges)
        own = np.einsum("iib->ib", smooth).real
        if not (own > 0).all():
            raise ValueError("a profile must not be flat in any track")
        if coherence is None and len(set(profile.tracks)) == len(profile.tracks) == 2:
            gamma = np.minimum(np.abs(smooth[0, 1]) / np.sqrt(own[0]) / np.sqrt(own[1]), 1.0)
            coherence = Tabulated(tuple(middle), tuple(gamma), abs(profile.tracks[0] - profile.tracks[1]))
        known: dict[str, Any] = {"coherence": coherence or Isotropic(), "contact_length": contact_length}
        return cls(middle, own.mean(axis=0), source=source, **known)

    @classmethod
    def from_csv(
        cls,
        path: str | PathLike[str],
        *,
        columns: Sequence[str] | None = None,
        step: float | None = None,
        track_width: float | None = None,
        tracks: Sequence[float] | None = None,
        segment: float | None = None,
        coherence: Coherence | None = None,
        contact_length: float = 0.0,
    ) -> "MeasuredRoad":
        """Read a file of a profile, see `load_profile`, or a table of a spectrum.

        Raises
        ------
        ValueError
            Naming the file: if it holds neither, the road is not as above, or a spectrum comes with options of a
            profile; OSError if it cannot be read.
        """
        kind, source = Path(path).suffix.lower(), str(path)
        estimate: dict[str, Any] = {"segment": segment, "coherence": coherence, "contact_length": contact_length}
        if kind in (ERD, OPENCRG):
            profile = load_profile(path, columns=columns, step=step, track_width=track_width, tracks=tracks)
            with naming(path):
                return cls.from_profile(profile, source=source, **estimate)
        names, values = read_table(path, belonging, names=columns)
        with naming(path):
            if not names and step is None and (values > 0).all():
                needed = f"{WAVENUMBER!r} and {PSD!r}, or {DISTANCE!r} and heights"
                raise ValueError(f"columns must have names, {needed}, got none")
            if tracks is not None:
                raise ValueError(f"tracks must be given for a {OPENCRG} file only, got {checks.shown(tracks)}")
            if not names or any(map(kind_of, names)):  # without names no spectrum, as that is above zero
                profile = profile_of(source, names, values, step=step, track_width=track_width)
                del values  # of a large profile, before its spectrum takes memory
                return cls.from_profile(profile, source=source, **estimate)
            n, density = curve_of(names, values, PSD)
            if not (step is track_width is segment is None):
                raise ValueError("a spectrum takes neither step nor track_width nor segment")
            known: dict[str, Any] = {"coherence": coherence or Isotropic(), "contact_length": contact_length}
            return cls(n, density, source=source, **known)

    @property
    def band(self) -> tuple[float, float]:
        """Lowest and highest wavenumber at which the road is known [cycle/m]."""
        return float(self.wavenumber[0]), float(self.wavenumber[-1])

    def describe(self) -> str:
        """Return a line that identifies the road."""
        low, high = self.band
        reference = f"Gd(0.1 cycle/m) = {self.psd(0.1, 1.0):.3g} m^3, " if low <= 0.1 <= high else ""
        return f"measured, {self.source}: {reference}known from {low:.3g} to {high:.3g} cycle/m{self._contact()}"

    def breakpoints(self, speed: float, /) -> tuple[float, ...]:
        """Frequencies of the wavenumbers inside the band at `speed` [m/s], kinks of the spectrum [Hz]."""
        return tuple((self.wavenumber[1:-1] * speed).tolist())

    def isotropic_coherence(self, _n: Real, _distance: float) -> Real:
        """Raise ValueError: the coherence of an isotropic surface depends on the spectrum of all shorter waves."""
        needed, got = (
            "such as Isotropic(exponent=2.0)",
            "Isotropic(), which needs the spectrum of all shorter waves",
        )
        raise ValueError(f"coherence of a measured spectrum must be a model of its own, {needed}, got {got}")

    def _psd(self, f: Real, speed: float) -> Real:
        n, (low, high) = f / speed, self.band
        outside = ~((n >= low * (1 - 1e-9)) & (n <= high * (1 + 1e-9)))  # f = V n may round
        if outside.any():
            allowed = f"from {_above(low * speed):g} to {-_above(-high * speed):g} Hz at {speed:g} m/s"
            known, got = f"known from {low:.5g} to {high:.5g} cycle/m", f"{f[outside].flat[0]:.5g} Hz"
            raise ValueError(f"f must lie {allowed}, as the road is {known}, got {got}")
        return np.exp(np.interp(np.log(n), np.log(self.wavenumber), np.log(self.density))) / speed


def _above(value: float) -> float:
    """Return the next number of five digits that is not below: an end of a band that is accepted when typed."""
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - 4)
    return float(f"{math.ceil(value / unit * (1 - 1e-12 * math.copysign(1.0, value))) * unit:.5g}")


def read_curve(path: str | PathLike[str], quantity: str) -> tuple[Real, Real]:
    """Read wavenumbers (k,), ascending and above zero [cycle/m], and a `quantity` (k,), `PSD` or `COHERENCE`."""
    table = read_table(path)
    with naming(path):
        return curve_of(*table, quantity)


def curve_of(names: Sequence[str], values: Real, quantity: str) -> tuple[Real, Real]:
    """Return wavenumbers and a quantity of a table, see `read_curve`."""
    if list(names or [WAVENUMBER, quantity]) != [WAVENUMBER, quantity] or values.shape[1] != 2:
        or_profile = ", or a distance and heights" if quantity == PSD else ""
        raise ValueError(f"columns must be {WAVENUMBER!r} and {quantity!r}{or_profile}, got {checks.shown(names)}")
    n, curve = values.T
    checks.ascending(WAVENUMBER, n)
    return n, curve


def _segment_points(profile: Profile, segment: float | None) -> int:
    """Points in a segment [m]; in an eighth of the profile if not given."""
    whole = profile.distance.size
    if segment is not None:
        checks.positive("segment", segment, "m")
    points = whole // SEGMENTS if segment is None else round(min(segment / profile.step, whole + 1))
    if not _LEAST <= points <= whole:
        least = _LEAST * profile.step
        allowed = f"a segment from {least:g} to {whole * profile.step:g} m, got {segment!r}"
        if segment is None:
            allowed = f"{_LEAST * SEGMENTS} points at least, or longer segments than an eighth, got {whole} points"
        raise ValueError(f"a profile in steps of {profile.step:g} m must have {allowed}")
    return points


def _welch(profile: Profile, points: int) -> tuple[Real, Complex]:
    """Wavenumbers (k,) [cycle/m] and cross-spectra (t, t, k) [m^3] of the tracks, by points in a segment."""
    from scipy import signal

    tracks = profile.height.T
    return signal.csd(tracks[:, None], tracks[None, :], 1 / profile.step, nperseg=points, detrend=signal.detrend)


def _third_octaves(n: Real, highest: float) -> Integer:
    """First indices of third-octave bands of wavenumbers k/segment up to the highest, and the end of the last.

    The lowest usable wavenumber is in the middle of the first band. Widths of 0.23 of the middle leave none empty.
    """
    end = int(np.searchsorted(n, highest * (1 + 1e-9), side="right"))
    band = np.round(3 * np.log2(np.arange(_LOWEST, end) / _LOWEST))
    return np.append(_LOWEST + np.flatnonzero(np.diff(band, prepend=-1)), end)


def _means(values: Complex, edges: Integer) -> Complex:
    """Means of values (..., k) over the bands between the edges (b + 1,), shape (..., b)."""
    return np.asarray(np.add.reduceat(values[..., : edges[-1]], edges[:-1], axis=-1) / np.diff(edges))

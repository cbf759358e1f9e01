"""Frequency weightings of ISO 2631 and ISO 5349 for human exposure to vibration, as filters and as table.

The filters are the analogue ones of ISO 8041-1, the table its design-goal factors in one-third-octave bands.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property, lru_cache, reduce
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks, datafiles
from ..quantities import Complex, Real, Record, frozen_array
from ..vehicles.feedback import numbers_of, system_of

if TYPE_CHECKING:
    import control


@dataclass(frozen=True)
class TabulatedWeighting:
    """Weighting by the one-third-octave table, straight in log factor over log frequency, beyond it too."""

    name: str

    @property
    def breakpoints(self) -> tuple[float, ...]:
        """Frequencies at which the slope of the factor changes [Hz]: bands of the table, except both ends."""
        return tuple(np.exp(self._table()[0][1:-1]).tolist())

    def factor(self, f: ArrayLike) -> Real:
        """Magnitude of the weighting at the frequencies `f` (n,) [Hz], shape (n,) [-]."""
        log_band, log_factor = self._table()
        log_f = np.log(np.asarray(f, dtype=float))
        segment = np.clip(np.searchsorted(log_band, log_f) - 1, 0, log_band.size - 2)
        slope = np.diff(log_factor)[segment] / np.diff(log_band)[segment]
        return np.exp(log_factor[segment] + slope * (log_f - log_band[segment]))

    response = factor  # a table has no phase

    def _table(self) -> tuple[Real, Real]:
        column = self.name.removesuffix("-table").lower()
        rows = datafiles.rows("standards/iso8041_wk_wb_table.csv")
        return np.log(BANDS), np.log([float(row[column]) for row in rows])


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class SystemWeighting(Record):
    """Weighting by the magnitude of a system of python-control; equal where the numbers of the systems are."""

    name: str = field(compare=False)
    numbers: tuple[NDArray[Any], ...] = field(repr=False)

    breakpoints: ClassVar[tuple[float, ...]] = ()
    """Frequencies at which the factor has a kink [Hz]: none."""

    @classmethod
    def of(cls, system: "control.LTI") -> Self:
        """Take a system; ValueError unless it has one input and one output and is in continuous time."""
        if not (system.ninputs == system.noutputs == 1 and system.isctime()):
            got = f"{system.ninputs} and {system.noutputs}, dt = {system.dt}"
            raise ValueError(f"weighting must have one input and one output in continuous time, got {got}")
        if hasattr(system, "num"):
            return cls.by_numbers(system.name, [system.num[0][0], system.den[0][0]])
        return cls.by_numbers(system.name, numbers_of(system))

    @classmethod
    def by_numbers(cls, name: str, numbers: Iterable[NDArray[Any]]) -> Self:
        """Take numerator and denominator, highest powers first, or the numbers of another system."""
        frozen = tuple(frozen_array(x, complex if np.iscomplexobj(x) else float) for x in numbers)
        return cls(name=name, numbers=frozen)

    @cached_property
    def system(self) -> "control.LTI":
        """The system of the weighting."""
        if not self.is_quotient:
            return system_of(self.numbers)
        import control

        return control.tf(*self.numbers)

    @property
    def is_quotient(self) -> bool:
        """Whether its numbers are a numerator and a denominator."""
        return self.numbers[0].ndim == 1

    @property
    def is_measured(self) -> bool:
        """Whether it is known at lines alone."""
        return self.numbers[0].ndim == 3

    def factor(self, f: ArrayLike) -> Real:
        """Magnitude of the weighting at the frequencies `f` (n,) [Hz], shape (n,) [-]."""
        return np.abs(self.response(f))

    def response(self, f: ArrayLike) -> Complex:
        """Return magnitude and phase of the weighting at the frequencies `f` (n,) [Hz], shape (n,) [-]."""
        s = 2j * np.pi * np.asarray(f, dtype=float)
        if self.is_quotient:
            numerator, denominator = self.numbers
            return np.asarray(np.polyval(numerator, s) / np.polyval(denominator, s))
        return np.asarray(self.system(s))

    def __str__(self) -> str:
        return str(self.name)


Weighting = str | SystemWeighting
"""A weighting by its name, or another one."""

BANDS = 10.0 ** (np.arange(-10, 21) / 10)
"""Exact frequencies of the table's one-third-octave bands [Hz]; its frequency column rounds them."""

TABLES = ("Wk-table", "Wb-table")

Quotient = tuple[list[float], list[float]]
"""Numerator and denominator, highest powers first."""


def checked(weighting: "Weighting | control.LTI | None") -> Weighting | None:
    """Return a weighting that is a name, a system or none; ValueError for anything else."""
    if weighting is not None and not isinstance(weighting, str | SystemWeighting):
        import control

        if isinstance(weighting, control.LTI):
            return SystemWeighting.of(weighting)
    if weighting is not None and not isinstance(weighting, SystemWeighting):
        checks.one_of("weighting", weighting, filters() + TABLES)
    return weighting


def by_name(weighting: Weighting) -> TabulatedWeighting | SystemWeighting:
    """Return a weighting by its name, of `filters` or `TABLES`, or by its system; ValueError for other names."""
    if isinstance(weighting, SystemWeighting):
        return weighting
    checks.one_of("weighting", weighting, filters() + TABLES)
    return TabulatedWeighting(weighting) if weighting in TABLES else _filter(weighting)


def weighting(name: str) -> "control.TransferFunction":
    """Return a weighting filter of ISO 2631 or ISO 5349 as a transfer function.

    Parameters
    ----------
    name : str
        One of ``Wk, Wd, Wf, Wc, We, Wj`` (ISO 2631-1), ``Wb`` (ISO 2631-4), ``Wm`` (buildings, ISO 2631-2) and
        ``Wh`` (the hand, ISO 5349-1).

    Returns
    -------
    control.TransferFunction
        From acceleration to weighted acceleration [-]: the product of band limiting, acceleration-velocity
        transition and upward step of ISO 8041-1 with the weighting's gain.

    Examples
    --------
    Wk weights vertical vibration of a seated person most between 4 and 12.5 Hz:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> wk = sc.weighting("Wk")
    >>> for f in (0.5, 1.0, 4.0, 8.0, 16.0):
    ...     print(f"{f:4.1f} Hz: {abs(wk(2j * np.pi * f)):.2f}")
     0.5 Hz: 0.42
     1.0 Hz: 0.48
     4.0 Hz: 0.97
     8.0 Hz: 1.04
    16.0 Hz: 0.77
    """
    checks.one_of("weighting", name, filters())
    import control

    signals: dict[str, Any] = {"inputs": ["acceleration"], "outputs": ["weighted_acceleration"]}
    return control.tf(*_filter(name).numbers, name=name, **signals)


def filters() -> tuple[str, ...]:
    """Return the names of the filters."""
    return tuple(_parameters())


@lru_cache
def _filter(name: str) -> SystemWeighting:
    p = _parameters()[name]
    factors = [*_band_limits(p), ([p["gain"]], [1.0]), _transition(p), _upward_step(p)]
    return SystemWeighting.by_numbers(name, [reduce(np.polymul, part) for part in zip(*factors, strict=True)])


@lru_cache
def _parameters() -> dict[str, dict[str, float]]:
    """Return the parameters of the standard by weighting: gain, quality factors, frequencies [Hz], NaN if none."""
    return {
        row["weighting"]: {key: float(row[key] or "nan") for key in row if key not in ("weighting", "use")}
        for row in datafiles.rows("standards/iso8041_parameters.csv")
    }


def _band_limits(p: dict[str, float]) -> tuple[Quotient, Quotient]:
    """Return the band limits: a two-pole Butterworth high pass at f1 and low pass at f2."""
    w1, q = 2 * math.pi * p["f1_hz"], 1 / math.sqrt(2)
    return ([1 / w1**2, 0.0, 0.0], _quadratic(p["f1_hz"], q)), ([1.0], _quadratic(p["f2_hz"], q))


def _transition(p: dict[str, float]) -> Quotient:
    """Return the acceleration-velocity transition: 1 at low frequency, as 1/f above f4 (1/f^2 without f3)."""
    if math.isinf(p["f4_hz"]):
        return [1.0], [1.0]
    lead = [1.0] if math.isinf(p["f3_hz"]) else [1 / (2 * math.pi * p["f3_hz"]), 1.0]
    return lead, _quadratic(p["f4_hz"], p["q4"])


def _upward_step(p: dict[str, float]) -> Quotient:
    """Return the upward step: from (f5/f6)^2 at low frequency to 1 at high; 1 if both are infinite."""
    if math.isinf(p["f5_hz"]):
        return [1.0], [1.0]
    step = (p["f5_hz"] / p["f6_hz"]) ** 2
    return [step * one for one in _quadratic(p["f5_hz"], p["q5"])], _quadratic(p["f6_hz"], p["q6"])


def _quadratic(f: float, q: float) -> list[float]:
    """Coefficients of 1 + s/(q w) + (s/w)^2 with w = 2 pi f, highest power first."""
    w = 2 * math.pi * f
    return [1 / w**2, 1 / (q * w), 1]

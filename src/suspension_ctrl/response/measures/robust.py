"""Robust measures: mean, quantile and CVaR of another measure over the scatter of a problem.

Each is a sum of the sorted values of the samples with constant weights.
"""

import re
from dataclasses import dataclass, replace
from math import ceil
from typing import Any, ClassVar

import numpy as np

from ... import checks
from ...quantities import Real
from ..load_case import LoadCase
from ..weightings import Weighting
from .measure import Measure, MeasureLike, OwnMeasure, measure_of
from .terms import NUMBER, CaseMeasure, number_text

_ROUNDING = 1e-9  # of samples, so that 95 % of 20 are 19


@dataclass(frozen=True, eq=False, repr=False)
class Robust(Measure):
    """A measure over the samples of a scatter."""

    measure: MeasureLike

    def __post_init__(self) -> None:
        super().__post_init__()
        inner = measure_of(self.measure)
        if isinstance(inner, Robust) or inner.maximise:
            needed = "of a measure of one vehicle without - in front"
            raise ValueError(f"{self.word} must be {needed}, got {checks.shown(str(inner))}")
        self._keep(measure=inner if isinstance(inner, OwnMeasure) else replace(inner, name=""), unit=inner.unit)

    @property
    def nominal(self) -> Measure:
        """The measure of one vehicle."""
        return measure_of(self.measure)

    def in_case(self, _case: LoadCase, _weighting: Weighting | None, /) -> CaseMeasure:
        """Raise ValueError: one vehicle has no such measure."""
        raise ValueError(f"scatter must be given for {self.label}, got none")

    def weights(self, samples: int, sign: float) -> Real:
        """Return the weights (s,) of ascending values; `sign` is 1 if less is better, else -1."""
        raise NotImplementedError

    def _rest(self) -> str:
        return str(self.measure)


class Mean(Robust, word="mean"):
    """Mean of a measure over the scatter of a problem.

    Parameters
    ----------
    measure : Measure
        Its text or a class too.
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.Mean(sc.ACC("driver")))
    mean ACC driver
    """

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word; options name and maximise."""
        return cls(Measure.parse(rest), **options)

    def weights(self, samples: int, _sign: float) -> Real:
        """Return equal weights."""
        return np.full(samples, 1 / samples)


@dataclass(frozen=True, eq=False, repr=False)
class _AtLevel(Robust):
    """A robust measure with a level [%]."""

    level: float = 95.0

    highest: ClassVar[float]

    def __post_init__(self) -> None:
        checks.within(f"level of {self.word}", self.level, 0, self.highest)
        self._keep(level=float(self.level))
        super().__post_init__()

    @classmethod
    def read(cls, rest: str, **options: Any) -> Measure:
        """Return the measure of a text after its word: a level [%] and a measure; options name and maximise."""
        found = re.fullmatch(rf"({NUMBER})\s+(.+)", rest)
        if not found:
            raise ValueError(
                f"{cls.word} must be like '{cls.word}95 SWS', got {checks.shown(f'{cls.word} {rest}'.strip())}"
            )
        return cls(Measure.parse(found[2]), float(found[1]), **options)

    def _text(self) -> str:
        return "-" * self.maximise + f"{self.word}{number_text(self.level)} {self._rest()}"


class Quantile(_AtLevel, word="q"):
    """Quantile of a measure over the scatter of a problem: the least value that a share of the samples keeps to.

    Parameters
    ----------
    measure : Measure
        Its text or a class too.
    level : float
        Share of the samples whose values are at most the quantile, 0 to 100 [%].
    name, maximise
        As of `Measure`; the name is optional.

    Examples
    --------
    A limit that 95 % of the vehicles meet:

    >>> import suspension_ctrl as sc
    >>> print(sc.Limit(sc.Quantile(sc.SWS("front"), 95), 0.03))
    q95 SWS front <= 0.03
    """

    highest = 100.0

    def weights(self, samples: int, _sign: float) -> Real:
        """Return 1 for the quantile."""
        return of_quantile(samples, self.level)


class CVaR(_AtLevel, word="CVaR"):
    """Conditional value at risk of a measure over the scatter of a problem: the mean of its worst values [1]_.

    Parameters
    ----------
    measure : Measure
        Its text or a class too.
    level : float
        Share of the samples that are better, 0 to 99.99: the mean is over the others [%]. The worst values are the
        largest, of a measure of which more is better and in a limit with a minimum the least.
    name, maximise
        As of `Measure`; the name is optional.

    References
    ----------
    .. [1] R. T. Rockafellar, S. Uryasev, "Optimization of conditional value-at-risk", Journal of Risk 2(3), 2000;
       of samples: the same, "Conditional value-at-risk for general loss distributions", Journal of Banking &
       Finance 26(7), 2002, equation (25).

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> print(sc.CVaR(sc.DTL("front"), 90))
    CVaR90 DTL front
    """

    highest = 99.99

    def weights(self, samples: int, sign: float) -> Real:
        """Return equal weights of the worst values, less of the one that belongs in part."""
        return of_tail(samples, self.level, sign)


def of_quantile(samples: int, level: float) -> Real:
    """Return the weights (s,) of ascending values in their quantile at a level [%]."""
    weights = np.zeros(samples)
    weights[max(ceil(samples * level / 100 - _ROUNDING), 1) - 1] = 1.0
    return weights


def of_tail(samples: int, level: float, sign: float) -> Real:
    """Return the weights (s,) of ascending values in the mean beyond a level [%], below it if the sign is -1."""
    tail = samples * (1 - level / 100)
    weights = np.clip(tail - np.arange(samples), 0.0, 1.0) / tail
    return np.ascontiguousarray(weights[::-1] if sign > 0 else weights)

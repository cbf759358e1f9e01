"""Scatter of coefficients and parameters in production and with age, and samples of it."""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import checks
from ..quantities import FrozenMapping, Real, Record, quantity

Tolerance = float | str | tuple[float | str, float | str]

_MOST = 1_000_000  # samples
_DEVIATIONS = 3.0  # standard deviations from the middle to a tolerance of the normal distribution
_DISTRIBUTIONS = ("uniform", "normal")
_FACTOR = ".scale"  # of a force law: stands for the whole law


@dataclass(frozen=True, eq=False, repr=False)
class Scatter(Record):
    """Scatter of coefficients and parameters about their values in a design, and a sample of it.

    Parameters
    ----------
    tolerances : mapping of str to float, text or pair of them
        By name the largest relative deviation, 0.05 or ``"5 %"`` for ±5 %; or the least and the largest one,
        ``(-0.25, 0.0)`` of a damper that loses up to a quarter with age. Names are those of coefficients and of
        parameters such as ``"body_mass"``, ``"front_tyre_stiffness"`` and ``"payload.mass"``, or ends of names:
        ``"spring"`` for ``"front.spring"`` and ``"rear.spring"``. Each deviates by itself, left and right alike.
        Of two that fit the longer one counts.
    samples : int
        Number of vehicles, up to 1e6; powers of 2 fill the ranges most evenly.
    seed : int
        Seed of the sample, a scrambled Sobol sequence: the same deviations for all designs.
    distribution : {"uniform", "normal"}
        Between the tolerances; a normal distribution has them three standard deviations from its middle and is
        truncated there.

    Raises
    ------
    ValueError
        If a deviation is 1 or more, or leaves nothing of a value, the limits are not in order, or about `samples`,
        `seed` and `distribution`.

    Examples
    --------
    >>> import suspension_ctrl as sc
    >>> scatter = sc.Scatter({"spring": "5 %", "front.damper": (-0.25, 0.0)}, samples=512)
    >>> print(scatter.describe())
    spring ±5 %, front.damper -25 to 0 %; 512 samples, seed 1
    """

    tolerances: Mapping[str, Tolerance]
    samples: int = 256
    seed: int = 1
    distribution: str = "uniform"

    def __post_init__(self) -> None:
        checks.mapped("scatter", self.tolerances)
        if not self.tolerances:
            raise ValueError("scatter must have a tolerance by name, one at least, got none")
        self._keep(tolerances=FrozenMapping({name: _interval(name, one) for name, one in self.tolerances.items()}))
        self._keep(samples=checks.at_least("samples", self.samples, 1), seed=checks.at_least("seed", self.seed, 0))
        checks.within("samples", self.samples, 1, _MOST)
        checks.one_of("distribution", self.distribution, _DISTRIBUTIONS)

    @property
    def intervals(self) -> Mapping[str, tuple[float, float]]:
        """Least and largest relative deviation by name or end of names."""
        pairs: Any = self.tolerances
        return FrozenMapping({name: (low, high) for name, (low, high) in pairs.items()})

    def of(self, known: Sequence[str]) -> dict[str, tuple[float, float]]:
        """Return the deviations of the known names that scatter; ValueError for one that fits none of them."""
        keys = sorted(self.intervals, key=len)
        for key in keys:
            if not any(fits(key, name) for name in known):
                checks.one_of("scatter", key, known)
        found = {name: self.intervals[key] for name in known for key in keys if fits(key, name)}  # the last counts
        return {name: pair for name, pair in found.items() if pair != (0.0, 0.0)}

    def factors(self, deviations: Iterable[tuple[float, float]]) -> Real:
        """Return samples (s, e) of the factors of e values with these deviations."""
        from scipy.stats import qmc  # half a second: not at import of the package

        low, high = np.array(list(deviations), dtype=float).reshape(-1, 2).T
        if not low.size:
            return np.ones((self.samples, 0))
        sequence = qmc.Sobol(low.size, rng=np.random.default_rng(self.seed))
        unit = sequence.random_base2((self.samples - 1).bit_length())[: self.samples]
        return np.asarray(1 + low + (high - low) * (_normal(unit) if self.distribution == "normal" else unit))

    def describe(self) -> str:
        """Return tolerances, samples and seed in words."""
        shown = ", ".join(f"{name} {_shown(*pair)}" for name, pair in self.intervals.items())
        kind = ", normal" if self.distribution == "normal" else ""
        return f"{shown}{kind}; {self.samples} samples, seed {self.seed}"


def scatter_of(given: Scatter | Mapping[str, Tolerance] | None) -> Scatter | None:
    """Return the scatter, also of tolerances by name; ValueError for another value."""
    if given is None or isinstance(given, Scatter):
        return given
    if not isinstance(given, Mapping):
        raise ValueError(f"scatter must be a Scatter or tolerances by name, got {checks.shown(given)}")
    return Scatter(given)


def fits(key: str, name: str) -> bool:
    """Whether a key is a name, with or without the factor of a force law, or its end."""
    return any(
        one == key or re.search(rf"[._]{re.escape(key)}$", one) for one in (name, name.removesuffix(_FACTOR))
    )


def _interval(name: object, given: Any) -> tuple[float, float]:
    """Return the least and the largest deviation; ValueError unless they leave a value above zero."""
    checks.of_kind("each name of scatter", name, str)
    what = f"scatter.{name}"
    if isinstance(given, tuple | list | np.ndarray):
        if len(given) != 2:
            raise ValueError(f"{what} must be a share or two in order, got {checks.shown(given)}")
        low, high = (_share(what, one) for one in given)
    else:
        high = _share(what, given)
        low = -high
    if not -1 < low <= high < 10:
        raise ValueError(f"{what} must leave values above zero, 0.05 for 5 %, got {checks.shown(given)}")
    return low, high


def _share(what: str, given: Any) -> float:
    """Return a share from a number or a text with a unit."""
    value = quantity(what, given) if isinstance(given, str) else given
    checks.within(what, value, -1e3, 1e3)
    return float(value)


def _normal(unit: Real) -> Real:
    """Return quantiles of a normal distribution truncated to the unit interval, at shares (s, e)."""
    from scipy.special import ndtr, ndtri

    tail = ndtr(-_DEVIATIONS)
    return np.asarray(0.5 + ndtri(tail + unit * (1 - 2 * tail)) / (2 * _DEVIATIONS))


def _shown(low: float, high: float) -> str:
    """Return deviations in percent."""
    return f"±{100 * high:g} %" if low == -high else f"{100 * low:g} to {100 * high:g} %"

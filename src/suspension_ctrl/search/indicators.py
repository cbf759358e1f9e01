"""Quality of a set of objectives against a reference front, in objectives scaled to that front."""

from dataclasses import dataclass, replace
from functools import cached_property

import moocore
import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Bool, Integer, Real, Record, frozen_array
from .nearest import nearest_others
from .shortfall import Goals, Shortfall
from .spreading import FEW, farthest_first

_TRIED = 500  # rows of many
_MANY = 10_000  # rows, which are put in order in less time than that saves


def non_dominated(objectives: ArrayLike) -> Bool:
    """Return a mask (n,) of the rows of objectives (n, m), to be minimised, that no other row dominates.

    A row with NaN is dominated and dominates no other.

    Examples
    --------
    Discomfort and travel of four struts; the first beats the last in both:

    >>> import suspension_ctrl as sc
    >>> sc.non_dominated([[1.8, 0.030], [2.0, 0.025], [2.3, 0.022], [1.9, 0.031]])
    array([ True,  True,  True, False])
    """
    values = checks.reals("objectives must be", objectives)
    if values.ndim != 2:
        raise ValueError(f"objectives must have shape (n, m), got {values.shape}")
    whole = _whole(values)
    whole[whole] = _undominated(values[whole])
    return whole


def _undominated(objectives: Real) -> Bool:
    """Return the mask (n,) of `non_dominated` of rows without NaN; many of three objectives are swept in order."""
    n, m = objectives.shape
    if n < _MANY or m != 3:
        return moocore.is_nondominated(objectives, keep_weakly=True)
    found = np.zeros(n, dtype=bool)
    found[_best(objectives, _swept_along(objectives))] = True
    return found


def _whole(values: Real) -> Bool:
    """Return a mask (n,) of the rows of values (n, m) without NaN."""
    lost = np.isnan(values)
    if not lost.any():  # mostly, and faster than row by row
        return np.ones(len(values), dtype=bool)
    return np.asarray(~lost.any(axis=1))


def _best(objectives: Real, along: int) -> Integer:
    """Return the indices (k,) of the rows without NaN that no other dominates, by an ascending objective."""
    rows, order = _for_sweep(objectives, along)
    return order[moocore.is_nondominated(rows, keep_weakly=True)]


def _for_sweep(objectives: Real, along: int) -> tuple[Real, Integer]:
    """Return rows (n, m) by an ascending objective, which stands last, and their order (n,).

    moocore sweeps two or three objectives along the last, in half of the time if rows stand in its order.
    """
    n, m = objectives.shape
    rows, order = np.empty((n, m)), np.argsort(objectives[:, along])
    for column, k in enumerate([*(k for k in range(m) if k != along), along]):
        rows[:, column] = objectives[:, k][order]
    return rows, order


def _swept_along(objectives: Real) -> int:
    """Return the objective along which rows (n, m) are swept fastest, tried on some of them.

    The sweep keeps the front of the other objectives, and is the faster the smaller that is.
    """
    n, m = objectives.shape
    if m != 3:
        return m - 1
    some = objectives[:: max(1, n // _TRIED)]
    others = [np.count_nonzero(moocore.is_nondominated(np.delete(some, k, axis=1))) for k in range(m)]
    return int(np.argmin(others))


def best_of(objectives: Real) -> Real:
    """Return the non-dominated rows (k, m) of objectives (n, m)."""
    return objectives[non_dominated(objectives)]


def evenly_spread(objectives: Real, size: int, few: int = FEW) -> Integer:
    """Return the indices, ascending, of at most `size` rows of objectives (n, m) that cover the set evenly.

    The ends come first, then repeatedly the row farthest from all before it, each objective divided by its range:
    H. K. Singh, K. S. Bhattacharjee, T. Ray, "Distance-based subset selection for benchmarking in evolutionary
    multi/many-objective optimization", IEEE Trans. Evol. Comput. 23(5), 2019. Of sets with at most `few` distances
    nothing is compiled.
    """
    if len(objectives) <= size:
        return np.arange(len(objectives))
    columns = np.ascontiguousarray(objectives.T)  # numpy reduces them in a fiftieth of the time
    span = np.ptp(columns, axis=1)
    ends = np.unique(columns.argmin(axis=1))[:size]
    scaled = columns / np.where(span > 0, span, 1.0)[:, np.newaxis]
    return np.sort(farthest_first(scaled.T, ends, size, few))


@dataclass(frozen=True, eq=False, repr=False)
class ReferenceFront(Record):
    """A reference front for indicators, in objectives scaled to its ideal point (0) and its nadir (1).

    An empty set (no feasible design) ranks last: hypervolume 0, IGD+ and epsilon infinite.

    Parameters
    ----------
    objectives : (n, m) ndarray
        Points of the front for distances, at most `SAMPLE`, evenly spread.
    ideal, nadir : (m,) ndarray
        Least and largest of each objective on the whole front.
    volume : float
        Hypervolume of the whole front in scaled objectives [-].

    Examples
    --------
    A quarter of a circle from (0, 1) to (1, 0): up to 1.1 in both objectives it dominates an area of 1.1^2 - (1
    - pi/4) = 0.995, both ends and the middle of it 71 % of that.

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> angle = np.linspace(0, np.pi / 2, 1001)
    >>> front = 1 - np.column_stack([np.sin(angle), np.cos(angle)])
    >>> reference = sc.ReferenceFront.of(front)
    >>> round(reference.volume, 2), round(reference.relative_hypervolume(front[[0, 500, 1000]]), 2)
    (1.0, 0.71)
    """

    objectives: Real
    ideal: Real
    nadir: Real
    volume: float

    HYPERVOLUME_REFERENCE = 1.1
    """Reference point of the hypervolume in scaled objectives: beyond the nadir, so that the ends count."""

    EXACT = 5
    """Largest number of objectives with an exact hypervolume: with 8 and 300 points it takes minutes."""

    SAMPLE = 2000
    """Largest number of points for distances."""

    def __post_init__(self) -> None:
        self._keep(**{name: frozen_array(getattr(self, name)) for name in ("objectives", "ideal", "nadir")})

    @classmethod
    def of(cls, objectives: ArrayLike, volume: float | None = None) -> "ReferenceFront":
        """Return the front of mutually non-dominated objectives (n, m); rows with NaN are left out.

        Its hypervolume is computed unless it is given. ValueError without a row of numbers.
        """
        given = checks.reals("objectives must be", objectives)
        if given.ndim != 2 or not _whole(given).any():
            raise ValueError(
                f"objectives must have shape (n, m) and a row without NaN, got {checks.shown(objectives)}"
            )
        objectives = given[_whole(given)]
        ideal, nadir = objectives.min(axis=0), objectives.max(axis=0)
        whole = cls(objectives, ideal, nadir, 0.0)
        volume = whole.hypervolume(objectives) if volume is None else volume
        if len(objectives) <= cls.SAMPLE:
            return replace(whole, volume=volume)
        return cls(objectives[evenly_spread(objectives, cls.SAMPLE)], ideal, nadir, volume)

    def scaled(self, objectives: ArrayLike) -> Real:
        """Return objectives (n, m) with this front's ideal point at 0 and its nadir at 1, without rows of NaN.

        An objective that is constant on the front is divided by its value, or by 1 if that is 0.
        """
        values = checks.reals("objectives must be", objectives)
        return self._scaled(values[_whole(values)])

    def _scaled(self, values: Real) -> Real:
        """Return scaled values (n, m), column by column in memory: numpy takes a tenth of the time."""
        ranges, size = self.nadir - self.ideal, np.abs(self.ideal)
        scale = np.where(ranges > 0, ranges, np.where(size > 0, size, 1.0))
        columns: Real = (np.ascontiguousarray(values.T) - self.ideal[:, np.newaxis]) / scale[:, np.newaxis]
        return columns.T

    def hypervolume(self, objectives: ArrayLike) -> float:
        """Return the volume dominated by objectives (n, m) up to 1.1 in scaled objectives [-].

        With more than `EXACT` objectives it is moocore's approximation, of a relative error of about 1e-3.
        """
        return self._volume(self.scaled(objectives))

    def _volume(self, scaled: Real) -> float:
        """Return the hypervolume of scaled objectives."""
        corner = self.HYPERVOLUME_REFERENCE
        if scaled.shape[-1] <= self.EXACT or len(scaled) == 0:
            return float(moocore.hypervolume(_for_sweep(scaled, self._along)[0], ref=corner))
        return float(moocore.hv_approx(scaled, ref=corner, nsamples=2**16))

    def relative_hypervolume(self, objectives: ArrayLike) -> float:
        """Return the hypervolume of objectives (n, m) over that of this front [-]."""
        return self.hypervolume(objectives) / self.volume

    def volume_and_spread(self, objectives: ArrayLike) -> tuple[float, float]:
        """Return `relative_hypervolume` and `spread` of objectives (n, m), scaled once."""
        scaled = self.scaled(objectives)
        return self._volume(scaled) / self.volume, self._spread(scaled)

    def igd_plus(self, objectives: ArrayLike) -> float:
        """Return the modified inverted generational distance IGD+ of objectives (n, m), scaled [-].

        H. Ishibuchi, H. Masuda, Y. Tanigaki, Y. Nojima, "Modified distance calculation in generational distance
        and inverted generational distance", EMO 2015.
        """
        return self.shortfall(objectives).igd_plus

    def epsilon(self, objectives: ArrayLike) -> float:
        """Return the least shift by which objectives (n, m), scaled, weakly dominate this front [-]."""
        return self.shortfall(objectives).epsilon

    def shortfall(self, objectives: ArrayLike, before: Shortfall | None = None) -> Shortfall:
        """Return how far objectives (n, m), scaled, fall short of this front, with those of `before`."""
        return self._goals.shortfall(self.scaled(objectives), before)

    def best(self, objectives: Real) -> Integer:
        """Return the indices (k,) of the `non_dominated` rows of objectives (n, m) without NaN.

        They stand by an ascending objective, in which order a later call and `hypervolume` take half of the time.
        """
        return _best(objectives, self._along)

    @cached_property
    def _along(self) -> int:
        """The objective along which sets near this front are swept fastest."""
        return _swept_along(self.objectives)

    @cached_property
    def _goals(self) -> Goals:
        """The points of this front, scaled."""
        return Goals.of(self.scaled(self.objectives))

    @cached_property
    def _ends(self) -> Real:
        """The point with the least of each objective (m, m), scaled."""
        front = self.scaled(self.objectives)
        return front[front.argmin(axis=0)]

    def spread(self, objectives: ArrayLike) -> float:
        """Return the generalised spread of objectives (n, m), scaled [-]; NaN for fewer than two points.

        It is 0 if all distances of nearest neighbours are equal and the set contains the ends of this front.

        References
        ----------
        A. Zhou, Y. Jin, Q. Zhang, B. Sendhoff, E. Tsang, "Combining model-based and genetics-based offspring
        generation for multi-objective optimization using a convergence criterion", IEEE CEC 2006.
        """
        return self._spread(self.scaled(objectives))

    def _spread(self, points: Real) -> float:
        """Return the spread of scaled objectives."""
        gaps = nearest_others(points)
        if len(gaps) < 2:
            return float("nan")
        columns = np.ascontiguousarray(points.T)
        ends = sum(np.sqrt(((columns - end[:, np.newaxis]) ** 2).sum(axis=0).min()) for end in self._ends)
        return float((ends + np.abs(gaps - gaps.mean()).sum()) / (ends + gaps.sum()))

"""Human exposure to histories of several points and axes: total values and daily exposure.

The total value of a point is the root sum of squares of its axes with the factors k of ISO 2631-1, 8.2.2.1, or of
ISO 5349-1 for the hand; overall it is that of the points of the body. The daily exposure of the body is that of
its worst axis, of the hand that of its total value (Directive 2002/44/EC, Annex).
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import nan
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from .. import checks
from ..quantities import FrozenMapping, Record, unit, wrapped
from .axes import AXES, DAY, HAND_A8, HORIZONTAL, VERTICAL, WHOLE_BODY_A8, WHOLE_BODY_VDV, DailyValues
from .histories import Exposure, exposure

if TYPE_CHECKING:
    import pandas as pd

_HOUR = 3600.0  # s


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ExposureByAxis(Record):
    """Measures of weighted accelerations by axis, total values, and daily exposure over a duration [s]."""

    axes: Mapping[str, Exposure]
    duration: float = field(metadata=unit("s"))

    @property
    def total_values(self) -> Mapping[str, float]:
        """Vibration total value by point, and if there are several of the body, ``"overall"`` [m/s^2]."""
        squares: dict[str, float] = {}
        for name, one in self.axes.items():
            point = name.split()[0]
            squares[point] = squares.get(point, 0.0) + (AXES[name].factor * one.rms) ** 2
        body = [square for point, square in squares.items() if point != "hand"]
        overall = {"overall": sum(body)} if len(body) > 1 else {}
        return FrozenMapping({point: square**0.5 for point, square in {**squares, **overall}.items()})

    def to_frame(self) -> "pd.DataFrame":
        """Return the measures by ``axis``; of rotations in rad/s^2 in place of m/s^2."""
        import pandas as pd

        rows = [
            (name, *AXES[name], one.offset, one.rms, one.peak, one.crest_factor, one.mtvv, one.vdv)
            for name, one in self.axes.items()
        ]
        columns = ["axis", "weighting", "k", "offset [m/s^2]", "a_w [m/s^2]", "peak [m/s^2]", "crest factor [-]"]
        return pd.DataFrame(rows, columns=[*columns, "MTVV [m/s^2]", "VDV [m/s^1.75]"]).set_index("axis")

    def daily(self) -> "pd.DataFrame":
        """Return the daily exposure by ``axis`` and measure, with the values of Directive 2002/44/EC.

        The exposure reaches its action and its limit value after so many hours, NaN if not within a day.
        """
        import pandas as pd

        columns = [
            "axis",
            "measure",
            "k",
            "value",
            "unit",
            "action",
            "limit",
            "action after [h]",
            "limit after [h]",
        ]
        return pd.DataFrame(list(self._daily()), columns=columns).set_index("axis")

    def _daily(self) -> Iterator[tuple[Any, ...]]:
        """Yield a row of `daily` for each axis of the body and measure, and for a hand."""
        for name, one in self.axes.items():
            point, axis = name.split()
            if point in ("seat", "floor") and axis in ("x", "y", "z"):
                k = (VERTICAL if axis == "z" else HORIZONTAL).factor
                yield from (self._a8(name, k, one.rms, WHOLE_BODY_A8), self._vdv(name, k, one))
        if "hand" in self.total_values:
            yield self._a8("hand", 1.0, self.total_values["hand"], HAND_A8)

    def _a8(self, name: str, k: float, rms: float, values: DailyValues) -> tuple[Any, ...]:
        after = [_within_a_day(DAY * (value / (k * rms)) ** 2) for value in values]
        return name, "A(8)", k, k * rms * (self.duration / DAY) ** 0.5, "m/s^2", *values, *after

    def _vdv(self, name: str, k: float, one: Exposure) -> tuple[Any, ...]:
        after = [_within_a_day(one.duration * (value / (k * one.vdv)) ** 4) for value in WHOLE_BODY_VDV]
        daily = k * one.vdv * (self.duration / one.duration) ** 0.25
        return name, "VDV", k, daily, "m/s^1.75", *WHOLE_BODY_VDV, *after

    def __repr__(self) -> str:
        totals = ", ".join(f"{point} {value:.4g}" for point, value in self.total_values.items())
        return wrapped(f"<ExposureByAxis of {', '.join(self.axes)}; total values [m/s^2]: {totals}>")


def exposure_by_axis(
    accelerations: Mapping[str, ArrayLike],
    time_step: float,
    *,
    duration: float = DAY,
    integration: str = "linear",
    settling: float = 0.0,
) -> ExposureByAxis:
    """Return the human exposure to histories of acceleration, each with the weighting of its axis.

    Parameters
    ----------
    accelerations : mapping of str to (n,) array_like
        By axis: ``"seat x"``, ``y``, ``z`` [m/s^2], ``roll``, ``pitch``, ``yaw`` [rad/s^2] of a seat; ``"back x"``
        and ``"feet x"`` likewise of backrest and feet, ``"floor x"`` under a standing person, ``"hand x"`` on a
        grip. x is forward, z up; ``"z"`` alone is that of the seat. Offsets such as gravity are removed.
    time_step : float
        Between two samples [s].
    duration : float
        Time of exposure in a day, > 0 [s]; eight hours by default.
    integration, settling
        As of `exposure`.

    Returns
    -------
    ExposureByAxis
        ``total_values`` by point [m/s^2]; ``to_frame()`` has the measures by axis, ``daily()`` the daily exposure
        beside the action and limit values of Directive 2002/44/EC.

    Raises
    ------
    ValueError
        About an axis that is unknown or given twice, or as of `exposure`, with the axis.

    Examples
    --------
    Two hours a day on a seat:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> rng = np.random.default_rng(1)
    >>> histories = {axis: level * rng.normal(size=12_000) for axis, level in (("x", 1.0), ("z", 2.0))}  # m/s^2
    >>> found = sc.exposure_by_axis(histories, 0.005, duration=2 * 3600.0)
    >>> print({point: round(value, 2) for point, value in found.total_values.items()})
    {'seat': 0.87}
    >>> print(found.daily()[["measure", "value", "unit", "action", "limit"]].round(2).to_string(index_names=False))
           measure  value      unit  action  limit
    seat x    A(8)   0.12     m/s^2     0.5   1.15
    seat x     VDV   2.98  m/s^1.75     9.1  21.00
    seat z    A(8)   0.42     m/s^2     0.5   1.15
    seat z     VDV  10.37  m/s^1.75     9.1  21.00
    """
    if not isinstance(accelerations, Mapping) or not accelerations:
        raise ValueError(f"accelerations must be a mapping by axis, got {checks.shown(accelerations)}")
    checks.positive("duration", duration, "s")
    found: dict[str, Exposure] = {}
    for given, history in accelerations.items():
        name = axis_of(given)
        if name in found:
            raise ValueError(f"accelerations must have each axis once, got {name} twice")
        try:
            found[name] = exposure(
                history, time_step, AXES[name].weighting, integration=integration, settling=settling
            )
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
    if len({round(one.duration / time_step) for one in found.values()}) > 1:
        got = ", ".join(f"{one.duration:g} s of {name}" for name, one in found.items())
        raise ValueError(f"accelerations must be of one length, got {got}")
    return ExposureByAxis(axes=FrozenMapping(found), duration=float(duration))


def _within_a_day(seconds: float) -> float:
    """Return a time in hours, NaN beyond 24."""
    return seconds / _HOUR if seconds <= 24 * _HOUR else nan


def axis_of(name: object) -> str:
    """Return the full name of an axis, in any case, with blanks or underscores; ValueError for another name."""
    text = " ".join(str(name).lower().replace("_", " ").split())
    full = f"seat {text}" if f"seat {text}" in AXES else text
    if full not in AXES:
        raise ValueError(f"axis must be one of {checks.listing(AXES, text)}, got {checks.shown(name)}")
    return full

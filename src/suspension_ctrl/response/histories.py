"""Human exposure to a history of vibration, ISO 2631-1:1997, clause 6: weighted signal, running r.m.s., dose.

Histories are sampled at even times, each sample counting for one time step.
"""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, Record, unit
from . import weightings

INTEGRATIONS = ("linear", "exponential")
"""Integrations of the running r.m.s., clause 6.3.1."""


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Exposure(Record):
    """Measures of a weighted acceleration; of a rotation in radians."""

    rms: float = field(metadata=unit("m/s^2"))  # clause 6.1
    peak: float = field(metadata=unit("m/s^2"))  # largest magnitude
    mtvv: float = field(metadata=unit("m/s^2"))  # maximum transient vibration value, of the running r.m.s. (6.3.1)
    vdv: float = field(metadata=unit("m/s^1.75"))  # vibration dose value (6.3.2)
    duration: float = field(metadata=unit("s"))  # T
    offset: float = field(default=0.0, metadata=unit("m/s^2"))  # mean of the history, removed from it

    @property
    def crest_factor(self) -> float:
        """Peak over r.m.s., clause 6.2.1 [-]; up to 9 the r.m.s. is normally enough (6.2.2)."""
        return self.peak / self.rms

    @property
    def mtvv_ratio(self) -> float:
        """MTVV/a_w [-]: above 1.5 the r.m.s. alone may say too little (clause 6.3.3)."""
        return self.mtvv / self.rms

    @property
    def vdv_ratio(self) -> float:
        """VDV/(a_w T^(1/4)) [-]: above 1.75 the r.m.s. alone may say too little (clause 6.3.3)."""
        return self.vdv / (self.rms * self.duration**0.25)


def weighted(acceleration: ArrayLike, time_step: float, name: str) -> Real:
    """Return a history of acceleration behind a weighting filter of ISO 2631, at rest before it.

    The bilinear transform makes the analogue filter digital: its factor at f is the analogue one at
    ``tan(pi f time_step)/(pi time_step)``, a frequency higher by (pi f time_step)^2/3: in steps of 5 ms that of Wk
    is within 0.3 % up to 10 Hz and 3.1 % at 20 Hz, in steps of 2 ms within 0.05 % and 0.5 %. Exact is the filter
    behind the vehicle, ``control.ss(weighting("Wk")) * closed[response, road]``. The step is no longer than a
    period of the filter's upper band limit, 10 ms but for Wf.
    """
    from scipy import signal

    history = _checked(acceleration, time_step)
    filter_ = weightings.weighting(name)
    poles = filter_.poles()
    highest = float(np.abs(poles).max()) / (2 * np.pi)
    if time_step * highest > 1 + 1e-9:
        raise ValueError(f"time_step must be at most {1 / highest:.3g} s for {name}, got {time_step!r}")
    gain = float(filter_.num[0][0][0] / filter_.den[0][0][0])
    digital = signal.bilinear_zpk(filter_.zeros(), poles, gain, 1 / time_step)
    return np.asarray(signal.sosfilt(signal.zpk2sos(*digital), history))


def running_rms(
    acceleration: ArrayLike, time_step: float, *, integration: str = "linear", time_constant: float = 1.0
) -> Real:
    """Return the running root mean square (n,) of a weighted acceleration, clause 6.3.1, with silence before it.

    Integration is ``"linear"``, the mean over the last `time_constant` seconds (to the nearest number of steps),
    or ``"exponential"``, with a weight of the past that falls to 1/e in that time; the standard recommends 1 s.
    """
    from scipy import signal

    squares = _checked(acceleration, time_step) ** 2
    checks.one_of("integration", integration, INTEGRATIONS)
    checks.positive("time_constant", time_constant, "s")
    if time_constant < time_step:
        raise ValueError(f"time_constant must be at least a time step of {time_step} s, got {time_constant!r}")
    if integration == "linear":
        steps = round(time_constant / time_step)
        return np.sqrt(signal.lfilter(np.full(steps, 1 / steps), [1.0], squares))
    kept = math.exp(-time_step / time_constant)
    return np.sqrt(signal.lfilter([1 - kept], [1.0, -kept], squares))


def exposure(
    acceleration: ArrayLike,
    time_step: float,
    weighting: str | None = None,
    *,
    integration: str = "linear",
    settling: float = 0.0,
    keep_offset: bool = False,
) -> Exposure:
    """Return the measures of an acceleration that is weighted already, or by a filter.

    The mean of the history, such as gravity or the offset of a sensor, is removed first: switched on at the start
    it would make the filter swing. It is the ``offset`` of the result.

    Parameters
    ----------
    acceleration : (n,) array_like
        [m/s^2], of a second at least after the settling, and not constant throughout.
    time_step : float
        Between two samples [s].
    weighting : str, optional
        Filter of ISO 2631 to be applied first, see `weighted`: ``"Wk"``.
    integration : str
        Of the running r.m.s. with a time constant of 1 s: ``"linear"`` or ``"exponential"``.
    settling : float
        Time at the start in which the filter settles, not counted in the measures [s].
    keep_offset : bool
        Whether the mean stays in the history.

    Examples
    --------
    Gravity in a history makes no difference:

    >>> import numpy as np
    >>> import suspension_ctrl as sc
    >>> t = np.arange(0.0, 60.0, 0.005)  # s
    >>> sine = np.sin(2 * np.pi * 4.0 * t)  # m/s^2
    >>> for acceleration in (sine, sine + 9.80665):
    ...     found = sc.exposure(acceleration, 0.005, "Wk")
    ...     print(f"r.m.s. {found.rms:.3f} m/s^2, offset {abs(found.offset):.2f} m/s^2")
    r.m.s. 0.684 m/s^2, offset 0.00 m/s^2
    r.m.s. 0.684 m/s^2, offset 9.81 m/s^2

    A shock of 0.1 s in a sine of 4 Hz raises MTVV and VDV much more than the r.m.s. value:

    >>> shock = sine + np.where(abs(t - 30.0) < 0.05, 8.0, 0.0)
    >>> for acceleration in (sine, shock):
    ...     found = sc.exposure(acceleration, 0.005)
    ...     print(f"r.m.s. {found.rms:.2f}, MTVV {found.mtvv:.2f} m/s^2, VDV {found.vdv:.1f} m/s^1.75")
    r.m.s. 0.71, MTVV 0.71 m/s^2, VDV 2.2 m/s^1.75
    r.m.s. 0.78, MTVV 2.56 m/s^2, VDV 4.5 m/s^1.75
    """
    history = _checked(acceleration, time_step)
    checks.not_negative("settling", settling, "s")
    offset = 0.0 if keep_offset else float(history.mean())
    rounding = 1e-12 * float(np.abs(history).max())
    history = history - offset
    if weighting is not None:
        history = weighted(history, time_step, weighting)
    history = history[round(min(settling / time_step, history.size)) :]
    duration = history.size * time_step
    peak = float(np.abs(history).max(initial=0.0))
    if duration < 1.0 - 1e-9 or peak <= rounding:
        got = f"{duration:g} s, peak {peak:g}"
        raise ValueError(f"acceleration must last 1 s at least and not be constant throughout, got {got}")
    return Exposure(
        rms=float(np.sqrt(np.mean(history**2))),
        peak=peak,
        mtvv=float(running_rms(history, time_step, integration=integration).max()),
        vdv=float(time_step * np.sum(history**4)) ** 0.25,
        duration=duration,
        offset=offset,
    )


def _checked(acceleration: ArrayLike, time_step: float) -> Real:
    checks.positive("time_step", time_step, "s")
    history = checks.reals("acceleration must be", acceleration)
    if history.ndim != 1 or history.size == 0 or not np.isfinite(history).all():
        raise ValueError(f"acceleration must be finite and of shape (n,), n >= 1, got shape {history.shape}")
    return history

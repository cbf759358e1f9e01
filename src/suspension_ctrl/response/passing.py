"""Histories of responses in an event for many designs, by the frequency response of the padded event.

What is left of a response at the end of the period is the error of the wrap-around. The plant, closed around
usual struts, is computed once; a design solves the loop of its struts at every frequency, ``(1 - P D) e = S`` as
for mean squares. What the road does to a response directly, as the tyre's stiffness to its load, is added in time:
the rest has few frequencies.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

import control
import numpy as np

from ..quantities import Bool, Complex, Real
from ..roads.events import Event
from ..vehicles.assembly import label
from ..vehicles.feedback import ORDERS, Dynamics, System, around, gains_by_order, selected, with_rates
from ..vehicles.vehicle import Vehicle
from .blocks import pairs_of
from .padded_event import PaddedEvent
from .ports import paths

_USUAL = (20e3, 2e3, 0.0)  # N/m, N s/m, kg: struts around which the plant is closed
_LEFT = 1e-3  # of the largest response, what may be left before the end of the period
_CUT = 5e-4  # of it, largest change by the frequencies left out, on usual struts
_NOTHING = 1e-9  # share of what the wheels do one by one, below which a response is rounding
_STEPS = 64  # samples of the elevation in the shortest wave of the event or of a mode
_TIMES = 4  # times in a wave of the highest frequency kept
_EVENTS = 64  # that are kept

Entries = Mapping[tuple[int, int], Complex]
"""Elements of a matrix by row and column, each (p, n); those that are absent are zero."""


class Passing(NamedTuple):
    """Responses of a vehicle in an event on usual struts, at n frequencies of the period.

    Struts are sums and differences of left and right; those that the event does not move are left out.
    """

    pairs: Real  # (a, q), the struts that move, by all
    omega: Real  # (n,)
    direct: Real  # (m, times + k), part of the responses by the elevation and its rate at the same time
    kinked: Bool  # (m, times), whether a kink of the response is within a step
    at_knots: Complex  # (n, k), values of the Fourier series at k knots of the event, the last of the times
    by_event: Complex  # (m, n), the rest of the responses as coefficients of Fourier series
    deflection: Complex  # (a, n), likewise
    by_strut: Complex  # (m, a, n), responses by tension
    feedback: Complex  # (a, a, n), deflections by tension
    rounding: Real  # (m,)
    judged: int  # of the times, the first, in which peaks count
    steady: bool

    def histories(self, stiffness: Entries) -> Real:
        """Return the responses (m, p, times + k) with struts that add a dynamic stiffness (a, a)."""
        deflection, spectra = self._deflections(stiffness), self.by_event[:, None]
        for (i, j), one in stiffness.items():
            spectra = spectra + self.by_strut[:, i, None] * (one * deflection[j])
        times = self.kinked.shape[1]
        waves = np.fft.irfft(spectra, times, axis=-1) * times
        if self.at_knots.size:
            waves = np.concatenate([waves, (spectra @ self.at_knots).real], axis=-1)
        return np.asarray(waves + self.direct[:, None])

    def _deflections(self, stiffness: Entries) -> list[Complex]:
        """Solve (1 - P D) e = S, e (a) of (p, n), by elimination, which needs no pivoting (see `ManyStruts`)."""
        struts = range(len(self.deflection))
        loop = [[np.complex128(i == j) for j in struts] for i in struts]
        for (k, j), one in stiffness.items():
            for i in struts:
                loop[i][j] = loop[i][j] - self.feedback[i, k] * one
        e = list(self.deflection)
        for c in struts:
            for i in struts[c + 1 :]:
                factor = loop[i][c] / loop[c][c]
                e[i] = e[i] - factor * e[c]
                for j in struts[c + 1 :]:
                    loop[i][j] = loop[i][j] - factor * loop[c][j]
        for c in reversed(struts):
            e[c] = (e[c] - sum(loop[c][j] * e[j] for j in struts[c + 1 :])) / loop[c][c]
        return e

    def crest(self, history: Real) -> Real:
        """Return maxima (m, p), between times by the parabola through the largest value and its neighbours."""
        at = history[..., : self.judged].argmax(axis=-1, keepdims=True)
        places = (np.clip(at + i, 0, self.judged - 1) for i in (-1, 0, 1))
        before, here, after = (np.take_along_axis(history, place, axis=-1)[..., 0] for place in places)
        bend = 2 * here - before - after
        smooth = (bend > 0) & ~np.take_along_axis(self.kinked, at[..., 0], axis=1)
        rise = np.divide((after - before) ** 2, 8 * bend, out=np.zeros_like(bend), where=smooth)
        return np.maximum(here + rise, history[..., self.kinked.shape[1] :].max(axis=-1, initial=-np.inf))

    def decayed(self, history: Real) -> Bool:
        """Return which designs (p,) have come to rest at the end of histories (m, p, times + k)."""
        size, times = np.abs(history), self.kinked.shape[1]
        end = slice(times - times // 8, times - times // 64)  # ahead of the ripple before a kink at time 0
        allowed = _LEFT * size.max(axis=-1) + self.rounding[:, None]
        return np.asarray(self.steady | (size[..., end].max(axis=-1) <= allowed).all(axis=0))

    def stiffness(self, vehicle: Vehicle, coefficients: Real) -> Entries:
        """Return the dynamic stiffness of struts with coefficients (p, c), less that of usual struts."""
        q, s = len(vehicle.struts), np.asarray(1j * self.omega, dtype=complex)
        unit = np.array([gains_by_order([one], {one.name: 1.0}, q) for one in vehicle.strut_coefficients])
        gains = self.pairs @ (np.tensordot(coefficients, unit, 1) - _usual_gains(q)) @ self.pairs.T
        powers = s ** np.arange(ORDERS)[:, None]
        present = np.argwhere(_coupling(vehicle, self.pairs)).tolist()
        found = {(i, j): np.asarray(gains[:, :, i, j] @ powers, dtype=complex) for i, j in present}
        for p, row in enumerate(coefficients.tolist() if vehicle.networks else ()):
            values = dict(zip((one.name for one in vehicle.strut_coefficients), row, strict=True))
            added = Dynamics.of(vehicle.networks, values, np.zeros((ORDERS, q, q))).stiffness(s)
            added = self.pairs @ added @ self.pairs.T
            for i, j in present:
                found[i, j][p] += added[:, i, j]
        return found


@lru_cache(_EVENTS)
def passing(vehicle: Vehicle, event: Event, speed: float, responses: tuple[str, ...], padding: float) -> Passing:
    """Return the responses in an event before a level road of this length [s]."""
    usual, m, q = _UsualStruts.of(vehicle, responses), len(responses), len(vehicle.struts)
    road = PaddedEvent.of(event, vehicle.contact_points, speed, padding)
    time = road.times(int(np.ceil(road.period * max(usual.fastest, 1 / event.finest(speed)) * _STEPS)))
    height = np.fft.rfft(road.height(time), axis=0) / time.size  # (n, r)
    omega: Real = 2 * np.pi / road.period * np.arange(len(height), dtype=float)
    h = usual.paths(omega)
    h[:, :m, :-q] -= usual.by_height + 1j * omega[:, None, None] * usual.by_rate
    by_road = h[:, :, :-q] * height[:, None]
    series, rounding = by_road.sum(axis=2).T, _NOTHING * np.abs(by_road[:, :m]).sum(axis=(0, 2))
    n = _kept(series[:m], usual.direct(road, time), rounding)
    pairs = _moved(vehicle, series[m:, :n])
    by_tension = np.tensordot(h[:n, :, -q:], pairs, (2, 1)).transpose(1, 2, 0)
    knots, kinks = road.knots if usual.kinks.any() else np.empty(0), usual.kinks[:, None]
    time, omega = road.times(_TIMES * n), omega[:n]
    return Passing(
        pairs=pairs,
        omega=omega,
        direct=usual.direct(road, np.concatenate([time, knots])),
        kinked=kinks & (np.abs(time[:, None] - knots) < time[1]).any(axis=1),
        at_knots=np.where(omega > 0, 2.0, 1.0)[:, None] * np.exp(1j * np.outer(omega, knots)),
        by_event=series[:m, :n],
        deflection=pairs @ series[m:, :n],
        by_strut=by_tension[:m],
        feedback=np.tensordot(pairs, by_tension[m:], 1),
        rounding=rounding,
        judged=round(time.size * road.end / road.period),
        steady=event.steady,
    )


class _UsualStruts(NamedTuple):
    """A vehicle with usual struts: m responses and q deflections by r roads and q tensions."""

    closed: System
    rows: list[int]  # outputs of the system: responses, of a jerk the acceleration, and deflections
    jerks: Bool  # (m + q,)
    by_height: Real  # (m, r), what the roads do to the responses at the same time
    by_rate: Real  # (m, r), what their rates do

    @classmethod
    def of(cls, vehicle: Vehicle, responses: Sequence[str]) -> "_UsualStruts":
        """Close the plant; the direct part of measured responses is unknown, and taken as 0."""
        q, r = len(vehicle.struts), len(vehicle.contact_points)
        integrals = list(map(label, vehicle.without_jerk(responses)))
        rates = {name: one for name, one in zip(responses, integrals, strict=True) if name != one}
        closed = around(vehicle.plant(list(dict.fromkeys(integrals))), _usual_gains(q))
        rows = [*map(closed.output_labels.index, integrals), *range(-2 * q, -q)]
        jerks, direct = (
            np.array([*(name in rates for name in responses), *[False] * q]),
            np.zeros((len(responses), 2 * r)),
        )
        if isinstance(closed, control.StateSpace):
            driven = selected(closed, closed.output_labels[: -2 * q], closed.input_labels[:-q], "driven")
            d = selected(with_rates(driven, rates), responses, driven.input_labels, "driven").D
            direct[:, : d.shape[1]] = d
        return cls(closed, rows, jerks, direct[:, :r], direct[:, r:])

    @property
    def kinks(self) -> Bool:
        """Which responses (m,) have kinks where the road has."""
        return np.asarray(self.by_height.any(axis=1) | self.by_rate.any(axis=1))

    @property
    def fastest(self) -> float:
        """Frequency of the fastest mode, 0 of a measured vehicle [Hz]."""
        poles = self.closed.poles() if isinstance(self.closed, control.StateSpace) else np.zeros(1)
        return float(np.abs(poles).max()) / (2 * np.pi)

    def paths(self, omega: Real) -> Complex:
        """Return the frequency response (n, m + q, r + q)."""
        h = paths(self.closed, omega / (2 * np.pi))[:, self.rows]
        h[:, self.jerks] *= 1j * omega[:, None, None]
        return h

    def direct(self, road: PaddedEvent, time: Real) -> Real:
        """Return what elevation and its rate do to the responses (m, k) at the same times (k,)."""
        return np.asarray(self.by_height @ road.height(time).T + self.by_rate @ road.rate(time).T)


def _kept(series: Complex, direct: Real, rounding: Real) -> int:
    """Return how many frequencies of Fourier series (m, n) keep responses in time, with `direct` (m, k) added."""
    samples, n = direct.shape[1], series.shape[1]
    largest = np.abs(np.fft.irfft(series, samples) * samples + direct).max(axis=1)
    doublings = 2 ** np.arange(3, 24)
    for size in np.sort(np.concatenate([doublings, 3 * doublings // 2])).tolist():
        rest = np.where(np.arange(n) < size, 0, series)
        if (np.abs(np.fft.irfft(rest, samples) * samples).max(axis=1) <= _CUT * largest + rounding).all():
            return min(size, n)
    return n


def _moved(vehicle: Vehicle, deflection: Complex) -> Real:
    """Return the sums and differences of struts (a, q) that deflect (q, n), and those coupled to them."""
    pairs, _ = pairs_of(vehicle.struts, vehicle.contact_points)
    sizes = np.abs(pairs @ deflection).max(axis=1)
    moved, coupling = sizes > _NOTHING * sizes.max(), _coupling(vehicle, pairs)
    for _ in moved:
        moved = moved | coupling[moved].any(axis=0)
    return pairs[moved]


def _coupling(vehicle: Vehicle, pairs: Real) -> Bool:
    """Return between which sums and differences of struts (a, a) coefficients act; each acts on itself."""
    q = len(vehicle.struts)
    gains = [one.gain for one in vehicle.strut_coefficients] + [np.diag(one.share) for one in vehicle.networks]
    return np.any([np.abs(pairs @ gain @ pairs.T) > _NOTHING for gain in [np.eye(q), *gains]], axis=0)


def _usual_gains(q: int) -> Real:
    """Return the gains (3, q, q) of usual struts by order."""
    return np.multiply.outer(_USUAL, np.eye(q))

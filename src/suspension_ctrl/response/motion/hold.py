"""Linear vehicles in time, exact for a road that is straight between even times: first-order hold."""

from typing import NamedTuple

import control
import numpy as np

from ...quantities import Complex, Real
from ...roads.events import Event
from ...roads.profiles import Profile
from .courses import heights_under
from .equations import roads_of

_STEPS = 200  # in the shortest wave of an event or mode: straight pieces then attenuate it by 8e-5
_SETTLED = 1e-3  # share of the slowest mode that is left at the end of an event
_LONGEST = 60.0  # s, after an event


class Model(NamedTuple):
    """x' = a x + b u, y = c x + d u + e u' under roads u; their rates u' drive no states."""

    a: Real
    b: Real
    c: Real
    d: Real
    e: Real
    roads: list[str]

    @classmethod
    def of(cls, closed: control.StateSpace) -> "Model":
        """Eliminate road rates G u' from the states: w = x - G u obeys w' = A w + (B + A G) u."""
        roads = roads_of(closed)
        r = len(roads)
        a, b, c, d = closed.A, closed.B, closed.C, closed.D
        g, e = (m[:, r:] if m.shape[1] > r else np.zeros((len(m), r)) for m in (b, d))
        return cls(a, b[:, :r] + a @ g, c, d[:, :r] + c @ g, e, roads)


class Wheels(NamedTuple):
    """The road under r wheels at k times."""

    points: Real  # (k, r, 4), heights of the last two points that a wheel has reached and of the next two
    share: Real  # (r,), share of a step by which the wheel is beyond the last
    start: float  # first place of the origin [m]

    @classmethod
    def on(cls, profile: Profile, contacts: Real, periodic: bool) -> "Wheels":
        """Place the wheels on a profile; ValueError if it is too short or too narrow."""
        x, step, n = contacts[:, 0], profile.step, profile.distance.size
        if (base := float(np.ptp(x))) > step * (n - 2):
            got = f"{step * (n - 1):g} m"
            raise ValueError(f"profile must be longer by a step than the wheelbase of {base:g} m, got {got}")
        ahead = np.round((x if periodic else x - x.min()) / step, 9)  # a whole number of steps but for rounding
        first = np.floor(ahead).astype(int)
        times = np.arange(n if periodic else n - int(np.ceil(ahead.max())))
        index = times[:, None, None] + first[:, None] + np.arange(-1, 3)
        index = index % n if periodic else np.clip(index, 0, n - 1)
        heights = heights_under(profile, contacts)[index, np.arange(len(contacts))[:, None]]
        return cls(heights, ahead - first, float(profile.distance[0] - (0.0 if periodic else x.min())))

    @classmethod
    def during(cls, event: Event, contacts: Real, speed: float, poles: Complex) -> tuple["Wheels", float]:
        """Return the wheels during an event until the modes of a model have settled, and the time step [s]."""
        end = float(event.knots(contacts, speed)[-1])
        if not event.steady:
            slowest = float(-poles.real.max(initial=-np.inf))
            end += min(_LONGEST, -np.log(_SETTLED) / slowest) if slowest > 0 else _LONGEST
        fastest = float(np.abs(poles[poles.imag != 0]).max(initial=0.0)) / (2 * np.pi)
        steps = int(np.ceil(end * max(fastest, 1 / event.finest(speed)) * _STEPS))
        dt = end / steps
        time = dt * np.arange(-1, steps + 2, dtype=float)
        height = event.elevation(time, contacts, speed)
        windows = np.lib.stride_tricks.sliding_window_view(height, 4, axis=0)
        return cls(windows, np.zeros(len(contacts)), -float(contacts[:, 0].max())), dt

    def elevation(self) -> Real:
        """Return the road's elevation (k, r) [m]."""
        return (1 - self.share) * self.points[:, :, 1] + self.share * self.points[:, :, 2]

    def rise(self) -> Real:
        """Return how much the road rises in a step (k, r) [m], at a kink the mean of both sides."""
        ahead = self.points[:, :, 2] - self.points[:, :, 1]
        behind = self.points[:, :, 1] - self.points[:, :, 0]
        return np.where(self.share == 0, (ahead + behind) / 2, ahead)


def states_of(model: Model, wheels: Wheels, dt: float, periodic: bool, start: float | None) -> Real:
    """Return the states (k, n) at times `dt` [s] apart; `start` is the height of a level road before [m]."""
    n, k = len(model.a), len(wheels.points)
    taps = np.array([_taps(model, i, dt, share) for i, share in enumerate(wheels.share.tolist())])
    drive = np.einsum("krj,rjn->nk", wheels.points[:, :, 1:], taps)  # contribution of a step
    drive = np.pad(drive, ((0, 0), (0, 1)))  # for the states after the last step
    forward = _straight(model.a, model.b[:, :1], dt)[0]
    sampled = control.ss(forward, np.eye(n), np.eye(n), np.zeros((n, n)), dt)
    if periodic:  # the first states recur after a period
        after = control.forced_response(sampled, inputs=drive).outputs[:, -1]
        at_first = np.linalg.solve(np.eye(n) - np.linalg.matrix_power(forward, k), after)
    else:
        height = wheels.elevation()[0] if start is None else np.full(model.b.shape[1], start)
        at_first = np.linalg.solve(model.a, -model.b @ height)
    return control.forced_response(sampled, inputs=drive, initial_state=at_first).outputs.T[:-1]


def _taps(model: Model, wheel: int, dt: float, share: float) -> Real:
    """Return what three points under a wheel add (3, n) to the states in a step from a `share` past the first."""
    b = model.b[:, wheel : wheel + 1]
    _, start, point = _straight(model.a, b, (1 - share) * dt)
    onward, again, end = _straight(model.a, b, share * dt)
    start, point = onward @ start, onward @ point + again
    return np.hstack([(1 - share) * start, share * start + point + (1 - share) * end, share * end]).T


def _straight(a: Real, b: Real, duration: float) -> tuple[Real, Real, Real]:
    """Return the matrices of a first-order hold over a duration [s]: of the states, first and last input."""
    from scipy.signal import cont2discrete

    n, r = b.shape
    forward, shifted, _, last, _ = cont2discrete((a, b, np.eye(n), np.zeros((n, r))), duration, "foh")
    return forward, shifted - forward @ last, last

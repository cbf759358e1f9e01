"""A vehicle driven over a profile: its responses in time, exact for a road that is straight between its points."""

from typing import TYPE_CHECKING, NamedTuple

import control
import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import checks
from ..quantities import signal_unit
from ..roads.profiles import Profile

if TYPE_CHECKING:
    import pandas as pd


Real = NDArray[np.float64]

_POINTS = 4
"""Least points of the profile in a wave of the fastest mode, which it then meets by 0.81, sinc^2 of 1/4."""
_SAME_TRACK = 1e-3  # m


def simulate(
    closed: control.StateSpace,
    profile: Profile,
    speed: float,
    contact_points: ArrayLike = ((0.0, 0.0),),
    *,
    periodic: bool = False,
) -> "pd.DataFrame":
    """Return the responses of a vehicle that is driven over a profile.

    A wheel at (x, y) follows the track at y, ``z(t) = h(d(t) + x, y)``, where d is where the origin is, the body's
    centre of gravity. Between two points the road is straight, and the response to that is exact: the states
    go from one sample to the next by matrix exponentials (first-order hold), also where the wheels pass their
    points at different times. ``control.forced_response`` alone would be exact for a single wheel only. What
    the straight pieces take from a wave of frequency f is the factor sinc^2(f step/speed) of their own. Steps
    that are uneven within what `Profile` allows count as their mean.

    Parameters
    ----------
    closed : control.StateSpace
        Vehicle with its struts, ``vehicle.closed(...)``, from roads [m] and, if tyres are damped, rates [m/s].
    profile : Profile
        The road, with a track under every wheel.
    speed : float
        Vehicle speed V [m/s].
    contact_points : (r, 2) array_like
        Where the roads touch, ``vehicle.contact_points``, x forward and y to the left [m]; by default one wheel on
        the track at y = 0.
    periodic : bool
        How it begins. If false, the rearmost wheel stands on the first point, the vehicle settled on the heights
        under its wheels as after a level road, and sets off at full speed; the foremost ends on the last point.
        Drop the first seconds, or begin with a level stretch. If true, the profile goes on from its last point
        over one step to its first, as those of `Road.profile` do without a seam, and the vehicle has driven
        on it for ever: one period of the steady state, without any transient.

    Returns
    -------
    DataFrame
        A row for each step of the profile: ``time [s]``, ``distance [m]`` of the origin along the road, and
        every response with its unit, ``body_acceleration [m/s^2]``; outputs of other names have none. On a kink of
        the road the load of a damped tyre jumps and is given as the mean of both sides. For finer samples of the
        same road, which such a load may need, give a profile of the heights ``profile.at(...)``.

    Raises
    ------
    ValueError
        If there are not as many contact points as roads, the profile lacks a track under one, is too short for
        the wheelbase, or has less than four points in a wave of the model's fastest mode at this speed.
    """
    import pandas as pd

    checks.positive("speed", speed, "m/s")
    model = _Model.of(closed)
    points = _checked_points(contact_points, model.roads)
    _check_step(closed, profile.step, speed)
    wheels = _Wheels.on(profile, points, periodic)
    dt = profile.step / speed
    states = _states(model, wheels, dt, periodic)
    responses = states @ model.c.T + wheels.elevation() @ model.d.T + wheels.rise() / dt @ model.e.T
    return pd.DataFrame(
        {
            "time [s]": dt * np.arange(len(states)),
            "distance [m]": wheels.start + profile.step * np.arange(len(states)),
            **{_header(name): values for name, values in zip(closed.output_labels, responses.T, strict=True)},
        }
    )


class _Model(NamedTuple):
    """x' = a x + b u, y = c x + d u + e u' under roads u, whose rates u' are no inputs of the states any more."""

    a: Real
    b: Real
    c: Real
    d: Real
    e: Real
    roads: list[str]

    @classmethod
    def of(cls, closed: control.StateSpace) -> "_Model":
        """Take what rates do to the states into these: with x' = A x + B u + G u' it is x - G u that moves so."""
        if not (isinstance(closed, control.StateSpace) and closed.isctime(strict=True)):
            got = f"{type(closed).__name__} with dt = {getattr(closed, 'dt', None)}"
            raise ValueError(f"closed must be a state-space model in continuous time, got {got}")
        roads = [name for name in closed.input_labels if not name.endswith("_rate")]
        r = len(roads)
        if closed.input_labels not in (roads, [*roads, *(f"{road}_rate" for road in roads)]):
            raise ValueError(f"closed must be driven by roads and their rates, got {closed.input_labels}")
        a, b, c, d = closed.A, closed.B, closed.C, closed.D
        g, e = (m[:, r:] if m.shape[1] > r else np.zeros((len(m), r)) for m in (b, d))
        return cls(a, b[:, :r] + a @ g, c, d[:, :r] + c @ g, e, roads)


class _Wheels(NamedTuple):
    """The road under r wheels at k times.

    Parameters
    ----------
    points : (k, r, 4) ndarray
        The last two points of the profile that each wheel has reached and the next two [m].
    share : (r,) ndarray
        Share of a step that each wheel is beyond the last point that it has reached, at all times alike.
    start : float
        Distance of the origin at first [m].
    """

    points: Real
    share: Real
    start: float

    @classmethod
    def on(cls, profile: Profile, contacts: Real, periodic: bool) -> "_Wheels":
        """Place the wheels on a profile; ValueError if it is too short or lacks a track."""
        x, step, n = contacts[:, 0], profile.step, profile.distance.size
        wheelbase = float(np.ptp(x))
        if wheelbase > step * (n - 2):
            raise ValueError(
                f"profile must be longer by a step than the wheelbase of {wheelbase:g} m, got {step * (n - 1):g} m"
            )
        ahead = np.round((x if periodic else x - x.min()) / step, 9)  # a whole number of steps but for rounding
        first = np.floor(ahead).astype(int)
        times = np.arange(n if periodic else n - int(np.ceil(ahead.max())))
        index = times[:, None, None] + first[:, None] + np.arange(-1, 3)
        index = index % n if periodic else np.clip(index, 0, n - 1)
        tracks = [_track(profile, y) for y in contacts[:, 1].tolist()]
        heights = profile.height[index, np.array(tracks)[:, None]]
        return cls(heights, ahead - first, float(profile.distance[0] - (0.0 if periodic else x.min())))

    def elevation(self) -> Real:
        """Return the road's elevation (k, r) [m]."""
        return (1 - self.share) * self.points[:, :, 1] + self.share * self.points[:, :, 2]

    def rise(self) -> Real:
        """Return how much the road rises in a step (k, r) [m], at a kink the mean of both sides."""
        ahead = self.points[:, :, 2] - self.points[:, :, 1]
        behind = self.points[:, :, 1] - self.points[:, :, 0]
        return np.where(self.share == 0, (ahead + behind) / 2, ahead)


def _states(model: _Model, wheels: _Wheels, dt: float, periodic: bool) -> Real:
    """States (k, n) of the model at the times of the wheels, `dt` [s] apart."""
    n, k = len(model.a), len(wheels.points)
    taps = np.array([_taps(model, i, dt, share) for i, share in enumerate(wheels.share.tolist())])
    drive = np.einsum("krj,rjn->nk", wheels.points[:, :, 1:], taps)  # what a step adds
    forward = _straight(model.a, model.b[:, :1], dt)[0]
    sampled = control.ss(forward, np.eye(n), np.eye(n), np.zeros((n, n)), dt)
    drive = np.pad(drive, ((0, 0), (0, 1)))  # for the states after the last step
    if periodic:  # what a period does to rest and to the first states brings these back
        after = control.forced_response(sampled, inputs=drive).outputs[:, -1]
        at_first = np.linalg.solve(np.eye(n) - np.linalg.matrix_power(forward, k), after)
    else:
        at_first = np.linalg.solve(model.a, -model.b @ wheels.elevation()[0])
    answer = control.forced_response(sampled, inputs=drive, initial_state=at_first)
    return answer.outputs.T[:-1]


def _taps(model: _Model, wheel: int, dt: float, share: float) -> Real:
    """Return what each of three points under a wheel adds (3, n) to the states in a step.

    The step begins a `share` of it past the first; the road goes straight to the second, then on to the third.
    """
    b = model.b[:, wheel : wheel + 1]
    _, start, point = _straight(model.a, b, (1 - share) * dt)
    onward, again, end = _straight(model.a, b, share * dt)
    start, point = onward @ start, onward @ point + again
    return np.hstack([(1 - share) * start, share * start + point + (1 - share) * end, share * end]).T


def _straight(a: Real, b: Real, duration: float) -> tuple[Real, Real, Real]:
    """Return states after a duration [s] by those before and by the first and last value of a straight input."""
    from scipy.signal import cont2discrete

    n, r = b.shape
    forward, shifted, _, last, _ = cont2discrete((a, b, np.eye(n), np.zeros((n, r))), duration, "foh")
    return forward, shifted - forward @ last, last


def _checked_points(contact_points: ArrayLike, roads: list[str]) -> Real:
    points = np.asarray(contact_points, dtype=float)
    if points.shape != (len(roads), 2) or not np.isfinite(points).all():
        raise ValueError(
            f"contact_points must be finite, x and y [m] for each of {', '.join(roads)}, got {points.tolist()}"
        )
    return points


def _check_step(closed: control.StateSpace, step: float, speed: float) -> None:
    poles = closed.poles()
    fastest = float(np.abs(poles[poles.imag != 0]).max(initial=0.0)) / (2 * np.pi)
    if step * fastest * _POINTS > speed * (1 + 1e-9):
        raise ValueError(
            f"profile must have steps of at most {speed / (_POINTS * fastest):.3g} m at {speed:g} m/s, "
            f"{_POINTS} in a wave of the fastest mode of {fastest:.3g} Hz, got {step:g} m"
        )


def _track(profile: Profile, y: float) -> int:
    apart = np.abs(np.array(profile.tracks) - y)
    if apart.min() > _SAME_TRACK:
        raise ValueError(f"profile must have a track at y = {y:g} m, got tracks at {list(profile.tracks)} m")
    return int(apart.argmin())


def _header(response: str) -> str:
    """Return name and unit of a response."""
    unit = signal_unit(response)
    return f"{response} [{unit}]" if unit else response

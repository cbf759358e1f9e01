"""A vehicle driven over a profile or an event: its responses in time, exact for a road of straight pieces."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import control
import numpy as np
from control import StateSpace
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Complex, Real, column_headers, signal_unit
from ..roads.events import Event
from ..roads.profiles import Profile
from ..roads.rigs import Rig
from ..vehicles.assembly import ResponseName
from ..vehicles.vehicle import Setting, Vehicle

if TYPE_CHECKING:
    import pandas as pd

_POINTS = 4  # of the profile in a wave of the fastest mode, at least: it meets that by 0.81, sinc^2 of 1/4
_STEPS = 200  # in the shortest wave of an event or mode: straight pieces then attenuate it by 8e-5
_SETTLED = 1e-3  # share of the slowest mode that is left at the end of an event
_LONGEST = 60.0  # s, after an event
_SAME_TRACK = 1e-3  # m
_ONE = ((0.0, 0.0),)  # contact point of one wheel


@overload
def simulate(
    closed: Vehicle,
    setting: Setting,
    profile: Profile | Event,
    speed: float = ...,
    *,
    periodic: bool = ...,
    responses: Sequence[ResponseName] | None = ...,
) -> "pd.DataFrame": ...


@overload
def simulate(
    closed: StateSpace,
    profile: Profile | Event,
    speed: float = ...,
    contact_points: ArrayLike = ...,
    *,
    periodic: bool = ...,
) -> "pd.DataFrame": ...


def simulate(closed: Any, *arguments: Any, **options: Any) -> "pd.DataFrame":
    """Drive a vehicle over a profile: ``simulate(vehicle, setting, profile, speed)``.

    ``simulate(closed, profile, speed, contact_points)`` drives any model from roads to responses. A wheel at
    (x, y) follows the track at y, ``z(t) = h(d(t) + x, y)``, where d is the place of the body's centre of gravity.
    The response to a road that is straight between its points is exact (first-order hold), also where the wheels
    pass its points at different times; straight pieces attenuate a wave of frequency f by sinc^2(f step/speed).

    Parameters
    ----------
    closed : Vehicle or control.StateSpace
        The vehicle; or ``vehicle.closed(...)``, from roads [m] and, if tyres are damped, rates [m/s].
    setting : mapping or (float, float)
        Of a vehicle the coefficients of its struts, as for ``vehicle.closed``.
    profile : Profile or Event
        The road, with a track under every wheel. With less than four points in a wave of the model's fastest mode
        at this speed it is refined by straight interpolation. Or an event such as `SpeedBump`, from the moment
        when the foremost wheel meets it until the vehicle has settled; of steady waves one period.
    speed : float
        Vehicle speed V [m/s]; not of a test rig.
    contact_points : (r, 2) array_like
        Of a model the points where the roads touch, x forward and y to the left [m]; by default one wheel on the
        track at y = 0. A vehicle knows its own.
    periodic : bool
        The start. If false, the rearmost wheel stands on the first point, the vehicle settled on the heights
        under its wheels as after a level road, and sets off at full speed; the foremost ends on the last point.
        Drop the first seconds, or begin with a level stretch. If true, the profile goes on from its last point
        over one step to its first, as those of `Road.profile` do without a seam, and the result is one period of
        the steady state, without any transient.

    Returns
    -------
    DataFrame
        A row for each step of the profile: ``time [s]``, ``distance [m]`` of the origin along the road (of an
        obstacle from its beginning, on a test rig none), and every response with its unit,
        ``body_acceleration [m/s^2]``. On a kink of the road the load of a damped
        tyre jumps and is given as the mean of both sides.

    Raises
    ------
    ValueError
        If there are not as many contact points as roads, or the profile lacks a track under one or is too short
        for the wheelbase.

    Examples
    --------
    A step of 50 mm at 10 m/s compresses the strut, which then swings out and comes to rest:

    >>> import suspension_ctrl as sc
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3)
    >>> history = sc.simulate(car, {"spring": 22e3, "damper": 1500.0}, sc.Step(height=0.05), speed=10.0)
    >>> list(history.columns)
    ['time [s]', 'distance [m]', 'body_acceleration [m/s^2]', 'suspension_travel [m]', 'tyre_load [N]']
    >>> travel = 1e3 * history["suspension_travel [m]"]
    >>> print(f"compression {-travel.min():.0f} mm, rebound {travel.max():.0f} mm")
    compression 59 mm, rebound 24 mm
    """
    drive = _drive_vehicle if isinstance(closed, Vehicle) else _drive
    return drive(closed, *arguments, **options)


def _drive_vehicle(
    vehicle: Vehicle,
    setting: Setting,
    profile: Profile | Event,
    speed: float = 0.0,
    *,
    periodic: bool = False,
    responses: Sequence[ResponseName] | None = None,
) -> "pd.DataFrame":
    closed = vehicle.closed(setting, responses=responses)
    return _drive(closed, profile, speed, vehicle.contact_points, periodic=periodic)


def _drive(
    closed: StateSpace,
    profile: Profile | Event,
    speed: float = 0.0,
    contact_points: ArrayLike = _ONE,
    *,
    periodic: bool = False,
) -> "pd.DataFrame":
    import pandas as pd

    if not isinstance(profile, Profile | Event):
        raise ValueError(f"profile must be a Profile or an event, got {checks.shown(profile)}")
    model = _Model.of(closed)
    points = _checked_points(contact_points, model.roads)
    if isinstance(profile, Event):
        periodic = profile.steady
        wheels, dt = _Wheels.during(profile, points, speed, closed.poles())
    else:
        checks.positive("speed", speed, "m/s")
        profile = _refined(profile, _coarsest(closed, speed), periodic)
        wheels, dt = _Wheels.on(profile, points, periodic), profile.step / speed
    states = _states(model, wheels, dt, periodic)
    responses = states @ model.c.T + wheels.elevation() @ model.d.T + wheels.rise() / dt @ model.e.T
    columns = column_headers(closed.output_labels, {name: signal_unit(name) for name in closed.output_labels})
    table, steps = pd.DataFrame(responses, columns=columns), np.arange(len(states))
    table.insert(0, "time [s]", dt * steps)
    if not isinstance(profile, Rig):
        table.insert(1, "distance [m]", wheels.start + speed * dt * steps)
    return table


class _Model(NamedTuple):
    """x' = a x + b u, y = c x + d u + e u' under roads u; their rates u' drive no states."""

    a: Real
    b: Real
    c: Real
    d: Real
    e: Real
    roads: list[str]

    @classmethod
    def of(cls, closed: StateSpace) -> "_Model":
        """Eliminate road rates G u' from the states: w = x - G u obeys w' = A w + (B + A G) u."""
        if not (isinstance(closed, StateSpace) and closed.isctime(strict=True)):
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
    """The road under r wheels at k times."""

    points: Real  # (k, r, 4), heights of the last two points that a wheel has reached and of the next two
    share: Real  # (r,), share of a step by which the wheel is beyond the last
    start: float  # first place of the origin [m]

    @classmethod
    def on(cls, profile: Profile, contacts: Real, periodic: bool) -> "_Wheels":
        """Place the wheels on a profile; ValueError if it is too short or lacks a track."""
        x, step, n = contacts[:, 0], profile.step, profile.distance.size
        if (base := float(np.ptp(x))) > step * (n - 2):
            got = f"{step * (n - 1):g} m"
            raise ValueError(f"profile must be longer by a step than the wheelbase of {base:g} m, got {got}")
        ahead = np.round((x if periodic else x - x.min()) / step, 9)  # a whole number of steps but for rounding
        first = np.floor(ahead).astype(int)
        times = np.arange(n if periodic else n - int(np.ceil(ahead.max())))
        index = times[:, None, None] + first[:, None] + np.arange(-1, 3)
        index = index % n if periodic else np.clip(index, 0, n - 1)
        tracks = [_track(profile, y) for y in contacts[:, 1].tolist()]
        heights = profile.height[index, np.array(tracks)[:, None]]
        return cls(heights, ahead - first, float(profile.distance[0] - (0.0 if periodic else x.min())))

    @classmethod
    def during(cls, event: Event, contacts: Real, speed: float, poles: Complex) -> tuple["_Wheels", float]:
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


def _states(model: _Model, wheels: _Wheels, dt: float, periodic: bool) -> Real:
    """States (k, n) of the model at the times of the wheels, `dt` [s] apart."""
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
        at_first = np.linalg.solve(model.a, -model.b @ wheels.elevation()[0])
    return control.forced_response(sampled, inputs=drive, initial_state=at_first).outputs.T[:-1]


def _taps(model: _Model, wheel: int, dt: float, share: float) -> Real:
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


def _checked_points(contact_points: ArrayLike, roads: list[str]) -> Real:
    points = np.asarray(contact_points, dtype=float)
    if points.shape != (len(roads), 2) or not np.isfinite(points).all():
        each = ", ".join(roads)
        raise ValueError(f"contact_points must be finite, x and y [m] for each of {each}, got {points.tolist()}")
    return points


def _coarsest(closed: StateSpace, speed: float) -> float:
    """Return the longest step [m] with four points in a wave of the fastest mode."""
    poles = closed.poles()
    fastest = float(np.abs(poles[poles.imag != 0]).max(initial=0.0)) / (2 * np.pi)
    return speed / (_POINTS * fastest) if fastest else np.inf


def _refined(profile: Profile, step: float, periodic: bool) -> Profile:
    """Return the profile in equal parts of its steps up to a step [m], straight between its points."""
    parts = int(np.ceil(profile.step / step * (1 - 1e-9)))
    if parts <= 1:
        return profile
    points = len(profile.distance)
    height = np.vstack([profile.height, profile.height[:1]]) if periodic else profile.height
    fine = np.arange((points if periodic else points - 1) * parts + (not periodic)) / parts
    tracks = [np.interp(fine, np.arange(len(height)), track) for track in height.T]
    return Profile(profile.distance[0] + profile.step * fine, np.transpose(tracks), profile.tracks)


def _track(profile: Profile, y: float) -> int:
    apart = np.abs(np.array(profile.tracks) - y)
    if apart.min() > _SAME_TRACK:
        needed = f"a track at y = {y:g} m, as by road.profile(..., tracks=({y:g}, ...))"
        raise ValueError(f"profile must have {needed}, got tracks at {list(profile.tracks)} m")
    return int(apart.argmin())

"""A vehicle driven over a profile or an event: its responses in time."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from control import StateSpace
from numpy.typing import ArrayLike

from .. import checks
from ..quantities import Real, column_headers, signal_unit
from ..roads.events import Event
from ..roads.profiles import Profile
from ..roads.rigs import Rig
from ..vehicles.assembly import ResponseName, label
from ..vehicles.unit_slips import warn_of_slip
from ..vehicles.vehicle import Setting, Vehicle
from .lift_off import tell_lift_off
from .motion.courses import Passage
from .motion.drivable import Motion, integrated, motion_of
from .motion.equations import roads_of
from .motion.hold import Model, Wheels, states_of
from .motion.integration import responses_in_time

if TYPE_CHECKING:
    import pandas as pd

_POINTS = 4  # of the profile in a wave of the fastest mode, at least: it meets that by 0.81, sinc^2 of 1/4
_HIGHEST = 1e4  # m, of a level road
_ONE = ((0.0, 0.0),)  # contact point of one wheel

Speed = float | Sequence[Sequence[float]] | Real
"""A speed [m/s], or rows of time [s] and speed."""


@overload
def simulate(
    closed: Vehicle,
    setting: Setting,
    profile: Profile | Event,
    speed: Speed = ...,
    *,
    periodic: bool = ...,
    responses: Sequence[ResponseName] | None = ...,
    start: float | None = ...,
    lift_off: bool = ...,
) -> "pd.DataFrame": ...


@overload
def simulate(
    closed: StateSpace,
    profile: Profile | Event,
    speed: Speed = ...,
    contact_points: ArrayLike = ...,
    *,
    periodic: bool = ...,
    start: float | None = ...,
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
        The road, as wide as the vehicle, linear across between its tracks. With less than four points in a wave
        of the model's fastest mode at this speed it is refined by straight interpolation. Or an event such as
        `SpeedBump`, from the moment when the foremost wheel meets it until the vehicle has settled; of steady
        waves one period.
    speed : float or (s, 2) array_like
        Vehicle speed V [m/s]; not of a test rig. Or rows of time [s], from 0 on, and speed, straight between them
        and constant after the last: ``[(0, 5), (6, 15)]``.
    contact_points : (r, 2) array_like
        Of a model the points where the roads touch, x forward and y to the left [m]; by default one wheel on the
        track at y = 0. A vehicle knows its own.
    periodic : bool
        The start. If false, the rearmost wheel stands on the first point, the vehicle settled on the heights
        under its wheels as after a level road, and sets off at full speed; the foremost ends on the last point.
        Drop the first seconds, or begin with a level stretch. If true, the profile goes on from its last point
        over one step to its first, as those of `Road.profile` do without a seam, and the result is one period of
        the steady state, without any transient.

    responses : sequence of str, optional
        Of a vehicle the responses, as for ``vehicle.closed``.
    start : float, optional
        Height of a level road on which the vehicle has settled before it stands on the profile [m], in place of
        the first heights.
    lift_off : bool
        Of a vehicle whether tyres may leave the road: then no tyre holds more tension than its static load.

    Returns
    -------
    DataFrame
        A row for each step of the profile: ``time [s]``, ``distance [m]`` of the origin along the road (of an
        obstacle from its beginning, on a test rig none), and every response with its unit,
        ``body_acceleration [m/s^2]``. On a kink of the road the load of a damped
        tyre jumps and is given as the mean of both sides.

        A vehicle with force laws, with tyres that may lift off, or at changing speed is integrated by power
        series in time, steps ending where a law has a knot; a step errs by 3e-8 of the largest state.
        Friction rises straight up to 1 mm/s, a damper by a power of the rate too. With force laws travel and loads
        count from the static position without payload, and a jerk is a difference quotient.

        ``attrs["lift_off"]`` has the share of time and the first place of each tyre that lifts off, or would.

    Warns
    -----
    LiftOffWarning
        If a tyre that may not lift off pulls on the road for more than 1 % of the time.
    UnitSlipWarning
        If a number of a vehicle seems to be in another unit.

    Raises
    ------
    ValueError
        If there are not as many contact points as roads, or the profile does not reach across to one or is too
        short for the wheelbase.

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

    With twice the damping in rebound the same damper lets it swing out less:

    >>> strut = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=1000.0, rebound=2000.0))
    >>> car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    >>> travel = 1e3 * sc.simulate(car, {"spring": 22e3}, sc.Step(height=0.05), 10.0)["suspension_travel [m]"]
    >>> print(f"compression {-travel.min():.0f} mm, rebound {travel.max():.0f} mm")
    compression 66 mm, rebound 14 mm
    """
    checks.of_kind("vehicle", closed, Vehicle, StateSpace)
    drive: Callable[..., pd.DataFrame] = _drive_vehicle if isinstance(closed, Vehicle) else _drive
    return drive(closed, *arguments, **options)


def _drive_vehicle(
    vehicle: Vehicle,
    setting: Setting,
    profile: Profile | Event,
    speed: Speed = 0.0,
    *,
    periodic: bool = False,
    responses: Sequence[ResponseName] | None = None,
    start: float | None = None,
    lift_off: bool = False,
) -> "pd.DataFrame":
    checks.listed("responses", vehicle.responses if responses is None else responses)
    vehicle, setting = vehicle.at(setting)
    names = list(vehicle.responses if responses is None else responses)
    warn_of_slip(vehicle, setting, caller=4)
    if integrated(vehicle, lift_off):
        plain = vehicle.without_jerk(names)
        motion = motion_of(vehicle, setting, plain, lift_off)
        jerks = [name != one for name, one in zip(names, plain, strict=True)]
        labels = [label(name) for name in names]
        table = _integrated(motion, labels, profile, speed, vehicle.contact_points, periodic, start, jerks)
    else:
        closed = vehicle.closed(setting, responses=names)
        table = _drive(closed, profile, speed, vehicle.contact_points, periodic=periodic, start=start)
    tell_lift_off(vehicle, setting, table, lift_off)
    return table


def _drive(
    closed: StateSpace,
    profile: Profile | Event,
    speed: Speed = 0.0,
    contact_points: ArrayLike = _ONE,
    *,
    periodic: bool = False,
    start: float | None = None,
) -> "pd.DataFrame":
    names, points = closed.output_labels, _checked_points(contact_points, roads_of(closed))
    if np.ndim(speed):
        return _integrated(Motion.of_model(closed), names, profile, speed, points, periodic, start)
    _check(profile, periodic, start)
    model, v = Model.of(closed), _number(speed, profile)
    if isinstance(profile, Event):
        periodic = profile.steady
        wheels, dt = Wheels.during(profile, points, v, closed.poles())
    else:
        profile = _refined(profile, _coarsest(closed, v), periodic)
        wheels, dt = Wheels.on(profile, points, periodic), profile.step / v
    states = states_of(model, wheels, dt, periodic, start)
    found = states @ model.c.T + wheels.elevation() @ model.d.T + wheels.rise() / dt @ model.e.T
    time = dt * np.arange(len(states), dtype=float)
    return _table(profile, names, time, wheels.start + v * time, found)


def _integrated(
    motion: Motion,
    names: Sequence[str],
    profile: Profile | Event,
    speed: Speed,
    contacts: Real,
    periodic: bool,
    start: float | None,
    jerks: Sequence[bool] = (),
) -> "pd.DataFrame":
    """Return the table of a vehicle that has no exact response."""
    _check(profile, periodic, start)
    rows = np.array([[0.0, _number(speed, profile)]]) if not np.ndim(speed) else _rows_of(speed)
    if len(rows) > 1 and (periodic or isinstance(profile, Rig) or (isinstance(profile, Event) and profile.steady)):
        raise ValueError(f"speed must be a number for a steady state or a rig, got {checks.shown(speed)}")
    if isinstance(profile, Event):
        passage = Passage.over_event(profile, contacts, rows)
    else:
        passage = Passage.over_profile(profile, contacts, rows, periodic)
    found = responses_in_time(motion, passage.course, passage.time, start, passage.periodic)
    for column in np.flatnonzero(jerks).tolist():
        found[:, column] = np.gradient(found[:, column], passage.time)
    return _table(profile, names, passage.time, passage.distance, found)


def _table(
    profile: Profile | Event, names: Sequence[str], time: Real, distance: Real, responses: Real
) -> "pd.DataFrame":
    """Return responses (k, m) with headers, behind time and distance (k,)."""
    import pandas as pd

    table = pd.DataFrame(responses, columns=column_headers(names, {name: signal_unit(name) for name in names}))
    table.insert(0, "time [s]", time)
    if not isinstance(profile, Rig):
        table.insert(1, "distance [m]", distance)
    return table


def _check(profile: Profile | Event, periodic: bool, start: float | None) -> None:
    """Raise ValueError about a profile or a start of the wrong kind."""
    if not isinstance(profile, Profile | Event):
        raise ValueError(f"profile must be a Profile or an event, got {checks.shown(profile)}")
    if start is not None and (periodic or isinstance(profile, Event)):
        raise ValueError(f"start must be None for a steady state and over an event, got {checks.shown(start)}")
    if start is not None:
        checks.within("start", start, -_HIGHEST, _HIGHEST)


def _number(speed: Any, profile: Profile | Event) -> float:
    """Return a speed [m/s]; ValueError unless it is above zero, on a test rig it does not matter."""
    if isinstance(profile, Rig):
        return 1.0
    checks.positive("speed", speed, "m/s")
    return float(speed)


def _rows_of(speed: Any) -> Real:
    """Return rows (s, 2) of time and speed; ValueError unless they begin at 0, ascend and are not negative."""
    rows = checks.reals("speed must be", speed)
    if rows.ndim != 2 or rows.shape[1] != 2 or not np.isfinite(rows).all() or rows[0, 0] != 0:
        needed = "a number, or rows of time [s] from 0 on and speed [m/s]"
        raise ValueError(f"speed must be {needed}, got {checks.shown(speed)}")
    if (np.diff(rows[:, 0]) <= 0).any() or (rows[:, 1] < 0).any() or rows[-1, 1] == 0:
        got = checks.shown(rows.tolist())
        raise ValueError(f"speed must be at ascending times, 0 m/s or more and at last more, got {got}")
    return rows


def _checked_points(contact_points: ArrayLike, roads: list[str]) -> Real:
    points = np.asarray(contact_points, dtype=float)
    if points.shape != (len(roads), 2) or not np.isfinite(points).all():
        needed = f"finite, x and y [m] for each of {checks.listing(roads)}"
        raise ValueError(f"contact_points must be {needed}, got {points.tolist()}")
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

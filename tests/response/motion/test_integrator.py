"""The integrator beside scipy's, for smooth laws, laws with kinks, networks, friction and tyres that lift off."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import suspension_ctrl as sc
from suspension_ctrl.response.lift_off import LiftOffWarning

M_B, M_W, K_T, K, SPEED = 250.0, 20.0, 140e3, 20e3, 10.0
STANDS = (M_B + M_W) * 9.80665  # N
BUMP = sc.SpeedBump(height=0.05, length=2.0)
MOUNT = 250e3  # N/m
CREEP = 1e-3  # m/s, up to which friction rises


@dataclass
class Case:
    """A strut beside a spring, its force by deflection, rate and inner states, and the rates of these."""

    strut: sc.Spring
    force: Callable[..., float]
    inner: Callable[..., list[float]] = field(default=lambda _d, _v, _s: [])
    states: int = 0
    lift_off: bool = False


def table(v: float) -> float:
    rates, forces = [0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 3.0], [0.0, 600.0, 850.0, 1250.0, 1450.0, 1750.0, 1750.0]
    return np.sign(v) * np.interp(abs(v), rates, forces)


def inverse_of_table(force: float) -> float:
    """Rate of the table with a slope of 300 N s/m at its end in place of 0."""
    rates, forces = [0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 9.0], [0.0, 600.0, 850.0, 1250.0, 1450.0, 1750.0, 4150.0]
    return np.sign(force) * np.interp(abs(force), forces, rates)


TABLE = {
    "velocity": [0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 3.0],
    "force": [0.0, 600.0, 850.0, 1250.0, 1450.0, 1750.0, 1750.0],
}
STEEP = TABLE | {"force": [*TABLE["force"][:-1], 2350.0]}
FORCE = 80.0  # N, of friction

CASES = {
    "quadratic": Case(
        sc.PowerDamper(force=1500.0, exponent=2.0),
        lambda _d, v, _s: 1500.0 * v * max(abs(v), CREEP),
    ),
    "root": Case(
        sc.PowerDamper(force=800.0, exponent=0.5),
        lambda _d, v, _s: 800.0 * v / np.sqrt(max(abs(v), CREEP)),
    ),
    "bilinear": Case(
        sc.BilinearDamper(bump=600.0, rebound=1200.0), lambda _d, v, _s: 1200.0 * v if v > 0 else 600.0 * v
    ),
    "table": Case(sc.TableDamper(**TABLE), lambda _d, v, _s: table(v)),
    "stops": Case(
        sc.parallel(
            sc.Damper(value=900.0),
            sc.BumpStop(gap=0.02, stiffness=200e3),
            sc.ReboundStop(gap=0.015, compression=[0.0, 0.01, 0.02], force=[0.0, 500.0, 2500.0]),
        ),
        lambda d, v, _s: 900.0 * v + 200e3 * min(d + 0.02, 0.0) + stop(max(d - 0.015, 0.0)),
    ),
    "friction": Case(
        sc.parallel(sc.Damper(value=900.0), sc.Friction(force=FORCE)),
        lambda _d, v, _s: 900.0 * v + FORCE * np.clip(v / CREEP, -1, 1),
    ),
    "table on a mount": Case(
        sc.series(sc.TableDamper(**STEEP), sc.Spring("mount", MOUNT)),
        lambda d, _v, s: MOUNT * (d - s[0]),
        lambda d, _v, s: [inverse_of_table(MOUNT * (d - s[0]))],
        states=1,
    ),
    "mount before a table, with a ratio": Case(
        sc.series(sc.Spring("mount", MOUNT), sc.TableDamper(**STEEP), installation_ratio=0.8),
        lambda d, _v, s: 0.8 * MOUNT * s[0],
        lambda _d, v, s: [0.8 * v - inverse_of_table(MOUNT * s[0])],
        states=1,
    ),
    "inerter before a table": Case(
        sc.series(sc.Inerter(value=30.0), sc.TableDamper(**TABLE)),
        lambda _d, v, s: table(v - s[0]),
        lambda _d, v, s: [table(v - s[0]) / 30.0],
        states=1,
    ),
    "table that lifts off": Case(
        sc.parallel(sc.TableDamper(**TABLE), sc.Friction(force=FORCE)),
        lambda _d, v, _s: table(v) + FORCE * np.clip(v / CREEP, -1, 1),
        lift_off=True,
    ),
}  # fmt: skip


def stop(depth: float) -> float:
    return np.interp(depth, [0.0, 0.01, 0.02, 0.05], [0.0, 500.0, 2500.0, 8500.0])


def by_scipy(case: Case, height: float, end: float, time: np.ndarray) -> np.ndarray:
    """Body acceleration, travel and tyre load (n, 3)."""

    def road(t: float) -> float:
        return height / 2 * (1 - np.cos(np.pi * SPEED * t)) if 0 < t < 0.2 else 0.0

    def parts(t: float, z: np.ndarray) -> tuple[float, float]:
        d, v = z[2] - z[0], z[3] - z[1]
        load = K_T * (z[0] - road(t))
        return K * d + case.force(d, v, z[4:]), min(load, STANDS) if case.lift_off else load

    def motion(t: float, z: np.ndarray) -> list[float]:
        strut, load = parts(t, z)
        return [z[1], (strut - load) / M_W, z[3], -strut / M_B, *case.inner(z[2] - z[0], z[3] - z[1], z[4:])]

    found = solve_ivp(
        motion, (0, end), np.zeros(4 + case.states), rtol=1e-10, atol=1e-12, t_eval=time, max_step=2e-3
    )
    forces = np.array([parts(t, z) for t, z in zip(time, found.y.T, strict=True)])
    return np.column_stack([-forces[:, 0] / M_B, found.y[2] - found.y[0], forces[:, 1]])


@pytest.mark.parametrize("name", CASES)
def test_responses_are_those_of_scipy_to_1e_6(name):
    """Of the largest value; scipy has no knots, so that its steps are short there."""
    case, end = CASES[name], 0.6
    height = 0.2 if case.lift_off else 0.05
    car = sc.QuarterCar(
        body_mass=M_B, wheel_mass=M_W, tyre_stiffness=K_T, strut=sc.parallel(sc.Spring(value=K), case.strut)
    )
    bump = sc.SpeedBump(height=height, length=2.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LiftOffWarning)
        history = sc.simulate(car, {}, bump, SPEED, lift_off=case.lift_off)
    history = history[history["time [s]"] < end]
    found, expected = history.iloc[:, 2:].to_numpy(), by_scipy(case, height, end, history["time [s]"].to_numpy())
    error = np.abs(found - expected).max(axis=0) / np.abs(expected).max(axis=0)
    assert error.max() < 1e-6
    if case.lift_off:
        assert (history["tyre_load [N]"] >= STANDS * (1 - 1e-12)).mean() > 0.1
        assert history["tyre_load [N]"].max() == pytest.approx(STANDS, rel=1e-12)

"""Struts that stand on the road: by closed forms, beside a stiffer tyre, and by Runge and Kutta."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import suspension_ctrl as sc
from garage import from_roads
from suspension_ctrl.quantities import Record
from suspension_ctrl.response.peaks import peaks
from suspension_ctrl.vehicles.assembly import Assembly, Link, Response
from suspension_ctrl.vehicles.dampers import BilinearDamper
from suspension_ctrl.vehicles.elements import Damper, Inerter, Spring
from suspension_ctrl.vehicles.networks import placed
from suspension_ctrl.vehicles.struts import Strut, parallel
from suspension_ctrl.vehicles.vehicle import AssembledVehicle

STRUT = parallel(Spring(), Damper())


@dataclass(frozen=True, eq=False, repr=False)
class Cart(Record, AssembledVehicle):
    """A mass on a strut that stands on the road, or beside it a quarter car with a strut beside its tyre."""

    strut: Strut = STRUT
    tyre: float = 0.0

    @cached_property
    def assembly(self) -> Assembly:
        own = placed(self.strut, "", [1.0])
        cart = Assembly(
            masses={"body": 300.0},
            contacts={"": (0.0, 0.0)},
            tyres=(),
            struts=(Link("", "road", (0.0, 0.0)),),
            strut_coefficients=own[0],
            networks=own[1],
            responses={
                "body_acceleration": Response("acceleration", "body"),
                "suspension_travel": Response("travel", ""),
                "tyre_load": Response("load", ""),
            },
        )
        if not self.tyre:
            return cart
        over, beside = placed(self.strut, "", [1.0, 0.0]), placed(STRUT, "beside", [0.0, 1.0])
        return replace(
            cart,
            masses={"wheel": 40.0, "body": 300.0},
            tyres=(Link("", "road", "wheel", self.tyre, 100.0),),
            struts=(Link("", "wheel", (0.0, 0.0)), Link("beside", "road", "wheel")),
            strut_coefficients=[*over[0], *beside[0]],
            networks=over[1],
        )


def test_a_mass_on_a_strut_on_the_road():
    """H = (k + s c)/(m s^2 + k + s c) of the mass, H - 1 of travel; the load is the force of the mass."""
    cart, f = Cart(), np.geomspace(0.1, 40, 9)
    s, k = 2j * np.pi * f, 2e4 + 1500 * 2j * np.pi * f
    h = k / (300 * s**2 + k)
    names = [*cart.responses, "suspension_travel_rate", "strut_force"]
    found = from_roads(cart, {"spring": 2e4, "damper": 1500.0}, names, f)[:, :, 0]
    force = 300 * s**2 * h
    expected = [s**2 * h, h - 1, -force, s * (h - 1), -force]
    np.testing.assert_allclose(found.T, expected, rtol=1e-12)
    assert cart.statics.static_loads(np.array([[2e4, 1500.0]])) == pytest.approx(300 * 9.80665, rel=1e-12)
    ride = sc.ride(cart, (2e4, 1500.0), sc.Iso8608Road("C"), 20.0, band=(0.1, 20.0))["value"]
    f = np.linspace(0.1, 20.0, 20001)
    load = from_roads(cart, {"spring": 2e4, "damper": 1500.0}, ["tyre_load"], f)[:, 0, 0]
    psd = abs(load) ** 2 * sc.Iso8608Road("C").psd(f, 20.0)
    assert ride["DTL"] == pytest.approx(np.sqrt(np.trapezoid(psd, f)), rel=1e-6)


@pytest.mark.parametrize("strut", [STRUT, parallel(Spring(), BilinearDamper(bump=1000.0, rebound=2000.0))])
def test_a_strut_beside_a_tyre_stiffens_it(strut):
    """A tyre of 150 kN/m beside a strut of 50 kN/m is one of 200 kN/m: spectra, static loads, motion, peaks."""
    bump, needed = (
        sc.SpeedBump(height=0.05, length=2.0),
        {"spring": 2e4} | ({"damper": 1500.0} if strut is STRUT else {}),
    )
    both = needed | {"beside": (5e4, 50.0)}
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, tyre_damping=150.0, strut=strut
    )  # fmt: skip
    parted = Cart(strut, 1.5e5)
    road = sc.Iso8608Road("C")
    one, other = (
        sc.ride(car, needed, road, 20.0, band=(0.1, 20.0)),
        sc.ride(parted, both, road, 20.0, band=(0.1, 20.0)),
    )
    np.testing.assert_allclose(other["value"][one.index], one["value"], rtol=1e-8)
    one, other = sc.simulate(car, needed, bump, 10.0), sc.simulate(parted, both, bump, 10.0)
    assert ((other - one).abs().max() <= 1e-6 * one.abs().max()).all()
    history = one.iloc[:, 2:].to_numpy()
    values = np.array([list(parted.coefficients(both).values())])
    high, low = peaks(parted, values, bump, 10.0, parted.responses)
    np.testing.assert_allclose([high[0], low[0]], [history.max(axis=0), history.min(axis=0)], rtol=2e-3)
    assert parted.statics.static_loads(values) == pytest.approx(340 * 9.80665, rel=1e-12)


def test_tyres_with_a_strut_beside_them_lift_off():
    bump = sc.SpeedBump(height=0.1, length=1.0)
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=40.0, tyre_stiffness=2e5, tyre_damping=150.0)
    one = sc.simulate(car, (2e4, 1500.0), bump, 10.0, lift_off=True)
    other = sc.simulate(
        Cart(tyre=1.5e5), {"spring": 2e4, "damper": 1500.0, "beside": (5e4, 50.0)}, bump, 10.0, lift_off=True
    )
    assert one.attrs["lift_off"][""].share > 0
    assert ((other - one).abs().max() <= 1e-5 * one.abs().max()).all()


def test_a_force_law_on_the_road_beside_runge_and_kutta():
    """A raised cosine of 50 mm over 2 m at 10 m/s."""
    cart = Cart(parallel(Spring(), BilinearDamper(bump=1000.0, rebound=2000.0)))
    history = sc.simulate(cart, {"spring": 2e4}, sc.SpeedBump(height=0.05, length=2.0), 10.0)

    def derivative(t, y):
        on = 10 * t < 2
        height, rate = 0.025 * (1 - np.cos(10 * np.pi * t)) * on, 0.25 * np.pi * np.sin(10 * np.pi * t) * on
        v = y[1] - rate
        return y[1], -(2e4 * (y[0] - height) + (2000.0 if v > 0 else 1000.0) * v) / 300.0

    time = history["time [s]"].to_numpy()
    kept = (time > 0.2) & (time < 1.0)
    first = solve_ivp(derivative, (0, 0.2), [0.0, 0.0], rtol=1e-9, atol=1e-12, max_step=2e-3)
    rest = solve_ivp(
        derivative, (0.2, 1.0), first.y[:, -1], t_eval=time[kept], rtol=1e-9, atol=1e-12, max_step=2e-3
    )
    np.testing.assert_allclose(history["suspension_travel [m]"][kept], rest.y[0], atol=1e-7)


def test_rejects_what_a_road_cannot_carry():
    law = Cart(parallel(Spring(), BilinearDamper(bump=1000.0, rebound=2000.0)))
    with pytest.raises(
        ValueError, match=r"^lift_off must be of a vehicle with springs and dampers alone on its roads"
    ):
        sc.simulate(law, {"spring": 2e4}, sc.SpeedBump(height=0.1, length=1.0), 10.0, lift_off=True)
    with pytest.raises(ValueError, match=r"^struts that stand on a road must be without inerter, got one$"):
        Cart(parallel(Spring(), Damper(), Inerter())).closed({"spring": 2e4, "damper": 1500.0, "inerter": 5.0})

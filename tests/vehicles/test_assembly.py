"""A vehicle put together by hand of masses and links, against matrices written out."""

import re
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import suspension_ctrl as sc
from garage import BENDING, FULL, HALF, from_roads
from suspension_ctrl.quantities import Record
from suspension_ctrl.response.peaks import peaks
from suspension_ctrl.vehicles.assembly import Assembly, Link, Response, joined, label
from suspension_ctrl.vehicles.dampers import BilinearDamper
from suspension_ctrl.vehicles.networks import placed
from suspension_ctrl.vehicles.struts import Damper, Inerter, Spring, Strut, parallel
from suspension_ctrl.vehicles.vehicle import AssembledVehicle, anti_roll_bar

STRUT = parallel(Spring(), Damper())


@dataclass(frozen=True, eq=False, repr=False)
class Cab(Record, AssembledVehicle):
    """A cab on a frame on a wheel: two struts over a damped tyre, a support to ground."""

    cab: float = 300.0

    @cached_property
    def assembly(self) -> Assembly:
        return Assembly(
            masses={"wheel": 50.0, "frame": 800.0, "body": self.cab},
            contacts={"axle": (0.0, 0.0)},
            tyres=[Link("axle", "axle_road", "wheel", 3e5, 200.0)],
            struts=[Link("axle", "wheel", "frame"), Link("cab", "frame", (0.0, 0.0))],
            supports=[Link("lead", None, "body", 500.0, 40.0)],
            strut_coefficients=[*placed(STRUT, "axle", [1.0, 0.0])[0], *placed(STRUT, "cab", [0.0, 1.0])[0]],
            responses={
                "frame_acceleration": Response("acceleration", "frame"),
                "cab_travel": Response("travel", "cab"),
                "axle_tyre_load": Response("load", "axle"),
            },
        )


def test_a_chain_of_masses_by_matrices_written_out():
    """(M s^2 + C s + K) z = tyre forces; a solution of 3 equations, to some hundred units of rounding."""
    f = np.geomspace(0.1, 40, 9)
    found = from_roads(Cab(), {"axle": (4e4, 3e3), "cab": (1e4, 800.0)}, Cab().responses, f)[:, :, 0]
    for s, h in zip(2j * np.pi * f, found, strict=True):
        tyre, axle, cab, lead = 3e5 + 200 * s, 4e4 + 3e3 * s, 1e4 + 800 * s, 500 + 40 * s
        impedance = np.diag([50 * s**2 + tyre + axle, 800 * s**2 + axle + cab, 300 * s**2 + cab + lead])
        impedance[[0, 1, 1, 2], [1, 0, 2, 1]] = -axle, -axle, -cab, -cab
        z = np.linalg.solve(impedance, [tyre, 0, 0])
        np.testing.assert_allclose(h, [s**2 * z[1], z[2] - z[1], tyre * (z[0] - 1)], rtol=1e-10)


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


def test_signals_bear_the_names_of_the_links():
    plant = Cab().plant(["cab_travel"])
    assert plant.input_labels == ["axle_road", "axle_road_rate", "axle_strut", "cab_strut"]
    assert plant.output_labels == [
        "cab_travel",
        *("axle_deflection", "cab_deflection", "axle_deflection_rate", "cab_deflection_rate"),
    ]
    assert plant.state_labels[:2] == ["wheel_displacement", "wheel_velocity"]
    assert label(("acceleration", 1.2, -0.4)) == "acceleration_at_1200_-400_mm"
    assert joined("", "road") == "road"


def test_weights_and_masses_count_what_is_carried():
    assembly = Cab(cab=250.0).assembly
    np.testing.assert_array_equal(assembly.mass_matrix, np.diag([50.0, 800.0, 250.0]))
    np.testing.assert_array_equal(assembly.weights, [50.0, 800.0, 250.0])
    assert assembly.sprung_mass == 1050.0


def test_deflections_are_those_of_a_rigid_body():
    """A strut over a corner of the full car: heave - x pitch + y roll - wheel, the road not at all."""
    e, road = FULL.assembly.elongations(FULL.assembly.struts)
    coordinates = FULL.assembly.coordinates
    for i, (corner, (x, y)) in enumerate(FULL.contacts.items()):
        row = dict(zip(coordinates, e[i], strict=True))
        assert (row["body"], row["pitch"], row["roll"], row[f"{corner}_wheel"]) == (1, -x, y, -1)
    assert not road.any()


def test_a_bar_resists_the_difference_of_travels():
    assert anti_roll_bar("bar", [1.0, -1.0], 2.0).gain.tolist() == [[0.25, -0.25], [-0.25, 0.25]]


BASE = {
    "masses": {"wheel": 40.0, "body": 300.0}, "contacts": {"": (0.0, 0.0)}, "responses": {},
    "tyres": [Link("", "road", "wheel", 2e5)], "struts": [Link("", "wheel", "body")], "strut_coefficients": [],
}  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"contacts": {"front": (0.0, 0.0)}},
         "tyres must be front, each from its road, got (Link(name='', lower='road', upper='wheel', "
         "stiffness=200000.0, damping=0.0),)"),
        ({"contacts": {"a": (0.0, 0.0)}, "tyres": [Link("a", "ground", "wheel")]},
         "tyres must be a, each from its road, got (Link(name='a', lower='ground', upper='wheel', stiffness=0.0, "
         "damping=0.0),)"),
        ({"tyres": []}, "tyres must be those of contacts, each from its road, got ()"),
        ({"struts": [Link("speed", "wheel", "body")]},
         "struts must not be called responses, road, speed, got 'speed'"),
        ({"bending": {(0.0, 0.0): {"bending_1": 0.1}}, "payload": [(10.0, (1.0, 0.0))]},
         "position must be one with known mode shapes, [(0.0, 0.0)], got (1.0, 0.0)"),
        ({"bending": {(0.0, 0.0): {"bending_1": 0.1}}, "struts": [Link("", "wheel", (0.5, 0.0))]},
         "position must be one with known mode shapes, [(0.0, 0.0)], got (0.5, 0.0)"),
    ],
)  # fmt: skip
def test_rejects_assemblies_that_do_not_fit(changes, message):
    assert Assembly(**BASE).coordinates == ("wheel", "body")
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        Assembly(**BASE | changes)


@pytest.mark.parametrize(
    ("responses", "message"),
    [
        (["roll_acceleration"], "response must be one of body_acceleration, pitch_acceleration"),
        ([("velocity", 0.0, 0.0)], "response must be one of body_acceleration, pitch_acceleration"),
        (["body_acceleration"] * 2, "responses must differ, points by a millimetre or more, got "),
        ([("acceleration", 0.1, 0.0), ("acceleration", 0.1001, 0.0)], "responses must differ, points by a mill"),
    ],
)
def test_rejects_responses_that_it_does_not_have(responses, message):
    with pytest.raises(ValueError, match="^" + message):
        HALF.plant(responses)


def test_a_point_of_a_flexible_body_needs_mode_shapes():
    with pytest.raises(ValueError, match=r"^position must be one with known mode shapes, .*, got \(0\.7, 0\.0\)$"):
        BENDING.on(FULL).plant([("acceleration", 0.7, 0.0)])

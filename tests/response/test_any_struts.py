"""Cars of several struts of any kind: against straight struts, one port, and static equilibrium."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.any_struts import AnyStruts
from suspension_ctrl.response.many_struts import ManyStruts

FILE = sc.load_vehicle("jian_2022_full")
FULL = {n: getattr(FILE.vehicle, n) for n in FILE.vehicle.__dataclass_fields__ if "strut" not in n}
ROAD = sc.Iso8608Road("C")
BAND = (0.1, 20.0)
FRONT = sc.TableDamper(velocity=[-1.0, -0.1, 0.0, 0.1, 1.0], force=[-900.0, -400.0, 0.0, 900.0, 3600.0])
REAR = sc.DigressiveDamper(low_speed=5000.0, high_speed=1500.0, knee=0.08, rebound_over_bump=1.5)
STRAIGHT = sc.parallel(sc.Spring(), sc.BilinearDamper(bump=2000.0, rebound=2000.0))


def full_car(front, rear=None) -> sc.FullCar:
    return sc.FullCar(**FULL, front_strut=front, rear_strut=rear or front)


def problem_of(vehicle, **struts) -> sc.RideProblem:
    bounds = {"front.spring": (5e3, 2e4), "rear.spring": (5e3, 2e4)}
    return sc.RideProblem(vehicle, ROAD, speed=20.0, bounds=bounds, struts=struts, band=BAND, nodes=256)


def test_straight_laws_give_the_linear_results():
    linear = {name: value for name, value in FILE.setting.items() if "spring" not in name}
    designs = [[1e4, 1.3e4], [7e3, 9e3]]
    expected = problem_of(FILE.vehicle, **linear)
    found = problem_of(full_car(STRAIGHT), front_antiroll=FILE.setting["front_antiroll"])
    kinds = [type(one.kernel.cases[0]) for one in (expected, found)]
    assert kinds == [ManyStruts, AnyStruts]
    np.testing.assert_allclose(found.evaluate(designs), expected.evaluate(designs), rtol=1e-12)


def test_laws_of_both_sides_are_one_where_left_and_right_are_alike():
    car = full_car(sc.parallel(sc.Spring(), FRONT), sc.parallel(sc.Spring(), REAR))
    setting = {"front.spring": 1e4, "rear.spring": 1.3e4}
    linear = sc.linearised(car, setting, ROAD, 20.0, band=BAND)
    assert list(linear.laws) == ["front.damper", "rear.damper"]
    table = sc.ride(linear, {}, ROAD, 20.0, band=BAND)["value"]
    for axle in ("front", "rear"):
        for side in ("left", "right"):
            rate = table[f"{axle}_{side}_suspension_travel_rate"]
            assert linear.laws[f"{axle}.damper"].deviation == pytest.approx(rate, rel=1e-6)


def test_sides_that_differ_have_laws_of_their_own():
    car = full_car(sc.parallel(sc.Spring(), FRONT), sc.parallel(sc.Spring(), REAR))
    laden = sc.Payload(mass=250.0, position=(-0.4, 0.5)).on(car)
    setting = {"front.spring": 1e4, "rear.spring": 1.3e4}
    linear = sc.linearised(laden, setting, ROAD, 20.0, band=BAND)
    assert list(linear.laws) == [
        f"{axle}_{side}.damper" for axle in ("front", "rear") for side in ("left", "right")
    ]
    table = sc.ride(linear, {}, ROAD, 20.0, band=BAND)["value"]
    for name, law in linear.laws.items():
        port = name.removesuffix(".damper")
        assert law.deviation == pytest.approx(table[f"{port}_suspension_travel_rate"], rel=1e-6)
    assert linear.laws["front_left.damper"].deviation != linear.laws["front_right.damper"].deviation


@pytest.mark.parametrize("payload", [None, (200.0, (-0.4, 0.5))])
def test_mean_forces_and_payload_are_in_equilibrium(payload):
    """Tyres and struts at the mean position: the forces on every mass cancel its payload's weight."""
    stop = sc.BumpStop(gap=0.01, stiffness=8e4)
    car = full_car(sc.parallel(sc.Spring(), FRONT, stop), sc.parallel(sc.Spring(), REAR))
    vehicle = sc.Payload(mass=payload[0], position=payload[1]).on(car) if payload else car
    setting = {"front.spring": 1e4, "rear.spring": 1.3e4, "front_antiroll": 2e4}
    linear = sc.linearised(vehicle, setting, ROAD, 20.0, band=BAND)
    tension = {}
    for port in vehicle.struts:
        axle = port.split("_")[0]
        key = port if payload else axle
        travel, other = (
            linear.mean_travel[port],
            linear.mean_travel[port.replace("left", "r").replace("right", "left").replace("_r", "_right")],
        )
        tension[port] = setting[f"{axle}.spring"] * travel + linear.laws[f"{key}.damper"].force
        if axle == "front":
            tension[port] += linear.laws[f"{key}.bump_stop"].force + 2e4 / FULL["front_track"] ** 2 * (
                travel - other
            )
    forces = np.array(list(tension.values()))
    x, y = vehicle.contact_points.T
    mass, (px, py) = payload or (0.0, (0.0, 0.0))
    weight = mass * 9.80665
    scale = weight + abs(linear.laws["front_left.damper" if payload else "front.damper"].force)
    assert forces.sum() == pytest.approx(-weight, abs=1e-7 * scale)
    assert forces @ x == pytest.approx(-weight * px, abs=1e-7 * scale)
    assert forces @ y == pytest.approx(-weight * py, abs=1e-7 * scale)


@pytest.mark.filterwarnings("ignore::suspension_ctrl.vehicles.unit_slips.UnitSlipWarning")
def test_a_quarter_car_with_a_rigid_passenger_is_the_quarter_car():
    """Two ports, of which one hardly moves: AnyStruts beside OnePort."""
    quarter = sc.QuarterCar(
        body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(sc.Spring(), REAR)
    )
    with_seat = sc.Seat(mass=1e-3, spring=1e3, damper=10.0, name="bag").on(quarter)
    tables = [sc.ride(one, {"spring": 22e3}, ROAD, 20.0, band=BAND)["value"] for one in (quarter, with_seat)]
    np.testing.assert_allclose(tables[1][:3], tables[0][:3], rtol=1e-4)  # 1e-3 of 317.5 kg is 3e-6


def test_a_search_over_the_coefficients_of_laws_by_both_algorithms():
    car = full_car(sc.parallel(sc.Spring(), FRONT), sc.parallel(sc.Spring(), REAR))
    bounds = {
        "front.spring": (5e3, 2e4),
        "front.damper.scale": (0.5, 2.0),
        "rear.spring": (5e3, 2e4),
        "rear.damper.knee": (0.02, 0.2),
        "rear.damper.low_speed": (2e3, 8e3),
    }
    struts = {"rear.damper.high_speed": 1500.0}
    problem = sc.RideProblem(
        car, ROAD, speed=20.0, bounds=bounds, struts=struts, band=BAND, constraints=["SWS <= 0.012"]
    )
    for algorithm in (sc.Nsga2(population=20), sc.MoeadDra(population=20)):
        run = sc.minimise(problem, algorithm, iterations=3, seed=1)
        again = problem.evaluate(run.designs)[:, : len(problem.objectives)]
        np.testing.assert_allclose(run.objectives, again, rtol=1e-12)

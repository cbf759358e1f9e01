"""Struts as data: laws know their networks, and a network stands for both sides of a symmetric car."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.blocks import pairs_of
from suspension_ctrl.response.load_case import LoadCase
from suspension_ctrl.response.mean_squares import case_of
from suspension_ctrl.response.measures.terms import Term
from suspension_ctrl.response.network_rows import IN_SERIES, NETWORK, OF_RATE
from suspension_ctrl.response.strut_data import apart, networks_of

FILE = sc.load_vehicle("jian_2022_full")
FULL = {n: getattr(FILE.vehicle, n) for n in FILE.vehicle.__dataclass_fields__ if "strut" not in n}


SIDES = np.kron(np.eye(2), np.ones((2, 2))) > 0  # left and right are partners


def test_laws_and_networks():
    front = sc.parallel(sc.Spring(), sc.Friction(force=30.0), sc.BumpStop(gap=0.02, stiffness=1e5))
    rear = sc.parallel(
        sc.Spring(),
        sc.series(sc.PowerDamper(force=2e3, exponent=2.0, installation_ratio=0.9), sc.Spring("mount", 2e5)),
        installation_ratio=0.8,
    )
    car = sc.FullCar(**FULL, front_strut=front, rear_strut=rear)
    values = car.coefficients({"front.spring": 1e4, "rear.spring": 1e4})
    networks = networks_of(car, values, ["rear.spring"], np.array([1.0, 2.0]), SIDES)
    assert networks.law[:, OF_RATE].tolist() == [1, 0, 1]
    assert networks.law[:, IN_SERIES].tolist() == [0, 0, 1]
    assert networks.law[:, NETWORK].tolist() == [0, 0, 1]
    np.testing.assert_allclose(networks.square, [1.0, 1.0, (0.8 * 0.9) ** 2])
    assert networks.ports.tolist() == [[True, True, False, False], [False, False, True, True]]
    assert [one.share for one in apart(car.networks[1], np.eye(4) > 0)] == [(0, 0, 1, 0), (0, 0, 0, 1)]
    assert networks.variable.tolist() == [list(values).index("rear.spring")]


def test_variables_that_change_a_curve_a_damper_or_a_part_change_the_damping():
    law = sc.TableDamper(velocity=[-1.0, 0.0, 1.0], force=[-900.0, 0.0, 1500.0])
    mounted = sc.series(sc.Damper("low", 500.0), sc.Spring("mount", 2e5))
    power = sc.PowerDamper("power", force=100.0, exponent=2.0)
    strut = sc.parallel(sc.Spring(), sc.Damper("base", 200.0), sc.Inerter(value=5.0), law, mounted, power)
    car = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=strut)
    values = car.coefficients({"spring": 2e4})
    alone = {name: networks_of(car, values, [name], np.array([1.0]), np.eye(1) > 0) for name in values}
    assert {name for name, one in alone.items() if one.same_damping} == {"spring", "inerter"}
    both = networks_of(car, values, ["spring", "base"], np.array([1.0]), np.eye(1) > 0)
    assert not both.same_damping


def test_a_curve_of_several_axles_leaves_left_and_right_apart():
    """Of a semitrailer: two loops of six struts in place of one of twelve; agreement to rounding."""
    file = sc.load_vehicle("kraz_semitrailer")
    case = LoadCase(vehicle=file.vehicle, road=sc.Iso8608Road("C"), speed=20.0)
    terms = [Term(name) for name in ("body_acceleration", "drive_rear_left_tyre_load", "roll_acceleration")]
    setting = file.vehicle.coefficients(file.setting)

    def whole(struts, contacts):
        return np.eye(len(struts)), np.eye(len(contacts))

    halves, one = (
        case_of(case, terms, setting, list(setting), (0.5, 20.0), 24, pairs) for pairs in (pairs_of, whole)
    )
    assert halves.struts.sizes[:, 0].tolist() == [6, 6]
    assert one.struts.sizes[:, 0].tolist() == [12]
    designs = np.array([list(setting.values())]) * [[1.0], [1.3]]
    np.testing.assert_allclose(halves(designs), one(designs), rtol=1e-12)
    assert halves.networks.ports.sum(axis=1).tolist() == [2] * 6

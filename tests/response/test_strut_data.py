"""Struts as data: laws know their networks, and a network stands for both sides of a symmetric car."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.network_rows import IN_SERIES, NETWORK, OF_RATE
from suspension_ctrl.response.strut_data import apart, networks_of

FILE = sc.load_vehicle("jian_2022_full")
FULL = {n: getattr(FILE.vehicle, n) for n in FILE.vehicle.__dataclass_fields__ if "strut" not in n}


def test_laws_and_networks():
    front = sc.parallel(sc.Spring(), sc.Friction(force=30.0), sc.BumpStop(gap=0.02, stiffness=1e5))
    rear = sc.parallel(
        sc.Spring(),
        sc.series(sc.PowerDamper(force=2e3, exponent=2.0, installation_ratio=0.9), sc.Spring("mount", 2e5)),
        installation_ratio=0.8,
    )
    car = sc.FullCar(**FULL, front_strut=front, rear_strut=rear)
    values = car.coefficients({"front.spring": 1e4, "rear.spring": 1e4})
    networks = networks_of(car, values, ["rear.spring"], np.array([1.0, 2.0]), True)
    assert networks.law[:, OF_RATE].tolist() == [1, 0, 1]
    assert networks.law[:, IN_SERIES].tolist() == [0, 0, 1]
    assert networks.law[:, NETWORK].tolist() == [0, 0, 1]
    np.testing.assert_allclose(networks.square, [1.0, 1.0, (0.8 * 0.9) ** 2])
    assert networks.ports.tolist() == [[True, True, False, False], [False, False, True, True]]
    assert [one.share for one in apart(car.networks[1], False)] == [(0, 0, 1, 0), (0, 0, 0, 1)]
    assert networks.variable.tolist() == [list(values).index("rear.spring")]

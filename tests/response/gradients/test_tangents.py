"""Derivatives of the dynamic stiffness of a network beside complex steps, joined in one pass or in two."""

import numpy as np
import pytest

import suspension_ctrl as sc
from complex_step import STEP, Placed
from suspension_ctrl.response.gradients.joints import fill_rows_and_joints, joints_of
from suspension_ctrl.response.gradients.tangents import fill_tangents, tangents_of
from suspension_ctrl.response.network_rows import DIRECT, STATES, fill_direct, rows_of
from suspension_ctrl.response.one_port import add_beside
from suspension_ctrl.response.strut_data import networks_of

F = np.linspace(0.3, 20.0, 11)
OMEGA = 2 * np.pi * F
BUSH = sc.MeasuredStiffness("bush", frequency=[0.1, 5.0, 30.0], storage=[1e5, 2e5, 3e5], loss=[1e4, 3e4, 3e4])
STRUT = sc.series(
    sc.Damper("own", 1500.0, installation_ratio=0.9),
    sc.parallel(
        sc.Spring("mount", 2e5),
        sc.Inerter("mass", 50.0),
        sc.series(sc.Damper("inner", 400.0), sc.Rubber("last", storage=1e5, loss=1e4)),
        sc.series(sc.Inerter("small", 20.0), BUSH),
        installation_ratio=1.2,
    ),
    installation_ratio=0.8,
)
CAR = sc.QuarterCar(
    body_mass=317.5,
    wheel_mass=45.4,
    tyre_stiffness=192e3,
    strut=sc.parallel(sc.Spring(), sc.Damper("base", 300.0), STRUT, installation_ratio=1.1),
)
SETTING = CAR.coefficients({"spring": 22e3})
BESIDE = {"spring": 1.1**2 * np.array([OMEGA**0, 0 * OMEGA]), "base": 1.1**2 * np.array([0 * OMEGA, OMEGA])}
VALUES = np.array(list(SETTING.values()))


@pytest.mark.parametrize("names", [list(SETTING), ["own", "spring"], ["inner"], ["loss"]])
def test_stiffness_by_every_coefficient(names):
    names = [name for name in SETTING if any(name == one or one in name for one in names)]
    networks = networks_of(CAR, SETTING, names, F, np.eye(1, dtype=bool))
    direct, rows = np.empty((networks.row.size, DIRECT)), rows_of(networks, F.size)
    joints, tangents = joints_of(networks, F.size), tangents_of(networks, F.size)
    fill_direct(networks, VALUES, np.empty((0, STATES)), direct)
    add_beside(networks, VALUES, direct)
    fill_rows_and_joints(networks, OMEGA, VALUES, direct, rows, joints)
    fill_tangents(networks, OMEGA, joints, tangents)
    (network,) = CAR.networks
    for name, found in zip(names, tangents.rows, strict=True):
        values = {key: value * (1 + 1j * STEP * (key == name)) for key, value in SETTING.items()}
        whole = Placed(network.strut, 0, values).stiffness(network.strut, OMEGA)
        expected = BESIDE.get(name, np.array([whole.re.imag, whole.im.imag]) / (STEP * SETTING[name]))
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())

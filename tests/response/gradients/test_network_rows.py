"""The adjoint of a network beside complex steps through its dynamic stiffness."""

import numpy as np
import pytest

import suspension_ctrl as sc
from complex_step import STEP, Apart, Placed
from suspension_ctrl.response.gradients.joints import fill_rows_and_joints
from suspension_ctrl.response.gradients.network_rows import adjoint_of, clear, pull, pull_share
from suspension_ctrl.response.network_rows import (
    DIRECT,
    SLOPE,
    STATES,
    fill_direct,
    fill_rows,
    fill_share,
    rows_of,
)
from suspension_ctrl.response.strut_data import networks_of

F = np.linspace(0.3, 20.0, 11)
OMEGA = 2 * np.pi * F
DAMPER = sc.BilinearDamper(bump=1500.0, rebound=1500.0, installation_ratio=0.9)
STRUT = sc.series(
    sc.parallel(DAMPER, sc.Spring("beside", 3e4)),
    sc.parallel(
        sc.Spring("mount", 2e5),
        sc.Inerter("mass", 50.0),
        sc.series(sc.Damper("inner", 400.0), sc.Rubber("last", storage=1e5, loss=1e4)),
        sc.MeasuredStiffness("bush", frequency=[0.1, 5.0, 30.0], storage=[1e5, 2e5, 3e5], loss=[1e4, 3e4, 3e4]),
    ),
    installation_ratio=0.8,
)
CAR = sc.QuarterCar(
    body_mass=317.5,
    wheel_mass=45.4,
    tyre_stiffness=192e3,
    strut=sc.parallel(sc.Spring(), STRUT, installation_ratio=1.1),
)
SETTING = CAR.coefficients({"spring": 22e3})
NETWORKS = networks_of(CAR, SETTING, list(SETTING), F, np.eye(1, dtype=bool))
VALUES = np.array(list(SETTING.values()))


@pytest.fixture(scope="module")
def filled() -> tuple[np.ndarray, np.ndarray]:
    """Direct elements and rows with a law of a slope of 1500 N s/m."""
    state, direct, rows = np.zeros((1, STATES)), np.empty((NETWORKS.row.size, DIRECT)), rows_of(NETWORKS, F.size)
    state[0, SLOPE] = 1500.0
    fill_direct(NETWORKS, VALUES, state, direct)
    fill_rows(NETWORKS, OMEGA, VALUES, direct, rows)
    return direct, rows


def placed(values: dict[str, complex], slope: complex) -> Placed:
    (network,) = CAR.networks
    one = Placed(network.strut, 0, values)
    one.laws[id(next(element for element in network.strut.elements if element.name == DAMPER.name))].slope = slope
    return one


def moved(output) -> tuple[np.ndarray, float]:
    """Derivatives of a real output of a network by all coefficients and by the slope of its law."""
    by_value = []
    for name in SETTING:
        values = {key: value * (1 + 1j * STEP * (key == name)) for key, value in SETTING.items()}
        by_value.append(output(placed(values, 1500.0)).imag / (STEP * SETTING[name]))
    return np.array(by_value), output(placed(SETTING, 1500.0 + 1j * STEP)).imag / STEP


def test_stiffness_by_every_coefficient_and_slope(filled):
    m = np.random.default_rng(0).normal(size=(2, F.size))
    adjoint = adjoint_of(NETWORKS, F.size, True)
    clear(adjoint)
    adjoint.rows[adjoint.place[NETWORKS.root[0]]] = m
    fill_rows_and_joints(NETWORKS, OMEGA, VALUES, *filled, adjoint.joints)
    pull(NETWORKS, OMEGA, adjoint)

    def output(one: Placed) -> complex:
        return (Apart(*m) * one.stiffness(one.strut, OMEGA)).re.sum()

    by_value, by_slope = moved(output)
    np.testing.assert_allclose(adjoint.by_value * VALUES, by_value * VALUES, rtol=1e-9, atol=1e-9)
    assert adjoint.by_slope[0] == pytest.approx(by_slope, rel=1e-9)


def test_the_share_of_a_law_by_every_coefficient_and_slope(filled):
    share, adjoint = np.empty(F.size), adjoint_of(NETWORKS, F.size, True)
    clear(adjoint)
    fill_share(NETWORKS, OMEGA, 0, *filled, share)
    pull_share(NETWORKS, OMEGA, 0, *filled, share, adjoint)
    fill_rows_and_joints(NETWORKS, OMEGA, VALUES, *filled, adjoint.joints)
    pull(NETWORKS, OMEGA, adjoint)

    def output(one: Placed) -> complex:
        ((_, found),) = one.shares(one.strut, OMEGA, Apart(np.ones(F.size)))
        return found.square().sum()

    assert output(placed(SETTING, 1500.0)).real == pytest.approx(share.sum(), rel=1e-12)
    by_value, by_slope = moved(output)
    np.testing.assert_allclose(adjoint.by_value * VALUES, by_value * VALUES, rtol=1e-9, atol=1e-9 * share.sum())
    assert adjoint.by_slope[0] == pytest.approx(by_slope, rel=1e-9)

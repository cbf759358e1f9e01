"""Changes of fractions of networks, in plain Python, beside complex steps of their polynomials."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.gradients.network_fractions import change_of_mirrored, fill_changes, whole_change
from suspension_ctrl.response.network_fractions import PARTS, fill_fractions, mirrored, whole
from suspension_ctrl.response.network_rows import DIRECT, fill_direct
from suspension_ctrl.response.strut_data import networks_of, nominal_state

MOUNTED = sc.series(sc.Damper("d", 1500.0), sc.parallel(sc.Spring("k", 2e5), sc.Damper("e", 90.0)))
CHAINS = sc.parallel(
    sc.series(sc.Damper("a", 900.0), sc.Spring("b", 3e5), installation_ratio=0.8),
    sc.series(sc.Spring("c", 1e5), sc.Damper("f", 400.0)),
    installation_ratio=0.9,
)


@pytest.mark.parametrize("strut", [MOUNTED, CHAINS])
def test_changes_are_complex_steps(strut):
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=sc.parallel(sc.Spring("own", 2e4), strut)
    )
    names = [one.name for one in car.strut_coefficients]
    networks = networks_of(car, car.coefficients({}), names, np.array([1.0]), np.eye(1) > 0)
    state, root, setting = nominal_state(networks)[0], networks.root[0], networks.setting
    sizes = (networks.row.size, DIRECT), (1 + networks.row.max(), PARTS)
    for c in range(1, setting.size):
        direct, rows = (np.zeros(size, dtype=complex) for size in sizes)
        fill_direct(networks, setting + 1j * np.eye(setting.size)[c] * 1e-30, state, direct)
        fill_fractions(networks, direct, rows)
        expected = np.imag(whole(direct, root, rows, networks.row[root])) / 1e-30
        change, changes = (np.empty(size) for size in sizes)
        fill_direct(networks, np.eye(setting.size)[c], state, change)
        fill_changes(networks, direct.real, rows.real, change, changes)
        found = whole_change(direct.real, root, rows.real, networks.row[root], change, changes)
        np.testing.assert_allclose(found, expected, rtol=1e-13)  # some twenty roundings, sums of positive numbers


def test_changes_of_products_at_minus_s():
    a, b, d_a, d_b = np.random.default_rng(0).normal(size=(4, 3))
    expected = np.imag(mirrored(a + 1e-30j * d_a, b + 1e-30j * d_b)) / 1e-30
    np.testing.assert_allclose(change_of_mirrored(a, b, d_a, d_b), expected, rtol=1e-14, atol=1e-15)

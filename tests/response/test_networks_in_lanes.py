"""Networks at eight frequencies beside those at all, in plain Python."""

import numpy as np

import suspension_ctrl as sc
from suspension_ctrl.response.lanes import WIDTH
from suspension_ctrl.response.network_rows import (
    DIRECT,
    elements,
    fill_direct,
    fill_rows,
    fill_share,
    stiffness_at,
)
from suspension_ctrl.response.networks_in_lanes import fill_nodes, share_at, stiffness_of
from suspension_ctrl.response.strut_data import networks_of, nominal_state

F = np.linspace(0.3, 19.0, 2 * WIDTH)
ROWS = {"frequency": [0.5, 10.0, 15.0], "storage": [2e5, 3e5, 3.5e5], "loss": [2e4, 5e4, 7e4]}


def test_stiffness_and_share_are_those_of_rows():
    """A law below two series, rubber and a measured part; at the second eight frequencies."""
    inner = sc.series(sc.Friction("f", force=50.0), sc.Rubber("r", storage=2e5, loss=3e4), installation_ratio=0.8)
    measured = sc.MeasuredStiffness("m", **ROWS)
    strut = sc.parallel(
        sc.Spring("k", 2e4),
        sc.series(sc.parallel(inner, sc.Inerter("b", 60.0)), measured, installation_ratio=0.9),
        sc.series(sc.Damper("d", 1500.0), sc.Spring("mount", 2e5)),
        installation_ratio=0.7,
    )  # fmt: skip
    car, omega = sc.QuarterCar(body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=strut), 2 * np.pi * F
    networks = networks_of(car, car.coefficients({}), [], F, np.eye(1) > 0)
    state, _ = nominal_state(networks)
    direct, rows = np.empty((networks.row.size, DIRECT)), np.zeros((1 + networks.row.max(), 2, F.size))
    fill_direct(networks, networks.setting, state, direct)
    fill_rows(networks, omega, networks.setting, direct, rows)
    share, nodes, w = np.empty(F.size), np.zeros(2 * WIDTH * len(rows)), omega[WIDTH:]
    fill_share(networks, omega, 0, direct, rows, share)
    fill_nodes(networks, w, WIDTH, networks.setting, direct, nodes)
    root = networks.root[0]
    expected = stiffness_at(elements(direct, root), omega, rows[networks.row[root]], slice(None))
    found = stiffness_of(w, direct, root, nodes, networks.row[root])
    np.testing.assert_allclose(found, np.array(expected)[:, WIDTH:], rtol=1e-13)  # rounded some ten times
    np.testing.assert_allclose(share_at(networks, 0, w, direct, nodes), share[WIDTH:], rtol=1e-13)

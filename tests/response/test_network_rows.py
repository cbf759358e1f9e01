"""Dynamic stiffness of networks at the nodes, against complex numbers."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.network_rows import (
    DEVIATION,
    DIRECT,
    SLOPE,
    elements,
    fill_direct,
    fill_rows,
    fill_share,
    stiffness_at,
)
from suspension_ctrl.response.strut_data import networks_of, nominal_state

F = np.array([0.3, 1.0, 4.0, 11.0, 19.0])
S = 2j * np.pi * F
ROWS = {"frequency": [0.5, 10.0, 15.0], "storage": [2e5, 3e5, 3.5e5], "loss": [2e4, 5e4, 7e4]}
ELEMENTS = {
    "damper": (sc.Damper("d", 1500.0), 1500.0 * S),
    "inerter": (sc.Inerter("b", 60.0), 60.0 * S**2),
    "rubber": (sc.Rubber("r", storage=2e5, loss=3e4), 2e5 + 3e4j + 0 * S),
    "measured": (
        sc.MeasuredStiffness("m", **ROWS),
        np.interp(F, ROWS["frequency"], ROWS["storage"]) + 1j * np.interp(F, ROWS["frequency"], ROWS["loss"]),
    ),
    "law": (sc.Friction("f", force=50.0), None),
}


def rows_of(strut):
    """Networks of a quarter car on a spring beside the strut: direct elements, rows at F, state of laws."""
    car = sc.QuarterCar(
        body_mass=300.0, wheel_mass=30.0, tyre_stiffness=2e5, strut=sc.parallel(sc.Spring("k", 2e4), strut)
    )
    networks = networks_of(car, car.coefficients({}), [], F, np.eye(1) > 0)
    state, _ = nominal_state(networks)
    direct, rows = np.empty((networks.row.size, DIRECT)), np.zeros((1 + networks.row.max(), 2, F.size))
    fill_direct(networks, networks.setting, state, direct)
    fill_rows(networks, 2 * np.pi * F, networks.setting, direct, rows)
    return networks, direct, rows, state


@pytest.mark.parametrize("one", ELEMENTS)
@pytest.mark.parametrize("other", ["damper", "measured"])
@pytest.mark.parametrize("join", [sc.parallel, sc.series])
def test_two_elements(one, other, join):
    if one == other:
        return
    (a, x), (b, y) = ELEMENTS[one], ELEMENTS[other]
    networks, direct, rows, state = rows_of(join(a, b, installation_ratio=0.7))
    if x is None:
        assert state[0, SLOPE] == pytest.approx(np.sqrt(2 / np.pi) * 50.0 / state[0, DEVIATION])
        x = state[0, SLOPE] * S
    expected = 0.49 * (x + y if join is sc.parallel else x * y / (x + y))
    root = networks.root[0]
    re, im = stiffness_at(elements(direct, root), 2 * np.pi * F, rows[networks.row[root]], slice(None))
    np.testing.assert_allclose(re + 1j * im, expected, rtol=1e-12)


def test_the_share_of_a_law():
    """In series with a mount, beside a damper, behind two installation ratios."""
    law = sc.Friction("f", force=50.0, installation_ratio=0.9)
    inner = sc.parallel(law, sc.Damper("d", 300.0))
    networks, direct, rows, state = rows_of(sc.series(inner, sc.Spring("mount", 1e5), installation_ratio=0.7))
    share = np.empty(F.size)
    fill_share(networks, 2 * np.pi * F, 0, direct, rows, share)
    part = 0.81 * state[0, SLOPE] * S + 300.0 * S
    np.testing.assert_allclose(share, np.abs(0.7 * 0.9 * 1e5 / (1e5 + part)) ** 2, rtol=1e-12)

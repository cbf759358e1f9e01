"""Derivatives of mean deflections beside differences of the static equilibrium."""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.gradients.laws import fill_law_slopes, law_slopes_of
from suspension_ctrl.response.gradients.mean_position import fill_mean_slopes, solve, yielding_of
from suspension_ctrl.response.mean_position import balance
from suspension_ctrl.response.network_rows import DEVIATION, MEAN, STATES
from suspension_ctrl.response.strut_data import networks_of
from suspension_ctrl.vehicles.networks import fill_curve

STOP = sc.BumpStop(gap=0.02, stiffness=60e3)
DAMPER = sc.BilinearDamper(bump=750.0, rebound=2250.0)
STRUTS = {
    "beside": (DAMPER, STOP),
    "in series": (DAMPER, sc.series(sc.Spring("top", 1.5e5), sc.parallel(sc.Spring("aux", 3e4), STOP))),
    "damper on a stop": (sc.series(DAMPER, sc.parallel(sc.Spring("aux", 3e4), STOP), installation_ratio=0.9),),
}
DEVIATIONS = {True: 0.3, False: 0.015}


@pytest.mark.parametrize("name", STRUTS)
def test_means_move_as_those_of_differences(name):
    """Extrapolated central differences of 1e-3: the equilibrium is found to 1e-10, which leaves 1e-7."""
    strut = sc.parallel(sc.Spring(), *STRUTS[name], installation_ratio=0.95)
    car = sc.QuarterCar(body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=strut)
    setting = car.coefficients({"spring": 22e3})
    networks = networks_of(car, setting, ["spring"], np.array([1.0]), np.eye(1, dtype=bool))
    laws = [DEVIATIONS[bool(of_rate)] for of_rate in networks.law[:, 0]]
    start = np.array([*setting.values(), *laws])
    nodes, position, curve = (
        np.empty((networks.row.size, 3)),
        np.zeros(1),
        np.empty(networks.laws.number.shape[:3]),
    )

    def state_at(x: np.ndarray) -> np.ndarray:
        values, state = x[: len(setting)], np.zeros((len(laws), STATES))
        state[:, DEVIATION] = x[len(setting) :]
        for law in range(len(laws)):
            fill_curve(networks.laws, law, values, curve[law])
        balance(networks, curve, values, state, nodes, position, np.empty((3, 1, 1)))
        return state

    expected = []
    for i, x in enumerate(start):
        by = 1e-3 * x * np.eye(start.size)[i]
        half, whole = (
            (state_at(start + m * by)[:, MEAN] - state_at(start - m * by)[:, MEAN]) / (2e-3 * m) for m in (1, 2)
        )
        expected.append((4 * half - whole) / 3)
    state, slopes, means = state_at(start), law_slopes_of(networks), np.empty((len(laws), start.size))
    fill_law_slopes(networks, curve, start[: len(setting)], state, slopes)
    fill_mean_slopes(networks, start[: len(setting)], nodes, position, slopes, yielding_of(networks), means)
    means[:, : len(setting)] *= start[: len(setting)]
    assert np.abs(means).max() > 1e-3
    np.testing.assert_allclose(means, np.transpose(expected), rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("n", [1, 2, 5])
def test_linear_equations_with_pivots(n):
    rng = np.random.default_rng(n)
    matrix, right = rng.normal(size=(n, n)), rng.normal(size=(n, 3))
    matrix[0, 0] = 0.0 if n > 1 else matrix[0, 0]
    expected = np.linalg.solve(matrix, right)
    solve(matrix, right)
    np.testing.assert_allclose(right, expected, rtol=1e-12)

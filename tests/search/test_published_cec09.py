"""MOEA/D-DRA beside what its authors printed for it: the mean IGD of 30 runs on problems of CEC 2009.

Q. Zhang, W. Liu, H. Li, "The performance of a new version of MOEA/D on CEC09 unconstrained MOP test instances",
IEEE CEC 2009: 30 variables, N = 600, 300,000 evaluations, T = 60, n_r = 6, delta = 0.9, CR = 1, F = 0.5, no
scaling of objectives, and 100 points chosen by weights from the last population for the indicator, the inverted
generational distance. The means are quoted from memory of the paper, but for UF6's, which others quote too.

Over seeds 0 to 10 the means here are 0.0043, 0.0072, 0.0070, 0.0583 and 0.0043 on UF1, UF2, UF3, UF4 and UF7, the
medians 0.0043, 0.0065, 0.0042, 0.0595 and 0.0042; the tests take five of these seeds. Of the other problems of
two objectives, UF5 comes out at 0.21 (printed 0.181) and UF6 at 0.12. The 0.0059 printed for UF6 is out of reach
for MOEA Framework as well, whose tracker has 0.114 to 0.135 at these settings.
"""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from functions import uf
from suspension_ctrl import MoeadDra, minimise
from suspension_ctrl.search.decomposition import ZERO_WEIGHT

PRINTED = {1: 0.00435, 2: 0.00679, 3: 0.00742, 4: 0.06385, 7: 0.00444}
F1 = np.linspace(0, 1, 1000)
EXPONENTS = {1: 0.5, 2: 0.5, 3: 0.5, 4: 2.0, 7: 1.0}
"""Of the fronts f_2 = 1 - f_1^exponent."""


def pareto_set(number: int, first: np.ndarray) -> np.ndarray:
    """Designs (n, 30) on the Pareto set at these values of x_1, by the formulas for it in report CES-487."""
    x, j = first[:, np.newaxis], np.arange(2, 31)
    angle = 6 * np.pi * x + j * np.pi / 30
    rest = np.sin(angle)
    if number == 2:
        along = 0.3 * x**2 * np.cos(24 * np.pi * x + 4 * j * np.pi / 30) + 0.6 * x
        rest = along * np.where(j % 2 == 0, np.sin(angle), np.cos(angle))
    elif number == 3:
        rest = x ** ((1 + 3 * (j - 2) / 28) / 2)
    return np.hstack([x, rest])


def chosen(objectives: np.ndarray) -> np.ndarray:
    """For each of the weights (i / 99, 1 - i / 99) the objectives with the least Tchebycheff value."""
    first = np.arange(100) / 99
    weights = np.maximum(np.stack([first, 1 - first], axis=1), ZERO_WEIGHT)
    values = (weights[:, np.newaxis] * (objectives - objectives.min(axis=0))).max(axis=2)
    return objectives[values.argmin(axis=1)]


def igd(number: int, objectives: np.ndarray) -> float:
    """Mean distance from the front to the nearest of the objectives."""
    distances, _ = cKDTree(objectives).query(np.stack([F1, 1 - F1 ** EXPONENTS[number]], axis=1))
    return distances.mean()


@pytest.mark.parametrize("number", PRINTED)
def test_moead_dra_is_as_good_as_its_authors(number):
    """The median of five runs is within a quarter above the printed mean and no better than half of it.

    Half, because a few bad runs draw the mean on UF3 away from the median; a quarter, because the median of five
    runs on UF2, the widest of the others with a standard deviation of 0.0018, has one of 0.0010.
    """
    optimiser = MoeadDra(population=600, normalise=False)
    runs = [minimise(uf(number), optimiser, evaluations=300_000, seed=seed) for seed in range(5)]
    median = np.median([igd(number, chosen(run.objectives)) for run in runs])
    assert 0.5 * PRINTED[number] < median < 1.25 * PRINTED[number]


@pytest.mark.parametrize("number", PRINTED)
def test_problems_have_their_pareto_sets(number):
    """Designs on the set lie on the front; a variable moved off it worsens its own objective and no other."""
    problem, first = uf(number), np.linspace(0.01, 0.99, 30)
    designs = pareto_set(number, first)
    on_front = problem.evaluate(designs)
    f1 = first**0.2 if number == 7 else first
    np.testing.assert_allclose(on_front[:, 0], f1, atol=1e-13)
    np.testing.assert_allclose(on_front[:, 1], 1 - f1 ** EXPONENTS[number], atol=1e-13)
    for j in (2, 3, 29, 30):
        moved = designs.copy()
        moved[:, j - 1] += 0.01
        worse = problem.evaluate(moved) - on_front
        own, other = (0, 1) if j % 2 else (1, 0)
        assert (worse[:, own] > 1e-6).all()
        np.testing.assert_allclose(worse[:, other], 0, atol=1e-12)

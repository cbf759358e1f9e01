"""Test problems with known Pareto fronts, as `Problem`s.

E. Zitzler, K. Deb, L. Thiele, "Comparison of multiobjective evolutionary algorithms: empirical results",
Evolutionary Computation 8(2), 2000; K. Deb, L. Thiele, M. Laumanns, E. Zitzler, "Scalable multi-objective
optimization test problems", CEC 2002.
"""

import numpy as np

from suspension_ctrl import Problem


def _zdt1(x: np.ndarray) -> np.ndarray:
    g = 1 + 9 * x[:, 1:].mean(axis=1)
    return np.stack([x[:, 0], g * (1 - np.sqrt(x[:, 0] / g))], axis=1)


def _dtlz2(x: np.ndarray) -> np.ndarray:
    radius = 1 + ((x[:, 2:] - 0.5) ** 2).sum(axis=1)
    a, b = x[:, 0] * np.pi / 2, x[:, 1] * np.pi / 2
    return radius[:, None] * np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=1)


def zdt1(variables: int = 30) -> Problem:
    return Problem(evaluate=_zdt1, lower=(0.0,) * variables, upper=(1.0,) * variables, objectives=("f1", "f2"))


def dtlz2(variables: int = 12) -> Problem:
    return Problem(
        evaluate=_dtlz2, lower=(0.0,) * variables, upper=(1.0,) * variables, objectives=("f1", "f2", "f3")
    )

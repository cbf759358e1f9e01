"""Test problems with known Pareto fronts, as `Problem`s.

E. Zitzler, K. Deb, L. Thiele, "Comparison of multiobjective evolutionary algorithms: empirical results",
Evolutionary Computation 8(2), 2000; K. Deb, L. Thiele, M. Laumanns, E. Zitzler, "Scalable multi-objective
optimization test problems", CEC 2002.
"""

from collections.abc import Callable

import numpy as np
from numba import njit

from suspension_ctrl import Problem


def _zdt1(x: np.ndarray) -> np.ndarray:
    g = 1 + 9 * x[:, 1:].mean(axis=1)
    return np.stack([x[:, 0], g * (1 - np.sqrt(x[:, 0] / g))], axis=1)


def _zdt2(x: np.ndarray) -> np.ndarray:
    g = 1 + 9 * x[:, 1:].mean(axis=1)
    return np.stack([x[:, 0], g * (1 - (x[:, 0] / g) ** 2)], axis=1)


def _zdt3(x: np.ndarray) -> np.ndarray:
    g = 1 + 9 * x[:, 1:].mean(axis=1)
    ratio = x[:, 0] / g
    return np.stack([x[:, 0], g * (1 - np.sqrt(ratio) - ratio * np.sin(10 * np.pi * x[:, 0]))], axis=1)


def _dtlz2(x: np.ndarray) -> np.ndarray:
    radius = 1 + ((x[:, 2:] - 0.5) ** 2).sum(axis=1)
    a, b = x[:, 0] * np.pi / 2, x[:, 1] * np.pi / 2
    return radius[:, None] * np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=1)


@njit
def _zdt1_kernel(x):
    g = 1 + 9 * x[1:].mean()
    return np.array([x[0], g * (1 - np.sqrt(x[0] / g))])


@njit
def _zdt2_kernel(x):
    g = 1 + 9 * x[1:].mean()
    return np.array([x[0], g * (1 - (x[0] / g) ** 2)])


@njit
def _zdt3_kernel(x):
    g = 1 + 9 * x[1:].mean()
    ratio = x[0] / g
    return np.array([x[0], g * (1 - np.sqrt(ratio) - ratio * np.sin(10 * np.pi * x[0]))])


@njit
def _dtlz2_kernel(x):
    radius = 1 + ((x[2:] - 0.5) ** 2).sum()
    a, b = x[0] * np.pi / 2, x[1] * np.pi / 2
    return radius * np.array([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)])


def _problem(evaluate: Callable, variables: int, objectives: int, kernel: Callable | None) -> Problem:
    return Problem(
        evaluate=evaluate,
        lower=(0.0,) * variables,
        upper=(1.0,) * variables,
        objectives=tuple(f"f{j + 1}" for j in range(objectives)),
        kernel=(kernel, ()) if kernel else None,
    )


def zdt1(variables: int = 30, *, compiled: bool = False) -> Problem:
    return _problem(_zdt1, variables, 2, _zdt1_kernel if compiled else None)


def zdt2(variables: int = 30, *, compiled: bool = False) -> Problem:
    return _problem(_zdt2, variables, 2, _zdt2_kernel if compiled else None)


def zdt3(variables: int = 30, *, compiled: bool = False) -> Problem:
    return _problem(_zdt3, variables, 2, _zdt3_kernel if compiled else None)


def dtlz2(variables: int = 12, *, compiled: bool = False) -> Problem:
    return _problem(_dtlz2, variables, 3, _dtlz2_kernel if compiled else None)

"""Test problems with known Pareto fronts, as `Problem`s.

E. Zitzler, K. Deb, L. Thiele, "Comparison of multiobjective evolutionary algorithms: empirical results",
Evolutionary Computation 8(2), 2000; K. Deb, L. Thiele, M. Laumanns, E. Zitzler, "Scalable multi-objective
optimization test problems", CEC 2002. UF1 to UF4 and UF7, whose Pareto sets are curves in the box: Q. Zhang, A.
Zhou, S. Zhao, P. N. Suganthan, W. Liu, S. Tiwari, "Multiobjective optimization test instances for the CEC 2009
special session and competition", University of Essex, report CES-487, 2008.
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


@njit
def _dtlz2_plane(x):
    radius, a = 1 + ((x[1:] - 0.5) ** 2).sum(), x[0] * np.pi / 2
    return radius * np.array([np.cos(a), np.sin(a)])


@njit
def _numbers(x):  # j of x_2 to x_n
    return np.arange(2, x.size + 1)


@njit
def _wave(x):  # a phase for each of x_2 to x_n
    return 6 * np.pi * x[0] + _numbers(x) * np.pi / x.size


@njit
def _odd_and_even(terms):  # means over odd j and over even j of terms for j = 2 to n
    return np.array([terms[1::2].mean(), terms[::2].mean()])


@njit
def _uf1(x):
    return np.array([x[0], 1 - np.sqrt(x[0])]) + 2 * _odd_and_even((x[1:] - np.sin(_wave(x))) ** 2)


@njit
def _uf2(x):
    j = _numbers(x)
    swing = 0.3 * x[0] ** 2 * np.cos(24 * np.pi * x[0] + 4 * j * np.pi / x.size) + 0.6 * x[0]
    curve = swing * np.sin(_wave(x) + j % 2 * np.pi / 2)  # a cosine for odd j
    return np.array([x[0], 1 - np.sqrt(x[0])]) + 2 * _odd_and_even((x[1:] - curve) ** 2)


@njit
def _uf3(x):
    j = _numbers(x)
    y = x[1:] - x[0] ** (0.5 + 1.5 * (j - 2) / (x.size - 2))
    ripple = np.cos(20 * y * np.pi / np.sqrt(j))
    ripples = np.array(
        [(1 - ripple[1::2].prod()) / ripple[1::2].size, (1 - ripple[::2].prod()) / ripple[::2].size]
    )
    return np.array([x[0], 1 - np.sqrt(x[0])]) + 8 * _odd_and_even(y**2) + 4 * ripples


@njit
def _uf4(x):
    y = np.abs(x[1:] - np.sin(_wave(x)))
    return np.array([x[0], 1 - x[0] ** 2]) + 2 * _odd_and_even(y / (1 + np.exp(2 * y)))


@njit
def _uf7(x):
    root = x[0] ** 0.2
    return np.array([root, 1 - root]) + 2 * _odd_and_even((x[1:] - np.sin(_wave(x))) ** 2)


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


def dtlz2_plane() -> Problem:
    """DTLZ2 with two objectives of 12 variables."""
    return _of_kernel(_dtlz2_plane, (0.0, 1.0))


def uf(number: int) -> Problem:
    """UF1, UF2, UF3, UF4 or UF7 with 30 variables."""
    kernel, rest = {
        1: (_uf1, (-1.0, 1.0)), 2: (_uf2, (-1.0, 1.0)), 3: (_uf3, (0.0, 1.0)), 4: (_uf4, (-2.0, 2.0)),
        7: (_uf7, (-1.0, 1.0)),
    }[number]  # fmt: skip
    return _of_kernel(kernel, rest, 30)


def _of_kernel(kernel: Callable, rest: tuple[float, float], variables: int = 12) -> Problem:
    """Two objectives, x_1 from 0 to 1 and all others within `rest`."""
    return Problem(
        evaluate=lambda designs: np.array([kernel(design) for design in designs]),
        lower=(0.0,) + (rest[0],) * (variables - 1),
        upper=(1.0,) + (rest[1],) * (variables - 1),
        objectives=("f1", "f2"),
        kernel=(kernel, ()),
    )

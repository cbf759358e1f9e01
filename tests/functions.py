"""Test problems with known Pareto fronts, as `Problem`s; those of Binh and Korn, of Srinivas and Deb, and C2-DTLZ2
have constraints.

E. Zitzler, K. Deb, L. Thiele, "Comparison of multiobjective evolutionary algorithms: empirical results",
Evolutionary Computation 8(2), 2000; K. Deb, L. Thiele, M. Laumanns, E. Zitzler, "Scalable multi-objective
optimization test problems", CEC 2002. UF1 to UF4 and UF7, whose Pareto sets are curves in the box: Q. Zhang, A.
Zhou, S. Zhao, P. N. Suganthan, W. Liu, S. Tiwari, "Multiobjective optimization test instances for the CEC 2009
special session and competition", University of Essex, report CES-487, 2008.
T. T. Binh, U. Korn, "MOBES: a multiobjective evolution strategy for
constrained optimization problems", Mendel 1997; N. Srinivas, K. Deb, "Multiobjective optimization using
nondominated sorting in genetic algorithms", Evolutionary Computation 2(3), 1994; H. Jain, K. Deb, "An evolutionary
many-objective optimization algorithm using reference-point based nondominated sorting approach, part II", IEEE
Trans. Evol. Comput. 18(4), 2014.
"""

import time
from collections.abc import Callable

import numpy as np
from numba import njit
from scipy.optimize import brentq

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


@njit
def _bnh_kernel(x):
    a, b = x
    return np.array([
        4 * a**2 + 4 * b**2, (a - 5) ** 2 + (b - 5) ** 2,
        ((a - 5) ** 2 + b**2) / 25 - 1, 1 - ((a - 8) ** 2 + (b + 3) ** 2) / 7.7,
    ])  # fmt: skip


@njit
def _srn_kernel(x):
    a, b = x
    return np.array([
        2 + (a - 2) ** 2 + (b - 1) ** 2, 9 * a - (b - 1) ** 2, (a**2 + b**2) / 225 - 1, (a - 3 * b) / 10 + 1,
    ])  # fmt: skip


@njit
def _c2dtlz2_kernel(x):
    f = _dtlz2_kernel(x)
    nearest = ((f - 1 / np.sqrt(3.0)) ** 2).sum()
    for j in range(3):
        nearest = min(nearest, (f**2).sum() - 2 * f[j] + 1)
    return np.append(f, nearest - 0.4**2)


def _constrained(kernel: Callable, lower: tuple, upper: tuple, m: int, c: int, compiled: bool) -> Problem:
    return Problem(
        evaluate=lambda designs: np.array([kernel(design) for design in designs]).reshape(-1, m + c),
        lower=lower,
        upper=upper,
        objectives=tuple(f"f{j + 1}" for j in range(m)),
        constraints=tuple(f"g{j + 1}" for j in range(c)),
        kernel=(kernel, ()) if compiled else None,
    )


def bnh(*, compiled: bool = True) -> Problem:
    return _constrained(_bnh_kernel, (0.0, 0.0), (5.0, 3.0), 2, 2, compiled)


def srn(*, compiled: bool = True) -> Problem:
    return _constrained(_srn_kernel, (-20.0, -20.0), (20.0, 20.0), 2, 2, compiled)


def c2dtlz2(variables: int = 7, *, compiled: bool = True) -> Problem:
    return _constrained(_c2dtlz2_kernel, (0.0,) * variables, (1.0,) * variables, 3, 1, compiled)


def bnh_set(n: int) -> np.ndarray:
    """Pareto-optimal designs (2 n, 2): a = b up to 3, then along the bound b = 3."""
    low, high = np.linspace(0, 3, n), np.linspace(3, 5, n)
    return np.concatenate([np.stack([low, low], axis=1), np.stack([high, np.full(n, 3.0)], axis=1)])


def srn_set(n: int) -> np.ndarray:
    """Pareto-optimal designs (3 n, 2), from the least of f1 to the least of f2.

    Where no constraint is active, f1 + f2 has its least at a = -2.5 for any b. At the ends of that line the set
    goes on along the line a - 3 b + 10 = 0 to the least of f1 on it, a = 1.1, and along the circle of radius 15 to
    the least of f2 on it, where its derivative 9 b + 2 a (b - 1) by the angle is zero.
    """
    line = np.linspace(1.1, -2.5, n)
    inside = np.linspace(2.5, np.sqrt(225 - 2.5**2), n)
    angles = [np.arctan2(inside[-1], -2.5), 3 * np.pi / 4]
    last = brentq(lambda t: -9 * np.sin(t) - 2 * (15 * np.sin(t) - 1) * np.cos(t), *angles)
    circle = np.linspace(angles[0], last, n)
    return np.concatenate([
        np.stack([line, (line + 10) / 3], axis=1),
        np.stack([np.full(n, -2.5), inside], axis=1),
        15 * np.stack([np.cos(circle), np.sin(circle)], axis=1),
    ])  # fmt: skip


def c2dtlz2_front(n: int) -> np.ndarray:
    """Pareto-optimal objectives: what of the unit sphere is within 0.4 of a corner or of the middle.

    Towards the origin a point comes no farther from a unit vector as long as it stays outside the sphere.
    """
    a, b = (angle.ravel() for angle in np.meshgrid(*[np.linspace(0, np.pi / 2, n)] * 2))
    sphere = np.stack([np.cos(a) * np.cos(b), np.cos(a) * np.sin(b), np.sin(a)], axis=1)
    centres = np.concatenate([np.eye(3), np.full((1, 3), 1 / np.sqrt(3))])
    return sphere[np.linalg.norm(sphere[:, None] - centres, axis=2).min(axis=1) <= 0.4]


def slow(designs: np.ndarray) -> np.ndarray:
    """ZDT1's objectives, as if they took a while."""
    time.sleep(0.01)
    return zdt1(4).evaluate(designs)

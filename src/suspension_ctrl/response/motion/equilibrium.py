"""Equilibrium of a vehicle with force laws on a road at rest, and the segments of laws at a start."""

import numpy as np

from ...compiled import compilable
from ...quantities import Real
from .crossings import bound, locate
from .expansion import accelerate, place, react
from .system import Course, Equations, Work
from .trees import Numbers, Tree

_ITERATIONS = 200  # at most
_AT_REST = 1e-6  # m/s, m/s^2, largest derivative in equilibrium
_SINGULAR = 1e-13  # of the largest singular value: none


@compilable(error_model="numpy")
def derivative(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real) -> None:
    """Put in the derivative of states, ``work.x[1]``, and the present values of laws and tyres."""
    work.x[0] = x
    react(e, tree, numbers, work, 0)
    accelerate(e, work, 0)


@compilable(error_model="numpy")
def find_segments(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real) -> None:
    """Set the segments of laws and tyres at a start, from those at 0 on, one knot at a time."""
    work.own[0] = 0.0
    for i in range(work.segment.size):
        locate(numbers, work, i)
    for _ in range(_ITERATIONS):
        derivative(e, tree, numbers, work, x)
        found = True
        for i in range(work.segment.size):
            beyond = int(work.own[0, i] > work.bounds[1, i]) - int(work.own[0, i] < work.bounds[0, i])
            if beyond != 0:
                found = False
                work.segment[i] += beyond
                bound(numbers, work, i)
        if found:
            break


@compilable(error_model="numpy")
def settle(e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, x: Real) -> bool:
    """Put in the states of equilibrium on the first heights by Newton's method; return whether it was found.

    The equations are linear while no law leaves its segment; laws of the rate stay on that of 0 m/s.
    """
    n = x.size
    slopes = np.zeros((n, n + 1))
    place(course, 0, 0.0, work.z)
    work.z[1] = 0.0
    x[:] = 0.0
    work.own[0] = 0.0
    for i in range(work.segment.size):
        locate(numbers, work, i)
    for _ in range(_ITERATIONS):
        derivative(e, tree, numbers, work, x)
        slopes[:, n] = -work.x[1]
        for j in range(n):
            x[j] += 1.0
            derivative(e, tree, numbers, work, x)
            x[j] -= 1.0
            slopes[:, j] = work.x[1] + slopes[:, n]
        solve(slopes)
        x += slopes[:, n]
        derivative(e, tree, numbers, work, x)
        found = True
        for i in range(tree.of_rate.size):
            if not tree.of_rate[i] and locate(numbers, work, i):
                found = False
        if found:
            return bool(np.abs(work.x[1]).max() < _AT_REST)
    return False


@compilable(error_model="numpy")
def solve(system: Real) -> None:
    """Put the solution into the last column of linear equations (n, n + 1); unknowns without a pivot are 0."""
    n = system.shape[0]
    order, smallest = np.arange(n), 0.0
    for k in range(n):
        row, column = k, k
        for i in range(k, n):
            for j in range(k, n):
                if abs(system[i, j]) > abs(system[row, column]):
                    row, column = i, j
        for j in range(n + 1):
            system[k, j], system[row, j] = system[row, j], system[k, j]
        for i in range(n):
            system[i, k], system[i, column] = system[i, column], system[i, k]
        order[k], order[column] = order[column], order[k]
        pivot = system[k, k]
        smallest = max(smallest, abs(pivot) * _SINGULAR)
        for j in range(k, n + 1):
            system[k, j] = system[k, j] / pivot if abs(pivot) > smallest else 0.0
        for i in range(n):
            factor = system[i, k] if i != k else 0.0
            for j in range(k, n + 1):
                system[i, j] -= factor * system[k, j]
    solution = system[:, n].copy()
    for k in range(n):
        system[order[k], n] = solution[k]

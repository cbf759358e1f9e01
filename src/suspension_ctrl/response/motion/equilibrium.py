"""Equilibrium of a vehicle with force laws on a road at rest, and the segments of laws at a start."""

import numpy as np

from ...compiled import compiled
from ...quantities import Real
from .crossings import bound, locate
from .expansion import accelerate, place, react
from .system import Course, Equations, Work
from .trees import Numbers, Tree

_ITERATIONS = 200  # at most
_AT_REST = 1e-6  # m/s, m/s^2, largest derivative in equilibrium
_SINGULAR = 1e-13  # of the largest singular value: none


@compiled(error_model="numpy")
def fill_derivatives(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real, found: Real) -> None:
    """Fill in the derivatives (k, n) of states (k, n), and the values of laws and tyres at the last."""
    for p in range(x.shape[0]):
        for i in range(x.shape[1]):
            work.x[0, i] = x[p, i]
        react(e, tree, numbers, work, 0)
        accelerate(e, work, 0)
        for i in range(x.shape[1]):
            found[p, i] = work.x[1, i]


def begin(numbers: Numbers, work: Work) -> None:
    """Set the segments of laws and tyres to those at 0."""
    work.own[0] = 0.0
    for i in range(work.segment.size):
        locate(numbers, work, i)


def find_segments(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real) -> None:
    """Set the segments of laws and tyres at a start, from the present ones on, one knot at a time."""
    found = np.empty((1, x.size))
    for _ in range(_ITERATIONS):
        fill_derivatives(e, tree, numbers, work, x[None], found)
        beyond = (work.own[0] > work.bounds[1]).astype(int) - (work.own[0] < work.bounds[0])
        if not beyond.any():
            break
        work.segment[:] += beyond
        for i in np.flatnonzero(beyond).tolist():
            bound(numbers, work, i)


def settle(e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, x: Real) -> bool:
    """Put in the states of equilibrium on the first heights by Newton's method; return whether it was found.

    The equations are linear while no law leaves its segment; laws of the rate stay on that of 0 m/s. States on
    which nothing depends are 0.
    """
    place(course, 0, 0.0, work.z)
    work.z[1] = 0.0
    x[:] = 0.0
    begin(numbers, work)
    by_deflection = np.flatnonzero(~tree.of_rate).tolist()
    for _ in range(_ITERATIONS):
        points = np.vstack([x + np.eye(x.size), x])
        found = np.empty_like(points)
        fill_derivatives(e, tree, numbers, work, points, found)
        moved = [locate(numbers, work, law) for law in by_deflection]
        if not any(moved) and np.abs(found[-1]).max() < _AT_REST:
            return True
        if not any(moved):
            x -= np.linalg.lstsq((found[:-1] - found[-1]).T, found[-1], rcond=_SINGULAR)[0]
    return False

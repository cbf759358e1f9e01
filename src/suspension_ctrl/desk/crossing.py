"""From an optimum on bounds of the box to a better one on the opposite bounds.

The ends of a variable with little effect may both be local optima: a descent ends at the one on its side.
"""

from collections.abc import Callable, Iterator

import numpy as np

from ..quantities import Real
from .descent import End, descended, excess_of
from .programs import Program

_NEAR = 0.02  # by which the objective, over its size, and rows may be above those of an optimum across the box
_TRIES = 2  # descents from one optimum
_ON_BOUND = 1e-6  # of the box
_BETTER = 1e-8  # relative


def crossed(end: End, program_at: Callable[[Real], Program]) -> End:
    """Return the best optimum that descents reach from others with one variable on the opposite bound.

    The programs are given by designs (d,) at which they begin.
    """
    seen = set[tuple[float, ...]]()
    while end.feasible:
        seen.add(_corner(end.program, end.z))
        better = next(_better(end, program_at, seen), None)
        if better is None:
            break
        end = better
    return end


def _better(end: End, program_at: Callable[[Real], Program], seen: set[tuple[float, ...]]) -> Iterator[End]:
    """Yield the ends of descents across the box that are better; keeps where they begin in `seen`."""
    starts = list[tuple[float, Program]]()
    for place in np.flatnonzero(_corner(end.program, end.z)).tolist():
        z = end.z.copy()
        z[place] = 1.0 - np.round(z[place])
        if _corner(end.program, z) not in seen:
            program = program_at(end.program.design(z))
            value = float(program.at(program.start).rows[0] * program.sizes[0])
            if max((value - end.value) / (abs(end.value) or 1.0), excess_of(program, program.start)) < _NEAR:
                starts.append((value, program))
    for _, program in sorted(starts, key=lambda start: start[0])[:_TRIES]:
        seen.add(_corner(program, program.start))
        found = descended(program)
        if found.feasible and found.value < end.value - _BETTER * abs(end.value):
            yield found


def _corner(program: Program, z: Real) -> tuple[float, ...]:
    """Return by variable -1 on its lower bound, 1 on its upper one, 0 between them."""
    own = z[: program.free.size]
    return tuple(np.where(own <= _ON_BOUND, -1.0, np.where(own >= 1 - _ON_BOUND, 1.0, 0.0)).tolist())

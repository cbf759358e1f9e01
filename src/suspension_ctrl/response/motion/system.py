"""The system that is integrated: equations, road, and storage of power series in time.

Everything is kept as power series about the present moment: the term of order k of ``x(t + s)`` belongs to s^k.
"""

from typing import NamedTuple

import numpy as np

from ...quantities import Integer, Real
from .trees import Tree

TERMS = 16
"""Highest order of a power series."""
ROAD = 4  # terms of the road, a cubic


class Equations(NamedTuple):
    """x' = a x + b z + g z' + f F + constant: v states of a vehicle, roads z and tensions F of the networks.

    Behind these states come those of the tree. Ports are c x, deflections and rates, and of struts on a road
    `standing` times z, and times z'. The tension of tyre t is
    ``load x + by_road z + by_rate z'``. Where tyres may lift off it is at most the static load; what is beyond
    acts on the states by `push`.
    """

    a: Real  # (v, v)
    b: Real  # (v, r)
    g: Real  # (v, r)
    f: Real  # (v, q)
    constant: Real  # (v,)
    c: Real  # (2q, v)
    standing: Real  # (q, r)
    load: Real  # (t, v), t = 0 where tyres stay on the road
    by_road: Real  # (t,)
    by_rate: Real  # (t,)
    static: Real  # (t,), load on level ground [N]
    push: Real  # (v, t)


class Course(NamedTuple):
    """Elevation under r wheels: a cubic in the time since its knot on each piece."""

    knots: Real  # (k + 1,) [s]
    pieces: Real  # (k, r, 4), by rising powers


class Work(NamedTuple):
    """Power series of n states and what follows from them, and the segments of l laws and t tyres."""

    columns: Real  # (v + 2r + q, v), effect of each state, road, its rate and tension on the derivatives
    ports: Real  # (v, 2q), effect of each state on the ports
    x: Real  # (TERMS + 2, n)
    z: Real  # (2, ROAD, r), road and its rate
    tension: Real  # (TERMS + 1, q)
    own: Real  # (TERMS + 1, l + t), deflection or rate of a law, tension of a tyre beyond its static load
    curved: Real  # (TERMS + 1, l), force of a law by a power of the rate
    slots: Real  # (8, slots), see `passes`
    law: Real  # (2, l), slope of each law, and the rest of its force
    segment: Integer  # (l + t,), of a tyre 0 on the road, 1 in the air
    bounds: Real  # (2, l + t), of the present segment, low and high
    reach: Real  # (l + t,), bound of what a law moves in a step
    size: Real  # (n,), largest magnitude of each state


def work_of(e: Equations, tree: Tree) -> Work:
    """Return zeros beside the columns."""
    q, laws, t = e.f.shape[1], tree.of_rate.size, e.static.size
    n = len(e.a) + tree.states
    return Work(
        columns=np.vstack([e.a.T, e.b.T, e.g.T, e.f.T]).copy(),
        ports=np.ascontiguousarray(e.c.T),
        x=np.zeros((TERMS + 2, n)),
        z=np.zeros((2, ROAD, e.b.shape[1])),
        tension=np.zeros((TERMS + 1, q)),
        own=np.zeros((TERMS + 1, laws + t)),
        curved=np.zeros((TERMS + 1, laws)),
        slots=np.zeros((8, tree.slots)),
        law=np.zeros((2, laws)),
        segment=np.zeros(laws + t, dtype=np.int64),
        bounds=np.zeros((2, laws + t)),
        reach=np.zeros(laws + t),
        size=np.zeros(n),
    )

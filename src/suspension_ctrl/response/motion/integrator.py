"""Integration in time of a vehicle with force laws, by the pair of Dormand and Prince of orders 5 and 4 [1]_.

Steps end on the knots of the road. Within a step every law stays on its segment, prolonged if need be, so that the
equations are smooth; a step that passes a knot of a law ends there, and the law goes on with its next segment.

.. [1] J. R. Dormand and P. J. Prince, "A family of embedded Runge-Kutta formulae", Journal of Computational and
   Applied Mathematics 6 (1980).
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled
from ...quantities import Bool, Integer, Real
from .passes import Scratch, deflect, excess, gather, locate, scratch_of, spread
from .trees import Numbers, Tree

_A = np.array(
    [
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
_C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
_ERROR = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
_FLOOR = 1e-3  # m, m/s, rad: errors of smaller states are relative to this
_SHORTEST = 1e-12  # s, of a step
_ITERATIONS = 200  # at most
_NO_CHANGE = 1e-12  # m/s, of a law's rate
_LOCATED = 1e-6  # of what a law moves in a step: where it leaves its segment
_AT_REST = 1e-6  # m/s, m/s^2, largest derivative in equilibrium
_SINGULAR = 1e-13  # of the largest singular value: none
_TRIES = 100_000  # steps between two knots of the road, at most


class Equations(NamedTuple):
    """x' = a x + b z + g z' + f F + constant: v states of a vehicle, roads z and tensions F of the networks.

    Behind these states come those of the tree. Ports are c x, deflections and rates. The tension of tyre t is
    ``load x + by_road z + by_rate z'``. Where tyres may lift off it is at most the static load; what is beyond
    acts on the states by `push`.
    """

    a: Real  # (v, v)
    b: Real  # (v, r)
    g: Real  # (v, r)
    f: Real  # (v, q)
    constant: Real  # (v,)
    c: Real  # (2q, v)
    load: Real  # (t, v), t = 0 where tyres stay on the road
    by_road: Real  # (t,)
    by_rate: Real  # (t,)
    static: Real  # (t,), load on level ground [N]
    push: Real  # (v, t)


class Course(NamedTuple):
    """Elevation under r wheels: a cubic in the time since its knot on each piece."""

    knots: Real  # (k + 1,) [s]
    pieces: Real  # (k, r, 4), by rising powers
    row: Integer  # (k + 1,), row of the result at a knot, -1 for none


class Work(NamedTuple):
    """Storage of an integration of n states."""

    scratch: Scratch
    stage: Real  # (7, n), derivatives
    ports: Real  # (2q,)
    tension: Real  # (q,), of the networks
    before: Real  # (2 (l + t),), excess of laws and tyres above and below their segments at the start of a step
    after: Real  # (2 (l + t),), at its end
    own: Real  # (t,), tension of each tyre beyond its static load
    lifted: Integer  # (t,), 1 for a tyre in the air
    z: Real  # (2, r), road and its rate
    turned: Bool  # (2 (l + t),), the ends of segments that a step passes
    start: Real  # (n,), states at the start of a step
    end: Real  # (n,)
    last: Real  # (2, n), states and derivative at the end of a step that goes too far
    size: Real  # (n,), largest magnitude of each state


@compilable(error_model="numpy")
def work_of(e: Equations, tree: Tree) -> Work:
    """Return zeros."""
    n, r, q, t = e.a.shape[0] + tree.states, e.b.shape[1], e.f.shape[1], e.static.size
    ends, lifted = 2 * (tree.of_rate.size + t), np.zeros(t, dtype=np.int64)
    passed, turned, states = np.zeros((2, ends)), np.zeros(ends, dtype=np.bool_), np.zeros((5, n))
    stage, z, ports, tension, own = np.zeros((7, n)), np.zeros((2, r)), np.zeros(2 * q), np.zeros(q), np.zeros(t)
    kept = (scratch_of(tree), stage, ports, tension, passed[0], passed[1], own, lifted, z, turned)
    return Work(*kept, states[0], states[1], states[2:4], states[4])


@compilable(error_model="numpy")
def differentiate(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real, dx: Real) -> None:
    """Put in the derivative of the states on the road `work.z`, and the present values of laws and tyres."""
    if tree.kind.size:
        _pull(e, tree, numbers, work, x, dx)
    for i in range(e.a.shape[0]):
        dx[i] = e.constant[i] + _product(e.a[i], x) + _product(e.f[i], work.tension)
        dx[i] += _product(e.b[i], work.z[0]) + _product(e.g[i], work.z[1])
    for t in range(e.static.size):
        tension = _product(e.load[t], x) + e.by_road[t] * work.z[0, t] + e.by_rate[t] * work.z[1, t]
        work.own[t] = tension - e.static[t]
        if work.lifted[t]:
            for i in range(e.a.shape[0]):
                dx[i] -= e.push[i, t] * work.own[t]


@compilable(error_model="numpy", forceinline=True)
def _pull(e: Equations, tree: Tree, numbers: Numbers, work: Work, x: Real, dx: Real) -> None:
    """Put in the tensions of the networks and the derivatives of their states."""
    q, scratch = work.tension.size, work.scratch
    for i in range(2 * q):
        work.ports[i] = _product(e.c[i], x)
    deflect(tree, numbers, scratch, work.ports[:q], x)
    for _ in range(_ITERATIONS):
        gather(tree, numbers, scratch, x)
        change = spread(tree, numbers, scratch, work.ports[q:], x, dx)
        if change < _NO_CHANGE or not tree.curved:
            break
    work.tension[:] = 0.0
    for i in range(tree.kind.size):
        if tree.port[i] >= 0:
            work.tension[tree.port[i]] += scratch.by_rate[i] * scratch.rate[i] + scratch.force[i]


@compilable(error_model="numpy", forceinline=True)
def _product(row: Real, x: Real) -> float:
    """Return the scalar product over the length of the row."""
    total = 0.0
    for i in range(row.size):
        total += row[i] * x[i]
    return total


@compilable(error_model="numpy", forceinline=True)
def _place(course: Course, piece: int, time: float, z: Real) -> None:
    """Put in the road and its rate (2, r) at a time since the knot [s]."""
    for r in range(z.shape[1]):
        c = course.pieces[piece, r]
        z[0, r] = c[0] + time * (c[1] + time * (c[2] + time * c[3]))
        z[1, r] = c[1] + time * (2 * c[2] + time * 3 * c[3])


@compilable(error_model="numpy")
def _step(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, piece: int, time: float, h: float
) -> None:
    """Put in the states after a step h, from those at its start and the derivative there."""
    end, stage = work.end, work.stage
    for s in range(1, 7):
        for i in range(end.size):
            total = 0.0
            for j in range(s):
                total += _A[s - 1, j] * stage[j, i]
            end[i] = work.start[i] + h * total
        _place(course, piece, time + _C[s] * h, work.z)
        differentiate(e, tree, numbers, work, end, stage[s])


@compilable(error_model="numpy", forceinline=True)
def _error(work: Work, h: float, tolerance: float) -> float:
    """Return the largest error of a state over what is allowed."""
    worst = 0.0
    for i in range(work.end.size):
        found = 0.0
        for s in range(7):
            found += _ERROR[s] * work.stage[s, i]
        size = max(work.size[i], abs(work.end[i])) + _FLOOR
        worst = max(worst, abs(h * found) / (tolerance * size))
    return worst if np.isfinite(worst) else np.inf


@compilable(error_model="numpy", forceinline=True)
def _compare(numbers: Numbers, work: Work, found: Real) -> None:
    """Put in how far each law and tyre is above and below its present segment (2 (l + t),)."""
    laws = numbers.knots.size
    for i in range(laws):
        found[2 * i], found[2 * i + 1] = excess(numbers, work.scratch, i)
    for t in range(work.own.size):
        found[2 * (laws + t)] = -np.inf if work.lifted[t] else work.own[t]
        found[2 * (laws + t) + 1] = -work.own[t] if work.lifted[t] else -np.inf


@compilable(error_model="numpy")
def _switch(numbers: Numbers, work: Work, i: int) -> None:
    """Let a law go on with the segment above or below, a tyre leave the road or meet it again."""
    laws = numbers.knots.size
    if i < 2 * laws:
        work.scratch.segment[i // 2] += 1 if i % 2 == 0 else -1
    else:
        work.lifted[i // 2 - laws] = 1 - work.lifted[i // 2 - laws]


@compilable(error_model="numpy", forceinline=True)
def _largest(excess: Real, counted: Bool) -> float:
    """Return the largest excess of those that count."""
    largest = -np.inf
    for i in range(excess.size):
        if counted[i] and excess[i] > largest:
            largest = excess[i]
    return largest


@compilable(error_model="numpy")
def _crossing(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, piece: int, time: float, h: float
) -> float:
    """Return the share of a step after which the first law or tyre is beyond its segment, by the cubic of Hermite.

    It is a root of the largest excess of those that are beyond at the end, found by the method of Illinois.
    """
    low, high, at = 0.0, 1.0, 1.0
    at_low, at_high = _largest(work.before, work.turned), _largest(work.after, work.turned)
    for i in range(work.end.size):
        work.last[0, i], work.last[1, i] = work.end[i], work.stage[6, i]
    range_ = at_high - at_low
    for _ in range(_ITERATIONS):
        at = (low * at_high - high * at_low) / (at_high - at_low)
        for i in range(work.end.size):
            rise, rest = work.last[0, i] - work.start[i], 1 - at
            bent = (1 - 2 * at) * rise - rest * h * work.stage[0, i] + at * h * work.last[1, i]
            work.end[i] = work.start[i] + at * (rise - rest * bent)
        _place(course, piece, time + at * h, work.z)
        differentiate(e, tree, numbers, work, work.end, work.stage[6])
        _compare(numbers, work, work.after)
        found = _largest(work.after, work.turned)
        if abs(found) < _LOCATED * range_:
            break
        if found > 0:
            high, at_high, at_low = at, found, at_low / 2
        else:
            low, at_low, at_high = at, found, at_high / 2
    return at


@compilable(error_model="numpy")
def _turn(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, piece: int, time: float, h: float
) -> float:
    """Put in the states where a step first leaves a segment; return the share of the step, 0 at its start."""
    at_start = False
    for i in range(work.after.size):
        work.turned[i] = work.after[i] > 0 and work.before[i] >= 0
        at_start = at_start or work.turned[i]
    share, near = 0.0, 0.0
    if at_start:
        _begin(e, tree, numbers, course, work, piece, time)
    else:
        for i in range(work.after.size):
            work.turned[i] = work.after[i] > 0
        near = _LOCATED * (_largest(work.after, work.turned) - _largest(work.before, work.turned))
        share = _crossing(e, tree, numbers, course, work, piece, time, h)
        _step(e, tree, numbers, course, work, piece, time, share * h)
        _compare(numbers, work, work.after)
        near = min(0.0, _largest(work.after, work.turned)) - near
    for i in range(work.after.size):
        if work.turned[i] and (at_start or work.after[i] >= near):
            _switch(numbers, work, i)
    return share


@compilable(error_model="numpy")
def _begin(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, piece: int, time: float
) -> None:
    """Put in the derivative at the start of a step, and what the laws and tyres have there."""
    _place(course, piece, time, work.z)
    differentiate(e, tree, numbers, work, work.start, work.stage[0])
    _compare(numbers, work, work.before)


@compilable(error_model="numpy")
def _advance(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, piece: int, h: float, tolerance: float
) -> float:
    """Take the states over a piece of the road; return the length of the next step, NaN for a failure."""
    time, duration = 0.0, course.knots[piece + 1] - course.knots[piece]
    for _ in range(_TRIES):
        _begin(e, tree, numbers, course, work, piece, time)
        rest = duration - time
        step = rest if h > 0.99 * rest else h
        _step(e, tree, numbers, course, work, piece, time, step)
        error, share = _error(work, step, tolerance), 1.0
        better = step * min(5.0, max(0.2, 0.9 * (error + 1e-12) ** -0.2))
        if error > 1:
            h = better
            if h < _SHORTEST:
                break
            continue
        _compare(numbers, work, work.after)
        for i in range(work.after.size):
            if work.after[i] > 0:
                share = _turn(e, tree, numbers, course, work, piece, time, step)
                break
        for i in range(work.end.size if share > 0 else 0):
            work.start[i] = work.end[i]
            work.size[i] = max(work.size[i], abs(work.end[i]))
        h = better if better < step or step == h else max(h, better)
        if step == rest and share == 1:
            return h
        time += share * step
    return np.nan


@compiled(error_model="numpy")
def drive(
    e: Equations, tree: Tree, numbers: Numbers, course: Course, start: Real, tolerance: float, rows: Real
) -> bool:
    """Fill in the states and tensions (k, n + q) of the rows, and whether all were reached.

    The start (n,) is NaN throughout for equilibrium on the first heights.
    """
    work, n = work_of(e, tree), start.size
    settled = np.isnan(start[0])
    for i in range(n):
        work.start[i] = 0.0 if settled else start[i]
    _find_segments(e, tree, numbers, course, work)
    if settled and not settle(e, tree, numbers, course, work):
        return False
    h = course.knots[1] - course.knots[0]
    for piece in range(course.knots.size):
        row = course.row[piece]
        for i in range(rows.shape[1] if row >= 0 else 0):
            rows[row, i] = work.start[i] if i < n else work.tension[i - n]
        if piece + 1 < course.knots.size:
            h = _advance(e, tree, numbers, course, work, piece, h, tolerance)
            if np.isnan(h):
                return False
    return True


@compilable(error_model="numpy")
def _find_segments(e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work) -> None:
    """Set the segments of laws and tyres at the start, from those at 0 on, one by one."""
    for i in range(numbers.knots.size):
        locate(numbers, work.scratch, i)
    for _ in range(_ITERATIONS):
        _begin(e, tree, numbers, course, work, 0, 0.0)
        found = True
        for i in range(work.before.size):
            if work.before[i] > 0:
                found = False
                _switch(numbers, work, i)
        if found:
            break


@compilable(error_model="numpy")
def settle(e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work) -> bool:
    """Put in the states of equilibrium on the first heights by Newton's method; return whether it was found.

    The equations are linear while no law leaves its segment; laws of the rate stay on that of 0 m/s.
    """
    n = work.start.size
    slopes = np.zeros((n, n + 1))
    for _ in range(_ITERATIONS):
        _stand(e, tree, numbers, course, work, work.start)
        for i in range(n):
            slopes[i, n] = -work.stage[1, i]
        for j in range(n):
            for i in range(n):
                work.end[i] = work.start[i] + (1.0 if i == j else 0.0)
            _stand(e, tree, numbers, course, work, work.end)
            for i in range(n):
                slopes[i, j] = work.stage[1, i] + slopes[i, n]
        solve(slopes)
        for i in range(n):
            work.start[i] += slopes[i, n]
        _stand(e, tree, numbers, course, work, work.start)
        _compare(numbers, work, work.after)
        found = True
        for i in range(2 * tree.of_rate.size):
            if work.after[i] > 0 and not tree.of_rate[i // 2]:
                locate(numbers, work.scratch, i // 2)
                found = False
        if found:
            largest = 0.0
            for i in range(n):
                largest = max(largest, abs(work.stage[1, i]))
            return largest < _AT_REST
    return False


@compilable(error_model="numpy")
def _stand(e: Equations, tree: Tree, numbers: Numbers, course: Course, work: Work, x: Real) -> None:
    """Put in the derivative of states on the first heights, the road at rest."""
    _place(course, 0, 0.0, work.z)
    for r in range(work.z.shape[1]):
        work.z[1, r] = 0.0
    differentiate(e, tree, numbers, work, x, work.stage[1])


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

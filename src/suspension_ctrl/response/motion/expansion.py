"""Power series of the motion in time, order by order, every law on its present segment.

On its segments a vehicle is linear but for powers of the rate: the term of order k + 1 of the states follows from
the terms of order k like a derivative, see Jorba and Zou [1]_ for integration by such series.

.. [1] A. Jorba and M. Zou, "A software package for the numerical integration of ODEs by means of high-order Taylor
   methods", Experimental Mathematics 14 (2005).
"""

from ...compiled import uncounted
from ...quantities import Real
from .passes import BY_RATE, DEFLECTION, FORCE, RATE, assemble, bend, deflect, gather, set_law, spread
from .system import ROAD, Course, Equations, Work
from .trees import Numbers, Tree

_ITERATIONS = 50  # of Newton's method, at most
_NO_CHANGE = 1e-12  # m/s, of a law's rate


@uncounted(error_model="numpy", forceinline=True)
def place(course: Course, piece: int, time: float, z: Real) -> None:
    """Put in the road and its rate (2, ROAD, r) about a time since the knot [s]."""
    for r in range(z.shape[2]):
        c = course.pieces[piece, r]
        z[0, 0, r] = c[0] + time * (c[1] + time * (c[2] + time * c[3]))
        z[0, 1, r] = c[1] + time * (2 * c[2] + time * 3 * c[3])
        z[0, 2, r], z[0, 3, r] = c[2] + time * 3 * c[3], c[3]
        for k in range(ROAD - 1):
            z[1, k, r] = (k + 1) * z[0, k + 1, r]


@uncounted(error_model="numpy", forceinline=True)
def react(e: Equations, tree: Tree, numbers: Numbers, work: Work, order: int) -> None:
    """Put in what the states of an order give: tensions, values of laws and tyres, rates of the tree."""
    if tree.slots:
        _pull(e, tree, numbers, work, order)
    laws = tree.of_rate.size
    for t in range(e.static.size):
        tension = -e.static[t] if order == 0 else 0.0
        for i in range(e.a.shape[0]):
            tension += e.load[t, i] * work.x[order, i]
        if order < ROAD:
            tension += e.by_road[t] * work.z[0, order, t] + e.by_rate[t] * work.z[1, order, t]
        work.own[order, laws + t] = tension


@uncounted(error_model="numpy", forceinline=True)
def _pull(e: Equations, tree: Tree, numbers: Numbers, work: Work, order: int) -> None:
    """Put in the tensions of the networks and the rates of their states."""
    q, laws, slots = work.tension.shape[1], tree.of_rate.size, work.slots
    for p in range(q):
        slots[DEFLECTION, p], slots[RATE, p] = 0.0, 0.0
    for i in range(work.ports.shape[0]):
        for p in range(q):
            slots[DEFLECTION, p] += work.ports[i, p] * work.x[order, i]
            slots[RATE, p] += work.ports[i, q + p] * work.x[order, i]
    for p in range(q if order < ROAD else 0):
        for r in range(e.standing.shape[1]):
            slots[DEFLECTION, p] += e.standing[p, r] * work.z[0, order, r]
            slots[RATE, p] += e.standing[p, r] * work.z[1, order, r]
    deflect(tree, work, order)
    for _ in range(_ITERATIONS if order == 0 and tree.curved else 1):
        if order == 0:
            for law in range(laws):
                set_law(numbers, work, law)
            assemble(tree, numbers, work)
        elif tree.curved:
            for law in range(laws):
                bend(numbers, work, law, order)
        gather(tree, work, order)
        if spread(tree, numbers, work, order) < _NO_CHANGE:
            break
    for p in range(q):
        work.tension[order, p] = slots[BY_RATE, p] * slots[RATE, p] + slots[FORCE, p]


@uncounted(error_model="numpy", forceinline=True)
def accelerate(e: Equations, work: Work, order: int) -> None:
    """Put in the states of the vehicle of the next order from what those of an order give."""
    v, r, after, columns = e.a.shape[0], e.b.shape[1], work.x[order + 1], work.columns
    for i in range(v):
        after[i] = e.constant[i] if order == 0 else 0.0
    for j in range(v):
        _add(after, columns[j], work.x[order, j])
    for j in range(r if order < ROAD else 0):
        _add(after, columns[v + j], work.z[0, order, j])
        _add(after, columns[v + r + j], work.z[1, order, j])
    for j in range(work.tension.shape[1]):
        _add(after, columns[v + 2 * r + j], work.tension[order, j])
    laws = work.segment.size - e.static.size
    for t in range(e.static.size):
        for i in range(v if work.segment[laws + t] else 0):
            after[i] -= e.push[i, t] * work.own[order, laws + t]
    for i in range(v):
        after[i] /= order + 1


@uncounted(error_model="numpy", forceinline=True)
def _add(total: Real, column: Real, factor: float) -> None:
    """Add a multiple of a column (v,) to the first states of a total."""
    for i in range(column.size):
        total[i] += factor * column[i]


@uncounted(error_model="numpy", forceinline=True)
def states_at(work: Work, terms: int, time: float, x: Real) -> None:
    """Put in the states (n,) a time after the start of the series [s]."""
    for i in range(work.x.shape[1]):
        total = work.x[terms, i]
        for k in range(terms - 1, -1, -1):
            total = total * time + work.x[k, i]
        x[i] = total

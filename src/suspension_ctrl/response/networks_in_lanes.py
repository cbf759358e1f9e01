"""Networks of struts at eight frequencies at a time, see `lanes`: what `network_rows` has at all frequencies."""

from ..compiled import uncounted
from ..quantities import Real
from ..vehicles.networks import MEASURED, PARALLEL
from .lanes import Lanes, Pair, at, fused, product, put, row_at, spread
from .network_rows import COEFFICIENT, DAMPING, INERTANCE, KIND, LAW_OF, LOSS, PART, STIFFNESS, Networks


@uncounted(error_model="numpy", forceinline=True)
def fill_nodes(networks: Networks, w: Lanes, t: int, values: Real, direct: Real, nodes: Real) -> None:
    """Fill in the rows of all nodes (16 (1 + x),) at eight frequencies from the t-th; the first stays 0."""
    node, row = networks.node, networks.row
    for i in range(row.size):
        if row[i] > 0:
            square, one, other = networks.ratio[i] * networks.ratio[i], node[i, PART], node[i, PART + 1]
            if node[i, KIND] == MEASURED:
                square *= values[node[i, COEFFICIENT]]
                own = times(square, at(networks.measured, node[i, COEFFICIENT + 1], t))
            elif node[i, KIND] == PARALLEL:
                (a, b), (c, d) = row_at(nodes, row[one]), row_at(nodes, row[other])
                own = times(square, (a + c, b + d))
            else:
                a, b = stiffness_of(w, direct, one, nodes, row[one])
                c, d = stiffness_of(w, direct, other, nodes, row[other])
                own = joined(square, (a, b), (c, d))
            put(own, nodes, row[i])


@uncounted(forceinline=True)
def direct_at(w: Lanes, elements: Real, i: int) -> Pair:
    """Return the dynamic stiffness of the i-th of direct elements (e, 4) at angular frequencies."""
    k, b = spread(elements[i, STIFFNESS]), spread(-elements[i, INERTANCE])
    return fused(b, w * w, k), fused(spread(elements[i, DAMPING]), w, spread(elements[i, LOSS]))


@uncounted(forceinline=True)
def stiffness_of(w: Lanes, direct: Real, i: int, nodes: Real, row: int) -> Pair:
    """Return the dynamic stiffness of a node by its direct elements (m, 4) and its row."""
    re, im = direct_at(w, direct, i)
    if row > 0:
        x, y = row_at(nodes, row)
        re, im = re + x, im + y
    return re, im


@uncounted(forceinline=True)
def times(factor: float, a: Pair) -> Pair:
    """Return a real number times a."""
    return spread(factor) * a[0], spread(factor) * a[1]


@uncounted(error_model="numpy", forceinline=True)
def joined(square: float, a: Pair, b: Pair) -> Pair:
    """Return a b/(a + b) times the square of an installation ratio."""
    x, y = a[0] + b[0], a[1] + b[1]
    re, im = product(a, b)
    factor = spread(square) / fused(x, x, y * y)
    return fused(re, x, im * y) * factor, fused(im, x, -(re * y)) * factor


@uncounted(error_model="numpy", forceinline=True)
def share_at(networks: Networks, law: int, w: Lanes, direct: Real, nodes: Real) -> Lanes:
    """Return |own deflection over deflection of the port|^2 of a law in series, by filled rows of nodes."""
    node, row, share, own = networks.node, networks.row, spread(networks.square[law]), -1
    for i in range(row.size):
        one, other = node[i, PART], node[i, PART + 1]
        if node[i, LAW_OF] == law:
            own = i
        elif own >= 0 and own in (one, other):
            if node[i, KIND] != PARALLEL:
                beside = other if own == one else one
                a, b = stiffness_of(w, direct, own, nodes, row[own])
                c, d = stiffness_of(w, direct, beside, nodes, row[beside])
                x, y = a + c, b + d
                share = share * fused(c, c, d * d) / fused(x, x, y * y)
            own = i
    return share

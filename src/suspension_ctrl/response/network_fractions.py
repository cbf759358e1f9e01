"""Dynamic stiffness of networks of springs, dampers and inerters as fractions N/S of polynomials in s = jw."""

from functools import reduce
from typing import NamedTuple

from ..compiled import uncounted
from ..quantities import Real
from ..vehicles.elements import LinearElement
from ..vehicles.networks import PARALLEL
from ..vehicles.struts import Parallel, Series, Strut
from ..vehicles.vehicle import Vehicle
from .network_rows import DAMPING, INERTANCE, KIND, PART, STIFFNESS, Networks

DEGREE = 2
"""Largest degree of a numerator and of a denominator."""
PARTS = 2 * (DEGREE + 1)
"""Coefficients of both."""
_NONE = 2 * DEGREE  # more than any

Polynomial = tuple[float, float, float]
"""Coefficients by rising powers of s."""
Product = tuple[float, float, float, float, float]
"""Those of a product of two polynomials."""
Fraction = tuple[Polynomial, Polynomial]
"""Numerator and denominator."""
ZERO, ONE = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)


class Degrees(NamedTuple):
    """Degrees of numerator and denominator."""

    numerator: int
    denominator: int

    @property
    def few(self) -> bool:
        """Whether both are at most the largest."""
        return max(self) <= DEGREE

    def beside(self, order: int) -> "Degrees":
        """Return those of the sum with a polynomial."""
        return Degrees(max(self.numerator, self.denominator + order), self.denominator)


def at_port(vehicle: Vehicle) -> Degrees:
    """Return the degrees of the one strut of a vehicle, beyond the largest if it is no fraction."""
    order = max((one.order for one in vehicle.strut_coefficients if one.gain.any()), default=0)
    found = reduce(_sum, (degrees(network.strut) for network in vehicle.networks), Degrees(0, 0))
    return found.beside(order)


def degrees(strut: Strut) -> Degrees:
    """Return the degrees of the dynamic stiffness of a strut, beyond the largest if it is no fraction."""
    if isinstance(strut, LinearElement):
        return Degrees(strut.order, 0)
    if not isinstance(strut, Parallel):
        return Degrees(_NONE, _NONE)
    parts = map(degrees, strut.parts)
    if isinstance(strut, Series):  # compliances add
        found = reduce(_sum, (Degrees(part.denominator, part.numerator) for part in parts))
        return Degrees(found.denominator, found.numerator)
    return reduce(_sum, parts)


def _sum(one: Degrees, other: Degrees) -> Degrees:
    (a, b), (c, d) = one, other
    return Degrees(max(a + d, c + b), b + d)


@uncounted(forceinline=True)
def fill_fractions(networks: Networks, direct: Real, rows: Real) -> None:
    """Fill in the fractions (1 + x, 6) of parts in series by direct elements (m, 4) of nodes; the first is 0."""
    node, row = networks.node, networks.row
    put(ZERO, ONE, rows, 0)
    for i in range(row.size):
        if row[i] > 0:
            one, other, square = node[i, PART], node[i, PART + 1], networks.ratio[i] * networks.ratio[i]
            if node[i, KIND] == PARALLEL:
                (a, b), (c, d) = row_at(rows, row[one]), row_at(rows, row[other])
                put(scaled(square, plus(times(a, d), times(c, b))), times(b, d), rows, row[i])
            else:
                (a, b), (c, d) = whole(direct, one, rows, row[one]), whole(direct, other, rows, row[other])
                put(scaled(square, times(a, c)), plus(times(a, d), times(c, b)), rows, row[i])


@uncounted(forceinline=True)
def whole(direct: Real, node: int, rows: Real, row: int) -> Fraction:
    """Return the fraction of a node: that of its row and its direct elements."""
    n, d = row_at(rows, row)
    return plus(n, times(element(direct, node), d)), d


@uncounted(forceinline=True)
def element(direct: Real, node: int) -> Polynomial:
    """Return the polynomial of direct elements."""
    return direct[node, STIFFNESS], direct[node, DAMPING], direct[node, INERTANCE]


@uncounted(forceinline=True)
def times(a: Polynomial, b: Polynomial) -> Polynomial:
    """Return a b, of which higher powers are zero."""
    return a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0]


@uncounted(forceinline=True)
def plus(a: Polynomial, b: Polynomial) -> Polynomial:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@uncounted(forceinline=True)
def scaled(factor: float, a: Polynomial) -> Polynomial:
    """Return a number times a."""
    return factor * a[0], factor * a[1], factor * a[2]


@uncounted(forceinline=True)
def mirrored(a: Polynomial, b: Polynomial) -> Product:
    """Return a(-s) b(s)."""
    square = a[0] * b[2] - a[1] * b[1] + a[2] * b[0]
    return a[0] * b[0], a[0] * b[1] - a[1] * b[0], square, a[2] * b[1] - a[1] * b[2], a[2] * b[2]


@uncounted(forceinline=True)
def row_at(rows: Real, row: int) -> Fraction:
    """Return one of fractions in rows (1 + x, 6)."""
    numerator = rows[row, 0], rows[row, 1], rows[row, 2]
    return numerator, (rows[row, 3], rows[row, 4], rows[row, 5])


@uncounted(forceinline=True)
def put(numerator: Polynomial, denominator: Polynomial, rows: Real, row: int) -> None:
    """Fill in one of fractions in rows (1 + x, 6)."""
    rows[row, 0], rows[row, 1], rows[row, 2] = numerator
    rows[row, 3], rows[row, 4], rows[row, 5] = denominator

"""Derivatives of networks as fractions N/S, along changes of their direct elements."""

from ...compiled import uncounted
from ...quantities import Real
from ...vehicles.networks import PARALLEL
from ..network_fractions import (
    ZERO,
    Fraction,
    Polynomial,
    Product,
    element,
    mirrored,
    plus,
    put,
    row_at,
    scaled,
    times,
    whole,
)
from ..network_rows import KIND, PART, Networks


@uncounted(forceinline=True)
def fill_changes(networks: Networks, direct: Real, rows: Real, change: Real, changes: Real) -> None:
    """Fill in the changes (1 + x, 6) of fractions of parts in series by that of direct elements (m, 4)."""
    node, row = networks.node, networks.row
    put(ZERO, ZERO, changes, 0)
    for i in range(row.size):
        if row[i] > 0:
            one, other, square = node[i, PART], node[i, PART + 1], networks.ratio[i] * networks.ratio[i]
            if node[i, KIND] == PARALLEL:
                upper, lower = row_at(rows, row[one]), row_at(rows, row[other])
                d_upper, d_lower = row_at(changes, row[one]), row_at(changes, row[other])
                denominator = change_of_product(upper[1], lower[1], d_upper[1], d_lower[1])
                put(scaled(square, change_of_sum(upper, lower, d_upper, d_lower)), denominator, changes, row[i])
            else:
                upper, lower = whole(direct, one, rows, row[one]), whole(direct, other, rows, row[other])
                d_upper = whole_change(direct, one, rows, row[one], change, changes)
                d_lower = whole_change(direct, other, rows, row[other], change, changes)
                numerator = change_of_product(upper[0], lower[0], d_upper[0], d_lower[0])
                put(scaled(square, numerator), change_of_sum(upper, lower, d_upper, d_lower), changes, row[i])


@uncounted(forceinline=True)
def whole_change(direct: Real, node: int, rows: Real, row: int, change: Real, changes: Real) -> Fraction:
    """Return the change of the fraction of a node."""
    (_, d), (d_n, d_d) = row_at(rows, row), row_at(changes, row)
    return plus(d_n, change_of_product(element(direct, node), d, element(change, node), d_d)), d_d


@uncounted(forceinline=True)
def change_of_product(a: Polynomial, b: Polynomial, d_a: Polynomial, d_b: Polynomial) -> Polynomial:
    """Return the change of a b."""
    return plus(times(d_a, b), times(a, d_b))


@uncounted(forceinline=True)
def change_of_sum(one: Fraction, other: Fraction, d_one: Fraction, d_other: Fraction) -> Polynomial:
    """Return the change of the numerator of the sum of two fractions."""
    first = change_of_product(one[0], other[1], d_one[0], d_other[1])
    return plus(first, change_of_product(other[0], one[1], d_other[0], d_one[1]))


@uncounted(forceinline=True)
def change_of_mirrored(a: Polynomial, b: Polynomial, d_a: Polynomial, d_b: Polynomial) -> Product:
    """Return the change of a(-s) b(s)."""
    u, v = mirrored(d_a, b), mirrored(a, d_b)
    return u[0] + v[0], u[1] + v[1], u[2] + v[2], u[3] + v[3], u[4] + v[4]

"""Mean squares over designs of one strut of springs, dampers and inerters, such as a damper on a mount.

Its dynamic stiffness is a fraction N/S of polynomials in s = jw, by which integrands are ratios of polynomials.
"""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Integer, Real
from .lanes import WIDTH, Lanes, empty, fused, in_lines, load, spread, store
from .network_fractions import PARTS, Degrees, fill_fractions, mirrored, put, row_at, whole
from .network_rows import DIRECT, STATES, Networks, fill_direct, setting_of
from .one_port import OnePort, add_beside
from .one_strut import TOGETHER, add_sums, clear
from .working_point import fill_values

POWERS = 3 * 5
"""Coefficients of S(-s) S(s), S(-s) N(s) and N(-s) N(s)."""
SIX = 6  # rows of the denominator, or twice as many, of which some are zeros


class OneFraction(NamedTuple):
    """Mean squares around a strut of dynamic stiffness N/S, from one frequency response of the plant.

    A response is (a S + b N) / (S + c N): its square and that of the denominator are linear in the coefficients of
    S(-s) S(s), S(-s) N(s) and N(-s) N(s), five of each.
    """

    port: OnePort  # the same strut as any other
    denominator: Real  # (6 or 12, n), of |S + c N|^2; n is a multiple of 16
    below: Integer  # (6 or 12,), the coefficient of each
    numerators: Real  # (q, n), of |a S + b N|^2 times a density, those that are not zero throughout
    term: Integer  # (q,), the term of each numerator
    power: Integer  # (q,), its coefficient

    @property
    def networks(self) -> Networks:
        """The network of the strut."""
        return self.port.networks

    @compiled(nogil=True, error_model="numpy")
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, v), each as if alone."""
        result, room = np.empty((designs.shape[0], self.port.terms)), room_for(self.port.networks)
        clear(result)
        gain, power = empty((TOGETHER, self.denominator.shape[1])), np.zeros((TOGETHER, POWERS))
        for first in range(0, designs.shape[0], TOGETHER):
            count = min(TOGETHER, designs.shape[0] - first)
            for p in range(count):
                fill_fraction(self.port.networks, designs, first + p, room)
                fill_powers(room.rows, p, power)
                fill_gains(self.denominator, self.below, p, power, gain)
            add_sums(self.numerators, self.term, self.power, gain, power, first, count, result)
        return result

    @classmethod
    def of(cls, port: OnePort, degrees: Degrees) -> "OneFraction":
        """Take a port with a strut of these degrees.

        Columns after those of the n frequencies fill up a multiple of two times `WIDTH` and add nothing.
        """
        filled = (0, 0), (0, -port.omega.size % (2 * WIDTH))
        denominator, _, below = _by_powers(port.denominator, np.arange(4), port.omega, degrees)
        denominator = np.pad(denominator, filled, mode="edge")
        missing = -below.size % SIX
        denominator, below = np.pad(denominator, ((0, missing), (0, 0))), np.pad(below, (0, missing))
        numerators, row, power = _by_powers(port.numerators, port.power, port.omega, degrees)
        numerators = np.pad(numerators, filled)
        return cls(port, in_lines(denominator), below, in_lines(numerators), port.term[row], power)


def _by_powers(rows: Real, part: Integer, omega: Real, degrees: Degrees) -> tuple[Real, Integer, Integer]:
    """Return rows by the coefficients of N and S, which each is of, and the coefficient.

    Of rows (r, n) that are by |S|^2, the real and imaginary parts of N/S times that, and |N|^2.
    """
    (n, d), found = degrees, list[tuple[int, int, int]]()
    for row in np.flatnonzero(rows.any(axis=1)).tolist():
        product, first, last = ((0, 0, 2 * d), (1, 0, n + d), (1, 1, n + d), (2, 0, 2 * n))[part[row]]
        found += [(row, 5 * product + m, m) for m in range(first, last + 1, 2)]
    own, coefficient, m = np.ascontiguousarray(np.array(found, dtype=np.int64).reshape(-1, 3).T)
    return rows[own] * (1 - m // 2 % 2 * 2)[:, None] * omega ** m[:, None], own, coefficient


class Room(NamedTuple):
    """Work arrays of a design."""

    values: Real  # (c,), coefficients
    direct: Real  # (m, 4), direct elements of every node
    state: Real  # (0, 8), of force laws
    rows: Real  # (2 + x, 6), fractions of parts in series, and of the port


@compilable()
def room_for(networks: Networks) -> Room:
    """Return work arrays."""
    m, last = networks.row.size, 0
    for i in range(m):
        last = max(last, networks.row[i])
    return Room(setting_of(networks), np.empty((m, DIRECT)), np.empty((0, STATES)), np.empty((2 + last, PARTS)))


@uncounted(forceinline=True)
def fill_fraction(networks: Networks, designs: Real, p: int, room: Room) -> None:
    """Fill in the fraction of the port in one of the designs (p, v), after those of parts in series."""
    root, rows = networks.root[0], room.rows
    fill_values(networks.variable, designs, p, room.values)
    fill_direct(networks, room.values, room.state, room.direct)
    add_beside(networks, room.values, room.direct)
    fill_fractions(networks, room.direct, rows)
    numerator, denominator = whole(room.direct, root, rows, networks.row[root])
    put(numerator, denominator, rows, rows.shape[0] - 1)


@uncounted(error_model="numpy", forceinline=True)
def fill_powers(rows: Real, p: int, power: Real) -> float:
    """Fill in row p (15,) by the last of fractions: products of N and S times a scale that is returned.

    The scale keeps the product of two denominators in range.
    """
    n, d = row_at(rows, rows.shape[0] - 1)
    lower, both, upper = mirrored(d, d), mirrored(d, n), mirrored(n, n)
    scale = 1.0 / (abs(lower[0]) + abs(lower[2]) + abs(lower[4]) + abs(upper[0]) + abs(upper[2]) + abs(upper[4]))
    for m in range(len(lower)):
        power[p, m], power[p, 5 + m], power[p, 10 + m] = scale * lower[m], scale * both[m], scale * upper[m]
    return scale


@uncounted(error_model="numpy")
def fill_gains(denominator: Real, below: Integer, p: int, power: Real, gain: Real) -> None:
    """Fill in row p of the gains |S + c N|^-2 (4, n): one division serves eight frequencies of each half."""
    half, more = gain.shape[1] // 2, below.size > SIX
    factors, others = six(power, p, below, 0), six(power, p, below, below.size - SIX)
    for i in range(0, half, WIDTH):
        one, other = loop_at(denominator, factors, 0, i), loop_at(denominator, factors, 0, half + i)
        if more:
            one = one + loop_at(denominator, others, SIX, i)
            other = other + loop_at(denominator, others, SIX, half + i)
        inverse = spread(1.0) / (one * other)
        store(inverse * other, gain, (p, i))
        store(inverse * one, gain, (p, half + i))


@uncounted(forceinline=True)
def six(power: Real, p: int, below: Integer, j: int) -> tuple[Lanes, ...]:
    """Return the coefficients of six rows of the denominator from the j-th, each eight times."""
    a, b, c = spread(power[p, below[j]]), spread(power[p, below[j + 1]]), spread(power[p, below[j + 2]])
    return a, b, c, spread(power[p, below[j + 3]]), spread(power[p, below[j + 4]]), spread(power[p, below[j + 5]])


@uncounted(forceinline=True)
def loop_at(denominator: Real, factors: tuple[Lanes, ...], row: int, i: int) -> Lanes:
    """Return six summands of the scaled |S + c N|^2 at eight frequencies."""
    found = load(denominator, (row, i)) * factors[0]
    for j in range(1, 6):
        found = fused(load(denominator, (row + j, i)), factors[j], found)
    return found

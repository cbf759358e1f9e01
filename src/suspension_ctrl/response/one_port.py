"""Mean squares over designs of one strut of any kind: ratios of polynomials in its dynamic stiffness."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled
from ..quantities import Complex, Integer, Real
from ..vehicles.networks import INERTER, LAW
from .mean_position import balance
from .network_rows import (
    COEFFICIENT,
    IN_SERIES,
    KIND,
    LAW_OF,
    NEXT,
    OF_RATE,
    SLOPE,
    STATES,
    Networks,
    fill_element,
    fill_rows,
    fill_share,
)
from .ports import Ports
from .working_point import MOST, NEAR, Points, begin, fill_values, guess, improve, keep, linearise

_USUAL = 10.0  # damping by the root of the stiffness: damping ratios of some 0.3 of bodies of some 300 kg


class OnePort(NamedTuple):
    """Mean squares around a strut of dynamic stiffness D, from one frequency response of the plant.

    As in `OneStrut` a response is (a + b D) / (1 + c D): |a + b D|^2 is linear in 1, Re D, Im D and |D|^2.
    """

    networks: Networks
    omega: Real  # (n,) angular frequencies [rad/s]
    denominator: Real  # (4, n), coefficients of |1 + c D|^2
    numerators: Real  # (r, n), of |a + b D|^2 times a density, those that are not zero throughout
    term: Integer  # (r,), the term of each numerator
    power: Integer  # (r,), its polynomial in D
    excitation: Real  # (2, n), of deflection and rate of the port without a strut, times the density
    guess: Real  # (3,), deviations of deflection and rate at a damping [N s/m] of the strut
    terms: int

    @compiled(error_model="numpy")
    def __call__(self, designs: Real) -> Real:
        """Return the mean squares (p, k) of designs (p, v), each as if alone; NaN without a working point."""
        laws, ports = self.networks.law.shape[0], self.networks.sag.size
        nothing = Points(np.empty((0, laws, STATES)), np.empty((0, ports)), np.empty(0, dtype=np.int64))
        return solve(self, designs, nothing)

    @classmethod
    def around(cls, networks: Networks, ports: Ports, f: Real, weight: Real, densities: Real) -> "OnePort":
        """Take ports at `f` (n,) [Hz], the road's density times quadrature weights (n,), and densities (k, n)."""
        omega = 2 * np.pi * f
        p21, p22 = ports.h[:, -1, 0], ports.h[:, -1, 1]
        numerators = np.array(
            [
                density * _square_of_line(by_road, by_strut * p21 - by_road * p22)
                for density, by_road, by_strut in zip(densities, *ports.h.T[:, : ports.m], strict=True)
            ]
        ).reshape(ports.m, 4, omega.size)
        term, power = np.nonzero(numerators.any(axis=2))
        denominator = _square_of_line(np.ones_like(p22), -p22)
        deflection = np.abs(p21) ** 2 * weight
        excitation = np.array([deflection, omega**2 * deflection])
        stiffness = networks.nominal[0, 0] + 1j * omega * _USUAL * np.sqrt(networks.nominal[0, 0])
        loop = 1 - p22 * stiffness
        deviations = np.sqrt((excitation / np.abs(loop) ** 2).sum(axis=1))
        guess = np.array([*deviations, _USUAL * np.sqrt(networks.nominal[0, 0])])
        return cls(networks, omega, denominator, numerators[term, power], term, power, excitation, guess, ports.m)


def _square_of_line(a: Complex, b: Complex) -> Real:
    """Coefficients (4, n) of |a + b D|^2 at 1, Re D, Im D and |D|^2."""
    cross = 2 * a.conj() * b
    return np.stack([np.abs(a) ** 2, cross.real, -cross.imag, np.abs(b) ** 2])


@compilable(error_model="numpy")
def solve(port: OnePort, designs: Real, points: Points) -> Real:
    """Return the mean squares (p, k) of designs (p, v), and fill in their working points if there is room."""
    networks, omega, excitation, denominator = port.networks, port.omega, port.excitation, port.denominator
    numerators, term, power = port.numerators, port.term, port.power
    node, ratio, law, square = networks.node, networks.ratio, networks.law, networks.square
    measured, root, gains, order = networks.measured, networks.root, networks.gain, networks.order
    count, number, by = networks.laws.most, networks.laws.number, networks.laws.by
    variable, values, n, m = networks.variable, networks.setting.copy(), omega.size, ratio.size
    rows, powers, gain, share = np.empty((m, 2, n)), np.ones((4, n)), np.empty(n), np.empty(n)
    curve, state, nodes = np.empty(number.shape[:3]), np.empty((count.size, STATES)), np.empty((m, 3))
    linear, whole, position, total = np.empty(3), np.empty(3), np.zeros(1), networks.total
    anywhere = points.iterations.size > 0 or (law[:, OF_RATE] == 0).any()
    result = np.empty((designs.shape[0], port.terms))
    for p in range(designs.shape[0]):
        fill_values(variable, designs[p], values)
        fill_linear(gains, order, values, linear)
        begin(law, number, by, values, curve, state)
        guess(port.guess, law, count, square, curve, values, linear[1], state)
        reached, iteration = False, 0
        while not reached and iteration < MOST:
            if anywhere:
                balance(networks, curve, values, state, nodes, position)
            else:
                linearise(law, count, curve, values, state)
            if networks.plain:
                add_elements(node, total, law, values, state, linear, whole)
                fill_gain_of_elements(denominator, omega, whole, gain)
            else:
                fill_rows(node, ratio, law, measured, omega, values, state, rows)
                fill_powers(linear, omega, root, rows, powers)
                fill_gain(denominator, powers, gain)
            fill_next(node, ratio, law, square, rows, excitation, gain, share, state)
            reached = improve(law, square, linear[1:2], state, iteration) < NEAR
            iteration += 1
        keep(points, p, state, position, iteration if reached else -1)
        if networks.plain:
            fill_powers(whole, omega, root[:0], rows, powers)
        result[p] = 0.0 if reached else np.nan
        add_terms(numerators, term, power, gain, powers, result[p])
    return result


@compilable(error_model="numpy")
def fill_next(
    node: Integer,
    ratio: Real,
    law: Integer,
    square: Real,
    rows: Real,
    excitation: Real,
    gain: Real,
    share: Real,
    state: Real,
) -> None:
    """Fill in the deviations that result for every law."""
    for i in range(square.size):
        share[:] = square[i]
        if law[i, IN_SERIES]:
            fill_share(node, ratio, i, rows, share)
        state[i, NEXT] = np.sqrt(weighted(gain, excitation[law[i, OF_RATE]], share))


@compilable()
def add_terms(numerators: Real, term: Integer, power: Integer, gain: Real, powers: Real, found: Real) -> None:
    """Add the integrals of the numerators to their terms (k,)."""
    for q in range(power.size):
        found[term[q]] += weighted(gain, numerators[q], powers[power[q]])


@compilable()
def fill_linear(gains: Real, order: Integer, values: Real, linear: Real) -> None:
    """Fill in stiffness, damping and inertance (3,) in parallel with the network."""
    linear[:] = 0.0
    for i in range(order.size):
        linear[order[i]] += gains[i, 0, 0] * values[i]


@compilable()
def add_elements(
    node: Integer, total: Real, law: Integer, values: Real, state: Real, linear: Real, whole: Real
) -> None:
    """Fill in stiffness, damping and inertance (3,) of a strut without series, the linear part included."""
    whole[:] = linear
    for i in range(total.size):
        kind = node[i, KIND]
        if kind == LAW:
            which = node[i, LAW_OF]
            whole[1 if law[which, OF_RATE] else 0] += total[i] * state[which, SLOPE]
        elif kind <= INERTER:
            whole[kind] += total[i] * values[node[i, COEFFICIENT]]  # SPRING, DAMPER, INERTER are 0, 1, 2


@compilable(fastmath={"contract", "nsz"})
def fill_powers(linear: Real, omega: Real, root: Integer, rows: Real, powers: Real) -> None:
    """Fill in Re D, Im D and |D|^2 (rows 1 to 3) of linear elements (3,) and of networks by their last nodes."""
    fill_element(linear[0], linear[1], linear[2], 0.0, omega, powers[1:3])
    re, im, square = powers[1], powers[2], powers[3]
    for last in root:
        real, imaginary = rows[last, 0], rows[last, 1]
        for i in range(re.size):
            re[i] += real[i]
            im[i] += imaginary[i]
    for i in range(re.size):
        square[i] = re[i] * re[i] + im[i] * im[i]


@compiled(inline="always")
def squared_loop(denominator: Real, re: float, im: float, i: int) -> float:
    """Return |1 + c D|^2 at a frequency."""
    lines = denominator[0, i] + denominator[1, i] * re + denominator[2, i] * im
    return lines + denominator[3, i] * (re * re + im * im)


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def fill_gain_of_elements(denominator: Real, omega: Real, whole: Real, gain: Real) -> None:
    """Fill in |1 + c D|^-2 of stiffness, damping and inertance (3,)."""
    k, c, b = whole[0], whole[1], whole[2]
    half = gain.size // 2
    for i in range(half):  # one division for two frequencies, as in `OneStrut`
        w, v = omega[i], omega[half + i]
        one = squared_loop(denominator, k - b * (w * w), c * w, i)
        other = squared_loop(denominator, k - b * (v * v), c * v, half + i)
        inverse = 1.0 / (one * other)
        gain[i], gain[half + i] = inverse * other, inverse * one
    if 2 * half < gain.size:
        w = omega[2 * half]
        gain[2 * half] = 1.0 / squared_loop(denominator, k - b * (w * w), c * w, 2 * half)


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def fill_gain(denominator: Real, powers: Real, gain: Real) -> None:
    """Fill in |1 + c D|^-2 by Re D and Im D."""
    re, im, half = powers[1], powers[2], gain.size // 2
    for i in range(half):
        one = squared_loop(denominator, re[i], im[i], i)
        other = squared_loop(denominator, re[half + i], im[half + i], half + i)
        inverse = 1.0 / (one * other)
        gain[i], gain[half + i] = inverse * other, inverse * one
    if 2 * half < gain.size:
        gain[2 * half] = 1.0 / squared_loop(denominator, re[2 * half], im[2 * half], 2 * half)


@compilable(fastmath={"reassoc", "contract", "nsz"})
def weighted(gain: Real, density: Real, power: Real) -> float:
    """Return the sum of the products of three rows (n,)."""
    total = 0.0
    for i in range(gain.size):
        total += gain[i] * density[i] * power[i]
    return total

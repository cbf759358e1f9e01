"""Mean squares over designs of one strut of any kind: ratios of polynomials in its dynamic stiffness."""

from typing import NamedTuple

import numpy as np

from ..compiled import compilable, compiled, uncounted
from ..quantities import Complex, Integer, Real
from .mean_position import balance
from .network_rows import (
    DIRECT,
    IN_SERIES,
    NEXT,
    OF_RATE,
    SLOPE,
    STATES,
    Networks,
    elements,
    fill_direct,
    fill_rows,
    fill_share,
    moves,
    rows_of,
    setting_of,
    stiffness_at,
)
from .ports import Ports
from .working_point import (
    MOST,
    NEAR,
    SOON,
    Points,
    begin,
    fill_damping,
    fill_values,
    guess,
    improve,
    keep,
    linearise,
)

_ROUNDS = 3  # each leaves some percent of the distance to the damping at the setting
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
    guess: Real  # (3,), deviations of deflection and rate at a damping [N s/m] near that of the setting
    terms: int

    @compilable()
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
        term, power = map(np.ascontiguousarray, np.nonzero(numerators.any(axis=2)))  # as pickles hold them
        denominator = _square_of_line(np.ones_like(p22), -p22)
        deflection = np.abs(p21) ** 2 * weight
        excitation = np.array([deflection, omega**2 * deflection])
        known = _known(networks, omega, p22, excitation)
        return cls(networks, omega, denominator, numerators[term, power], term, power, excitation, known, ports.m)


def _square_of_line(a: Complex, b: Complex) -> Real:
    """Coefficients (4, n) of |a + b D|^2 at 1, Re D, Im D and |D|^2."""
    cross = 2 * a.conj() * b
    return np.stack([np.abs(a) ** 2, cross.real, -cross.imag, np.abs(b) ** 2])


def _known(networks: Networks, omega: Real, feedback: Complex, excitation: Real) -> Real:
    """Return deviations of deflection and rate, and their damping (3,): near that of force laws at the setting."""
    stiffness, damping = networks.nominal[0, 0], _USUAL * np.sqrt(networks.nominal[0, 0])
    for _ in range(_ROUNDS if len(networks.law) else 1):
        loop = 1 - feedback * (stiffness + 1j * omega * damping)
        known = np.array([*np.sqrt((excitation / np.abs(loop) ** 2).sum(axis=1)), damping])
        damping = _damping(networks._replace(same_damping=False), known)
        if not 0.0 < damping < np.inf:
            break
    return known


def _damping(networks: Networks, known: Real) -> float:
    """Return the damping by dampers and laws of the rate at the setting, at the deviations by those known."""
    law, values, beside = networks.law, networks.setting, np.empty(1)
    curve, state = np.empty(networks.laws.number.shape[:3]), np.zeros((len(law), STATES))
    fill_damping(networks, values, beside)
    begin(law, networks.laws, values, curve, state)
    guess(known, networks, curve, values, beside[0], state)
    linearise(law, networks.laws.most, curve, values, state)
    return float(beside[0] + (networks.square * state[:, SLOPE])[law[:, OF_RATE] > 0].sum())


class Room(NamedTuple):
    """Work arrays of a batch of designs, for the design at hand."""

    values: Real  # (c,), coefficients
    curve: Real  # (l, 3, k + 1), of every law
    state: Real  # (l, 8), of every law
    nodes: Real  # (m, 3), at 0 Hz
    position: Real  # (1,), mean deflection of the port
    work: Real  # (3, 1, 1), equations of the position
    damping: Real  # (1,), of dampers beside the network
    direct: Real  # (m, 4), direct elements of every node
    rows: Real  # (1 + x, 2, n), of nodes with parts in series
    gain: Real  # (4, n), |1 + c D|^-2 times 1, Re D, Im D and |D|^2
    share: Real  # (n,), of a law in the deflection


@compilable()
def room_for(networks: Networks, n: int) -> Room:
    """Return work arrays at n frequencies."""
    laws, nodes, number = networks.law.shape[0], networks.row.size, networks.laws.number
    curve, state = np.empty((laws, 3, number.shape[2])), np.empty((laws, STATES))
    rows, gain = rows_of(networks, n), np.empty((4, n))
    values, statics, direct = setting_of(networks), np.empty((nodes, 3)), np.empty((nodes, DIRECT))
    position, work, damping = np.zeros(1), np.empty((3, 1, 1)), np.empty(1)
    return Room(values, curve, state, statics, position, work, damping, direct, rows, gain, np.empty(n))


@compiled(nogil=True, error_model="numpy")
def solve(port: OnePort, designs: Real, points: Points) -> Real:
    """Return the mean squares (p, k) of designs (p, v), and fill in their working points if there is room."""
    networks, room = port.networks, room_for(port.networks, port.omega.size)
    statics = points.iterations.size > 0 or moves(networks)
    result = np.empty((designs.shape[0], port.terms))
    for p in range(designs.shape[0]):
        fill_row(port, room, designs, p, statics, points, result)
    return result


# Functions of a port and its room are inlined: the two are some three hundred words to pass on.
@uncounted(error_model="numpy", forceinline=True)
def fill_row(
    port: OnePort, room: Room, designs: Real, p: int, statics: bool, points: Points, result: Real
) -> None:
    """Fill in the mean squares of one of the designs."""
    fill_values(port.networks.variable, designs, p, room.values)
    if p == 0 or not port.networks.same_damping:
        begin(port.networks.law, port.networks.laws, room.values, room.curve, room.state)
    iterations = settle(port, room, statics)
    keep(points, p, room.state, room.position, iterations)
    for term in range(port.terms):
        result[p, term] = 0.0 if iterations > 0 else np.nan
    add_terms(port.numerators, port.term, port.power, room.gain, p, result)


@compilable(error_model="numpy", forceinline=True)
def settle(port: OnePort, room: Room, statics: bool) -> int:
    """Close the loop at the working point of a design; return the iterations, -1 if it is not reached."""
    networks, law, curve, values, state = port.networks, port.networks.law, room.curve, room.values, room.state
    count, square, plain = networks.laws.most, networks.square, room.rows.shape[0] == 1
    fill_damping(networks, values, room.damping)
    guess(port.guess, networks, curve, values, room.damping[0], state)
    change = np.inf if count.size > 0 else 0.0
    for iteration in range(MOST):
        if statics:
            balance(networks, curve, values, state, room.nodes, room.position, room.work)
        else:
            linearise(law, count, curve, values, state)
        fill_direct(networks, values, state, room.direct)
        add_beside(networks, values, room.direct)
        last = not plain or change < SOON
        if last:
            fill_rows(networks, port.omega, values, room.direct, room.rows)
            close(port, room)
            fill_next(port, room)
        else:
            fill_next_by_port(port, room.direct, state)
        change = improve(law, square, room.damping, state, iteration)
        if last and change < NEAR:
            return iteration + 1
    return -1


@compilable(forceinline=True)
def add_beside(networks: Networks, values: Real, direct: Real) -> None:
    """Add the springs, dampers and inerters beside the network to its direct elements."""
    last, gain, order = networks.root[0], networks.gain, networks.order
    for i in range(order.size):
        direct[last, order[i]] += gain[i, 0, 0] * values[i]


@compilable(error_model="numpy", forceinline=True)
def fill_next(port: OnePort, room: Room) -> None:
    """Fill in the deviations that result for every law, by the closed loop."""
    networks, share, state = port.networks, room.share, room.state
    for i in range(state.shape[0]):
        of_rate = networks.law[i, OF_RATE]
        if networks.law[i, IN_SERIES]:
            fill_share(networks, port.omega, i, room.direct, room.rows, share)
            state[i, NEXT] = np.sqrt(weighted(room.gain, port.excitation, of_rate, share))
        else:
            state[i, NEXT] = np.sqrt(networks.square[i] * product_of(room.gain[0], port.excitation[of_rate]))


@compilable(error_model="numpy", forceinline=True)
def fill_next_by_port(port: OnePort, direct: Real, state: Real) -> None:
    """Fill in the deviations that result for every law of a network without series."""
    networks = port.networks
    deflection, rate = port_squares(port.denominator, port.omega, port.excitation, direct, networks.root[0])
    for i in range(state.shape[0]):
        seen = rate if networks.law[i, OF_RATE] else deflection
        state[i, NEXT] = np.sqrt(networks.square[i] * seen)


@compilable(fastmath={"reassoc", "contract", "nsz"}, error_model="numpy")
def port_squares(denominator: Real, omega: Real, excitation: Real, direct: Real, last: int) -> tuple[float, float]:
    """Return the mean squares of deflection and rate of a port on direct elements."""
    k, c, b, h = elements(direct, last)
    deflection, rate, half = 0.0, 0.0, omega.size // 2
    for i in range(half):  # one division for two frequencies, as in `OneStrut`
        j = half + i
        w, v = omega[i], omega[j]
        one = squared_loop(denominator, k - b * (w * w), h + c * w, i)
        other = squared_loop(denominator, k - b * (v * v), h + c * v, j)
        inverse = 1.0 / (one * other)
        deflection += inverse * (other * excitation[0, i] + one * excitation[0, j])
        rate += inverse * (other * excitation[1, i] + one * excitation[1, j])
    for i in range(2 * half, omega.size):
        one = squared_loop(denominator, k - b * (omega[i] * omega[i]), h + c * omega[i], i)
        deflection, rate = deflection + excitation[0, i] / one, rate + excitation[1, i] / one
    return deflection, rate


@compiled(inline="always")
def squared_loop(denominator: Real, re: float, im: float, i: int) -> float:
    """Return |1 + c D|^2 at a frequency."""
    lines = denominator[0, i] + denominator[1, i] * re + denominator[2, i] * im
    return lines + denominator[3, i] * (re * re + im * im)


@compilable(error_model="numpy", forceinline=True)
def close(port: OnePort, room: Room) -> None:
    """Fill in the gains of the loop with the last node of the network."""
    last = port.networks.root[0]
    fill_gain(port.denominator, port.omega, room.direct, last, room.rows, port.networks.row[last], room.gain)


@compilable(fastmath={"contract", "nsz"}, error_model="numpy")
def fill_gain(denominator: Real, omega: Real, direct: Real, last: int, rows: Real, r: int, gain: Real) -> None:
    """Fill in |1 + c D|^-2 times 1, Re D, Im D and |D|^2 (4, n)."""
    own, row = elements(direct, last), rows[r]
    for i in range(omega.size):
        re, im = stiffness_at(own, omega[i], row, i)
        one = 1.0 / squared_loop(denominator, re, im, i)
        gain[0, i], gain[1, i], gain[2, i], gain[3, i] = one, one * re, one * im, one * (re * re + im * im)


@compilable(fastmath={"reassoc", "contract", "nsz"})
def weighted(gain: Real, excitation: Real, of_rate: int, share: Real) -> float:
    """Return the mean square of the port's deflection or rate, times a share (n,)."""
    total = 0.0
    for i in range(share.size):
        total += gain[0, i] * excitation[of_rate, i] * share[i]
    return total


@uncounted()
def add_terms(numerators: Real, term: Integer, power: Integer, gain: Real, p: int, result: Real) -> None:
    """Add the integrals of the numerators (r, n) to the terms of a design (p, k)."""
    for q in range(power.size):
        result[p, term[q]] += product_of(numerators[q], gain[power[q]])


@compilable(fastmath={"reassoc", "contract", "nsz"})
def product_of(left: Real, right: Real) -> float:
    """Return the sum of the products of two rows (n,)."""
    total = 0.0
    for i in range(left.size):
        total += left[i] * right[i]
    return total

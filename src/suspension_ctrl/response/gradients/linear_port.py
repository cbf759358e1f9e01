"""Derivatives of mean squares around one strut without force laws, forward through its network.

A change of the dynamic stiffness changes |1 + c D|^-2 times 1, Re D, Im D and |D|^2, and these the mean squares as
they make them: with two to four variables that costs half of an adjoint for each measure.
"""

from typing import NamedTuple

import numpy as np

from ...compiled import compilable, compiled, uncounted
from ...quantities import Real
from ..network_rows import STATES, fill
from ..one_port import OnePort, add_terms
from .joints import Joints, joints_of
from .one_port import close
from .tangents import Tangents, fill_tangents, tangents_of
from .wanted import Wanted, combine, fill_weights
from .working_point import Settled, settle, settled_of


class Room(NamedTuple):
    """Work arrays of a batch of designs, for the design at hand."""

    settled: Settled
    joints: Joints
    tangents: Tangents
    gain: Real  # (4, n)
    change: Real  # (4, n), derivative of the gains by a variable
    by_variable: Real  # (v, k), derivatives of the mean squares
    weight: Real  # (s, k)


@compilable()
def room_for(port: OnePort, wanted: Wanted, variables: int) -> Room:
    """Return work arrays."""
    networks, n = port.networks, port.omega.size
    gain, change, weight = np.empty((4, n)), np.empty((4, n)), np.empty(wanted.factor.shape)
    settled, joints, tangents = settled_of(networks, n), joints_of(networks, n), tangents_of(networks, n)
    return Room(settled, joints, tangents, gain, change, np.empty((variables, port.terms)), weight)


@compiled(nogil=True, error_model="numpy")
def with_slopes(port: OnePort, wanted: Wanted, designs: Real) -> tuple[Real, Real]:
    """Return the mean squares (p, k) of designs (p, v), and the derivatives (p, s, v) of what is wanted."""
    (count, variables), measures = designs.shape, wanted.largest.size
    room, states = room_for(port, wanted, variables), np.empty((count, 0, STATES))
    squares, slopes = np.zeros((count, port.terms)), np.empty((count, measures, variables))
    for p in range(count):
        settle(port.networks, designs, p, states, room.settled)
        fill_design(port, wanted, room, p, squares, slopes)
    return squares, slopes


@uncounted(error_model="numpy", forceinline=True)
def fill_design(port: OnePort, wanted: Wanted, room: Room, p: int, squares: Real, slopes: Real) -> None:
    """Fill in the mean squares of one of the designs, by direct elements known, and the derivatives."""
    close(port, room.settled, room.joints, room.gain)
    fill_tangents(port.networks, port.omega, room.joints, room.tangents)
    add_terms(port.numerators, port.term, port.power, room.gain, p, squares)
    fill_weights(wanted, squares, p, room.weight)
    for v in range(room.by_variable.shape[0]):
        fill_change(port.denominator, room.gain, room.tangents.rows[v], room.change)
        fill(room.by_variable[v], 0.0)
        add_terms(port.numerators, port.term, port.power, room.change, v, room.by_variable)
    combine(room.weight, room.by_variable, p, slopes)


@uncounted(fastmath={"contract", "nsz"}, forceinline=True)
def fill_change(denominator: Real, gain: Real, tangent: Real, change: Real) -> None:
    """Fill in the derivatives of gains (4, n) along a derivative of D (2, n)."""
    for t in range(tangent.shape[1]):
        one, by_re, by_im, square = gain[0, t], gain[1, t], gain[2, t], gain[3, t]
        re, im = tangent[0, t], tangent[1, t]
        line = denominator[1, t] * re + denominator[2, t] * im
        both = 2.0 * (by_re * re + by_im * im)
        less = one * line + denominator[3, t] * both
        change[0, t], change[1, t] = -one * less, one * re - by_re * less
        change[2, t], change[3, t] = one * im - by_im * less, both - square * less

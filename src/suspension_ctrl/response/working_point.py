"""Working point of force laws: the standard deviations that the linearised laws themselves cause."""

from math import exp, log, sqrt
from typing import NamedTuple

import numpy as np

from ..compiled import compilable
from ..quantities import Integer, Real
from ..vehicles.networks import Laws, fill_curve
from .gaussian import of_lines, of_power
from .network_rows import (
    CHANGE,
    DEVIATION,
    FORCE,
    MEAN,
    NETWORK,
    NEXT,
    OF_RATE,
    POWER,
    SLOPE,
    STATES,
    STEP,
    TAKEN,
    Networks,
)

MOST = 400
"""Iterations after which the working point counts as not reached."""
NEAR = 1e-8
"""Relative change of every deviation, and of every mean by it, in the last iteration; the error is far smaller."""
SOON = 1e-4
"""Change after which the next iteration is likely to be the last."""
_FIRST_RATE, _FIRST_DEFLECTION = 0.2, 0.01  # m/s and m, standard deviations to begin with
_LARGEST = 2.0  # change of ln s in an iteration
_QUICK = 15  # iterations before steps become shorter
_GUESSES = 2  # steps to the first deviations


class Points(NamedTuple):
    """Working points of p designs; room for none if they are not asked for."""

    state: Real  # (p, l, 8), of every law
    position: Real  # (p, q), mean deflection of every port [m]
    iterations: Integer  # (p,), -1 where the point is not reached


def room_for_points(networks: Networks, p: int) -> Points:
    """Return room for the working points of p designs."""
    laws, ports = len(networks.law), networks.sag.size
    return Points(np.empty((p, laws, STATES)), np.zeros((p, ports)), np.empty(p, dtype=np.int64))


@compilable(error_model="numpy")
def begin(law: Integer, laws: Laws, values: Real, curve: Real, state: Real) -> None:
    """Fill in the curves (l, 3, k + 1) at these coefficients and the first state (l, 8)."""
    for i in range(law.shape[0]):
        fill_curve(laws, i, values, curve[i])
        state[i, DEVIATION] = _FIRST_RATE if law[i, OF_RATE] else _FIRST_DEFLECTION
        state[i, MEAN] = 0.0


@compilable()
def fill_values(variable: Integer, designs: Real, p: int, values: Real) -> None:
    """Put one of the designs (p, v) into the coefficients (c,)."""
    for v in range(variable.size):
        values[variable[v]] = designs[p, v]


@compilable()
def fill_damping(networks: Networks, values: Real, damping: Real) -> None:
    """Fill in the damping (t,) of linear dampers in parallel with each network."""
    gains, order, port = networks.gain, networks.order, networks.port
    for t in range(port.size):
        damping[t] = 0.0
        for c in range(order.size):
            if order[c] == 1:
                damping[t] += gains[c, port[t], port[t]] * values[c]


@compilable()
def relaxation(iteration: int) -> float:
    """Return the share of a step that is taken: all of it at first, less where stiff stops make steps swing."""
    if iteration < 3 * _QUICK:
        return 1.0 if iteration < _QUICK else 0.5
    return 0.15 if iteration < 7 * _QUICK else 0.04


@compilable()
def keep(points: Points, p: int, state: Real, position: Real, iterations: int) -> None:
    """Keep the working point of a design if there is room."""
    if points.iterations.size > 0:
        points.iterations[p] = iterations
        for i in range(position.size):
            points.position[p, i] = position[i]
        for i in range(state.shape[0]):
            for j in range(STATES):
                points.state[p, i, j] = state[i, j]


@compilable(error_model="numpy")
def linearise(law: Integer, count: Integer, curve: Real, values: Real, state: Real) -> None:
    """Fill in force, slope and change of every law, with `count` (l,) knots, at its deviation and mean."""
    for i in range(count.size):
        mean, s = state[i, MEAN], state[i, DEVIATION]
        force, slope, change = of_lines(curve, i, count[i], mean, s)
        if law[i, POWER] >= 0:
            own = of_power(values[law[i, POWER]], values[law[i, POWER + 1]], s)
            slope, change = slope + own[0], change + own[1]
        state[i, FORCE], state[i, SLOPE], state[i, CHANGE] = force, slope, change


@compilable(error_model="numpy", forceinline=True)
def guess(known: Real, networks: Networks, curve: Real, values: Real, damping: float, state: Real) -> None:
    """Take first deviations by those `known` (3,) at another damping: white road velocity keeps s^2 c."""
    law, count, square, x = networks.law, networks.laws.most, networks.square, 0.0
    for step in range(_GUESSES + 1):
        for i in range(count.size):
            state[i, DEVIATION], state[i, MEAN] = known[law[i, OF_RATE]] * sqrt(square[i]) * exp(x), 0.0
        if networks.same_damping or step == _GUESSES:
            break
        linearise(law, count, curve, values, state)
        total, rise = damping, 0.0
        for i in range(count.size):
            if law[i, OF_RATE]:
                total += square[i] * state[i, SLOPE]
                rise += square[i] * state[i, CHANGE]
        if total <= 0.0:
            break
        x += (log(known[2] / total) - 2 * x) / (2 + rise / total)


@compilable(error_model="numpy")
def improve(law: Integer, square: Real, damping: Real, state: Real, iteration: int) -> float:
    """Take the next deviations by those that result from the last; return the largest relative change.

    With white road velocity s^2 c is constant: the logarithm of s has a slope of -e/2 by the elasticity e of the
    total damping c. Beyond that the step is Anderson's of depth 1, a secant for a single law.
    """
    error, product, length = 0.0, 0.0, 0.0
    for i in range(law.shape[0]):
        step = log(state[i, NEXT] / state[i, DEVIATION])
        error = max(error, abs(step))
        step /= 1.0 + 0.5 * elasticity(law, square, damping, state, i)
        difference = step - state[i, STEP]
        product += difference * step
        length += difference * difference
        state[i, NEXT] = step
    back = product / length if 0 < iteration < _QUICK and length > 0.0 else 0.0
    for i in range(law.shape[0]):
        step = state[i, NEXT]
        change = step - back * (state[i, TAKEN] + step - state[i, STEP])
        if not abs(change) < _LARGEST:
            change = max(-_LARGEST, min(step, _LARGEST))
        state[i, TAKEN], state[i, STEP] = relaxation(iteration) * change, step
        state[i, DEVIATION] *= exp(state[i, TAKEN])
    return error


@compilable(error_model="numpy")
def elasticity(law: Integer, square: Real, damping: Real, state: Real, which: int) -> float:
    """Return that of the total damping in parallel with a law of the rate, 0 for a law of the deflection."""
    if not law[which, OF_RATE]:
        return 0.0
    network = law[which, NETWORK]
    total, rise = damping[network], 0.0
    for i in range(law.shape[0]):
        if law[i, OF_RATE] and law[i, NETWORK] == network:
            total += square[i] * state[i, SLOPE]
            rise += square[i] * state[i, CHANGE]
    return rise / total if total > 0.0 else 0.0

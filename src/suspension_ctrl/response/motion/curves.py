"""Force laws in time: curves without jumps, and where a law is on its curve."""

import numpy as np

from ...compiled import compilable
from ...quantities import Real
from ...vehicles.networks import Laws, fill_curve

CREEP = 1e-3
"""Rate [m/s] up to which friction, and a damper by a power of the rate, are straight through the origin."""


@compilable(error_model="numpy")
def fill_law(laws: Laws, law: int, values: Real, knot: Real, slope: Real, base: Real, power: Real) -> int:
    """Fill in knots, slopes, forces at 0 (2k + 3,) and power (2,) of a curve without jumps; return the knots."""
    curve, count = np.empty(laws.number.shape[1:3]), 0
    fill_curve(laws, law, values, curve)
    at, rise, jump = curve[0], curve[1], curve[2]
    slope[0] = rise[0]
    for i in range(laws.most[law]):
        if jump[i] > 0:
            knot[count], slope[count + 1] = at[i] - CREEP, jump[i] / (2 * CREEP) + (rise[i] + rise[i + 1]) / 2
            count += 1
        knot[count], slope[count + 1] = at[i] + (CREEP if jump[i] > 0 else 0.0), rise[i + 1]
        count += 1
    power[0], power[1] = 0.0, 1.0
    if laws.power[law, 0] >= 0:
        power[0], power[1] = values[laws.power[law, 0]], values[laws.power[law, 1]]
        knot[0], knot[1], count = -CREEP, CREEP, 2
        slope[1] = power[0] * CREEP ** (power[1] - 1)
        slope[2] = 0.0
        return count
    base[0], middle = 0.0, 0
    for i in range(count):
        base[i + 1] = base[i] + (slope[i] - slope[i + 1]) * knot[i]
        middle = i + 1 if knot[i] < 0 else middle
    rest = base[middle]
    for i in range(count + 1):
        base[i] -= rest
    return count

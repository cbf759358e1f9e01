"""Linear quadratic regulator with full information: states of the vehicle and of its roads.

Roads cannot be controlled. Feedback is by a Riccati equation of the vehicle alone, the same on any road; what
leads ahead of the road by a Sylvester equation, the least criterion by a Lyapunov equation.
"""

from typing import NamedTuple

import numpy as np

from ...quantities import Real
from .actuated import Actuated
from .road_model import RoadModel

_LEAST_DAMPING = 1e-6  # ratio of a motion that counts


class Regulator(NamedTuple):
    """Forces ``-(feedback x + ahead x_road)``, and the least criterion over all frequencies."""

    feedback: Real  # (q, n)
    ahead: Real  # (q, roads' n)
    least: float


def regulator(plant: Actuated, roads: RoadModel, squares: Real, effort: Real) -> Regulator:
    """Return the controller of least ``sum squares E[terms^2] + sum effort E[forces^2]``.

    `squares` (k,) are factors of the terms, `effort` (q,) of the forces. Of all controllers, linear or not, none
    has a smaller criterion. ValueError if a motion of the vehicle does not count in it.
    """
    from scipy.linalg import solve_continuous_lyapunov, solve_sylvester

    (a, b, by_rate, by_road), (c, d, term_rate, term_road) = plant.rates, plant.terms
    scale = (squares @ d**2 + effort) ** -0.5  # forces in units of which each costs 1
    b, d = b * scale, d * scale
    from_roads = by_rate @ roads.rate + by_road @ roads.displacement
    c_roads = term_rate @ roads.rate + term_road @ roads.displacement
    weighted, weighted_roads, weighted_force = (squares[:, None] * part for part in (c, c_roads, d))
    cost = d.T @ weighted_force + np.diag(effort * scale**2)
    cross, cross_roads = c.T @ weighted_force, c_roads.T @ weighted_force
    p = _riccati(a, b, c.T @ weighted, cost, cross)
    feedback = np.linalg.solve(cost, b.T @ p + cross.T)
    noise = np.vstack([by_rate @ roads.direct, roads.b])
    if not len(roads.a):
        least = np.trace(noise.T @ p @ noise)
        return Regulator(scale[:, None] * feedback, np.zeros((len(effort), 0)), float(least))
    right = p @ from_roads + c.T @ weighted_roads - feedback.T @ cross_roads.T
    p_roads = solve_sylvester((a - b @ feedback).T, roads.a, -right)
    ahead = np.linalg.solve(cost, b.T @ p_roads + cross_roads.T)
    own = from_roads.T @ p_roads
    own = own + own.T + c_roads.T @ weighted_roads - ahead.T @ cost @ ahead
    whole = np.block([[p, p_roads], [p_roads.T, solve_continuous_lyapunov(roads.a.T, -own)]])
    least = np.trace(noise.T @ whole @ noise)
    return Regulator(scale[:, None] * feedback, scale[:, None] * ahead, float(least))


def _riccati(a: Real, b: Real, squares: Real, cost: Real, cross: Real) -> Real:
    """Return the solution P (n, n) with ``A' P + P A + Q = (P B + S) R^-1 (P B + S)'``."""
    from scipy.linalg import solve_continuous_are

    try:
        p = np.asarray(solve_continuous_are(a, b, squares, cost, s=cross), dtype=np.float64)
        poles = np.linalg.eigvals(a - b @ np.linalg.solve(cost, b.T @ p + cross.T))
        damped = bool((poles.real < -_LEAST_DAMPING * np.abs(poles)).all())
    except np.linalg.LinAlgError:
        damped = False
    if not damped:
        needed = "all motions of the vehicle, such as acceleration, travel and tyre load of all wheels"
        raise ValueError(f"measures must count {needed}, for a controller, got some that do not")
    return p

"""Kalman filter: states of vehicle and roads from sensors with white noise, and the controller that uses them."""

from typing import NamedTuple

import numpy as np

from ...quantities import Complex, Real
from .actuated import Actuated
from .regulator import Regulator
from .road_model import RoadModel


class Estimator(NamedTuple):
    """States x of vehicle and roads, estimated by ``x' = A x + B u + L (y - C x - D u)`` from s sensors."""

    a: Real  # (n, n)
    b: Real  # (n, q)
    c: Real  # (s, n)
    d: Real  # (s, q)
    gain: Real  # (n, s), L

    @classmethod
    def of(cls, plant: Actuated, roads: RoadModel, intensity: Real, of_forces: Real) -> "Estimator":
        """Return the estimator of least mean squares of errors.

        White noises of sensors have an `intensity` (s,), those of forces an intensity `of_forces` (q,).
        ValueError if the sensors do not tell all motions that are not damped.
        """
        rates, sensors, n, k = plant.rates, plant.sensors, len(plant.rates.state), len(roads.a)
        from_roads = rates.rate @ roads.rate + rates.road @ roads.displacement
        a = np.block([[rates.state, from_roads], [np.zeros((k, n)), roads.a]])
        b = np.vstack([rates.force, np.zeros((k, rates.force.shape[1]))])
        c = np.hstack([sensors.state, sensors.rate @ roads.rate + sensors.road @ roads.displacement])
        noise = np.hstack([np.vstack([rates.rate @ roads.direct, roads.b]), b * np.sqrt(of_forces)])
        seen = np.hstack([sensors.rate @ roads.direct, sensors.force * np.sqrt(of_forces)])
        scale = intensity**-0.5  # readings in units of their noise
        gain = _kalman(a, scale[:, None] * c, noise, scale[:, None] * seen)
        return cls(a, b, c, sensors.force, gain * scale)

    def forces(self, regulator: Regulator, s: Complex) -> Complex:
        """Return F (k, q, s) at s (k,) [rad/s]: forces are -F times readings without the forces' own share."""
        gains = np.hstack([regulator.feedback, regulator.ahead])
        closed = self.a - self.b @ gains - self.gain @ (self.c - self.d @ gains)
        states = np.linalg.solve(s[:, None, None] * np.eye(len(closed)) - closed, self.gain.astype(complex))
        by_reading = gains @ states
        return np.asarray(np.linalg.solve(np.eye(len(gains)) + by_reading @ self.d, by_reading))


def _kalman(a: Real, c: Real, noise: Real, seen: Real) -> Real:
    """Return L (n, s) with sensors' noises of unit intensity; `noise` (n, t) is `seen` (s, t) by them at once."""
    from scipy.linalg import solve_continuous_are

    spread, cross = np.eye(len(c)) + seen @ seen.T, noise @ seen.T
    try:
        p = solve_continuous_are(a.T, c.T, noise @ noise.T, spread, s=cross)
    except np.linalg.LinAlgError:
        needed = "all motions of the vehicle that are not damped, such as the deflection of each strut"
        raise ValueError(f"sensors must tell {needed}, got some that do not") from None
    return np.asarray(np.linalg.solve(spread, c @ p + cross.T).T)

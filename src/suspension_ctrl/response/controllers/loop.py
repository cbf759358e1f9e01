"""Frequency response of a vehicle with a controller, from its roads as they are to terms and forces."""

from typing import NamedTuple

import numpy as np

from ...quantities import Complex, Real
from .actuated import Actuated, Rows
from .regulator import Regulator
from .road_model import RoadModel


class Loop(NamedTuple):
    """A vehicle at s = jw (k,) around a stable feedback: its states by further forces and by roads."""

    plant: Actuated
    s: Complex  # (k,)
    base: Real  # (q, n)
    by_force: Complex  # (k, n, q)
    by_road: Complex  # (k, n, r)
    road_states: Complex  # (k, roads' n, r)

    @classmethod
    def around(cls, plant: Actuated, roads: RoadModel, f: Real, base: Real) -> "Loop":
        """Take it at f (k,) [Hz]."""
        s: Complex = np.asarray(2j * np.pi * f, dtype=np.complex128)
        rates = plant.rates
        q, r = rates.force.shape[1], rates.rate.shape[1]
        inputs = np.empty((s.size, len(base.T), q + r), dtype=np.complex128)
        inputs[:, :, :q], inputs[:, :, q:] = rates.force, _by_road(rates, s)
        matrix = s[:, None, None] * np.eye(len(base.T)) - (rates.state - rates.force @ base)
        found: Complex = np.asarray(np.linalg.solve(matrix, inputs), dtype=np.complex128)
        return cls(plant, s, base, found[:, :, :q], found[:, :, q:], roads.states(s))

    def regulated(self, regulator: Regulator) -> tuple[Complex, Complex]:
        """Return terms (k, m, r) and forces (k, q, r) by roads with a regulator."""
        return self.closed(regulator.feedback, regulator.ahead @ self.road_states)

    def closed(self, feedback: Real | Complex, forward: Complex) -> tuple[Complex, Complex]:
        """Return terms and forces by roads, forces being ``-feedback x - forward road``.

        Feedback (q, n) or (k, q, n), forward (k, q, r) or 0.
        """
        return self._closed(feedback, forward, self.by_road, _by_road(self.plant.responses, self.s))

    def sensed(self, gain: Complex) -> tuple[Complex, Complex]:
        """Return terms by roads (k, m, r), and by noises of the sensors and of the forces (k, m, s + q).

        Forces are ``-gain`` (k, q, s) times what the sensors read without the forces' share.
        """
        rows, feedback, size = self.plant.sensors, gain @ self.plant.sensors.state, gain.shape[2]
        forward = np.concatenate([gain, gain @ rows.force], axis=2)
        states = np.pad(self.by_force, ((0, 0), (0, 0), (size, 0)))
        direct = np.pad(self.plant.responses.force, ((0, 0), (size, 0)))
        by_noise, _ = self._closed(feedback, forward, states, direct)
        return self.closed(feedback, gain @ _by_road(rows, self.s))[0], by_noise

    def _closed(
        self, feedback: Real | Complex, forward: Complex, open_states: Complex | Real, direct: Complex | Real
    ) -> tuple[Complex, Complex]:
        """Return terms and forces by inputs with states (k, n, r) around the base and terms (k, m, r) at once."""
        own, rows = feedback - self.base, self.plant.responses
        loop = np.eye(len(self.base)) + own @ self.by_force
        further = -np.linalg.solve(loop, own @ open_states + forward)
        states = self.by_force @ further + open_states
        forces = further - self.base @ states
        return np.asarray(rows.state @ states + rows.force @ forces + direct), np.asarray(forces)

    def with_struts(self, stiffness: Complex) -> tuple[Complex, Complex]:
        """Return terms and forces by roads with struts of dynamic stiffness (k, q, q) in place of a controller."""
        rows = self.plant.deflections
        return self.closed(-stiffness @ rows.state, -stiffness @ _by_road(rows, self.s))


def _by_road(rows: Rows, s: Complex) -> Complex:
    """Return the share (k, m, r) of the roads in rows."""
    return np.asarray(s[:, None, None] * rows.rate + rows.road)

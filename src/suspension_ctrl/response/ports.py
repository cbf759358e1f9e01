"""Frequency response of a vehicle from roads and struts to responses and deflections."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from ..quantities import Complex, Real
from ..vehicles.assembly import ResponseName
from ..vehicles.feedback import ORDERS, System, around, gains_by_order, has_states
from ..vehicles.vehicle import Vehicle

_TOGETHER = 1000  # frequencies at which equations are solved together


class Ports(NamedTuple):
    """Frequency response (n, m + q, r + q): m responses and q deflections by r roads and q tensions of struts."""

    h: Complex
    m: int
    r: int

    @classmethod
    def of(
        cls,
        vehicle: Vehicle,
        f: Real,
        responses: Sequence[ResponseName],
        values: Mapping[str, float] | None = None,
        added: Real | None = None,
    ) -> "Ports":
        """Take it at ascending `f` (n,) [Hz] around struts with `values`, closed in state space: no drift.

        Gains (3, q, q) by order may be `added`.
        """
        q = len(vehicle.struts)
        integrals = vehicle.without_jerk(responses)
        distinct = list(dict.fromkeys(integrals))
        gains = gains_by_order(vehicle.strut_coefficients, values or {}, q)
        if added is not None:
            gains += added
        plant = around(vehicle.bare(distinct), gains)
        rows = [*map(distinct.index, integrals), *range(len(distinct), len(distinct) + q)]
        h = paths(plant, f)[:, rows]
        jerks = [i for i, (name, one) in enumerate(zip(responses, integrals, strict=True)) if name != one]
        h[:, jerks] *= 2j * np.pi * f[:, None, None]
        return cls(h, len(responses), len(vehicle.contact_points))

    def around(self, stiffness: Complex) -> "Ports":
        """Return the ports around struts of this dynamic stiffness D (n, q, q): h + h_2 (1 - D h_22)^-1 D h_1."""
        h, m, r = self
        loop = np.eye(stiffness.shape[1]) - stiffness @ h[:, m:, r:]
        return self._replace(h=h + h[:, :, r:] @ np.linalg.solve(loop, stiffness @ h[:, m:]))


def paths(system: System, f: Real) -> Complex:
    """Return H(w) (n, outputs, inputs) at ascending f (n,) [Hz]; rates of roads are added to the roads."""
    omega = 2 * np.pi * f
    h = _frequency_response(system, omega)
    if r := sum(name.endswith("_rate") for name in system.input_labels):
        roads = h[:, :, :r] + 1j * omega[:, None, None] * h[:, :, r : 2 * r]
        h = np.concatenate([roads, h[:, :, 2 * r :]], axis=2)
    return h


def _frequency_response(system: System, omega: Real) -> Complex:
    """Return H(w) (n, outputs, inputs) at ascending w (n,) [rad/s], bit for bit as by python-control.

    That solves frequency by frequency, in 20 times the time: a road of 10,000 points has 100,000 of them.
    """
    if has_states(system) and system.nstates > 1:
        states = np.eye(system.nstates)
        parts = np.split(omega, range(_TOGETHER, omega.size, _TOGETHER))
        with suppress(np.linalg.LinAlgError):  # at a pole
            x = (np.linalg.solve(1j * part[:, None, None] * states - system.A, system.B) for part in parts)
            return np.concatenate([system.C @ one + system.D for one in x])
    return np.moveaxis(system.frequency_response(omega, squeeze=False).frdata, 2, 0)


def dynamic_stiffness(gains: Real, omega: Real) -> Complex:
    """Return D (n, q, q) of gains by order (3, q, q): sum of gain (jw)^order."""
    return np.asarray(np.tensordot((1j * omega[:, None]) ** np.arange(ORDERS), gains, 1))

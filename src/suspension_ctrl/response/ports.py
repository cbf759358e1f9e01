"""Frequency response of a vehicle from roads and struts to responses and deflections."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ..quantities import Complex, Real
from ..vehicles.assembly import ResponseName
from ..vehicles.feedback import ORDERS, around, gains_by_order
from ..vehicles.vehicle import Vehicle


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
    ) -> "Ports":
        """Take it at `f` (n,) [Hz], ascending, around struts with the coefficients `values`, if given.

        They are closed in state space: a body on springs does not drift away at low frequency, which would cost
        digits. A response may be asked for more than once.
        """
        omega = 2 * np.pi * f
        q, r = len(vehicle.struts), len(vehicle.contact_points)
        distinct = list(dict.fromkeys(responses))
        plant = around(vehicle.plant(distinct), gains_by_order(vehicle.parameters, values or {}, q))
        h = np.moveaxis(plant.frequency_response(omega, squeeze=False).frdata, 2, 0)
        h = h[:, [*map(distinct.index, responses), *range(len(distinct), len(distinct) + q)]]
        roads, struts = h[:, :, :r], h[:, :, -q:]
        if h.shape[2] > r + q:  # damped tyres follow the road's rate too
            roads = roads + 1j * omega[:, None, None] * h[:, :, r : 2 * r]
        return cls(np.concatenate([roads, struts], axis=2), len(responses), r)

    def around(self, stiffness: Complex) -> "Ports":
        """Return the ports around struts of this dynamic stiffness D (n, q, q): h + h_2 (1 - D h_22)^-1 D h_1."""
        h, m, r = self
        loop = np.eye(stiffness.shape[1]) - stiffness @ h[:, m:, r:]
        return self._replace(h=h + h[:, :, r:] @ np.linalg.solve(loop, stiffness @ h[:, m:]))


def dynamic_stiffness(gains: Real, omega: Real) -> Complex:
    """Return D (n, q, q) of gains by order (3, q, q): sum of gain (jw)^order."""
    return np.asarray(np.tensordot((1j * omega[:, None]) ** np.arange(ORDERS), gains, 1))

"""A vehicle's frequency response from roads and struts to responses and deflections."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

import control
import numpy as np

from ..quantities import Complex, Real
from ..vehicles.assembly import ResponseName, StrutParameter
from ..vehicles.feedback import around


class Plant(Protocol):
    """The part of a vehicle that its responses to roads are computed from."""

    @property
    def struts(self) -> tuple[str, ...]:
        """Names of the struts (q,)."""

    @property
    def contact_points(self) -> Real:
        """Where the roads touch (r, 2) [m]."""

    @property
    def parameters(self) -> tuple[StrutParameter, ...]:
        """Coefficients of the struts."""

    def plant(
        self, responses: Sequence[ResponseName] | None = None
    ) -> control.StateSpace | control.FrequencyResponseData:
        """Return the model: from roads, their rates, struts to responses, deflections and rates of the struts."""


class Ports(NamedTuple):
    """Frequency response of a plant at n frequencies.

    Parameters
    ----------
    h : (n, m + q, r + q) complex ndarray
        Responses, then deflections of struts, by roads and by tensions of struts.
    m, r : int
        Numbers of responses and of roads.
    """

    h: Complex
    m: int
    r: int

    @classmethod
    def of(
        cls, vehicle: Plant, f: Real, responses: Sequence[ResponseName], gains: tuple[Real, Real] | None = None
    ) -> "Ports":
        """Take it at the frequencies `f` (n,) [Hz], ascending; `responses` may hold one more than once.

        With `gains`, tensions of the struts by deflections and by their rates (q, q), there are such struts in
        place already and the ports are for what is added to them. A body on springs does not drift away at low
        frequency, which would cost digits.
        """
        omega = 2 * np.pi * f
        q, r = len(vehicle.struts), len(vehicle.contact_points)
        distinct = list(dict.fromkeys(responses))  # one may be asked for with several weightings
        plant = vehicle.plant(distinct)
        if gains is not None:
            plant = around(plant, np.hstack(gains))
        h = np.moveaxis(_response(plant, omega), 2, 0)[:, : len(distinct) + q]
        h = h[:, [*map(distinct.index, responses), *range(len(distinct), len(distinct) + q)]]
        roads, struts = h[:, :, :r], h[:, :, -q:]
        if h.shape[2] > r + q:  # damped tyres follow the road's rate too
            roads = roads + 1j * omega[:, None, None] * h[:, :, r : 2 * r]
        return cls(np.concatenate([roads, struts], axis=2), len(responses), r)


def _response(plant: control.StateSpace | control.FrequencyResponseData, omega: Real) -> Complex:
    """Return the frequency response (outputs, inputs, n)."""
    return plant.frequency_response(omega, squeeze=False).frdata

"""Struts as feedback: a plant with a static gain from deflections and their rates to tensions."""

from functools import cached_property
from typing import Any

import control
import numpy as np

from ..quantities import Complex, Real


class MeasuredResponse(control.FrequencyResponseData):  # type: ignore[misc]  # python-control has no types
    """Frequency response that is a cubic spline between its lines and unknown beyond them."""

    def eval(self, omega: Any, squeeze: bool | None = None) -> Complex:
        """Return it at angular frequencies [rad/s]; ValueError beyond the lines."""
        at = np.atleast_1d(omega).real
        check_measured(at, self.omega)
        return control.frd(self._spline(at), at).eval(omega, squeeze=squeeze)

    @cached_property
    def _spline(self) -> Any:
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.omega, self.frdata, axis=2)


def check_measured(omega: Real, lines: Real) -> None:
    """Raise ValueError unless angular frequencies [rad/s] lie within the ascending `lines` of a table."""
    found, known = (np.array([x.min(), x.max()]) / (2 * np.pi) for x in (omega, lines))
    if not known[0] <= found[0] <= found[1] <= known[1]:
        raise ValueError(
            "band must lie within what was measured, {:g} to {:g} Hz, got frequencies from {:g} to {:g} Hz".format(
                *known, *found
            )
        )


def around(
    plant: control.StateSpace | control.FrequencyResponseData, gain: Real
) -> control.StateSpace | control.FrequencyResponseData:
    """Return the plant with a static `gain` (q, 2 q) from its last outputs to its last inputs, which all stay.

    `control.StateSpace.lft` is the same but for its check, which refuses gains above some 1e7.
    """
    q = len(gain)
    if isinstance(plant, control.StateSpace):
        b, c, d, fed = plant.B[:, -q:], plant.C[-2 * q :], plant.D[:, -q:], plant.D[-2 * q :]
        k = np.linalg.solve(np.eye(q) - gain @ fed[:, -q:], gain)
        return control.ss(plant.A + b @ k @ c, plant.B + b @ k @ fed, plant.C + d @ k @ c, plant.D + d @ k @ fed)
    h = np.moveaxis(plant.frdata, 2, 0)
    loop = np.eye(q) - gain @ h[:, -2 * q :, -q:]
    closed = h + h[:, :, -q:] @ np.linalg.solve(loop, gain @ h[:, -2 * q :])
    return MeasuredResponse(np.moveaxis(closed, 0, 2), plant.omega)


def closed(
    plant: control.StateSpace | control.FrequencyResponseData, gain: Real
) -> control.StateSpace | control.FrequencyResponseData:
    """Return the plant with that gain, without the ports of the struts."""
    system, q = around(plant, gain), len(gain)
    names = {"inputs": plant.input_labels[:-q], "outputs": plant.output_labels[: -2 * q], "name": "vehicle"}
    if isinstance(plant, control.StateSpace):
        b, c, d = system.B[:, :-q], system.C[: -2 * q], system.D[: -2 * q, :-q]
        return control.ss(system.A, b, c, d, states=plant.state_labels, **names)
    return MeasuredResponse(system.frdata[: -2 * q, :-q], plant.omega, **names)

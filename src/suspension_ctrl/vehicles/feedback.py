"""Struts as feedback: a plant with gains from deflections and their derivatives to tensions."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, TypeAlias

import control
import numpy as np
from numpy.typing import NDArray

from ..quantities import Complex, Real
from .assembly import StrutParameter

ORDERS = 3  # of the derivative of a deflection in a tension: springs 0, dampers 1, inerters and masses 2
System: TypeAlias = control.StateSpace | control.FrequencyResponseData


class MeasuredResponse(control.FrequencyResponseData):  # type: ignore[misc]  # python-control has no types
    """Frequency response that is a cubic spline between its lines and unknown beyond them."""

    def eval(self, omega: Any, squeeze: bool | None = None) -> Complex:
        """Return it at angular frequencies [rad/s]; ValueError beyond the lines."""
        at = np.atleast_1d(omega).real
        found, known = (np.array([x.min(), x.max()]) / (2 * np.pi) for x in (at, self.omega))
        if not known[0] <= found[0] <= found[1] <= known[1]:
            got = "{:g} to {:g} Hz, got frequencies from {:g} to {:g} Hz".format(*known, *found)
            raise ValueError(f"band must lie within what was measured, {got}")
        return control.frd(self._spline(at), at).eval(omega, squeeze=squeeze)

    @cached_property
    def _spline(self) -> Any:
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.omega, self.frdata, axis=2)


def numbers_of(system: System) -> tuple[NDArray[Any], ...]:
    """Return A, B, C and D, or frequency response and lines [rad/s]: a system itself cannot be pickled."""
    if isinstance(system, control.StateSpace):
        return system.A, system.B, system.C, system.D
    return system.frdata, system.omega


def system_of(numbers: Sequence[NDArray[Any]], **names: Any) -> System:
    """Return the system of these numbers."""
    return control.ss(*numbers, **names) if len(numbers) == 4 else MeasuredResponse(*numbers, **names)


def gains_by_order(parameters: Iterable[StrutParameter], values: Mapping[str, float], q: int) -> Real:
    """Return tensions by deflections and their first and second derivatives (3, q, q); none for other names."""
    gains = np.zeros((ORDERS, q, q))
    for parameter in parameters:
        gains[parameter.order] += values.get(parameter.name, 0.0) * parameter.gain
    return gains


def around(plant: System, gains: Real) -> System:
    """Return the plant, ports included, with struts of these gains (3, q, q) from last outputs to last inputs.

    `control.StateSpace.lft` refuses gains above some 1e7 and has no second derivatives.
    """
    q, names = gains.shape[1], {"inputs": plant.input_labels, "outputs": plant.output_labels}
    if isinstance(plant, control.StateSpace):
        b, c, d, fed = plant.B[:, -q:], plant.C[-2 * q :], plant.D[:, -q:], plant.D[-2 * q :]
        if gains[2].any():
            c, fed = np.vstack([c, c[-q:] @ plant.A]), np.vstack([fed, c[-q:] @ plant.B])
        gain = np.hstack([*gains[: len(c) // q]])
        k = np.linalg.solve(np.eye(q) - gain @ fed[:, -q:], gain)
        matrices = plant.A + b @ k @ c, plant.B + b @ k @ fed, plant.C + d @ k @ c, plant.D + d @ k @ fed
        return control.ss(*matrices, states=plant.state_labels, **names)
    h = np.moveaxis(plant.frdata, 2, 0)
    stiffness = np.tensordot((1j * plant.omega[:, None]) ** np.arange(ORDERS), gains, 1)
    fed = stiffness @ h[:, -2 * q : -q]
    closed = h + h[:, :, -q:] @ np.linalg.solve(np.eye(q) - fed[:, :, -q:], fed)
    return MeasuredResponse(np.moveaxis(closed, 0, 2), plant.omega, **names)


def selected(system: System, outputs: Sequence[str], inputs: Sequence[str], name: str) -> System:
    """Return the system with these outputs and inputs; an input that it does not have has no effect."""
    row, known = [system.output_labels.index(output) for output in outputs], system.input_labels
    column = [known.index(one) if one in known else len(known) for one in inputs]
    names = {"inputs": list(inputs), "outputs": list(outputs), "name": name}
    if isinstance(system, control.StateSpace):
        b, d = (np.pad(matrix, ((0, 0), (0, 1)))[:, column] for matrix in (system.B, system.D))
        return control.ss(system.A.copy(), b, system.C[row], d[row], states=system.state_labels, **names)
    h = np.pad(system.frdata, ((0, 0), (0, 1), (0, 0)))[row][:, column]
    return MeasuredResponse(h, system.omega.copy(), **names)

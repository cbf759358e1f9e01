"""Struts as feedback: a plant with gains from deflections and their derivatives to tensions."""

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import control
import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from ..quantities import Complex, Real
from .assembly import Network, StrutCoefficient
from .struts import Fraction

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


def gains_by_order(coefficients: Iterable[StrutCoefficient], values: Mapping[str, float], q: int) -> Real:
    """Return tensions by deflections and their first and second derivatives (3, q, q); none for other names."""
    gains = np.zeros((ORDERS, q, q))
    for one in coefficients:
        gains[one.order] += values.get(one.name, 0.0) * one.gain
    return gains


class Dynamics(NamedTuple):
    """Struts as gains (3, q, q) by order, and strictly proper filters from deflections to tensions, by port."""

    gains: Real
    filters: tuple[tuple[int, Fraction], ...] = ()

    @classmethod
    def of(cls, networks: Iterable[Network], values: Mapping[str, float], gains: Real) -> "Dynamics":
        """Return gains and networks together; ValueError for force laws and rubber of constant loss."""
        total, filters = gains.copy(), list[tuple[int, Fraction]]()
        for network in networks:
            own = {name.removeprefix(network.prefix): value for name, value in values.items()}
            numerator, denominator = network.strut.fraction(own)
            direct, rest = polynomial.polydiv(numerator, denominator)
            for port in np.flatnonzero(network.share).tolist():
                total[: direct.size, port, port] += direct
                filters += [(port, (np.asarray(rest, dtype=np.float64), denominator))] if rest.any() else []
        return cls(total, tuple(filters))

    def stiffness(self, s: Complex) -> Complex:
        """Return the dynamic stiffness (n, q, q) at s (n,) [rad/s]."""
        stiffness = np.asarray(np.tensordot(s[:, None] ** np.arange(ORDERS), self.gains, 1))
        for port, (numerator, denominator) in self.filters:
            stiffness[:, port, port] += polynomial.polyval(s, numerator) / polynomial.polyval(s, denominator)
        return stiffness

    def around(self, plant: System) -> System:
        """Return the plant, ports included, with these struts from last outputs to last inputs."""
        if not isinstance(plant, control.StateSpace):
            return _around_stiffness(plant, self.stiffness(1j * plant.omega))
        return _with_filters(around(plant, self.gains), self.filters, self.gains.shape[1])


def _with_filters(
    plant: control.StateSpace, filters: Sequence[tuple[int, Fraction]], q: int
) -> control.StateSpace:
    """Return the plant with states of the filters after its own."""
    a, b, c, d = plant.A, plant.B, plant.C, plant.D
    states, first_out, first_in = list(plant.state_labels), len(c) - 2 * q, b.shape[1] - q
    for port, (numerator, denominator) in filters:
        own_a, own_b, own_c = _controllable(numerator, denominator)
        k, deflection, tension = len(own_a), first_out + port, first_in + port
        fed = own_b @ c[deflection : deflection + 1]  # ahead of the new states, which the tension drives
        loop = own_b @ d[deflection : deflection + 1, tension : tension + 1] @ own_c
        by_tension = b[:, tension : tension + 1] @ own_c
        a = np.block([[a, by_tension], [fed, own_a + loop]])
        b = np.vstack([b, own_b @ d[deflection : deflection + 1]])
        c = np.hstack([c, d[:, tension : tension + 1] @ own_c])
        states += [f"{plant.input_labels[tension]}_{len(states) + i}" for i in range(k)]
    return control.ss(a, b, c, d, states=states, inputs=plant.input_labels, outputs=plant.output_labels)


def _controllable(numerator: Real, denominator: Real) -> tuple[Real, Real, Real]:
    """Return A (k, k), B (k, 1) and C (1, k) of a strictly proper fraction, balanced."""
    from scipy.linalg import matrix_balance

    k = denominator.size - 1
    a, c = np.eye(k, k, 1), np.zeros((1, k))
    a[-1] = -denominator[:-1] / denominator[-1]
    c[0, : numerator.size] = numerator / denominator[-1]
    balanced, scale = matrix_balance(a, permute=False)
    b = np.asarray(np.linalg.solve(scale, np.eye(k, 1, 1 - k)), dtype=np.float64)
    return np.asarray(balanced), b, np.asarray(c @ scale)


def _around_stiffness(plant: control.FrequencyResponseData, stiffness: Complex) -> "MeasuredResponse":
    """Return the plant with struts of a dynamic stiffness (n, q, q)."""
    q, h = stiffness.shape[1], np.moveaxis(plant.frdata, 2, 0)
    fed = stiffness @ h[:, -2 * q : -q]
    closed = h + h[:, :, -q:] @ np.linalg.solve(np.eye(q) - fed[:, :, -q:], fed)
    names = {"inputs": plant.input_labels, "outputs": plant.output_labels}
    return MeasuredResponse(np.moveaxis(closed, 0, 2), plant.omega, **names)


def around(plant: System, gains: Real) -> System:
    """Return the plant, ports included, with struts of these gains (3, q, q) from last outputs to last inputs.

    `control.StateSpace.lft` refuses gains above some 1e7 and has no second derivatives.
    """
    if not isinstance(plant, control.StateSpace):
        stiffness = np.tensordot((1j * plant.omega[:, None]) ** np.arange(ORDERS), gains, 1)
        return _around_stiffness(plant, stiffness)
    names = {"inputs": plant.input_labels, "outputs": plant.output_labels}
    matrices = fed_back((plant.A, plant.B, plant.C, plant.D), gains)
    return control.ss(*matrices, states=plant.state_labels, **names)


def fed_back(plant: tuple[Real, Real, Real, Real], gains: Real) -> tuple[Real, Real, Real, Real]:
    """Return A, B, C and D with struts of these gains, see `around`."""
    (a, inputs, outputs, direct), q = plant, gains.shape[1]
    b, c, d, fed = inputs[:, -q:], outputs[-2 * q :], direct[:, -q:], direct[-2 * q :]
    if gains[2].any():
        if fed[-q:, :-q][gains[2].any(axis=0)].any():
            raise ValueError("struts that stand on a road must be without inerter, got one")
        c, fed = np.vstack([c, c[-q:] @ a]), np.vstack([fed, c[-q:] @ inputs])
    gain = np.hstack([*gains[: len(c) // q]])
    k = np.linalg.solve(np.eye(q) - gain @ fed[:, -q:], gain)
    return a + b @ k @ c, inputs + b @ k @ fed, outputs + d @ k @ c, direct + d @ k @ fed


def with_rates(system: System, rates: Mapping[str, str]) -> System:
    """Return the system with further outputs, rates by name of others; ValueError if an input acts on one."""
    labels = system.output_labels
    row = [labels.index(name) for name in rates.values()]
    names = {"inputs": system.input_labels, "outputs": [*labels, *rates]}
    if not isinstance(system, control.StateSpace):
        h = system.frdata
        return MeasuredResponse(np.concatenate([h, 1j * system.omega * h[row]]), system.omega, **names)
    a, b, c, d = system.A, system.B, system.C, system.D
    for rate, direct in zip(rates, d[row], strict=True):
        if direct.any():
            given = system.input_labels[int(np.flatnonzero(direct)[0])]
            needed = f"the output {rate!r} where an input acts on {rates[rate]}"
            raise ValueError(f"system must have {needed}, got {given}")
    c, d = np.vstack([c, c[row] @ a]), np.vstack([d, c[row] @ b])
    return control.ss(a, b, c, d, states=system.state_labels, **names)


def with_copies(system: System, copies: Mapping[str, str], tensions: Mapping[str, str]) -> System:
    """Return the system with further outputs, copies by name of outputs and of `tensions` among the inputs."""
    labels, inputs = system.output_labels, system.input_labels
    row, fed = [labels.index(name) for name in copies.values()], np.eye(len(inputs))
    fed = fed[[inputs.index(name) for name in tensions.values()]]
    names = {"inputs": inputs, "outputs": [*labels, *copies, *tensions]}
    if not isinstance(system, control.StateSpace):
        h = system.frdata
        through = np.repeat(fed[:, :, None], system.omega.size, axis=2)
        return MeasuredResponse(np.concatenate([h, h[row], through]), system.omega, **names)
    c, d = system.C, system.D
    c = np.vstack([c, c[row], np.zeros((len(fed), c.shape[1]))])
    return control.ss(system.A, system.B, c, np.vstack([d, d[row], fed]), states=system.state_labels, **names)


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

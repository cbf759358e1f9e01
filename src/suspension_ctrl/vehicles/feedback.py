"""Struts as feedback: a plant with gains from deflections and their derivatives to tensions."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from ..quantities import Complex, Real
from .assembly import Network, StrutCoefficient
from .state_matrices import StateMatrices
from .struts import Fraction

if TYPE_CHECKING:
    import control

ORDERS = 3  # of the derivative of a deflection in a tension: springs 0, dampers 1, inerters and masses 2
System: TypeAlias = "control.StateSpace | control.FrequencyResponseData"  # or `StateMatrices`


def has_states(system: System) -> bool:
    """Whether a system has A, B, C and D: it is a state space, of python-control or as `StateMatrices`."""
    return hasattr(system, "A")


def numbers_of(system: System) -> tuple[NDArray[Any], ...]:
    """Return A, B, C and D, or frequency response and lines [rad/s]: a system itself cannot be pickled."""
    if has_states(system):
        return system.A, system.B, system.C, system.D
    return system.frdata, system.omega


def system_of(numbers: Sequence[NDArray[Any]], **names: Any) -> System:
    """Return the system of python-control of these numbers."""
    import control

    return control.ss(*numbers, **names) if len(numbers) == 4 else measured(*numbers, **names)


def measured(h: Complex, omega: Real, **names: Any) -> System:
    """Return the frequency response h (m, p, n) at w (n,) [rad/s]."""
    from .measured_response import MeasuredResponse

    return MeasuredResponse(h, omega, **names)


def _with(system: System, matrices: tuple[Real, Real, Real, Real], **names: Any) -> System:
    """Return a state space of the kind of `system`, with the names of its signals where no others are given."""
    names = {
        "states": system.state_labels, "inputs": system.input_labels, "outputs": system.output_labels,
        "name": None, **names,
    }  # fmt: skip
    return (
        StateMatrices(*matrices, *names.values())
        if isinstance(system, StateMatrices)
        else system_of(matrices, **names)
    )


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
        if not has_states(plant):
            return _around_stiffness(plant, self.stiffness(1j * plant.omega))
        return _with_filters(around(plant, self.gains), self.filters, self.gains.shape[1])


def _with_filters(plant: System, filters: Sequence[tuple[int, Fraction]], q: int) -> System:
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
    return _with(plant, (a, b, c, d), states=states)


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


def _around_stiffness(plant: System, stiffness: Complex) -> System:
    """Return the plant with struts of a dynamic stiffness (n, q, q)."""
    q, h = stiffness.shape[1], np.moveaxis(plant.frdata, 2, 0)
    fed = stiffness @ h[:, -2 * q : -q]
    closed = h + h[:, :, -q:] @ np.linalg.solve(np.eye(q) - fed[:, :, -q:], fed)
    names = {"inputs": plant.input_labels, "outputs": plant.output_labels}
    return measured(np.moveaxis(closed, 0, 2), plant.omega, **names)


def around(plant: System, gains: Real) -> System:
    """Return the plant, ports included, with struts of these gains (3, q, q) from last outputs to last inputs.

    `control.StateSpace.lft` refuses gains above some 1e7 and has no second derivatives.
    """
    if not has_states(plant):
        stiffness = np.tensordot((1j * plant.omega[:, None]) ** np.arange(ORDERS), gains, 1)
        return _around_stiffness(plant, stiffness)
    return _with(plant, fed_back((plant.A, plant.B, plant.C, plant.D), gains))


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
    if not has_states(system):
        h = system.frdata
        return measured(np.concatenate([h, 1j * system.omega * h[row]]), system.omega, **names)
    a, b, c, d = system.A, system.B, system.C, system.D
    for rate, direct in zip(rates, d[row], strict=True):
        if direct.any():
            given = system.input_labels[int(np.flatnonzero(direct)[0])]
            needed = f"the output {rate!r} where an input acts on {rates[rate]}"
            raise ValueError(f"system must have {needed}, got {given}")
    c, d = np.vstack([c, c[row] @ a]), np.vstack([d, c[row] @ b])
    return _with(system, (a, b, c, d), **names)


def with_copies(system: System, copies: Mapping[str, str], tensions: Mapping[str, str]) -> System:
    """Return the system with further outputs, copies by name of outputs and of `tensions` among the inputs."""
    labels, inputs = system.output_labels, system.input_labels
    row, fed = [labels.index(name) for name in copies.values()], np.eye(len(inputs))
    fed = fed[[inputs.index(name) for name in tensions.values()]]
    names = {"inputs": inputs, "outputs": [*labels, *copies, *tensions]}
    if not has_states(system):
        h = system.frdata
        through = np.repeat(fed[:, :, None], system.omega.size, axis=2)
        return measured(np.concatenate([h, h[row], through]), system.omega, **names)
    c, d = system.C, system.D
    c = np.vstack([c, c[row], np.zeros((len(fed), c.shape[1]))])
    return _with(system, (system.A, system.B, c, np.vstack([d, d[row], fed])), **names)


def selected(system: System, outputs: Sequence[str], inputs: Sequence[str], name: str) -> System:
    """Return the system with these outputs and inputs; an input that it does not have has no effect."""
    row, known = [system.output_labels.index(output) for output in outputs], system.input_labels
    column = [known.index(one) if one in known else len(known) for one in inputs]
    names = {"inputs": list(inputs), "outputs": list(outputs), "name": name}
    if has_states(system):
        b, d = (np.pad(matrix, ((0, 0), (0, 1)))[:, column] for matrix in (system.B, system.D))
        return _with(system, (system.A.copy(), b, system.C[row], d[row]), **names)
    h = np.pad(system.frdata, ((0, 0), (0, 1), (0, 0)))[row][:, column]
    return measured(h, system.omega.copy(), **names)

"""Scores of a ride problem by functions of complex designs, and their derivatives by complex steps.

Real and imaginary parts of frequency responses are kept apart, each an analytic function of the design: a step of
1e-30 j changes no real part, and the imaginary part is the derivative to rounding. Loops are solved by numpy, from
the ports of the vehicle. Force laws are iterated to their working point, by error functions of complex numbers; a
port has laws of its own.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import reduce
from operator import add
from typing import Any

import numpy as np
from scipy.special import erfc, gamma

from suspension_ctrl import MeasuredStiffness, RideProblem, Rubber
from suspension_ctrl.response import weightings
from suspension_ctrl.response.load_case import LoadCase
from suspension_ctrl.response.mapped import unmapped
from suspension_ctrl.response.measures.limits import Limit
from suspension_ctrl.response.measures.terms import CaseMeasure, Term
from suspension_ctrl.response.ports import Ports
from suspension_ctrl.response.quadrature import frequency_nodes
from suspension_ctrl.vehicles.elements import LinearElement
from suspension_ctrl.vehicles.force_laws import Curve, ForceLaw
from suspension_ctrl.vehicles.formulas import Formulas
from suspension_ctrl.vehicles.struts import Parallel, Series, Strut
from suspension_ctrl.vehicles.varied import Varied, ported, setting_of
from suspension_ctrl.vehicles.vehicle import coefficients_by_name

STEP = 1e-30
_SHARE = 0.6  # of a step to the working point: contracts for elasticities of damping from -1 to 4


def jacobian(problem: RideProblem, design: np.ndarray, of: slice = slice(None)) -> np.ndarray:
    """Return the derivatives (m + c, d) at a design (d,) without zeros, by all variables or some."""
    steps = (design + 1j * STEP * np.diag(design))[of]
    return np.array([scores(problem, step).imag / (STEP * x) for step, x in zip(steps, design[of], strict=True)]).T


def scores(problem: RideProblem, design: np.ndarray) -> np.ndarray:
    """Return the objectives and constraints (m + c,) at a complex design (d,)."""
    judged = [*problem.measures, *problem.constraints]
    by_case = [problem.scoring.in_cases(one) for one in judged]
    found = np.array(
        [_squares(problem, c, [one[c] for one in by_case], design) for c in range(len(problem.cases))]
    )
    shares = np.array([case.share for case in problem.cases])
    values = []
    for one, squares in zip(judged, found.T, strict=True):
        worst = problem.worst_case or isinstance(one, Limit)
        total = squares[squares.real.argmax()] if worst else squares @ shares / shares.sum()
        scale, offset = (one.scale, one.offset) if isinstance(one, Limit) else (one.sign, 0.0)
        values.append(scale * np.sqrt(total) + offset)
    return np.array(values)


def _squares(problem: RideProblem, c: int, measures: list[CaseMeasure], design: np.ndarray) -> np.ndarray:
    """Return the sum or the largest of the terms of each measure (s,) in a load case."""
    terms, case = list(dict.fromkeys(term.integral for one in measures for term in one.terms)), problem.cases[c]
    fixed = coefficients_by_name(problem.struts, {})
    vehicle = ported(case.vehicle, problem.variables, fixed, problem.cases[0].vehicle)
    middle = {name: (low + high) / 2 for name, (low, high) in problem.bounds.items()}
    origin = setting_of(vehicle, middle, problem.struts)
    given = dict(zip(problem.variables, design, strict=True))
    if isinstance(vehicle, Varied):
        given = dict(zip(vehicle.varying, by_formulas(vehicle.formulas, design), strict=True))
    own, inner = (
        LoadCase(vehicle=vehicle, road=case.road, speed=case.speed),
        problem.scores.kernel(problem.nodes).cases[c],
    )
    ride = Ride(own, terms, origin, {**origin, **given}, problem, unmapped(inner, np.empty((0, 0)))[0])
    squares, found = dict(zip(terms, ride.mean_squares(), strict=True)), []
    for one in measures:
        parts = np.array([term.factor**2 * squares[term.integral] for term in one.terms])
        found.append(parts[parts.real.argmax()] if one.largest else parts.sum())
    return np.array(found)


def by_formulas(formulas: Formulas, design: np.ndarray) -> np.ndarray:
    """Return the coefficients (w,) of a complex design (d,)."""
    slots = np.array(formulas.start, dtype=complex)
    slots[: design.size] = design
    for target, factor, base, power in zip(
        formulas.target, formulas.factor, formulas.base, formulas.power, strict=True
    ):
        slots[target] += factor * np.prod([slots[b] ** p for b, p in zip(base, power, strict=True) if b >= 0])
    return slots[formulas.result]


class Apart:
    """A complex number, array or matrix with real and imaginary part apart."""

    def __init__(self, re: Any, im: Any = 0.0) -> None:
        self.re, self.im = re, im

    @classmethod
    def of(cls, values: np.ndarray) -> "Apart":
        return cls(values.real, values.imag)

    def __add__(self, other: "Apart") -> "Apart":
        return Apart(self.re + other.re, self.im + other.im)

    def __sub__(self, other: "Apart") -> "Apart":
        return Apart(self.re - other.re, self.im - other.im)

    def __mul__(self, other: "Apart") -> "Apart":
        return Apart(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)

    def __matmul__(self, other: "Apart") -> "Apart":
        return Apart(self.re @ other.re - self.im @ other.im, self.re @ other.im + self.im @ other.re)

    def __truediv__(self, other: "Apart") -> "Apart":
        size = other.square()
        return self * Apart(other.re / size, -other.im / size)

    def __getitem__(self, key: Any) -> "Apart":
        return Apart(self.re[key], self.im[key])

    def square(self) -> np.ndarray:
        return self.re**2 + self.im**2

    def solve(self, right: "Apart") -> "Apart":
        """Return the solution of linear equations (n, q, q), of twice as many real ones."""
        whole = np.concatenate([np.concatenate([self.re, -self.im], 2), np.concatenate([self.im, self.re], 2)], 1)
        found = np.linalg.solve(whole, np.concatenate([right.re, right.im], 1))
        return Apart(*np.split(found, 2, axis=1))


def power_of_jw(omega: np.ndarray, order: int) -> Apart:
    """Return (jw)^order (n,)."""
    zero = np.zeros_like(omega)
    return (Apart(zero + 1.0, zero), Apart(zero, omega), Apart(-(omega**2), zero))[order]


class Law:
    """A force law at a port: deviation and mean of its deflection or rate, mean force and slope."""

    def __init__(self, law: ForceLaw) -> None:
        self.law = law
        self.s, self.mean, self.force, self.slope = 0.2 if law.of_rate else 0.01, 0.0, 0.0, 0.0

    def linearise(self, values: list[complex]) -> None:
        self.force, self.slope = gaussian(self.law.curve, values, self.mean, self.s)


def gaussian(curve: Curve, values: list[complex], mean: complex, s: complex) -> tuple[complex, complex]:
    """Return mean force and mean slope of a curve."""

    def product(factors: tuple[float, tuple[int, ...]]) -> complex:
        return factors[0] * np.prod([values[i] for i in factors[1]])

    slopes, jumps = [product(one) for one in curve.slopes], [product(one) for one in curve.jumps]
    force, slope = slopes[0] * mean, slopes[0]
    for i, (constant, factors) in enumerate(curve.knots):
        knot, rise, jump = constant + product(factors), slopes[i + 1] - slopes[i], jumps[i] if jumps else 0.0
        z = (knot - mean) / s
        above, density = erfc(complex(z) / np.sqrt(2)) / 2, np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi)
        force += rise * (s * (density - z * above) + (knot if np.real(knot) < 0 else 0.0))
        force += jump * (above - 0.5 + 0.5 * np.sign(np.real(knot)))
        slope += rise * above + jump * density / s
    if curve.power:
        c, a = (values[i] for i in curve.power)
        slope += c * a * (np.sqrt(2) * s) ** (a - 1) * gamma(complex(a) / 2) / np.sqrt(np.pi)
    return force, slope


@dataclass
class Placed:
    """A strut of networks at a port, with its laws and its values by name."""

    strut: Strut
    port: int
    values: Mapping[str, complex]
    laws: dict[int, Law] = field(default_factory=dict)
    first: dict[int, complex] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.laws = {id(one): Law(one) for one in self.strut.elements if isinstance(one, ForceLaw)}

    def own(self, element: Strut) -> list[complex]:
        return [self.values[one.name] for one in element.coefficients]

    def stiffness(self, strut: Strut, omega: np.ndarray) -> Apart:
        """Return the dynamic stiffness (n,) at w (n,)."""
        square, one = Apart(strut.installation_ratio**2), np.ones_like(omega)
        if isinstance(strut, Series):
            return square / self.compliance(strut, omega)
        if isinstance(strut, Parallel):
            return square * reduce(add, (self.stiffness(part, omega) for part in strut.parts))
        if isinstance(strut, ForceLaw):
            return square * Apart(self.laws[id(strut)].slope) * power_of_jw(omega, int(strut.of_rate))
        values = self.own(strut)
        if isinstance(strut, Rubber):
            return square * Apart(values[0] * one, values[1] * one)
        if isinstance(strut, MeasuredStiffness):
            rows = (np.interp(omega / (2 * np.pi), strut.frequency, part) for part in (strut.storage, strut.loss))
            return square * Apart(values[0]) * Apart(*rows)
        assert isinstance(strut, LinearElement)
        return square * Apart(values[0]) * power_of_jw(omega, strut.order)

    def compliance(self, strut: Series, omega: np.ndarray) -> Apart:
        """Return the sum of the compliances (n,) of the parts."""
        return reduce(add, (Apart(np.ones_like(omega)) / self.stiffness(part, omega) for part in strut.parts))

    def shares(self, strut: Strut, omega: np.ndarray, above: Apart) -> Iterator[tuple[Law, Apart]]:
        """Yield each law with its deflection by that of the port (n,)."""
        above = above * Apart(strut.installation_ratio)
        if isinstance(strut, ForceLaw):
            yield self.laws[id(strut)], above
        if isinstance(strut, Parallel):
            for part in strut.parts:
                own = above
                if isinstance(strut, Series):
                    own = above / self.compliance(strut, omega) / self.stiffness(part, omega)
                yield from self.shares(part, omega, own)

    def tension(self, strut: Strut, x: complex) -> tuple[complex, complex]:
        """Return mean tension and stiffness at rest for a mean deflection, and move the laws to their means."""
        ratio = strut.installation_ratio
        x = ratio * x
        if isinstance(strut, Series):
            force, stiffness = self.in_series(strut.parts, x)
        elif isinstance(strut, Parallel):
            force, stiffness = map(sum, zip(*(self.tension(part, x) for part in strut.parts), strict=True))
        elif isinstance(strut, ForceLaw):
            law = self.laws[id(strut)]
            law.mean = 0.0 if strut.of_rate else x
            law.linearise(self.own(strut))
            force, stiffness = law.force, 0.0 if strut.of_rate else law.slope
        else:
            stiffness = strut.static_stiffness(self.values) / ratio**2
            force = stiffness * x
        return ratio * force, ratio**2 * stiffness

    def in_series(self, parts: tuple[Strut, ...], x: complex) -> tuple[complex, complex]:
        """Return them for parts in series: Newton's steps from the last deflection of the first."""
        if len(parts) == 1:
            return self.tension(parts[0], x)
        first, rest = self.first.get(id(parts[0]), 0.5 * x), parts[1:]
        for _ in range(2):
            (force, k), (other, k_rest) = self.tension(parts[0], first), self.in_series(rest, x - first)
            first += (other - force) / (k + k_rest) if k + k_rest != 0 else 0.0
        self.first[id(parts[0])] = first
        return force, k * k_rest / (k + k_rest) if k + k_rest != 0 else 0.0


class Ride:
    """Mean squares of terms at complex values of the coefficients, by ports around an origin."""

    def __init__(self, case, terms: list[Term], origin, values, problem: RideProblem, inner) -> None:
        self.case, self.origin, self.values, self.inner = case, origin, values, inner
        self.weights = [term.weighting and weightings.by_name(term.weighting) for term in terms]
        kinks = {f for one in self.weights if one for f in one.breakpoints}
        self.f, self.w = frequency_nodes(problem.band, problem.nodes, kinks.union(case.breakpoints))
        self.terms, self.omega = terms, 2 * np.pi * self.f
        self.placed = [
            Placed(network.strut, port, {n.removeprefix(network.prefix): v for n, v in values.items()})
            for network in case.vehicle.networks
            for port in np.flatnonzero(network.share).tolist()
        ]
        q = len(case.vehicle.struts)
        self.position = np.zeros(q, dtype=complex)
        self.nominal = np.zeros((3, q, q))  # a usual strut in place of each network
        for one in self.placed:
            self.nominal[:2, one.port, one.port] = 2e4, 1500.0
        self.ports = Ports.of(case.vehicle, self.f, [term.response for term in terms], origin, self.nominal)
        self.roads = case.cross_spectrum(self.f)

    def mean_squares(self) -> np.ndarray:
        """Return the mean squares (k,)."""
        if any(one.laws for one in self.placed):
            self.settle()
        factors = [
            self.w * self.omega**term.moment * (one.factor(self.f) ** 2 if one else 1.0)
            for term, one in zip(self.terms, self.weights, strict=True)
        ]
        return (self.spectra(self.closed()[:, : self.ports.m]).T * factors).sum(axis=1)

    def spectra(self, h: Apart) -> np.ndarray:
        """Return the spectra (n, k) of responses by roads (n, k, r)."""
        caused = h @ Apart.of(self.roads)
        return (caused.re * h.re + caused.im * h.im).sum(axis=2)

    def closed(self) -> Apart:
        """Return responses and deflections by roads (n, m + q, r): h + h_2 (1 - D h_22)^-1 D h_1."""
        m, r, h = self.ports.m, self.ports.r, Apart.of(self.ports.h)
        q = self.nominal.shape[1]
        stiffness = Apart(*np.zeros((2, self.f.size, q, q), dtype=complex))
        for order, gain in enumerate(self.nominal):
            stiffness -= power_of_jw(self.omega, order)[:, None, None] * Apart(gain)
        for one in self.case.vehicle.strut_coefficients:
            change = self.values[one.name] - self.origin[one.name]
            stiffness += power_of_jw(self.omega, one.order)[:, None, None] * Apart(change * one.gain)
        for placed in self.placed:
            own = placed.stiffness(placed.strut, self.omega)
            stiffness.re[:, placed.port, placed.port] += own.re
            stiffness.im[:, placed.port, placed.port] += own.im
        loop = Apart(np.eye(q)) - stiffness @ h[:, m:, r:]
        return h[:, :, :r] + h[:, :, r:] @ loop.solve(stiffness @ h[:, m:, :r])

    def settle(self) -> None:
        """Iterate the deviations of all laws until neither real nor imaginary part changes."""
        for _ in range(300):
            self.balance()
            spectra, changes = self.spectra(self.closed()[:, self.ports.m :]), []
            for one in self.placed:
                for law, share in one.shares(one.strut, self.omega, Apart(np.ones_like(self.omega))):
                    own = spectra[:, one.port] * self.w * share.square()
                    total = (own * (self.omega**2 if law.law.of_rate else 1.0)).sum()
                    step = 0.5 * np.log(total / law.s**2)
                    law.s = law.s * np.exp(_SHARE * step)
                    changes += [abs(step.real), abs(step.imag) / STEP]
            if max(changes) < 1e-13:
                break

    def balance(self) -> None:
        """Move ports and laws to mean deflections, d = sag + C (F(d) - K0 d) of the case, by two steps."""
        networks, q = self.inner.networks, len(self.case.vehicle.struts)
        straight, weight = np.zeros((q, q), dtype=complex), np.zeros(q, dtype=complex)
        for c, name in enumerate(self.origin):
            straight += self.values[name] * networks.gain[c] if networks.order[c] == 0 else 0.0
            weight += self.values[name] * networks.weight[c] * np.diag(networks.gain[c])
        d = self.position
        for _ in range(2):
            force, stiffness = straight @ d + weight, straight.copy()
            for one in self.placed:
                tension, k = one.tension(one.strut, d[one.port])
                force[one.port] += tension
                stiffness[one.port, one.port] += k
            off = d - networks.sag - networks.compliance @ (force - networks.nominal @ d)
            d -= np.linalg.solve(np.eye(q) - networks.compliance @ (stiffness - networks.nominal), off)
        self.position = d

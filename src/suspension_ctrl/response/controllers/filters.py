"""Rational filters as chains of sections of first and second order, each scaled by its own frequency."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...quantities import Complex, Real

_ROUNDING = 1e-13  # of the imaginary part of a real root


class Filter(NamedTuple):
    """A filter of one input and one output: x' = A x + b u, y = c x + d u."""

    a: Real  # (n, n)
    b: Real  # (n,)
    c: Real  # (n,)
    d: float

    @classmethod
    def of(cls, zeros: ArrayLike, poles: ArrayLike, gain: float) -> "Filter":
        """Return ``gain prod(s - zeros)/prod(s - poles)``, poles no fewer than zeros, conjugates in pairs."""
        chain = cls(np.empty((0, 0)), np.empty(0), np.empty(0), 1.0)
        for b, a in _sections(zeros, poles):
            corner = 1j * (np.sqrt(a[2]) if a[0] else a[2])
            size = np.abs(np.polyval(b, corner) / np.polyval(a, corner))  # states of all sections are of one size
            chain, gain = chain.before(cls._section(b / size, a)), float(gain * size)
        return chain._replace(c=gain * chain.c, d=gain * chain.d)

    @classmethod
    def of_system(cls, system: Any) -> "Filter":
        """Return a state space of python-control with one input and one output."""
        zeros, poles = system.zeros(), system.poles()
        at = 1.0 + np.abs(np.concatenate([zeros, poles])).max(initial=0.0)  # beyond all of them
        gain = np.real(system(at) * np.prod((at - poles) / at) / np.prod((at - zeros) / at))
        return cls.of(zeros, poles, float(gain * at ** (len(poles) - len(zeros))))

    @classmethod
    def of_quotient(cls, numerator: Real, denominator: Real) -> "Filter":
        """Return the quotient of two polynomials, highest powers first."""
        return cls.of(np.roots(numerator), np.roots(denominator), float(numerator[0] / denominator[0]))

    def before(self, other: "Filter") -> "Filter":
        """Return this filter with another behind it."""
        a = np.block([[self.a, np.zeros((len(self.a), len(other.a)))], [np.outer(other.b, self.c), other.a]])
        c = np.concatenate([other.d * self.c, other.c])
        return Filter(a, np.concatenate([self.b, other.b * self.d]), c, other.d * self.d)

    def response(self, s: Complex) -> Complex:
        """Return the transfer function (n,) at s (n,) [rad/s]."""
        states = np.linalg.solve(s[:, None, None] * np.eye(len(self.a)) - self.a, self.b[:, None])
        return np.asarray(self.d + states[:, :, 0] @ self.c)

    @classmethod
    def _section(cls, numerator: Real, denominator: Real) -> "Filter":
        """Return a section by its polynomials (3,), highest powers first."""
        (b0, b1, b2), (a0, a1, a2) = numerator.tolist(), denominator.tolist()
        if a0 == 0:
            return cls(np.array([[-a2]]), np.array([a2]), np.array([b2 / a2 - b1]), b1)
        w = np.sqrt(a2)
        a = np.array([[0.0, w], [-w, -a1]])
        return cls(a, np.array([0.0, w]), np.array([b2 / a2 - b0, (b1 - b0 * a1) / w]), b0)


def _sections(zeros: ArrayLike, poles: ArrayLike) -> Iterator[tuple[Real, Real]]:
    """Yield numerators and denominators (3,), highest powers first, of quotients of second order.

    As `scipy.signal.zpk2sos` does, of which the import takes half a second: poles stand with the nearest zeros.
    """
    pairs, single = _apart(poles)
    two = [*pairs, *(single[i : i + 2] for i in range(0, len(single), 2))]
    own: list[list[complex]] = [[] for _ in two]
    pairs, single = _apart(zeros)
    for group in [*pairs, *([one] for one in single)]:
        free = [i for i, one in enumerate(two) if len(own[i]) + len(group) <= len(one)]
        own[min(free, key=lambda i: min(abs(group[0] - pole) for pole in two[i]))] += group
    for roots in zip(own, two, strict=True):
        numerator, denominator = (np.pad(np.atleast_1d(np.real(np.poly(one))), (2 - len(one), 0)) for one in roots)
        yield numerator, denominator


def _apart(roots: ArrayLike) -> tuple[list[list[complex]], list[complex]]:
    """Return conjugate pairs, and real roots by size."""
    roots = np.asarray(roots)
    real = np.abs(np.imag(roots)) <= _ROUNDING * np.abs(roots)
    pairs = [[one, one.conjugate()] for one in roots[~real & (np.imag(roots) > 0)].tolist()]
    return pairs, sorted(np.real(roots[real]).tolist(), key=abs)

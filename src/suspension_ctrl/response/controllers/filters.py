"""Rational filters as chains of sections of first and second order, each scaled by its own frequency."""

from typing import Any, NamedTuple

import numpy as np

from ...quantities import Complex, Real


class Filter(NamedTuple):
    """A filter of one input and one output: x' = A x + b u, y = c x + d u."""

    a: Real  # (n, n)
    b: Real  # (n,)
    c: Real  # (n,)
    d: float

    @classmethod
    def of(cls, zeros: Real | Complex, poles: Real | Complex, gain: float) -> "Filter":
        """Return ``gain prod(s - zeros)/prod(s - poles)``, poles no fewer than zeros, conjugates in pairs."""
        from scipy.signal import zpk2sos

        chain, given = cls(np.empty((0, 0)), np.empty(0), np.empty(0), 1.0), (zeros, poles, 1.0)
        sections: Any = zpk2sos(*given, pairing="minimal", analog=True) if len(poles) else ()  # type: ignore[arg-type]
        for section in sections:
            b, a = section[:3], section[3:]
            corner = 1j * (np.sqrt(a[2]) if a[0] else a[2])
            size = np.abs(np.polyval(b, corner) / np.polyval(a, corner))  # states of all sections are of one size
            chain, gain = chain.before(cls._section(b / size, a)), float(gain * size)
        return chain._replace(c=gain * chain.c, d=gain * chain.d)

    @classmethod
    def of_system(cls, system: Any) -> "Filter":
        """Return a system of python-control, a transfer function or state space, of one input and one output."""
        zeros, poles = system.zeros(), system.poles()
        at = 1.0 + np.abs(np.concatenate([zeros, poles])).max(initial=0.0)  # beyond all of them
        gain = np.real(system(at) * np.prod((at - poles) / at) / np.prod((at - zeros) / at))
        return cls.of(zeros, poles, float(gain * at ** (len(poles) - len(zeros))))

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

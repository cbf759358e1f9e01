"""Mean-square responses of one strut: every integral is a polynomial in spring and damper over another."""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from ..quantities import Complex, Real
from .ports import Ports


class StrutLoop(NamedTuple):
    """Mean-square responses of any design of one strut, from one frequency response of the plant.

    With the strut D = K + jwC around the ports of the plant P, a response is
    ``P11 + P12 D (1 - P22 D)^-1 P21 = (a + b D) / (1 + c D)``, where a = P11, b = P12 P21 - P11 P22 and
    c = -P22. Both |a + b D|^2 and |1 + c D|^2 are linear in the terms 1, K, C, K^2, C^2 of a design. Only
    numerators that are not zero at every frequency are kept.

    Parameters
    ----------
    denominator : (5, n) ndarray
        Coefficients of |1 + c D|^2 at n frequencies.
    numerators : (q, n) ndarray
        Coefficients of |a + b D|^2, each times the density to integrate it with.
    response, term : (q,) ndarray
        Number of the response and of the term to which a numerator belongs.
    """

    denominator: Real
    numerators: Real
    response: NDArray[np.int64]
    term: NDArray[np.int64]

    @classmethod
    def around(cls, ports: Ports, omega: Real, densities: Real) -> "StrutLoop":
        """Take the ports of a plant with one strut on one road, at angular frequencies `omega` (n,) [rad/s].

        `densities` (m, n) hold for each response what multiplies its squared magnitude in the integral: the
        road's spectrum, times the squared weighting, times the quadrature weight.
        """
        p21, p22 = ports.h[:, -1, 0], ports.h[:, -1, 1]
        numerators = np.array(
            [
                density * _square_of_line(by_road, by_strut * p21 - by_road * p22, omega)
                for density, by_road, by_strut in zip(densities, *ports.h.T[:, : ports.m], strict=True)
            ]
        )
        response, term = np.nonzero(numerators.any(axis=2))
        return cls(_square_of_line(np.ones_like(p22), -p22, omega), numerators[response, term], response, term)


# The sums over frequencies may be taken in whatever order suits the processor, the same one for every design;
# numpy's error model leaves out a check for division by zero that would keep the loop from being vectorised.
@njit(cache=True, fastmath={"reassoc", "contract", "nsz"}, error_model="numpy")
def fill_mean_squares(design: Real, loop: StrutLoop, gain: Real, result: Real) -> None:
    """Put the mean squares (m,) of a design (K [N/m], C [N s/m]) in `result`; `gain` (n,) is for its use."""
    k, c = design[0], design[1]
    kk, cc = k * k, c * c
    d = loop.denominator
    for i in range(gain.size):
        gain[i] = 1.0 / (d[0, i] + d[1, i] * k + d[2, i] * c + d[3, i] * kk + d[4, i] * cc)
    result[:] = 0.0
    for q in range(loop.term.size):
        integral = 0.0
        for i in range(gain.size):
            integral += gain[i] * loop.numerators[q, i]
        result[loop.response[q]] += integral * (1.0, k, c, kk, cc)[loop.term[q]]


@njit(cache=True)
def loop_mean_squares(design: Real, loop: StrutLoop) -> Real:
    """Return the mean squares (m,) of one design (2,)."""
    result = np.empty(loop.response[-1] + 1)
    fill_mean_squares(design, loop, np.empty(loop.denominator.shape[1]), result)
    return result


@njit(cache=True)
def loop_mean_squares_of_all(designs: Real, loop: StrutLoop) -> Real:
    """Return the mean squares (p, m) of designs (p, 2), to the last bit those of each one alone."""
    results = np.empty((designs.shape[0], loop.response[-1] + 1))
    gain = np.empty(loop.denominator.shape[1])
    for i in range(designs.shape[0]):
        fill_mean_squares(designs[i], loop, gain, results[i])
    return results


def _square_of_line(a: Complex, b: Complex, omega: Real) -> Real:
    """Coefficients (5, n) of |a + b (K + jwC)|^2; the product K C has none, as K and jwC are at right angles."""
    return np.stack(
        [
            np.abs(a) ** 2,
            2 * (a.conj() * b).real,
            2 * (a.conj() * b * 1j * omega).real,
            np.abs(b) ** 2,
            omega**2 * np.abs(b) ** 2,
        ]
    )

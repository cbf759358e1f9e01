"""Responses of a vehicle to a random road: spectra of one design, and the strut loop of many at once."""

from typing import NamedTuple, Protocol

import control
import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray


class Road(Protocol):
    """What the road has to offer: its one-sided spectrum [m^2/Hz] over frequency [Hz] at a speed [m/s]."""

    def psd(self, f: ArrayLike, speed: float) -> NDArray[np.float64]:
        """Return the spectrum (n,) at the frequencies `f` (n,)."""


def frequency_responses(closed: control.StateSpace, f: NDArray[np.float64]) -> dict[str, NDArray[np.complex128]]:
    """Return H(w) from the road to every response of a vehicle with its struts.

    Parameters
    ----------
    closed : control.StateSpace
        Input ``road`` [m].
    f : (n,) ndarray
        Frequencies in ascending order [Hz].

    Returns
    -------
    dict of str to (n,) complex ndarray
        By response [response unit/m].
    """
    response = closed.frequency_response(2 * np.pi * f)
    return {name: response[name, "road"].frdata[0, 0] for name in closed.output_labels}


def response_psds(
    closed: control.StateSpace, f: NDArray[np.float64], road_psd: NDArray[np.float64]
) -> dict[str, NDArray[np.float64]]:
    """Return the spectrum of every response, |H(w)|^2 times the road's, equation (3).

    Parameters
    ----------
    closed, f
        As for `frequency_responses`.
    road_psd : (n,) ndarray
        The road's one-sided spectrum at these frequencies [m^2/Hz].

    Returns
    -------
    dict of str to (n,) ndarray
        One-sided spectrum by response [response unit^2/Hz].
    """
    return {name: np.abs(h) ** 2 * road_psd for name, h in frequency_responses(closed, f).items()}


def phase_degrees(h: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return the continuous phase of a response (n,) [deg], beginning between -90 and 270 degrees.

    A response that begins opposite to the road, at -180 or 180 degrees, so always begins at 180.
    """
    phase = np.degrees(np.unwrap(np.angle(h)))
    return phase + 360 if phase[0] < -90 else phase


def natural_frequencies(closed: control.StateSpace) -> NDArray[np.float64]:
    """Return the undamped natural frequencies of the oscillating modes, ascending [Hz]."""
    omega, damping, _ = control.damp(closed, doprint=False)
    return np.unique(np.round(omega[np.abs(damping) < 1], 9)) / (2 * np.pi)


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

    denominator: NDArray[np.float64]
    numerators: NDArray[np.float64]
    response: NDArray[np.int64]
    term: NDArray[np.int64]

    @classmethod
    def around(
        cls, plant: control.StateSpace, f: NDArray[np.float64], densities: dict[str, NDArray[np.float64]]
    ) -> "StrutLoop":
        """Take the frequency response of `plant` at `f` (n,) [Hz].

        `densities` holds for each response by name what multiplies its squared magnitude in the integral, (n,):
        the road's spectrum, times the squared weighting, times the quadrature weight.
        """
        omega = 2 * np.pi * f
        frequency_response = plant.frequency_response(omega)

        def path(output: str, source: str) -> NDArray[np.complex128]:
            return frequency_response[output, source].frdata[0, 0]

        p21, p22 = path("deflection", "road"), path("deflection", "strut")
        numerators = np.array(
            [
                density * _square_of_line(path(r, "road"), path(r, "strut") * p21 - path(r, "road") * p22, omega)
                for r, density in densities.items()
            ]
        )
        response, term = np.nonzero(numerators.any(axis=2))
        return cls(_square_of_line(np.ones_like(p22), -p22, omega), numerators[response, term], response, term)


# The sums over frequencies may be taken in whatever order suits the processor, the same one for every design;
# numpy's error model leaves out a check for division by zero that would keep the loop from being vectorised.
@njit(cache=True, fastmath={"reassoc", "contract", "nsz"}, error_model="numpy")
def fill_root_mean_squares(
    design: NDArray[np.float64], loop: StrutLoop, gain: NDArray[np.float64], result: NDArray[np.float64]
) -> None:
    """Put the root mean squares (m,) of a design (K [N/m], C [N s/m]) in `result`; `gain` (n,) is for its use."""
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
    for r in range(result.size):
        result[r] = np.sqrt(result[r])


@njit(cache=True)
def root_mean_squares(design: NDArray[np.float64], loop: StrutLoop) -> NDArray[np.float64]:
    """Return the root mean squares (m,) of one design (2,)."""
    result = np.empty(loop.response[-1] + 1)
    fill_root_mean_squares(design, loop, np.empty(loop.denominator.shape[1]), result)
    return result


@njit(cache=True)
def root_mean_squares_of_all(designs: NDArray[np.float64], loop: StrutLoop) -> NDArray[np.float64]:
    """Return the root mean squares (p, m) of designs (p, 2), to the last bit those of each one alone."""
    results = np.empty((designs.shape[0], loop.response[-1] + 1))
    gain = np.empty(loop.denominator.shape[1])
    for i in range(designs.shape[0]):
        fill_root_mean_squares(designs[i], loop, gain, results[i])
    return results


def _square_of_line(
    a: NDArray[np.complex128], b: NDArray[np.complex128], omega: NDArray[np.float64]
) -> NDArray[np.float64]:
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

"""Responses of a vehicle with its struts to a random road."""

import control
import numpy as np
from numpy.typing import NDArray


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

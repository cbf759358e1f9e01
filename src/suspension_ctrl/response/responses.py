"""Responses of a vehicle with its struts to a random road."""

from collections.abc import Sequence

import control
import numpy as np
from numpy.typing import NDArray


def road_paths(closed: control.LTI, f: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return H(w) from each road to each response of a vehicle with its struts.

    Parameters
    ----------
    closed : control.StateSpace or control.FrequencyResponseData
        Inputs: roads [m] and, where a tyre is damped, their rates [m/s], which follow them.
    f : (n,) ndarray
        Frequencies in ascending order [Hz].

    Returns
    -------
    (n, m, r) complex ndarray
        [response unit/m].
    """
    omega = 2 * np.pi * f
    h = np.moveaxis(closed.frequency_response(omega, squeeze=False).frdata, 2, 0)
    rates = sum(name.endswith("_rate") for name in closed.input_labels)
    roads = h.shape[2] - rates
    if rates:
        h = h[:, :, :roads] + 1j * omega[:, None, None] * h[:, :, roads:]
    return h


def frequency_responses(
    closed: control.LTI, f: NDArray[np.float64], delays: Sequence[float] = (0.0,)
) -> dict[str, NDArray[np.complex128]]:
    """Return H(w) to every response of a vehicle with its struts from a road that is alike on all its tracks.

    Parameters
    ----------
    closed, f
        As for `road_paths`.
    delays : (r,) sequence of float
        How long after the first wheel each meets the road [s].

    Returns
    -------
    dict of str to (n,) complex ndarray
        By response [response unit/m].
    """
    late = np.exp(-2j * np.pi * f[:, None] * np.asarray(delays))
    h = (road_paths(closed, f) * late[:, None, :]).sum(axis=2)
    return dict(zip(closed.output_labels, h.T, strict=True))


def response_psds(
    closed: control.LTI, f: NDArray[np.float64], road: NDArray[np.float64] | NDArray[np.complex128]
) -> dict[str, NDArray[np.float64]]:
    """Return the spectrum of every response, equation (3): under one wheel |H(w)|^2 times the road's.

    Parameters
    ----------
    closed, f
        As for `road_paths`.
    road : (n,) or (n, r, r) ndarray
        The road's one-sided spectrum at these frequencies, under several wheels their cross-spectra [m^2/Hz].

    Returns
    -------
    dict of str to (n,) ndarray
        One-sided spectrum by response [response unit^2/Hz].
    """
    h = road_paths(closed, f)
    psd = np.einsum("nmi,nij,nmj->mn", h, road.reshape(len(f), h.shape[2], h.shape[2]), h.conj()).real
    return dict(zip(closed.output_labels, psd, strict=True))


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

"""Modes of a vehicle with its struts, and what to call them."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import control
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd


_NAMES = {"body": "heave"}


class Mode(NamedTuple):
    """A mode: name, undamped frequency [Hz], damping ratio [-], complex amplitude (n,) of each coordinate."""

    name: str
    frequency: float
    damping_ratio: float
    shape: NDArray[np.complex128]

    @staticmethod
    def table(modes: Sequence["Mode"], coordinates: Sequence[str]) -> "pd.DataFrame":
        """Return a row for each mode."""
        import pandas as pd

        rows = [(mode.name, mode.frequency, mode.damping_ratio, *mode.shape) for mode in modes]
        return pd.DataFrame(rows, columns=["name", "frequency [Hz]", "damping ratio [-]", *coordinates])


def modes_of(closed: control.StateSpace, coordinates: Sequence[str], inertias: NDArray[np.float64]) -> list[Mode]:
    """Return the modes of a vehicle by rising frequency; a real pole is one with damping ratio 1.

    Parameters
    ----------
    closed : control.StateSpace
        Each coordinate and its rate are states beside each other.
    coordinates : (n,) sequence of str
    inertias : (n,) ndarray
        Mass or moment of inertia of each coordinate.
    """
    poles, vectors = np.linalg.eig(closed.A)
    modes = []
    for pole, vector in zip(poles, vectors.T, strict=True):
        if pole.imag >= 0:
            shape = vector[::2] / vector[::2][np.abs(vector[::2]).argmax()]
            damping_ratio = 1.0 if pole.imag == 0 else -pole.real / abs(pole)
            name = mode_name(shape, coordinates, inertias)
            modes.append(Mode(name, abs(pole) / (2 * np.pi), damping_ratio, shape.astype(complex)))
    return sorted(modes, key=lambda mode: mode.frequency)


def mode_name(shape: NDArray[np.complex128], coordinates: Sequence[str], inertias: NDArray[np.float64]) -> str:
    """Name a mode after the coordinate, or the two wheels of an axle, with the most kinetic energy in it.

    Wheels of an axle that move together hop, against each other they tramp.
    """
    energy: dict[str, float] = {}
    parts = [re.sub("_(left|right)_wheel$", "_wheel", name) for name in coordinates]
    for part, share in zip(parts, inertias * np.abs(shape) ** 2, strict=True):
        energy[part] = energy.get(part, 0.0) + share
    part = max(energy, key=lambda name: energy[name])
    if not part.endswith("wheel"):
        return _NAMES.get(part, part.replace("_", " "))
    pair = [shape[i] for i in range(len(parts)) if parts[i] == part]
    against = len(pair) == 2 and (pair[0] * pair[1].conj()).real < 0
    return f"{part} {'tramp' if against else 'hop'}".replace("_", " ")

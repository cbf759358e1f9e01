"""Modes of a vehicle with its struts, and their names."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import control
import numpy as np

from ..quantities import Complex, Real
from .assembly import Assembly

if TYPE_CHECKING:
    import pandas as pd


def modes_of(closed: control.StateSpace, assembly: Assembly) -> "pd.DataFrame":
    """Return `AssembledVehicle.modes`; each coordinate and its rate are states beside each other."""
    import pandas as pd

    poles, vectors = np.linalg.eig(closed.A)
    n = len(assembly.coordinates)
    rows: list[tuple[Any, ...]] = []
    for pole, vector in zip(poles, vectors[: 2 * n : 2].T, strict=True):
        if pole.imag >= 0:
            shape = (vector / vector[np.abs(vector).argmax()]).astype(complex)
            name = mode_name(shape, assembly.coordinates, np.diag(assembly.mass_matrix))
            damping_ratio = 1.0 if pole.imag == 0 else -pole.real / abs(pole)
            rows.append((name, abs(pole) / (2 * np.pi), damping_ratio, *shape))
    table = pd.DataFrame(rows, columns=["name", "frequency [Hz]", "damping ratio [-]", *assembly.coordinates])
    return table.sort_values("frequency [Hz]", kind="stable", ignore_index=True)


def mode_name(shape: Complex, coordinates: Sequence[str], inertias: Real) -> str:
    """Name a mode by the largest kinetic energy: a coordinate, or an axle's hop (in phase) or tramp (opposed)."""
    energy: dict[str, float] = {}
    parts = [re.sub("_(left|right)_wheel$", "_wheel", name) for name in coordinates]
    for part, share in zip(parts, inertias * np.abs(shape) ** 2, strict=True):
        energy[part] = energy.get(part, 0.0) + share
    part = max(energy, key=lambda name: energy[name])
    if not part.endswith("wheel"):
        return "heave" if part == "body" else part.replace("_", " ")
    pair = [shape[i] for i in range(len(parts)) if parts[i] == part]
    against = len(pair) == 2 and (pair[0] * pair[1].conj()).real < 0
    return f"{part} {'tramp' if against else 'hop'}".replace("_", " ")

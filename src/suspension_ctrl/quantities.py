"""Names and units of quantities: of parameters, of signals, in keys of files and headers of tables."""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]


def key_of(name: str, unit: str) -> str:
    """Return the key of a quantity: its name and its unit, ``""`` if it has none."""
    return "_".join([name, *unit.replace("^", "").replace("/", " per ").split()])


def signal_unit(signal: str) -> str:
    """Return the unit of a response or a deflection by its name as a signal, empty if that tells none."""
    if signal in ("pitch_acceleration", "roll_acceleration"):
        return "rad/s^2"
    if signal.endswith("acceleration") or signal.startswith("acceleration_at"):
        return "m/s^2"
    return {"travel": "m", "deflection": "m", "load": "N"}.get(signal.rsplit("_", 1)[-1], "")


_UNITS = {"mass": "kg", "inertia": "kg m^2", "stiffness": "N/m", "damping": "N s/m"}


def unit_of(parameter: str) -> str:
    """Return the unit of a vehicle's parameter, which its name tells: ``"body_mass"`` is in kg, a length in m."""
    return _UNITS.get(parameter.rsplit("_", 1)[-1], "m")


def column_headers(names: Sequence[str], units: Mapping[str, str]) -> list[str]:
    """Return each name with its unit in brackets, as in the header of a table: ``"SWS [m]"``."""
    return [f"{name} [{units[name]}]" if units.get(name) else name for name in names]

"""Tables of measured frequency responses as CSV files.

The first column is ``frequency [Hz]``; two more for each output and input are called as in
``body_acceleration/front_road real [m/s^2/m]`` and ``body_acceleration/front_road imag [m/s^2/m]``.
"""

import re
from itertools import product

import control
import numpy as np

from .. import checks
from ..quantities import Real, signal_unit

FREQUENCY = "frequency [Hz]"
_COLUMN = re.compile(r"([\w-]+)/(\w+) (real|imag) \[(.*)\]", re.ASCII)
_INPUT = re.compile(r"(?:\w+_)?(road|road_rate|strut)", re.ASCII)
_INPUT_UNITS = {"road": "m", "road_rate": "m/s", "strut": "N"}


def frequency_responses(names: list[str], values: Real) -> control.FrequencyResponseData:
    """Return the system of a table (n, c) with columns of these names; ValueError if it is none."""
    if names[:1] != [FREQUENCY]:
        raise ValueError(
            f"first column must be {FREQUENCY!r}, got {checks.shown(names[0]) if names else 'no names'}"
        )
    omega, names, values = 2 * np.pi * values[:, 0], names[1:], values[:, 1:]
    parts = dict(zip(map(_part, names), values.T, strict=True))
    if len(parts) < len(names):
        raise ValueError(f"columns must differ, got {checks.shown(max(names, key=names.count))} twice")
    if not parts:
        raise ValueError("there must be columns of responses, got none")
    outputs, inputs = (list(dict.fromkeys(part[i] for part in parts)) for i in (0, 1))
    for output, given, part in product(outputs, inputs, ("real", "imag")):
        if (output, given, part) not in parts:
            raise ValueError(f"columns must include {output}/{given} {part}, got none")
    h = [[parts[o, i, "real"] + 1j * parts[o, i, "imag"] for i in inputs] for o in outputs]
    return control.frd(h, omega, inputs=inputs, outputs=outputs)


def _part(name: str) -> tuple[str, str, str]:
    """Return output, input, and ``real`` or ``imag`` by the name of a column."""
    found = _COLUMN.fullmatch(name)
    if not found:
        raise ValueError(
            f"column must be like 'body_acceleration/front_road real [m/s^2/m]', got {checks.shown(name)}"
        )
    output, given, part, unit = found.groups()
    kind = _INPUT.fullmatch(given)
    if not kind:
        raise ValueError(f"input must be like 'front_road' or 'front_strut', got {checks.shown(given)}")
    if not signal_unit(output):
        known = "'body_acceleration', 'acceleration_at_1200_-400_mm', 'front_tyre_load' or 'front_deflection'"
        raise ValueError(f"output must be like {known}, got {checks.shown(output)}")
    right = f"{signal_unit(output)}/{_INPUT_UNITS[kind[1]]}"
    if unit != right:
        raise ValueError(f"column {output}/{given} {part} must be in {right}, got {checks.shown(unit)}")
    return output, given, part

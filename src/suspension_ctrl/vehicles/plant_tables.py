"""Tables of frequency responses as CSV files.

The first column is ``frequency [Hz]``; two more for each output and input are called as in
``body_acceleration/front_road real [m/s^2/m]`` and ``body_acceleration/front_road imag [m/s^2/m]``.
"""

import re
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import control
import numpy as np

from .. import checks
from ..quantities import Real, signal_unit
from ..tables import read_table

if TYPE_CHECKING:
    import pandas as pd

FREQUENCY = "frequency [Hz]"
_COLUMN = re.compile(r"([\w-]+)/(\w+) (real|imag) \[(.*)\]", re.ASCII)
_INPUT = re.compile(r"(?:\w+_)?(road|road_rate|strut)", re.ASCII)
_INPUT_UNITS = {"road": "m", "road_rate": "m/s", "strut": "N"}


def read_responses(path: Path) -> control.FrequencyResponseData:
    """Return the system of a CSV file."""
    return frequency_responses(*read_table(path))


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


def response_table(system: control.FrequencyResponseData) -> "pd.DataFrame":
    """Return the table from which `frequency_responses` makes the system; ValueError for other signals."""
    import pandas as pd

    columns = {FREQUENCY: system.omega / (2 * np.pi)}
    for output, given in product(system.output_labels, system.input_labels):
        values = system.frdata[system.output_labels.index(output), system.input_labels.index(given)]
        unit = f"{signal_unit(output)}/{input_unit(given)}"
        for part, numbers in (("real", values.real), ("imag", values.imag)):
            column = f"{output}/{given} {part} [{unit}]"
            _part(column)
            columns[column] = numbers
    return pd.DataFrame(columns)


def input_unit(name: str) -> str:
    """Return the unit of an input by its name, ``""`` if it is no road or strut."""
    found = _INPUT.fullmatch(name)
    return _INPUT_UNITS[found[1]] if found else ""


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

"""Frequency responses of vehicles without their struts, as CSV files.

Inputs are called ``<wheel>_road`` [m] and ``<strut>_strut``, its tension [N]; outputs ``<place>_acceleration``
[m/s^2], of ``pitch`` and ``roll`` [rad/s^2], ``acceleration_at_1200_-400_mm`` [m/s^2] of a point of the body,
``<tyre>_tyre_load`` [N] and ``<strut>_deflection`` [m]. Struts, wheels and tyres in one place have one name, which
is left out together with the underscore where there is one wheel only. Signs are those of `vehicles`.

A file has a column ``frequency [Hz]`` and for each output by each input two columns, such as
``front_deflection/rear_strut real [m/N]`` and ``front_deflection/rear_strut imag [m/N]``.
"""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .assembly import Response
from .csv_tables import read_table
from .signals import signal_unit

if TYPE_CHECKING:
    from os import PathLike

Transfer = dict[tuple[str, str], NDArray[np.complex128]]
"""Frequency responses (n,) by output and input."""

FREQUENCY = "frequency [Hz]"
_COLUMN = re.compile(r"([\w-]+)/(\w+) (real|imag) \[(.*)\]", re.ASCII)
_INPUT = re.compile(r"(?:(\w+)_)?(road|strut)", re.ASCII)
_OUTPUT = re.compile(r"(?:(\w+)_)?(acceleration|tyre_load|deflection)", re.ASCII)
_POINT = re.compile(r"acceleration_at_(-?\d{1,6})_(-?\d{1,6})_mm", re.ASCII)
_KINDS = {"acceleration": "acceleration", "tyre_load": "load", "deflection": "travel"}


class Input(NamedTuple):
    """A ``road`` or a ``strut``, and its name."""

    kind: str
    where: str

    @property
    def unit(self) -> str:
        """Its unit."""
        return {"road": "m", "strut": "N"}[self.kind]


def input_of(name: str) -> Input:
    """Return which input a name means; ValueError if none."""
    found = _INPUT.fullmatch(name)
    if not found:
        raise ValueError(f"input must be like 'front_road' or 'front_strut', got {name!r}")
    return Input(found[2], found[1] or "")


def output_of(name: str) -> Response:
    """Return which output a name means, of a deflection the travel; ValueError if none."""
    if point := _POINT.fullmatch(name):
        return Response("acceleration", (int(point[1]) / 1e3, int(point[2]) / 1e3))
    found = _OUTPUT.fullmatch(name)
    if not found or name == "acceleration":
        raise ValueError(
            "output must be like 'body_acceleration', 'acceleration_at_1200_-400_mm', 'front_tyre_load' or "
            f"'front_deflection', got {name!r}"
        )
    return Response(_KINDS[found[2]], found[1] or "")


def read_plant(path: "str | PathLike[str]") -> tuple[NDArray[np.float64], Transfer]:
    """Read a table.

    Parameters
    ----------
    path : path-like
        CSV file (see `plant_tables`).

    Returns
    -------
    (n,) ndarray, dict of (str, str) to (n,) complex ndarray
        Lines [Hz], and frequency responses by output and input.

    Raises
    ------
    ValueError
        Naming the file, if columns are missing, unknown, there twice or of another unit, or a cell is no finite
        number.
    OSError
        If the file cannot be read.
    """
    names, values = read_table(path)
    if names[0] != FREQUENCY:
        raise ValueError(f"{path}: first column must be {FREQUENCY!r}, got {names[0]!r}")
    try:
        return values[:, 0], _transfer(names[1:], values[:, 1:])
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _transfer(names: Sequence[str], values: NDArray[np.float64]) -> Transfer:
    parts = {}
    for name, column in zip(names, values.T, strict=True):
        part = _part(name)
        if part in parts:
            raise ValueError(f"column must be there once, got {name!r} twice")
        parts[part] = column
    for output, given, which in parts:
        other = "imag" if which == "real" else "real"
        if (output, given, other) not in parts:
            raise ValueError(f"column {output}/{given} {which} must have one beside it called {other}, got none")
    pairs = dict.fromkeys((output, given) for output, given, _ in parts)
    return {pair: parts[*pair, "real"] + 1j * parts[*pair, "imag"] for pair in pairs}


def _part(name: str) -> tuple[str, str, str]:
    """Return what is in a column: output, input and whether the real or the imaginary part."""
    found = _COLUMN.fullmatch(name)
    if not found:
        raise ValueError(f"column must be like 'body_acceleration/front_road real [m/s^2/m]', got {name!r}")
    output, given, part, unit = found.groups()
    output_of(output)  # whether it is one
    right = f"{signal_unit(output)}/{input_of(given).unit}"
    if unit != right:
        raise ValueError(f"column {output}/{given} {part} must be in {right}, got {unit!r}")
    return output, given, part

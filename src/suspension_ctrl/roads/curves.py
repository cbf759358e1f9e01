"""Profiles and spectra of roads as CSV files, whose columns carry units in their names.

A profile has ``distance [m]`` and ``height [m]``, or ``left [m]`` and ``right [m]``, or for tracks anywhere
columns such as ``height at y = 0.75 m [m]``. A spectrum has ``wavenumber [cycle/m]`` and ``psd [m^3]``, a
coherence ``wavenumber [cycle/m]`` and ``coherence [-]``. Lines that start with ``#`` say where the
numbers are from.
"""

import csv
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .. import checks
from ..tables import read_table, table_rows
from .profiles import Profile

if TYPE_CHECKING:
    from os import PathLike


DISTANCE, HEIGHT, LEFT, RIGHT = "distance [m]", "height [m]", "left [m]", "right [m]"
WAVENUMBER, PSD, COHERENCE = "wavenumber [cycle/m]", "psd [m^3]", "coherence [-]"
_TRACK = re.compile(r"height at y = (-?\d+(?:\.\d+)?(?:e-?\d+)?) m \[m\]", re.ASCII)
_TRACK_COLUMN = "height at y = {} m [m]"


def read_profile(path: "str | PathLike[str]", track_width: float | None = None) -> Profile:
    """Read a profile.

    Parameters
    ----------
    path : path-like
        CSV file with the columns of a profile.
    track_width : float, optional
        Distance of the tracks in columns ``left [m]`` and ``right [m]``, which need it [m].

    Returns
    -------
    Profile
        With its tracks in the order of the columns.

    Raises
    ------
    ValueError
        Naming the file, if columns are missing, unknown or of another unit, a cell is no finite number, the
        distances do not ascend evenly (see `Profile`) or the width does not fit.
    OSError
        If the file cannot be read.
    """
    names, values = read_table(path)
    if names[:1] != [DISTANCE] or len(names) < 2:
        raise ValueError(f"{path}: first column must be {DISTANCE!r} and then heights, got {names}")
    try:
        return Profile(values[:, 0], values[:, 1:], _tracks(names[1:], track_width))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def write_profile(path: "str | PathLike[str]", profile: Profile) -> None:
    """Write a profile for `read_profile`, which returns the very same numbers."""
    names = [_TRACK_COLUMN.format(np.format_float_positional(y, trim="-")) for y in profile.tracks]
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([DISTANCE, *([HEIGHT] if profile.tracks == (0.0,) else names)])
        writer.writerows(np.column_stack([profile.distance, profile.height]).tolist())


def read_curve(path: "str | PathLike[str]", quantity: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read a curve over wavenumber.

    Parameters
    ----------
    path : path-like
        CSV file with the columns ``wavenumber [cycle/m]`` and `quantity`.
    quantity : str
        Name of the other column, `PSD` or `COHERENCE`.

    Returns
    -------
    (k,) ndarray, (k,) ndarray
        Wavenumbers, ascending and above zero [cycle/m], and the quantity, finite.

    Raises
    ------
    ValueError
        Naming the file, if the columns are others, a cell is no finite number or the wavenumbers are not as above.
    OSError
        If the file cannot be read.
    """
    names, values = read_table(path)
    if names != [WAVENUMBER, quantity]:
        raise ValueError(f"{path}: columns must be {WAVENUMBER!r} and {quantity!r}, got {names}")
    n = values[:, 0]
    wrong = np.flatnonzero(~(np.diff(n, prepend=0.0) > 0))
    if wrong.size:
        raise ValueError(
            f"{path}: {WAVENUMBER} must be above zero and ascend, got {n[wrong[0]]} in row {wrong[0] + 1}"
        )
    return n, values[:, 1]


def columns(path: "str | PathLike[str]") -> list[str]:
    """Return the names of a file's columns; raises as `read_profile`."""
    return table_rows(path)[0]


def _tracks(names: Sequence[str], width: float | None) -> tuple[float, ...]:
    """Where the tracks of the height columns are [m]."""
    if names == [LEFT, RIGHT]:
        if width is None:
            raise ValueError(f"{LEFT!r} and {RIGHT!r} need a track width in m, got none")
        checks.positive("track width", width, "m")
        return width / 2, -width / 2
    if width is not None:
        raise ValueError(f"a track width goes with {LEFT!r} and {RIGHT!r} only, got {list(names)}")
    if names == [HEIGHT]:
        return (0.0,)
    found = [_TRACK.fullmatch(name) for name in names]
    for name, match in zip(names, found, strict=True):
        if match is None:
            raise ValueError(
                f"columns after {DISTANCE!r} must be {HEIGHT!r}, or {LEFT!r} and {RIGHT!r}, or all like "
                f"{_TRACK_COLUMN.format(0.75)!r}, got {name!r}"
            )
    return tuple(float(match[1]) for match in found if match)

"""Histories of acceleration from CSV or RPC III files: a column for each axis with its unit, and even times.

Headers are such as ``time [ms]``, ``z [g]``, ``seat x [m/s^2]``; round brackets are allowed. Other columns do not
count.
"""

from collections.abc import Mapping, Sequence
from os import PathLike

from .. import checks
from ..documents import naming
from ..quantities import Real, quantity
from ..tables.headers import name_and_unit
from .axes import AXES
from .human_exposure import axis_of
from .recordings import even_step, read_recording

TIME = ("time", "t")
_UNIT_OF = {"roll": "rad/s^2", "pitch": "rad/s^2", "yaw": "rad/s^2"}


def read_accelerations(
    path: str | PathLike[str],
    axes: Mapping[str, str] | None = None,
    time_step: float | None = None,
    columns: Sequence[str] | None = None,
) -> tuple[dict[str, Real], float]:
    """Return histories (n,) by axis [m/s^2, rad/s^2] and their time step [s].

    `axes` gives axes by the names of columns that are not called like them. A file without times needs the step,
    one without headers the names of all `columns`, with units. ValueError names the file.
    """
    named = {_plain(column): axis_of(axis) for column, axis in (axes or {}).items()}
    headers, values = read_recording(path, lambda names: _wanted(names, named), columns)
    with naming(path):
        if not headers:
            raise ValueError("columns must have names, in a header or given for all such as 'z [g]', got none")
        step, histories = time_step, dict[str, Real]()
        for header, column in zip(headers, values.T, strict=True):
            name, unit = _parts(header)
            if name in TIME and name not in named:
                if step is not None:
                    needed = "one column, or time_step without one"
                    raise ValueError(f"time must be {needed}, got {checks.shown(header)}")
                step = even_step(column * _factor(header, unit, "s"))
                continue
            axis = named.get(name) or axis_of(name)
            if axis in histories:
                raise ValueError(f"columns must have each axis once, got {axis} twice")
            column *= _factor(header, unit, _UNIT_OF.get(axis.split()[1], "m/s^2"))  # in place: files are large
            histories[axis] = column
        if step is None:
            raise ValueError(
                "columns must include a time such as 'time [s]', or time_step must be given, got none"
            )
        return histories, step


def _wanted(names: Sequence[str], named: Mapping[str, str]) -> list[int]:
    """Return the indices of times and axes; ValueError if there is no axis, or a named column is missing."""
    known = [_parts(header)[0] for header in names]
    if missing := named.keys() - set(known):
        raise ValueError(f"columns must include {min(missing)!r}, got {checks.shown(list(names))}")
    axes = [name for name in known if name in named or _is_axis(name)]
    if not axes:
        needed = "an axis such as 'z [m/s^2]' or 'seat x [g]', or one must be named by axes"
        raise ValueError(f"columns must include {needed}, got {checks.shown(list(names))}")
    return [i for i, name in enumerate(known) if name in axes or name in TIME]


def _is_axis(name: str) -> bool:
    return name in AXES or f"seat {name}" in AXES


def _plain(name: str) -> str:
    """Return a name in lower case, with blanks for underscores."""
    return " ".join(name.lower().replace("_", " ").split())


def _parts(header: str) -> tuple[str, str]:
    """Return plain name and unit of a header."""
    name, unit = name_and_unit(header)
    return _plain(name), unit


def _factor(header: str, unit: str, needed: str) -> float:
    """Return the factor of a column to the unit that is needed; ValueError for another dimension or none."""
    if not unit:
        raise ValueError(f"columns must have their units, as in '{header} [{needed}]', got {checks.shown(header)}")
    return quantity(f"unit of {checks.shown(header)}", f"1 {unit}", needed)
